//! `dalembert verify`: the exact proof, then the emitted text run bit for bit
//! against the generic runtime and against given states.

use dalembert_codegen::certify::attack::{Attack, attack};
use dalembert_codegen::certify::certificate::Certificate;
use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::generate::{GenerateError, Generated, generate};
use dalembert_codegen::scene::Setting;
use dalembert_codegen::verify::floating::{BOUND, Emitted, GIVEN_BOUND, Measure, Runtime};
use dalembert_codegen::verify::states::{SEED, STATES, seeded};
use dalembert_model::robot::Robot;
use serde_json::{Value, json};

use crate::args::VerifyArgs;
use crate::generate::report;
use crate::outcome::{Failure, Outcome};
use crate::{input, output, progress, sines};

/// A measured error and its bound.
struct Check {
    against: &'static str,
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
    attack: Attack,
}

impl Claim<'_> {
    fn is_of(&self, emitted: &Emitted) -> bool {
        let function = self.certificate.emitted.function;
        function == emitted.function && self.certificate.scalar == emitted.scalar
    }

    fn passed(&self) -> bool {
        self.attack.violation.is_none()
    }
}

/// Climbs to the largest error of each output.
const CLIMBS: usize = 2;

/// Runs the subcommand.
pub fn run(args: &VerifyArgs) -> Outcome {
    let (robot, mut request) = input::robot_and_request(&args.robot, &args.choice)?;
    let given = match &args.states {
        Some(file) => input::states(file, robot.joints.len())?,
        None => Vec::new(),
    };
    let session = progress::watch(&mut request);
    // What cannot be proved is not generated: this ends with the reason.
    let generated = generate(&robot, &request)?;
    drop(session);
    let setting = Setting::of(&robot, request.scene.as_ref()).map_err(GenerateError::Scene)?;
    let states = seeded(setting.robot(), STATES, SEED);
    let runtime = Runtime::in_setting(setting);
    let mut checks = Vec::new();
    let claims = claims(&generated)?;
    for emitted in &generated.emitted {
        // What a tolerance left out is no rounding: its bound is E.
        if claims.iter().any(|claim| claim.is_of(emitted)) {
            continue;
        }
        for measure in emitted.against_runtime(&runtime, &states) {
            checks.push(Check {
                against: "runtime",
                states: states.len(),
                measure,
                bound: BOUND * emitted.scalar.unit_roundoff(),
            });
        }
        // Given states are doubles: rounded to f32 they are other states.
        if emitted.scalar == ScalarType::F64 {
            for measure in emitted.against_given(&given) {
                checks.push(Check {
                    against: "states",
                    states: given.len(),
                    measure,
                    bound: GIVEN_BOUND,
                });
            }
        }
    }
    let sines = sines::checks(&generated, &states);
    if args.json {
        output::print_json(&json(&robot, &generated, &checks, &claims, &sines))?;
    } else {
        let text = text(&robot, &generated, &checks, &claims);
        output::print(&(text + &sines::table(&sines)))?;
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
    if checks.iter().all(Check::passed) {
        Ok(())
    } else {
        Err(Failure::Check(
            "error: rounding costs more than the bound".into(),
        ))
    }
}

/// The certificates of a scene with a tolerance, attacked.
fn claims(generated: &Generated) -> Result<Vec<Claim<'_>>, Failure> {
    let admitted = generated
        .functions
        .iter()
        .filter_map(|f| f.admitted.as_ref());
    let mut claims = Vec::new();
    for certificate in admitted.flat_map(|admitted| &admitted.certificates) {
        let attack = attack(certificate, STATES, CLIMBS, SEED)
            .map_err(|error| Failure::Check(format!("error: {error}")))?;
        claims.push(Claim {
            certificate,
            attack,
        });
    }
    Ok(claims)
}

fn text(robot: &Robot, generated: &Generated, checks: &[Check], claims: &[Claim<'_>]) -> String {
    let mut text = format!("robot {}, input {}\n\n", robot.name, robot.short_hash());
    for function in &generated.functions {
        text += &format!("  {} {}\n", function.function, function.proof);
    }
    for claim in claims {
        let certificate = claim.certificate;
        text += &format!(
            "\n{} in {}, certified, and the largest errors at {} states\n",
            certificate.emitted.function, certificate.scalar, claim.attack.states
        );
        let mut rows = report::bounds(certificate);
        rows[0].push("observed".into());
        for (row, observed) in rows[1..].iter_mut().zip(&claim.attack.observed) {
            row.push(format!("{observed:.3e}"));
        }
        text += &output::table(&rows, 0);
    }
    if checks.is_empty() {
        return text;
    }
    text += "\nworst normwise error\n";
    let head = [
        "function", "scalar", "quantity", "against", "in u", "error", "bound", "",
    ];
    let mut rows = vec![head.map(String::from).to_vec()];
    for check in checks {
        let measure = &check.measure;
        rows.push(vec![
            measure.function.to_string(),
            measure.scalar.to_string(),
            measure.quantity.symbol().to_owned(),
            format!("{} {}", check.states, check.against),
            format!("{:.1}", measure.in_units()),
            format!("{:.1e}", measure.error),
            format!("{:.1e}", check.bound),
            if check.passed() { "ok" } else { "FAILED" }.to_owned(),
        ]);
    }
    text += &output::table(&rows, 1);
    for warning in &generated.warnings {
        text += &format!("warning: {warning}\n");
    }
    text
}

fn json(
    robot: &Robot,
    generated: &Generated,
    checks: &[Check],
    claims: &[Claim<'_>],
    sines: &[sines::Check],
) -> Value {
    let proofs = generated.functions.iter().map(|f| {
        json!({
            "function": f.function.name(),
            "proved": true,
            "points": f.proof.points,
            "degree": f.proof.degree,
            "failure_exponent": f.proof.failure_exponent,
        })
    });
    let errors = checks.iter().map(|check| {
        let measure = &check.measure;
        json!({
            "function": measure.function.name(),
            "scalar": measure.scalar.name(),
            "quantity": measure.quantity.symbol(),
            "against": check.against,
            "states": check.states,
            // An infinite error has no JSON: null.
            "error": measure.error,
            "error_in_u": measure.in_units(),
            "bound": check.bound,
            "passed": check.passed(),
        })
    });
    let claims = claims.iter().map(|claim| {
        let bounds = claim.certificate.bounds.iter();
        json!({
            "function": claim.certificate.emitted.function.name(),
            "scalar": claim.certificate.scalar.name(),
            "certified": bounds.map(|bound| bound.total()).collect::<Vec<_>>(),
            "observed": claim.attack.observed,
            "states": claim.attack.states,
            "passed": claim.passed(),
        })
    });
    let claims: Vec<Value> = claims.collect();
    let passed = checks.iter().all(Check::passed)
        && claims.iter().all(|c| c["passed"] == true)
        && sines.iter().all(sines::Check::passed);
    let sines: Vec<Value> = sines.iter().map(sines::Check::json).collect();
    json!({
        "robot": robot.name,
        "input": robot.short_hash(),
        "proofs": proofs.collect::<Vec<_>>(),
        "errors": errors.collect::<Vec<_>>(),
        "certificates": claims,
        "sines": sines,
        "warnings": generated.warnings,
        "passed": passed,
    })
}
