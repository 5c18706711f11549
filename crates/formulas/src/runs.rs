//! The runs of a robot: joints that turn about parallel axes.

use dalembert_codegen::workspace::Setup;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;

use crate::arm::{PosedChain, SymbolicArm, Variable};
use crate::canonical::Runs;
use crate::ring::Polynomial;

/// Finds the joints that turn about parallel axes, one carried by the other.
pub fn runs(setup: &Setup, arm: &SymbolicArm, chain: &PosedChain<Polynomial>) -> Runs {
    let robot = setup.robot();
    let variable = |joint: usize| {
        arm.variables
            .iter()
            .find(|variable| variable.joint == joint)
    };
    let mut runs: Vec<Vec<usize>> = Vec::new();
    let mut run_of_link: Vec<Option<usize>> = Vec::new();
    for (link, row) in chain.chain.links.iter().zip(&chain.rows) {
        let before = link.parent.and_then(|parent| run_of_link[parent]);
        if link.kind == JointKind::Prismatic {
            run_of_link.push(before);
            continue;
        }
        let is_parallel = link.rotation[0][2].is_zero() && link.rotation[1][2].is_zero();
        let run = match before.filter(|_| is_parallel) {
            Some(run) => run,
            None => {
                runs.push(Vec::new());
                runs.len() - 1
            }
        };
        run_of_link.push(Some(run));
        let joint = robot.mover_of(*row);
        let is_new = runs.iter().all(|run| !run.contains(&joint));
        if is_new && variable(joint).is_some() {
            runs[run].push(joint);
        }
    }
    for run in &mut runs {
        run.sort_unstable();
    }
    runs.retain(|run| !run.is_empty());
    let slides = arm
        .variables
        .iter()
        .filter(|variable| variable.kind == JointKind::Prismatic);
    Runs {
        runs,
        slide_symbols: slides.clone().map(Variable::slide_symbol).collect(),
        slides: slides.map(|variable| variable.joint).collect(),
    }
}
