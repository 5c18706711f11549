//! `dalembert verify`: the exact proof, then the emitted text run bit for bit
//! against the generic runtime and against given states.
//!
//! - this file: what is checked, and how the run ends
//! - [`given`]: given states
//! - [`show`]: what was found, as text and as JSON

mod given;
mod show;

use dalembert_codegen::workspace::{
    BOUND, Certificate, Emitted, Falsification, Measure, Runtime, SEED, STATES, falsify,
};
use dalembert_codegen::{GenerateError, Generated, ScalarType};

use crate::args::VerifyArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output, progress, sines};
use given::Given;
use show::Found;

/// An error measured against the runtime, and its bound.
struct Check {
    states: usize,
    measure: Measure,
    bound: f64,
}

impl Check {
    fn passed(&self) -> bool {
        self.measure.error <= self.bound
    }
}

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
    let given = args.states.as_deref();
    let given = given.map(|file| Given::read(file, &robot, &request));
    let mut given = given.transpose()?;
    let session = progress::watch(&mut request);
    // What cannot be proved is not generated: this ends with the reason.
    let generated = input::generated(&args.robot, &robot, &request)?;
    drop(session);
    let scene_robot = request.scene_robot(&robot).map_err(GenerateError::Scene)?;
    let states = scene_robot.states(STATES, SEED);
    let runtime = Runtime::in_scene(scene_robot);
    let mut checks = Vec::new();
    let claims = claims(&generated)?;
    for emitted in &generated.emitted {
        // What a tolerance left out is no rounding: its bound is E.
        if claims.iter().any(|claim| claim.is_of(emitted)) {
            continue;
        }
        for measure in emitted.against_runtime(&runtime, &states) {
            checks.push(Check {
                states: states.len(),
                measure,
                bound: BOUND * emitted.scalar.unit_roundoff(),
            });
        }
    }
    if let Some(given) = &mut given {
        given.compare(&runtime, &generated);
    }
    let sines = sines::checks(&generated, &states);
    let found = Found {
        robot: &robot,
        generated: &generated,
        checks: &checks,
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
    if !checks.iter().all(Check::passed) {
        return Err(Failure::Check(
            "error: rounding costs more than the bound".into(),
        ));
    }
    let disagreement = given.and_then(|given| given.disagreement(&robot));
    disagreement.map_or(Ok(()), |why| Err(Failure::Check(why)))
}

/// Returns the certificates of a scene with a tolerance, falsified.
fn claims(generated: &Generated) -> Result<Vec<Claim<'_>>, Failure> {
    let admitted = generated
        .functions
        .iter()
        .filter_map(|f| f.admitted.as_ref());
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
