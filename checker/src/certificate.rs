//! What is taken from a certificate: the text, and what is claimed of it. The programs,
//! the edits and the parts of the bounds in it are not looked at.

use serde::Deserialize;

use crate::fault::Fault;
use crate::file::results;
use crate::quantity::Function;

/// The longest file, and the most certificates in it.
const MOST_BYTES: usize = 16 << 20;
const MOST_CLAIMS: usize = 16;

/// A claim: at every state of the box, each output of the text is within E·T of the
/// function. Other fields of the file are not read.
#[derive(Clone, Debug, Default, Deserialize)]
pub struct Claim {
    /// The version of the format.
    certificate: u32,
    /// The scene, if there is one.
    #[serde(default)]
    pub scene: Option<String>,
    /// The name of the function.
    pub function: String,
    /// The joints, from one, that results are over.
    pub rows: Vec<usize>,
    /// `f64` or `f32`
    pub scalar: String,
    /// The ranges of q, rad or m.
    pub position: Vec<[f64; 2]>,
    /// The ranges of q̇, rad/s or m/s.
    pub velocity: Vec<[f64; 2]>,
    /// The ranges of q̈, rad/s² or m/s².
    pub acceleration: Vec<[f64; 2]>,
    /// T, one an output, in the output's unit.
    pub scale: Vec<f64>,
    /// What T is: `actuator` or `range`.
    #[serde(default)]
    pub relative_to: Option<String>,
    /// E, one an output; null where nothing is claimed.
    pub total: Vec<Option<f64>>,
    /// The text of the function.
    pub text: String,
}

impl Claim {
    /// Returns the function; where the text returns a struct of another name, the bundle of its fields.
    ///
    /// # Errors
    /// It is none of those that are checked, or returns what they do not.
    pub fn function(&self) -> Result<Function, Fault> {
        if let Some(known) = Function::named(&self.function) {
            return Ok(known);
        }
        let rows = self.rows.len();
        let returned = results(&self.function, &self.text);
        let why = match Function::bundle(&returned, rows) {
            Ok(bundle) if !returned.is_empty() => return Ok(bundle),
            Ok(_) => "no recursion here gives it".to_owned(),
            Err(result) => format!("it returns `{result}`"),
        };
        let why = format!("`{}` is not checked: {why}", self.function);
        Err(Fault::certificate(why))
    }

    /// Returns the rows, from zero.
    pub(crate) fn rows(&self) -> Vec<usize> {
        self.rows.iter().map(|row| row - 1).collect()
    }

    /// Returns whether the fields are of one claim.
    ///
    /// # Errors
    /// The first that is not, with what was expected.
    pub(crate) fn whole(&self) -> Result<(), Fault> {
        let count = self.rows.len();
        let outputs = self.function()?.places(count.min(64)).len();
        let is_bound = |total: &Option<f64>| total.is_some_and(|e| (0.0..1.0).contains(&e));
        let known = ["f64", "f32"].contains(&self.scalar.as_str());
        let has_rows = count < 64 && !self.rows.contains(&0);
        let has_total = self.total.len() == outputs && self.total.iter().all(is_bound);
        let (has_format, has_scale) = (self.certificate == 2, self.scale.len() == outputs);
        Fault::unless(has_format, "`certificate`: expected format 2")?;
        Fault::unless(known, "`scalar`: expected f64 or f32")?;
        Fault::unless(has_rows, "`rows`: expected joints, from 1")?;
        Fault::unless(has_scale, "`scale`: expected one an output")?;
        let why = "`total`: expected E, from zero to below one, one an output";
        Fault::unless(has_total, why)
    }
}

/// Reads a certificate, or a list of them.
///
/// # Errors
/// What has not a certificate's fields; what they say is for [`crate::audit`] to judge.
pub fn read(text: &str) -> Result<Vec<Claim>, Fault> {
    let why = format!("more than {MOST_BYTES} bytes");
    Fault::unless(text.len() <= MOST_BYTES, &why)?;
    let read: Result<Vec<Claim>, serde_json::Error> = match text.trim_start().starts_with('[') {
        true => serde_json::from_str(text),
        false => serde_json::from_str(text).map(|one| vec![one]),
    };
    let claims = read.map_err(|error| Fault::certificate(error.to_string()))?;
    let why = format!("1 to {MOST_CLAIMS} in a file, not {}", claims.len());
    Fault::unless((1..=MOST_CLAIMS).contains(&claims.len()), &why)?;
    Ok(claims)
}
