//! The text of a certificate: JSON, written here, read by the command.

use std::fmt::Write;

use hmac_sha256::Hash;

use super::certificate::{ASSUMPTIONS, Certificate, METHOD};
use super::edits::{Edit, Place};
use super::interval::Interval;
use crate::emit::ScalarType;
use crate::emit::function::input_name;
use crate::function::Function;
use crate::generate::Start;
use crate::graph::AngleSum;
use crate::plan::parse::operand as read_operand;
use crate::plan::write::operand as write_operand;
use crate::plan::{Entry, Plan};
use crate::portfolio::Source;
use crate::schedule::{Operand, Program};
use crate::sincos::proof::Errors;
use crate::sincos::{AngleKernel, Sines};
use crate::verify::text::TextProgram;

/// The version of the format.
pub const VERSION: u32 = 1;

impl Certificate {
    /// The certificate as JSON; numbers read back as they were.
    pub fn to_json(&self) -> String {
        let mut text = String::from("{\n");
        let mut field = |name: &str, value: String| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {}: {value},", string(name));
        };
        field("certificate", VERSION.to_string());
        field("robot", string(&self.robot));
        field("input", string(&self.input));
        if let Some(scene) = &self.scene {
            field("scene", string(&scene.name));
            field("scene_hash", string(&scene.hash));
        }
        field("function", string(self.emitted.function.name()));
        field("scalar", string(self.scalar.name()));
        field("method", string(METHOD));
        let libm = |index: &usize| *index != 1 || self.sines.is_empty();
        let assumed = (0..ASSUMPTIONS.len()).filter(libm);
        field("assumptions", list(assumed.map(|a| string(ASSUMPTIONS[a]))));
        let ranges = |of: &[Interval]| {
            list(
                of.iter()
                    .map(|x| list([x.low(), x.high()].into_iter().map(number))),
            )
        };
        field("position", ranges(&self.limits.position));
        field("velocity", ranges(&self.limits.velocity));
        field("acceleration", ranges(&self.limits.acceleration));
        field("scale", list(self.scales.iter().copied().map(number)));
        if let Some(scale) = self.relative_to {
            field("relative_to", string(scale.word()));
        }
        for (name, part) in [
            (
                "model",
                (|s| s.model) as fn(&super::certificate::Split) -> f64,
            ),
            ("sincos", |s| s.sincos),
            ("rounding", |s| s.rounding),
            ("total", |s| s.total()),
        ] {
            field(
                name,
                list(self.bounds.iter().map(|split| number(part(split)))),
            );
        }
        if !self.sines.is_empty() {
            field("polynomials", list(self.sines.iter().map(sine)));
        }
        if let Some(least) = self.lambda_min {
            field("lambda_min", number(least));
        }
        let stages = self.stages.iter().map(|stage| {
            let edits = list(stage.edits.iter().map(|edit| string(&write_edit(edit))));
            let program = string(&plan_text(self, &stage.program));
            format!("{{ \"program\": {program}, \"edits\": {edits} }}")
        });
        field("stages", list(stages));
        field("emitted", string(&plan_text(self, &self.emitted)));
        field("text_hash", string(&text_hash(&self.text)));
        let _ = write!(text, "  \"text\": {}\n}}\n", string(&self.text));
        text
    }
}

/// What is claimed of an angle's polynomials; their literals are in the text.
fn sine(sine: &AngleKernel) -> String {
    let (angle, form) = (string(&sine.angle.to_string()), string(&sine.form));
    let range = list(
        [sine.range.low(), sine.range.high()]
            .into_iter()
            .map(number),
    );
    let (sin, cos) = (number(sine.errors.sin), number(sine.errors.cos));
    format!(
        "{{ \"angle\": {angle}, \"form\": {form}, \"range\": {range}, \
         \"sin\": {sin}, \"cos\": {cos} }}"
    )
}

/// The polynomials that a certificate's text computes sines by, each with
/// what is claimed of it: angle, form, range and errors.
///
/// # Errors
/// What is wrong with the text, or an angle of which it has no polynomials.
pub fn read_sines(
    text: &str,
    function: Function,
    scalar: ScalarType,
    claims: Vec<(String, String, Interval, Errors)>,
) -> Result<Sines, String> {
    let text = TextProgram::parse(text, function, scalar).map_err(|error| error.to_string())?;
    let mut sines = Sines::new();
    for (name, form, range, errors) in claims {
        let angle: AngleSum = name.parse().map_err(|()| format!("`{name}` is no angle"))?;
        let mut angles = text.trig.iter().filter(|trig| trig.angle == angle);
        let kernel = angles.find_map(|trig| trig.kernel.clone());
        sines.push(AngleKernel {
            angle,
            range,
            form,
            kernel: kernel.ok_or_else(|| format!("`text` has no polynomials of `{name}`"))?,
            errors,
        });
    }
    Ok(sines)
}

/// SHA-256 of a printed text in hexadecimal.
pub fn text_hash(text: &str) -> String {
    let hash = Hash::hash(text.as_bytes());
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A program as a plan of one entry.
fn plan_text(certificate: &Certificate, program: &Program) -> String {
    Plan {
        robot: certificate.robot.clone(),
        input: certificate.input.clone(),
        entries: vec![Entry {
            start: Start::Auto,
            scalar: certificate.scalar,
            source: Source::Regrouped,
            stages: Vec::new(),
            scene: certificate.scene.clone(),
            program: program.clone(),
            edited: None,
        }],
    }
    .write()
}

/// Reads what [`Certificate::to_json`] writes of a program.
///
/// # Errors
/// What is wrong with the text.
pub fn read_program(text: &str) -> Result<Program, String> {
    let plan = Plan::parse(text).map_err(|error| error.to_string())?;
    let mut entries = plan.entries.into_iter();
    match (entries.next(), entries.next()) {
        (Some(entry), None) => Ok(entry.program),
        _ => Err("expected one program".into()),
    }
}

/// An edit as text: `t12 = ~t3`, `qd[5] = #0`.
pub fn write_edit(edit: &Edit) -> String {
    let place = match edit.place {
        Place::Input(input) => input_name(input),
        Place::Step(step) => format!("t{}", step + 1),
        Place::Left(step) => format!("t{}.left", step + 1),
        Place::Right(step) => format!("t{}.right", step + 1),
    };
    let sign = if edit.negative { "~" } else { "" };
    format!("{place} = {sign}{}", write_operand(&edit.value))
}

/// Reads an edit of a program.
///
/// # Errors
/// What is wrong with the text.
pub fn read_edit(text: &str, program: &Program) -> Result<Edit, String> {
    let (place, value) = text
        .split_once(" = ")
        .ok_or_else(|| format!("`{text}` is no edit"))?;
    let (step, side) = place.split_once('.').unwrap_or((place, ""));
    let place = match (read_operand(step, program)?, side) {
        (Operand::Input(input), "") => Place::Input(input),
        (Operand::Step(step), "") => Place::Step(step),
        (Operand::Step(step), "left") => Place::Left(step),
        (Operand::Step(step), "right") => Place::Right(step),
        _ => return Err(format!("`{place}` cannot be replaced")),
    };
    let (negative, value) = match value.strip_prefix('~') {
        Some(rest) => (true, rest),
        None => (false, value),
    };
    Ok(Edit {
        place,
        negative,
        value: read_operand(value, program)?,
    })
}

/// The shortest decimal that reads back as the number. JSON has no infinity:
/// a bound that says nothing is null.
fn number(x: f64) -> String {
    if x.is_finite() {
        format!("{x:e}")
    } else {
        "null".into()
    }
}

fn list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(", "))
}

fn string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            c if c < ' ' => {
                let _ = write!(quoted, "\\u{:04x}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
