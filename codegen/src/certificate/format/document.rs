//! The fields of a certificate's file.

use hmac_sha256::Hash;
use serde::{Deserialize, Serialize};

use super::error::{FormatFault, Listed};
use super::polynomials::Polynomials;
use super::program::{Listing, StageListing};
use super::{Ends, VERSION};
use crate::bound::input_box::InputBox;
use crate::certificate::{Certificate, METHOD};
use crate::function::{Argument, Function};
use crate::interval::Interval;
use crate::program::{Library, Program, ScalarType};
use crate::scene::SceneKey;
use crate::split::ErrorByCause;
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scale;

/// A number; null for a bound that says nothing, since JSON has no infinity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Option<f64>", into = "Option<f64>")]
pub(super) struct Number(pub(super) f64);

impl From<Option<f64>> for Number {
    fn from(value: Option<f64>) -> Self {
        Number(value.unwrap_or(f64::INFINITY))
    }
}

impl From<Number> for Option<f64> {
    fn from(Number(value): Number) -> Self {
        value.is_finite().then_some(value)
    }
}

/// A certificate as its file has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document {
    certificate: u32,
    robot: String,
    input: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    scene_hash: Option<String>,
    function: String,
    /// One-based.
    rows: Vec<usize>,
    arguments: Vec<String>,
    scalar: String,
    method: String,
    assumptions: Vec<String>,
    position: Vec<Ends>,
    velocity: Vec<Ends>,
    acceleration: Vec<Ends>,
    scale: Vec<Number>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    relative_to: Option<String>,
    model: Vec<Number>,
    sincos: Vec<Number>,
    rounding: Vec<Number>,
    total: Vec<Number>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    polynomials: Vec<Polynomials>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lambda_min: Option<f64>,
    stages: Vec<StageListing>,
    emitted: Listing,
    text_hash: String,
    text: String,
}

impl Document {
    /// What is written of a certificate.
    pub(super) fn of(certificate: &Certificate) -> Document {
        let Certificate {
            limits, emitted, ..
        } = certificate;
        let ends = |ranges: &[Interval]| ranges.iter().map(|x| [x.low(), x.high()]).collect();
        let part = |part: fn(&ErrorByCause) -> f64| {
            let bounds = certificate.bounds.iter();
            bounds.map(|bound| Number(part(bound))).collect()
        };
        let scene = certificate.scene.as_ref();
        let assumptions = certificate.assumptions();
        Document {
            certificate: VERSION,
            robot: certificate.robot.clone(),
            input: certificate.input.clone(),
            scene: scene.map(|scene| scene.name.clone()),
            scene_hash: scene.map(|scene| scene.hash.clone()),
            function: emitted.function.text(),
            rows: emitted.rows.iter().map(|row| row + 1).collect(),
            arguments: emitted.arguments.iter().map(|a| a.name().into()).collect(),
            scalar: certificate.scalar.name().into(),
            method: METHOD.into(),
            assumptions: assumptions.into_iter().map(String::from).collect(),
            position: ends(&limits.position),
            velocity: ends(&limits.velocity),
            acceleration: ends(&limits.acceleration),
            scale: certificate.scales.iter().copied().map(Number).collect(),
            relative_to: certificate.relative_to.map(|scale| scale.word().into()),
            model: part(|s| s.model),
            sincos: part(|s| s.sincos),
            rounding: part(|s| s.rounding),
            total: part(|s| s.total()),
            polynomials: certificate.sines.iter().map(Polynomials::of).collect(),
            lambda_min: certificate.lambda_min,
            stages: certificate.stages.iter().map(StageListing::of).collect(),
            emitted: Listing::of(emitted),
            text_hash: text_hash(&certificate.text),
            text: certificate.text.clone(),
        }
    }

    /// The claim, if the file says nothing else.
    pub(super) fn certificate(&self) -> Result<Certificate, FormatFault> {
        if self.certificate != VERSION {
            return Err(FormatFault::Version(self.certificate));
        }
        let certificate = self.parse()?;
        let again = Document::of(&certificate);
        match self.differs(&again) {
            None => Ok(certificate),
            Some(field) => Err(FormatFault::Field(field)),
        }
    }

    fn parse(&self) -> Result<Certificate, FormatFault> {
        let function = known("function", &self.function, |text| {
            Function::parse(text).ok()
        })?;
        let scalar = known("scalar", &self.scalar, ScalarType::from_name)?;
        let relative_to = self.relative_to.as_ref();
        let relative_to = relative_to.map(|word| known("relative_to", word, scale));
        let scene = match (&self.scene, &self.scene_hash) {
            (Some(name), Some(hash)) => Some(SceneKey {
                name: name.clone(),
                hash: hash.clone(),
            }),
            (None, None) => None,
            _ => return Err(FormatFault::HalfScene),
        };
        let empty = self.empty(function)?;
        let emitted = self.emitted.program(Listed::Emitted, &empty)?;
        let mut stages = Vec::new();
        for (index, stage) in self.stages.iter().enumerate() {
            stages.push(stage.stage(Listed::Stage(index + 1), &empty)?);
        }
        let sines = self.polynomials.iter().map(|p| p.sines(scalar));
        Ok(Certificate {
            robot: self.robot.clone(),
            input: self.input.clone(),
            scene,
            scalar,
            limits: InputBox {
                position: ranges("position", &self.position)?,
                velocity: ranges("velocity", &self.velocity)?,
                acceleration: ranges("acceleration", &self.acceleration)?,
            },
            scales: self.scale.iter().map(|x| x.0).collect(),
            relative_to: relative_to.transpose()?,
            stages,
            emitted,
            text: self.text.clone(),
            library: self.library(),
            sines: sines.collect::<Result<_, FormatFault>>()?,
            bounds: self.bounds()?,
            lambda_min: self.lambda_min,
        })
    }

    /// The library whose assumption is stated.
    fn library(&self) -> Library {
        let stated = |library: &Library| {
            let words = library.assumption();
            self.assumptions.iter().any(|stated| stated == words)
        };
        Library::ALL.into_iter().find(stated).unwrap_or_default()
    }

    /// A program of this function, with nothing in it.
    fn empty(&self, function: Function) -> Result<Program, FormatFault> {
        let joints = self.position.len();
        if !(1..=Robot::MAX_JOINTS).contains(&joints) {
            return Err(FormatFault::Joints);
        }
        let row = |&row: &usize| (1..=joints).contains(&row).then(|| row - 1);
        let rows: Option<Vec<usize>> = self.rows.iter().map(row).collect();
        let rows = rows.filter(|rows| rows.len() <= joints);
        let argument = |word: &String| {
            let named = Argument::from_name(word).filter(|a| Argument::STATE.contains(a));
            named.ok_or_else(|| FormatFault::Argument(word.clone()))
        };
        Ok(Program {
            function,
            joints,
            rows: rows.ok_or(FormatFault::Rows)?,
            arguments: self
                .arguments
                .iter()
                .map(argument)
                .collect::<Result<_, _>>()?,
            load: 0,
            trig: Vec::new(),
            speeds: Vec::new(),
            steps: Vec::new(),
            outputs: Vec::new(),
        })
    }

    fn bounds(&self) -> Result<Vec<ErrorByCause>, FormatFault> {
        let (model, sincos, rounding) = (&self.model, &self.sincos, &self.rounding);
        if model.len() != sincos.len() || model.len() != rounding.len() {
            return Err(FormatFault::Bounds);
        }
        let parts = model.iter().zip(sincos).zip(rounding);
        let bounds = parts.map(|((model, sincos), rounding)| ErrorByCause {
            model: model.0,
            sincos: sincos.0,
            rounding: rounding.0,
        });
        Ok(bounds.collect())
    }

    /// The first field that is not as in another document, but for those that
    /// the check looks at: there the check says what is wrong.
    fn differs(&self, other: &Document) -> Option<&'static str> {
        let fields = [
            ("method", self.method == other.method),
            ("assumptions", self.assumptions == other.assumptions),
            ("total", self.total == other.total),
            ("polynomials", self.polynomials == other.polynomials),
            ("stages", self.stages == other.stages),
            ("emitted", self.emitted == other.emitted),
            ("text_hash", self.text_hash == other.text_hash),
        ];
        if let Some((name, _)) = fields.into_iter().find(|(_, same)| !same) {
            return Some(name);
        }
        (self != other).then_some("certificate")
    }
}

fn known<T>(
    field: &'static str,
    word: &str,
    find: impl Fn(&str) -> Option<T>,
) -> Result<T, FormatFault> {
    find(word).ok_or_else(|| {
        let word = word.to_owned();
        FormatFault::Unknown { field, word }
    })
}

fn scale(word: &str) -> Option<Scale> {
    let mut words = Scale::WORDS.into_iter();
    words
        .find(|(known, _)| *known == word)
        .map(|(_, scale)| scale)
}

fn ranges(field: &'static str, ends: &[Ends]) -> Result<Vec<Interval>, FormatFault> {
    let range = |(index, &[low, high]): (usize, &Ends)| {
        let number = index + 1;
        Interval::new(low, high).ok_or(FormatFault::Range { field, number })
    };
    ends.iter().enumerate().map(range).collect()
}

/// SHA-256 of a printed text in hexadecimal.
pub fn text_hash(text: &str) -> String {
    let hash = Hash::hash(text.as_bytes());
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}
