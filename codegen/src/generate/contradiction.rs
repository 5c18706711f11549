//! What was proved, tried: emitted code is run before it is handed out.
//!
//! A proof in a prime field may miss, with a chance that nobody will see, and
//! whoever writes it may err. Two states of the robot tell: the text, read back,
//! against the robot's own recursion in 256 bits. How far it may be off follows
//! from its own numbers ([`running`]); with a tolerance, from its certificate.

use crate::bound::sample::draw;
use crate::certificate::Certificate;
use crate::falsify::held;
use crate::generate::{GenerateError, GeneratedFunction};
use crate::random::Random;
use crate::scene::SceneRobot;
use crate::states::JointState;
use crate::verify::floating::Emitted;
use crate::verify::reference::Reference;
use crate::verify::running;

/// Two states: what is wrong, is wrong almost everywhere.
const STATES: usize = 2;

/// A seed of its own.
const SEED: u64 = 0x0074_7269_616c;

/// Runs every emitted function.
pub(super) fn check(
    scene_robot: &SceneRobot,
    functions: &[GeneratedFunction],
    emitted: &[Emitted],
) -> Result<(), GenerateError> {
    // Limits may reach beyond f32, and the reference is of finite numbers.
    let states: Vec<JointState> = scene_robot
        .states(STATES, SEED)
        .iter()
        .map(JointState::in_finite_single)
        .collect();
    let reference = Reference::new(scene_robot);
    for generated in functions {
        let certificates = generated.admitted.iter().flat_map(|a| &a.certificates);
        let certificates: Vec<&Certificate> = certificates.collect();
        for emitted in emitted.iter().filter(|e| e.function == generated.function) {
            let scalar = emitted.scalar;
            let claim = certificates.iter().find(|claim| claim.scalar == scalar);
            let mut random = Random::new(SEED);
            for state in &states {
                let (state, bounds) = match claim {
                    Some(claim) => {
                        let limits = &claim.limits;
                        let state = held(&draw(limits, &mut random), scalar, limits);
                        (state, claim.errors())
                    }
                    None => {
                        let (library, sines) = (emitted.text.library, generated.sines(scalar));
                        let program = &generated.program;
                        let bounds = running::errors(program, scalar, library, sines, state);
                        (state.clone(), bounds)
                    }
                };
                let truth = reference.run(generated.function, &state);
                let results = emitted.run(&state);
                for (index, ((result, truth), bound)) in
                    results.iter().zip(&truth).zip(bounds).enumerate()
                {
                    let error = truth.error(*result);
                    if error > bound {
                        let most = match claim {
                            Some(_) => "its certificate allows",
                            None => "rounding is no more than",
                        };
                        let why = format!(
                            "it passed its proof, but gave a wrong result when it was run: {} is \
                             {error:.3e} off the robot's own recursion, and {most} {bound:.3e}",
                            generated.program.entry(index)
                        );
                        let function = generated.function;
                        return Err(GenerateError::Defect(function, Some(scalar), why));
                    }
                }
            }
        }
    }
    Ok(())
}
