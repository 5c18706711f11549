//! Requests: the functions, the robot and the scene that macro, build script, command and library
//! fill in, and that every stage of a generation reads.
//!
//! - this file: [`Job`]
//! - `error`: the reasons for which nothing is generated
//! - `request`: what somebody wants of a robot; [`options`]: the table of its options
//!
//! Takes words of macro, build script, command or library; returns a [`Request`], or a
//! [`GenerateError`].

mod error;
pub(crate) mod options;
mod request;

use dalembert_model::robot::Robot;
use dalembert_model::scene::Tolerance;

use crate::program::Program;
use crate::setup::Setup;
pub use error::{GenerateError, Miss};
pub use request::{Prefer, Request};

/// A request for a robot in its scene.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// The robot as its file has it.
    pub robot: &'a Robot,
    /// The robot in the request's scene, by [`Request::prepare`].
    pub setup: &'a Setup,
    pub request: &'a Request,
}

impl<'a> Job<'a> {
    /// Returns the job with another request for the same robot in the same scene.
    #[must_use]
    pub fn with<'b>(&self, request: &'b Request) -> Job<'b>
    where
        'a: 'b,
    {
        Job { request, ..*self }
    }

    pub fn tolerance(&self) -> Option<&'a Tolerance> {
        self.setup.scene()?.tolerance.as_ref()
    }

    pub(crate) fn finished(&self, program: &Program) -> Program {
        match self.request.fma {
            true => program.fused(),
            false => program.clone(),
        }
    }
}
