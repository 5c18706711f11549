//! `dalembert verify`: the exact proof, then what rounding costs the emitted text, run bit for bit:
//! inside the limits, at states that somebody else computed, and at the extremes.
//!
//! - this file: what is checked, and how the run ends
//! - [`given`]: given states
//! - [`show`]: what was found, as text and as JSON

mod given;
mod show;

use crate::extremes::{self, Verdict};
use crate::measure::Bench;
use dalembert_codegen::workspace::{
    Certificate, Emitted, Falsification, Runtime, SEED, STATES, falsify,
};
use dalembert_codegen::{GenerateError, Generated, ScalarType};

use crate::args::VerifyArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output, progress, sines};
use given::Given;
use show::Found;

/// A certificate and the largest errors that were seen.
struct Claim<'g> {
    certificate: &'g Certificate,
    falsification: Falsification,
}

impl Claim<'_> {
    fn is_of(&self, emitted: &Emitted) -> bool {
        let function = self.certificate.emitted.function;
        function == emitted.function && self.certificate.scalar == emitted.scalar
    }

    fn passed(&self) -> bool {
        self.falsification.violation.is_none()
    }
}

/// Climbs to the largest error of each output.
const CLIMBS: usize = 2;

/// Runs the subcommand.
pub fn run(args: &VerifyArgs) -> Outcome {
    let wanted = input::wanted(&args.robot, &args.options.0, &ScalarType::ALL)?;
    let input::Wanted {
        robot, mut request, ..
    } = wanted;
    let given = args.given.as_deref();
    let given = given.map(|file| Given::read(file, &robot, &request));
    let mut given = given.transpose()?;
    let session = progress::watch(&mut request);
    // What cannot be proved is not generated: this ends with the reason.
    let generated = input::generated(&args.robot, &robot, &request)?;
    drop(session);
    let scene_robot = request.scene_robot(&robot).map_err(GenerateError::Scene)?;
    let states = scene_robot.states(args.states, SEED);
    let claims = claims(&generated)?;
    // What a tolerance left out is no rounding: its bound is E.
    let emitted = generated.emitted.iter();
    let exact = emitted.filter(|emitted| !claims.iter().any(|claim| claim.is_of(emitted)));
    let bench = Bench::new(scene_robot.clone());
    let mut rows = extremes::inside(&bench, exact, &states);
    if args.extremes {
        let progress = |case: &str| output::note(&format!("… {case}"));
        rows.extend(extremes::torques(&robot, &request, args.states, progress)?);
        output::note("… nearest to singular");
        rows.extend(extremes::divided(&robot, &request, args.states)?);
    }
    if let Some(given) = &mut given {
        given.compare(&Runtime::in_scene(scene_robot), &generated);
    }
    let sines = sines::checks(&generated, &states);
    let found = Found {
        robot: &robot,
        generated: &generated,
        states: args.states,
        rows: &rows,
        claims: &claims,
        sines: &sines,
        given: given.as_ref(),
    };
    if args.json {
        output::print_json(&found.json())?;
    } else {
        output::print(&found.text())?;
    }
    if !sines.iter().all(sines::Check::passed) {
        return Err(Failure::Check(
            "error: a polynomial is further from its sine than was proved".into(),
        ));
    }
    if !claims.iter().all(Claim::passed) {
        return Err(Failure::Check(
            "error: a certificate is violated: a defect of this program".into(),
        ));
    }
    let failed = rows.iter().filter(|row| row.verdict == Verdict::Failed);
    match failed.count() {
        0 => {}
        failed => {
            return Err(Failure::Check(format!(
                "error: rounding costs more than the bound in {failed} of {} rows",
                rows.len()
            )));
        }
    }
    let disagreement = given.and_then(|given| given.disagreement(&robot));
    disagreement.map_or(Ok(()), |why| Err(Failure::Check(why)))
}

/// Falsifies the certificates of a scene with a tolerance.
fn claims(generated: &Generated) -> Result<Vec<Claim<'_>>, Failure> {
    let functions = generated.functions.iter();
    let admitted = functions.filter_map(|function| function.admitted.as_ref());
    let mut claims = Vec::new();
    for certificate in admitted.flat_map(|admitted| &admitted.certificates) {
        let falsification = falsify(certificate, STATES, CLIMBS, SEED)
            .map_err(|error| Failure::Check(format!("error: {error}")))?;
        claims.push(Claim {
            certificate,
            falsification,
        });
    }
    Ok(claims)
}
