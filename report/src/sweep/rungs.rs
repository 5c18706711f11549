//! Rungs kept: the variants of one tolerance, in a file of their own as soon as
//! they are certified.
//!
//! A file says by a hash which robot, scene, exact program and options it is of,
//! and by another one that it is whole. A variant is kept as a plan keeps it; of one with
//! polynomials for its sines only that it follows the one before: they are found anew.

use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::certificate::Certificate;
use dalembert_codegen::workspace::certificate::format::text_hash;
use dalembert_codegen::workspace::plan::{Edited, Entry, Plan};
use dalembert_codegen::workspace::portfolio::{Source, Start};
use serde_json::{Value, json};

use super::fault::{Damage, RungError, RungFault};
use super::{Point, SweepError};

/// The version of the format.
const VERSION: u32 = 3;

/// The largest file that is read.
const MAX_BYTES: u64 = 256 << 20;

/// The variants of one tolerance.
pub struct Rung {
    /// Zero for the exact program.
    pub tolerance: f64,
    /// The variants.
    pub points: Vec<Point>,
}

/// What a rung says of a variant: what a plan keeps, or that it is the variant before with
/// polynomials for its sines.
pub enum Kept<'k> {
    /// A variant of which libm computes the sines.
    Variant(&'k Entry),
    /// The one before, with polynomials.
    Polynomials(&'k Certificate),
}

/// A folder of rungs.
pub struct Rungs {
    folder: PathBuf,
    key: String,
}

impl Rungs {
    /// Returns a folder, which need not be there, for a run that `identity` tells apart
    /// from every other: robot, scene, exact program, options.
    pub fn new(folder: &Path, identity: &str) -> Rungs {
        let version = env!("CARGO_PKG_VERSION");
        Rungs {
            folder: folder.to_owned(),
            key: text_hash(&format!("{version}\n{identity}")),
        }
    }

    fn path(&self, tolerance: f64) -> PathBuf {
        self.folder.join(format!("{tolerance:e}.json"))
    }

    /// Returns a rung that was kept, if there is one; `certified` makes the claim of a variant.
    ///
    /// # Errors
    /// It is of another run, or damaged.
    pub fn kept(
        &self,
        tolerance: f64,
        certified: impl Fn(Kept<'_>) -> Option<Certificate>,
    ) -> Result<Option<Rung>, SweepError> {
        let path = self.path(tolerance);
        let fail = |fault| {
            let path = path.clone();
            SweepError::Rung(RungError::Kept { path, fault })
        };
        let unreadable = |error: std::io::Error| fail(RungFault::Unreadable(error.to_string()));
        let damaged = |damage| fail(RungFault::Damaged(damage));
        let mut bytes = Vec::new();
        // Opening a pipe would wait for somebody who writes into it.
        match fs::metadata(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(unreadable(error)),
            Ok(found) if !found.is_file() => return Err(fail(RungFault::NoFile)),
            Ok(_) => {}
        }
        File::open(&path)
            .and_then(|file| file.take(MAX_BYTES).read_to_end(&mut bytes))
            .map_err(unreadable)?;
        let json: Value = serde_json::from_slice(&bytes)
            .map_err(|error| damaged(Damage::Json(error.to_string())))?;
        let text = |key: &str| json.get(key).and_then(Value::as_str);
        if json.get("rung").and_then(Value::as_u64) != Some(VERSION.into()) {
            return Err(damaged(Damage::Version));
        }
        if text("run") != Some(&self.key) {
            return Err(fail(RungFault::OtherRun));
        }
        let body = json.get("body").unwrap_or(&Value::Null);
        if text("hash") != Some(&text_hash(&body.to_string())) {
            return Err(damaged(Damage::Hash));
        }
        rung(tolerance, body, certified).map(Some).map_err(damaged)
    }

    /// Keeps a rung, whole or not at all; one with a violation is looked into
    /// instead.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn keep(&self, rung: &Rung) -> Result<(), SweepError> {
        let is_known = |point: &Point| point.violation.is_none() && point.certified.is_finite();
        if !rung.points.iter().all(is_known) {
            return Ok(());
        }
        let points = rung.points.iter().map(|point| {
            json!({
                "plan": point.certificate.sines.is_empty().then(|| plan(&point.certificate)),
                "observed": point.observed,
                "rounding_observed": point.rounding_observed,
            })
        });
        let body = json!({
            "tolerance": rung.tolerance,
            "points": points.collect::<Vec<_>>(),
        });
        let hash = text_hash(&body.to_string());
        let text = json!({ "rung": VERSION, "run": self.key, "hash": hash, "body": body });
        let path = self.path(rung.tolerance);
        let unfinished = path.with_extension("unfinished");
        let written = fs::create_dir_all(&self.folder)
            .and_then(|()| fs::write(&unfinished, text.to_string() + "\n"))
            .and_then(|()| fs::rename(&unfinished, &path));
        written.map_err(|error| {
            let error = error.to_string();
            SweepError::Rung(RungError::Unwritten { path, error })
        })
    }

    /// Deletes the rungs of these tolerances: the run is through.
    pub fn forget(&self, tolerances: impl IntoIterator<Item = f64>) {
        for tolerance in tolerances {
            // What stays is found, and said to be of another run, next time.
            let _ = fs::remove_file(self.path(tolerance));
        }
        let _ = fs::remove_dir(&self.folder);
    }
}

/// Returns the plan that keeps a variant.
fn plan(certificate: &Certificate) -> String {
    let stages = &certificate.stages;
    let exact = stages.first().map(|stage| &stage.program);
    let plan = Plan {
        robot: certificate.robot.clone(),
        input: certificate.input.clone(),
        entries: vec![Entry {
            start: Start::Auto,
            scalar: certificate.scalar,
            source: Source::Regrouped,
            passes: Vec::new(),
            scene: certificate.scene.clone(),
            parameters: None,
            program: exact.unwrap_or(&certificate.emitted).clone(),
            edited: Some(Edited {
                stages: stages.clone(),
                program: certificate.emitted.clone(),
                bounds: certificate.bounds.clone(),
                lambda_min: certificate.lambda_min,
            }),
        }],
    };
    plan.write()
}

fn rung(
    tolerance: f64,
    body: &Value,
    certified: impl Fn(Kept<'_>) -> Option<Certificate>,
) -> Result<Rung, Damage> {
    if body.get("tolerance").and_then(Value::as_f64) != Some(tolerance) {
        return Err(Damage::Tolerance);
    }
    let all = body.get("points").and_then(Value::as_array);
    let mut points: Vec<Point> = Vec::new();
    for json in all.ok_or(Damage::Missing("points"))? {
        let certificate = match (json.get("plan").and_then(Value::as_str), points.last()) {
            (Some(text), _) => {
                let plan = Plan::parse(text).map_err(|error| Damage::Plan(error.to_string()))?;
                let entry = plan.entries.first().ok_or(Damage::Missing("program"))?;
                certified(Kept::Variant(entry))
            }
            (None, Some(before)) => certified(Kept::Polynomials(&before.certificate)),
            (None, None) => return Err(Damage::Missing("plan")),
        };
        let number = |key: &str| json.get(key).and_then(Value::as_f64);
        points.push(Point {
            observed: number("observed"),
            rounding_observed: number("rounding_observed"),
            ..Point::new(tolerance, certificate.ok_or(Damage::Variant)?)
        });
    }
    Ok(Rung { tolerance, points })
}
