//! The fields of a certificate's file.

use hmac_sha256::Hash;
use serde::Serialize;

use super::polynomials::Polynomials;
use super::program::{Listing, StageListing};
use super::{Ends, VERSION};
use crate::certificate::{Certificate, METHOD};
use crate::interval::Interval;
use crate::split::ErrorByCause;

/// A number; null for a bound that says nothing, since JSON has no infinity.
#[derive(Clone, Copy, Serialize)]
#[serde(into = "Option<f64>")]
struct Number(f64);

impl From<Number> for Option<f64> {
    fn from(Number(value): Number) -> Self {
        value.is_finite().then_some(value)
    }
}

/// A certificate as its file has it.
#[derive(Serialize)]
pub(super) struct Document {
    certificate: u32,
    robot: String,
    input: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
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
    #[serde(skip_serializing_if = "Option::is_none")]
    relative_to: Option<String>,
    model: Vec<Number>,
    sincos: Vec<Number>,
    rounding: Vec<Number>,
    total: Vec<Number>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    polynomials: Vec<Polynomials>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lambda_min: Option<f64>,
    stages: Vec<StageListing>,
    emitted: Listing,
    text_hash: String,
    text: String,
}

impl Document {
    /// Returns what is written of a certificate.
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
            stages: certificate.stages.iter().map(StageListing::new).collect(),
            emitted: Listing::new(emitted),
            text_hash: text_hash(&certificate.text),
            text: certificate.text.clone(),
        }
    }
}

/// Returns SHA-256 of a printed text in hexadecimal.
fn text_hash(text: &str) -> String {
    let hash = Hash::hash(text.as_bytes());
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}
