//! Certificates read from their files.

use std::path::Path;

use dalembert_codegen::certify::certificate::{Certificate, Split};
use dalembert_codegen::certify::edits::Stage;
use dalembert_codegen::certify::input_box::InputBox;
use dalembert_codegen::certify::interval::Interval;
use dalembert_codegen::certify::json::{VERSION, read_edit, read_program, read_sines, text_hash};
use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::plan::SceneKey;
use dalembert_codegen::sincos::proof::Errors;
use dalembert_model::scene::Scale;
use serde_json::Value;

use crate::input;
use crate::outcome::Failure;

/// The largest certificate that is read.
const MOST_BYTES: u64 = 64 << 20;

/// Reads certificates: one, or a list. Nothing in them is trusted: [`Certificate::check`] does
/// the rest.
pub(super) fn read(path: &Path) -> Result<Vec<(Certificate, Value)>, Failure> {
    let name = path.display();
    let fail = |why: String| Failure::Input(format!("error: {name}: {why}"));
    let bytes = input::bytes(path, MOST_BYTES)?;
    let json: Value = serde_json::from_slice(&bytes).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        Failure::Input(format!("error: {error}\n --> {name}:{line}:{column}"))
    })?;
    let several = json.as_array().map(Vec::as_slice);
    let all = several.unwrap_or(std::slice::from_ref(&json));
    if all.is_empty() {
        return Err(fail("there is no certificate in it".into()));
    }
    let read = all.iter().map(|json| Ok((parse(json)?, json.clone())));
    let read: Result<Vec<_>, String> = read.collect();
    read.map_err(fail)
}

/// What is claimed of an angle's polynomials.
fn sine(json: &Value) -> Option<(String, String, Interval, Errors)> {
    let text = |key| json.get(key)?.as_str().map(str::to_owned);
    let range = json.get("range")?.as_array()?;
    let [low, high] = range.as_slice() else {
        return None;
    };
    let range = Interval::new(low.as_f64()?, high.as_f64()?)?;
    let (sin, cos) = (json.get("sin")?.as_f64()?, json.get("cos")?.as_f64()?);
    Some((text("angle")?, text("form")?, range, Errors { sin, cos }))
}

fn parse(json: &Value) -> Result<Certificate, String> {
    let field = |key: &str| json.get(key).ok_or_else(|| format!("`{key}` is missing"));
    if field("certificate")?.as_u64() != Some(VERSION.into()) {
        return Err(format!(
            "this version reads certificates of version {VERSION}"
        ));
    }
    let text = |key: &str| {
        let text = field(key)?.as_str().map(str::to_owned);
        text.ok_or_else(|| format!("`{key}` is no text"))
    };
    let list = |key: &str| {
        let list = field(key)?.as_array();
        list.ok_or_else(|| format!("`{key}` is no list"))
    };
    let numbers = |key: &str| {
        // null stands for a bound that says nothing.
        let number = |value: &Value| value.as_f64().or(value.is_null().then_some(f64::INFINITY));
        let numbers: Option<Vec<f64>> = list(key)?.iter().map(number).collect();
        numbers.ok_or_else(|| format!("`{key}` has an entry that is no number"))
    };
    let ranges = |key: &str| {
        let range = |value: &Value| {
            let [low, high] = value.as_array()?.as_slice() else {
                return None;
            };
            Interval::new(low.as_f64()?, high.as_f64()?)
        };
        let ranges: Option<Vec<Interval>> = list(key)?.iter().map(range).collect();
        ranges.ok_or_else(|| format!("`{key}` has an entry that is no range"))
    };
    let (model, sincos, rounding) = (numbers("model")?, numbers("sincos")?, numbers("rounding")?);
    if model.len() != sincos.len() || model.len() != rounding.len() {
        return Err("`model`, `sincos` and `rounding` differ in length".into());
    }
    let parts = model.iter().zip(&sincos).zip(&rounding);
    let bounds = parts.map(|((&model, &sincos), &rounding)| Split {
        model,
        sincos,
        rounding,
    });
    let mut stages = Vec::new();
    for stage in list("stages")? {
        let missing = || "a stage needs `program` and `edits`".to_owned();
        let program = stage
            .get("program")
            .and_then(Value::as_str)
            .ok_or_else(missing)?;
        let program = read_program(program)?;
        let edits = stage
            .get("edits")
            .and_then(Value::as_array)
            .ok_or_else(missing)?;
        let edits: Result<Vec<_>, String> = edits
            .iter()
            .map(|edit| read_edit(edit.as_str().unwrap_or_default(), &program))
            .collect();
        let edits = edits?;
        stages.push(Stage { program, edits });
    }
    let printed = text("text")?;
    if text("text_hash")? != text_hash(&printed) {
        return Err("`text_hash` is not the hash of `text`".into());
    }
    let word = text("scalar")?;
    let scalar = ScalarType::from_name(&word).ok_or_else(|| format!("`{word}` is no scalar"))?;
    let emitted = read_program(&text("emitted")?)?;
    let claims = match json.get("polynomials") {
        None => Vec::new(),
        Some(_) => list("polynomials")?
            .iter()
            .map(sine)
            .collect::<Option<_>>()
            .ok_or("an entry of `polynomials` needs `angle`, `form`, `range`, `sin` and `cos`")?,
    };
    Ok(Certificate {
        robot: text("robot")?,
        input: text("input")?,
        scene: match json.get("scene") {
            None => None,
            Some(_) => Some(SceneKey {
                name: text("scene")?,
                hash: text("scene_hash")?,
            }),
        },
        relative_to: match json.get("relative_to") {
            None => None,
            Some(_) => {
                let word = text("relative_to")?;
                let scale = Scale::WORDS.into_iter().find(|(known, _)| *known == word);
                let scale = scale.ok_or_else(|| format!("`{word}` is no scale"))?;
                Some(scale.1)
            }
        },
        scalar,
        limits: InputBox {
            position: ranges("position")?,
            velocity: ranges("velocity")?,
            acceleration: ranges("acceleration")?,
        },
        scales: numbers("scale")?,
        stages,
        sines: read_sines(&printed, emitted.function, scalar, claims)?,
        emitted,
        text: printed,
        bounds: bounds.collect(),
        lambda_min: match json.get("lambda_min") {
            None => None,
            Some(value) => Some(value.as_f64().ok_or("`lambda_min` is no number")?),
        },
    })
}
