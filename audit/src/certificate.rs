//! What is taken from a certificate: the text, and what is claimed of it. The programs,
//! the edits and the parts of the bounds in it are not looked at.

use serde::Deserialize;

use crate::fault::Fault;
use crate::scene::Ranges;

/// The longest file.
const MOST_BYTES: usize = 16 << 20;
/// The most certificates of a file.
const MOST_CERTIFICATES: usize = 16;

/// The fields that are read; numbers are null where they are infinite.
#[derive(Clone, Debug, Deserialize)]
struct Document {
    certificate: u32,
    #[serde(default)]
    scene: Option<String>,
    function: String,
    rows: Vec<usize>,
    scalar: String,
    position: Vec<[f64; 2]>,
    velocity: Vec<[f64; 2]>,
    acceleration: Vec<[f64; 2]>,
    scale: Vec<Option<f64>>,
    #[serde(default)]
    relative_to: Option<String>,
    total: Vec<Option<f64>>,
    text: String,
}

/// The functions that are audited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// τ = D q̈ + h + c + b∘q̇
    InverseDynamics,
    /// c
    Gravity,
    /// D, row by row
    Inertia,
    /// h
    Coriolis,
}

impl Function {
    /// All of them with their names.
    const NAMES: [(&'static str, Function); 4] = [
        ("inverse_dynamics", Function::InverseDynamics),
        ("gravity", Function::Gravity),
        ("inertia", Function::Inertia),
        ("coriolis", Function::Coriolis),
    ];
}

/// A claim: at every state of the box, each output of the text is within E·T of the
/// function.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The scene, if there is one.
    pub scene: Option<String>,
    /// The name of the function.
    pub name: String,
    /// The same.
    pub function: Function,
    /// The joints, from zero, that results are over.
    pub rows: Vec<usize>,
    /// Whether it is in f32; else it is in f64.
    pub is_single: bool,
    /// The box.
    pub ranges: Ranges,
    /// T, one an output, in the output's unit.
    pub scale: Vec<f64>,
    /// What T is: `actuator` or `range`.
    pub relative_to: Option<String>,
    /// E, one an output.
    pub total: Vec<f64>,
    /// The text of the function.
    pub text: String,
}

/// Reads a certificate, or a list of them.
///
/// # Errors
/// What is no certificate of format 2, or of a function that is not audited.
pub fn read(text: &str) -> Result<Vec<Claim>, Fault> {
    if text.len() > MOST_BYTES {
        return Err(Fault::certificate(format!("more than {MOST_BYTES} bytes")));
    }
    let documents: Result<Vec<Document>, serde_json::Error> = match text.trim_start().starts_with('[') {
        true => serde_json::from_str(text),
        false => serde_json::from_str(text).map(|one| vec![one]),
    };
    let documents = documents.map_err(|error| Fault::certificate(error.to_string()))?;
    if !(1..=MOST_CERTIFICATES).contains(&documents.len()) {
        let why = format!("1 to {MOST_CERTIFICATES} in a file, not {}", documents.len());
        return Err(Fault::certificate(why));
    }
    documents.into_iter().map(claim).collect()
}

fn claim(document: Document) -> Result<Claim, Fault> {
    if document.certificate != 2 {
        let why = format!("expected format 2, not {}", document.certificate);
        return Err(Fault::certificate(why));
    }
    let name = document.function;
    let function = Function::NAMES.iter().find(|(known, _)| *known == name);
    let known: Vec<&str> = Function::NAMES.iter().map(|(known, _)| *known).collect();
    let function = function.ok_or_else(|| {
        let known = known.join(", ");
        Fault::certificate(format!("`{name}` is not audited; these are: {known}"))
    })?;
    let is_single = match document.scalar.as_str() {
        "f32" => true,
        "f64" => false,
        other => return Err(Fault::certificate(format!("`{other}` is neither f32 nor f64"))),
    };
    let joints = document.position.len();
    let row = |&row: &usize| (1..=joints).contains(&row).then(|| row - 1);
    let rows: Option<Vec<usize>> = document.rows.iter().map(row).collect();
    let rows = rows.ok_or_else(|| Fault::certificate("`rows` are no joints"))?;
    let outputs = match function.1 {
        Function::Inertia => rows.len() * rows.len(),
        _ => rows.len(),
    };
    let numbers = |list: Vec<Option<f64>>, field: &str| match list.len() == outputs {
        true => Ok(list.into_iter().map(|x| x.unwrap_or(f64::INFINITY)).collect()),
        false => Err(Fault::certificate(format!("`{field}`: expected {outputs} numbers"))),
    };
    Ok(Claim {
        scene: document.scene,
        function: function.1,
        name,
        rows,
        is_single,
        ranges: Ranges {
            position: document.position,
            velocity: document.velocity,
            acceleration: document.acceleration,
        },
        scale: numbers(document.scale, "scale")?,
        relative_to: document.relative_to,
        total: numbers(document.total, "total")?,
        text: document.text,
    })
}
