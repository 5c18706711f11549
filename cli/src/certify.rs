//! `dalembert certify`: a certificate checked again, part by part.

use std::path::Path;

use dalembert_codegen::certify::attack::attack;
use dalembert_codegen::certify::certificate::{Certificate, Split};
use dalembert_codegen::certify::edits::Stage;
use dalembert_codegen::certify::input_box::InputBox;
use dalembert_codegen::certify::interval::Interval;
use dalembert_codegen::certify::json::{VERSION, read_edit, read_program, read_sines, text_hash};
use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::generate::GenerateError;
use dalembert_codegen::plan::SceneKey;
use dalembert_codegen::scene::Setting;
use dalembert_codegen::sincos::proof::Errors;
use dalembert_model::read::Reading;
use dalembert_model::scene::{Scale, Scene};
use serde_json::Value;

use crate::args::CertifyArgs;
use crate::generate::report;
use crate::outcome::{Failure, Outcome};
use crate::{input, output};

/// The largest certificate that is read.
const MOST_BYTES: u64 = 64 << 20;

/// Characters of a field that a message shows.
const MOST_SHOWN: usize = 160;

/// Runs the subcommand.
pub fn run(args: &CertifyArgs) -> Outcome {
    let reading = input::reading(&args.robot)?;
    let certificates = read(&args.certificate)?;
    for (certificate, json) in &certificates {
        one(args, &reading, certificate, json)?;
    }
    Ok(())
}

fn one(args: &CertifyArgs, reading: &Reading, certificate: &Certificate, json: &Value) -> Outcome {
    let name = args.certificate.display();
    let own = certificate.scene.as_ref().map(|scene| &scene.name);
    let scene = args.scene.as_ref().or(own);
    let scene = scene.map(|scene| input::scene(&args.robot, reading, scene));
    let scene = scene.transpose()?;
    // What `tradeoff` finds for other tolerances is about the scene without its.
    let bare = scene.map(Scene::without_tolerance);
    let is_bare = certificate.scene == bare.as_ref().map(SceneKey::of);
    let scene = if is_bare { bare.as_ref() } else { scene };
    let setting = Setting::of(&reading.robot, scene).map_err(GenerateError::Scene)?;
    let checked = certificate
        .check_in(&setting)
        .map_err(|why| Failure::Check(format!("error: {name}: {why}")))?;
    complete(certificate, json).map_err(|why| Failure::Check(format!("error: {name}: {why}")))?;
    let of = scene.map_or_else(String::new, |scene| format!(" in scene {}", scene.name));
    let mut text = format!(
        "{name} holds for `{}` in {} of {}{of}\n  {}\n",
        certificate.emitted.function, certificate.scalar, reading.robot.name, checked.proof
    );
    text += &over(certificate);
    for finding in &checked.findings {
        text += &format!("warning: {finding}\n");
    }
    let mut rows = report::bounds(certificate);
    let mut seen = None;
    if args.samples > 0 {
        let attack = attack(certificate, args.samples, args.climbs, 1)
            .map_err(|error| Failure::Check(format!("error: {name}: {error}")))?;
        rows[0].push("observed".into());
        for (row, observed) in rows[1..].iter_mut().zip(&attack.observed) {
            row.push(format!("{observed:.3e}"));
        }
        seen = Some(attack);
    }
    text += &output::table(&rows, 0);
    output::print(&text)?;
    if let Some(attack) = seen {
        output::note(&format!("run at {} states", attack.states));
        if let Some((index, state)) = attack.violation {
            return Err(Failure::Check(format!(
                "error: {name}: {} errs more than E at q = {:?}, qd = {:?}, qdd = {:?}",
                certificate.emitted.entry(index),
                state.q,
                state.qd,
                state.qdd
            )));
        }
    }
    Ok(())
}

/// Reads certificates: one, or a list. Nothing in them is trusted: [`Certificate::check`] does
/// the rest.
fn read(path: &Path) -> Result<Vec<(Certificate, Value)>, Failure> {
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

/// Whether every field is what it is to be: those that follow from others, like
/// E, and those that every certificate has alike.
fn complete(certificate: &Certificate, json: &Value) -> Result<(), String> {
    let again = serde_json::from_str::<Value>(&certificate.to_json());
    let again = again.map_err(|error| error.to_string())?;
    let empty = serde_json::Map::new();
    let (given, again) = (
        json.as_object().unwrap_or(&empty),
        again.as_object().unwrap_or(&empty),
    );
    for key in again.keys().chain(given.keys()) {
        if key == "method" && given.get(key).is_some_and(Value::is_string) {
            // How its maker found the bounds; here they were found anew.
            continue;
        }
        match (given.get(key), again.get(key)) {
            (Some(given), Some(again)) if alike(given, again) => {}
            (Some(given), Some(again)) => {
                return Err(format!(
                    "`{key}` is {}; from the rest of the certificate follows {}",
                    shown(given),
                    shown(again)
                ));
            }
            (None, _) => return Err(format!("`{key}` is missing")),
            (_, None) => return Err(format!("`{key}` is none of a certificate's fields")),
        }
    }
    Ok(())
}

/// Numbers by their values: 0 is 0.0.
fn alike(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => a.as_f64() == b.as_f64(),
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let same = |(key, a): (&String, &Value)| b.get(key).is_some_and(|b| alike(a, b));
            a.len() == b.len() && a.iter().all(same)
        }
        _ => a == b,
    }
}

/// A value, or the beginning of it.
fn shown(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(MOST_SHOWN) {
        None => text,
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}

/// The box, inside which everything holds.
fn over(certificate: &Certificate) -> String {
    let InputBox {
        position,
        velocity,
        acceleration,
    } = &certificate.limits;
    let mut rows = vec![["over", "q", "qd", "qdd"].map(str::to_owned).to_vec()];
    let range = |x: &Interval| format!("{} .. {}", inward(x.low(), true), inward(x.high(), false));
    for (joint, ((q, qd), qdd)) in (1..).zip(position.iter().zip(velocity).zip(acceleration)) {
        let name = format!("joint {joint}");
        rows.push(vec![name, range(q), range(qd), range(qdd)]);
    }
    output::table(&rows, 0)
}

/// With six decimals at most, towards zero width.
fn inward(x: f64, up: bool) -> String {
    let scaled = x * 1e6;
    let rounded = if up { scaled.ceil() } else { scaled.floor() };
    // A zero without a sign.
    format!("{}", rounded / 1e6 + 0.0)
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
