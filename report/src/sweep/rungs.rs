//! Rungs kept: the variants of one tolerance, in a file of their own as soon as
//! they are certified.
//!
//! A file says by a hash which robot, scene, exact program and options it is of,
//! and by another one that it is whole. Whoever wants to trust a certificate in
//! it runs `dalembert certify`: here it is what this program wrote.

use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::certificate::format::{read, text_hash};
use serde_json::{Value, json};

use super::fault::{Damage, RungError, RungFault};
use super::{Point, SweepError};

/// The version of the format.
const VERSION: u32 = 2;

/// The largest file that is read.
const MAX_BYTES: u64 = 256 << 20;

/// The variants of one tolerance.
pub struct Rung {
    /// Zero for the exact program.
    pub tolerance: f64,
    /// The variants.
    pub points: Vec<Point>,
}

/// A folder of rungs.
pub struct Rungs {
    folder: PathBuf,
    key: String,
}

impl Rungs {
    /// A folder, which need not be there, for a run that `identity` tells apart
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

    /// A rung that was kept.
    ///
    /// # Errors
    /// It is of another run, or damaged.
    pub fn kept(&self, tolerance: f64) -> Result<Option<Rung>, SweepError> {
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
        self.rung(tolerance, body).map(Some).map_err(damaged)
    }

    fn rung(&self, tolerance: f64, body: &Value) -> Result<Rung, Damage> {
        if body.get("tolerance").and_then(Value::as_f64) != Some(tolerance) {
            return Err(Damage::Tolerance);
        }
        let points = body.get("points").and_then(Value::as_array);
        let point = |json: &Value| {
            let text = json.get("certificate").and_then(Value::as_str);
            let text = text.ok_or(Damage::Missing("certificate"))?;
            let certificates = read(text).map_err(Damage::Certificate)?;
            let [certificate] =
                <[_; 1]>::try_from(certificates).map_err(|_| Damage::Certificates)?;
            let number = |key: &str| json.get(key).and_then(Value::as_f64);
            Ok(Point {
                observed: number("observed"),
                rounding_observed: number("rounding_observed"),
                ..Point::new(tolerance, certificate)
            })
        };
        let points = points.ok_or(Damage::Missing("points"))?.iter().map(point);
        Ok(Rung {
            tolerance,
            points: points.collect::<Result<_, Damage>>()?,
        })
    }

    /// Keeps a rung, whole or not at all; one with a violation is looked into
    /// instead.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn keep(&self, rung: &Rung) -> Result<(), SweepError> {
        if rung.points.iter().any(|point| point.violation.is_some()) {
            return Ok(());
        }
        let points = rung.points.iter().map(|point| {
            json!({
                "certificate": point.certificate.to_json(),
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
