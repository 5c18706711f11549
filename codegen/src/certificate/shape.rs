//! A plan's variant fits the scene: the function, arguments and results of the robot in its
//! scene, and nothing read that they do not have.
//!
//! Everything after this may take for granted that lists are as long as they
//! should be, that operands come before their users, and that every input is
//! an argument's entry that the function may read.

use dalembert_model::robot::JointKind;

use super::{Certificate, Refuted, WrongInput};
use crate::function::Argument;
use crate::program::Input;
use crate::program::Program;
use crate::setup::Setup;

/// Checks that all parts of a claim fit the scene and each other.
pub(super) fn check(certificate: &Certificate, setup: &Setup) -> Result<(), Refuted> {
    let Certificate {
        emitted, limits, ..
    } = certificate;
    let (n, outputs) = (setup.joints(), emitted.dag.outputs.len());
    let lists = [&limits.position, &limits.velocity, &limits.acceleration];
    let fits = lists.iter().all(|list| list.len() == n) && certificate.scales.len() == outputs;
    if !fits {
        return Err(Refuted::Shape);
    }
    let checker = Checker { setup, emitted };
    checker.program("the exact program", &certificate.exact)?;
    checker.program("the emitted program", emitted)
}

struct Checker<'a> {
    setup: &'a Setup,
    emitted: &'a Program,
}

impl Checker<'_> {
    fn program(&self, name: &str, program: &Program) -> Result<(), Refuted> {
        let function = self.emitted.function;
        let rows = self.setup.rows();
        let signature = [
            ("function", program.function == function),
            ("number of joints", program.joints == self.setup.joints()),
            ("list of rows", program.rows == rows),
            (
                "list of arguments",
                program.arguments == self.setup.arguments(function),
            ),
            (
                "number of results",
                program.dag.outputs.len() == function.outputs(self.setup.sizes(function)),
            ),
        ];
        if let Some((what, _)) = signature.into_iter().find(|(_, same)| !same) {
            let program = name.to_owned();
            return Err(Refuted::Signature { program, what });
        }
        let mut inputs = program.dag.inputs();
        inputs.try_for_each(|input| self.input(name, *input))
    }

    fn input(&self, program: &str, input: Input) -> Result<(), Refuted> {
        match self.wrong(input) {
            None => Ok(()),
            Some(why) => Err(Refuted::Input {
                program: program.to_owned(),
                input: input.name(),
                why,
            }),
        }
    }

    fn wrong(&self, input: Input) -> Option<WrongInput> {
        let joints = &self.setup.robot().joints;
        let of = |joint: usize, kind: Option<JointKind>| match joints.get(joint) {
            None => Some(WrongInput::NoJoint),
            Some(_) if self.setup.lock(joint).is_some() => Some(WrongInput::Locked),
            Some(row) => match (kind, row.kind) {
                (Some(JointKind::Revolute), JointKind::Prismatic) => Some(WrongInput::Slides),
                (Some(JointKind::Prismatic), JointKind::Revolute) => Some(WrongInput::Turns),
                _ => None,
            },
        };
        let (argument, wrong) = match input {
            Input::Sin(joint) | Input::Cos(joint) => {
                let wrong = of(joint, Some(JointKind::Revolute));
                (Argument::Position, wrong)
            }
            // No bound is known of what its root costs.
            Input::PerSpeed(_) => (Argument::Velocity, Some(WrongInput::Friction)),
            Input::Entry(argument, joint) => {
                let slides = argument == Argument::Position;
                let kind = slides.then_some(JointKind::Prismatic);
                (argument, of(joint, kind))
            }
        };
        let missing = !self.emitted.arguments.contains(&argument);
        wrong.or(missing.then_some(WrongInput::NoArgument))
    }
}
