//! What was proved, tried: emitted code is run before it is handed out.
//!
//! A proof in a prime field may miss, with a chance that nobody will see, and
//! whoever writes it may err. Two states of the robot tell: the text, read back,
//! against the robot's own recursion in 256 bits. How far it may be off follows
//! from its own numbers ([`running`]); with a tolerance, from its certificate.

use super::reason::Contradiction;
use crate::certificate::Refuted;
use crate::generate::{GenerateError, GeneratedFunction};
use crate::program::ScalarType;
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
        if let Some(admitted) = &generated.admitted {
            for certificate in &admitted.certificates {
                certificate
                    .run(scene_robot, STATES)
                    .map_err(|why| match why {
                        Refuted::Ran { .. } => GenerateError::Contradicted {
                            function: generated.function,
                            scalar: certificate.scalar,
                            why: Contradiction::Certificate(Box::new(why)),
                        },
                        other => GenerateError::Edited(generated.function, other),
                    })?;
            }
            continue;
        }
        for state in &states {
            let truth = reference.run(generated.function, state);
            let own = emitted.iter().filter(|e| e.function == generated.function);
            for emitted in own {
                let bounds = running::errors(
                    &generated.program,
                    emitted.scalar,
                    emitted.text.library,
                    generated.sines(emitted.scalar),
                    state,
                );
                let results = emitted.run(state);
                for (index, ((result, truth), bound)) in
                    results.iter().zip(&truth).zip(bounds).enumerate()
                {
                    let error = truth.error(*result);
                    if error > bound {
                        let entry = generated.program.entry(index);
                        return Err(contradicted(
                            generated,
                            emitted.scalar,
                            &entry,
                            error,
                            bound,
                        ));
                    }
                }
            }
        }
    }
    Ok(())
}

fn contradicted(
    generated: &GeneratedFunction,
    scalar: ScalarType,
    entry: &str,
    error: f64,
    bound: f64,
) -> GenerateError {
    GenerateError::Contradicted {
        function: generated.function,
        scalar,
        why: Contradiction::Recursion {
            entry: entry.to_owned(),
            error,
            bound,
        },
    }
}
