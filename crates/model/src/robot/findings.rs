//! Errors and warnings about robots and scenes, each at keys of the robot file.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::BodyRange;
use crate::diagnostic::{Diagnostic, Place, RobotWarning};

/// The errors and warnings about a robot or a scene, each at keys of the robot file.
#[derive(Default)]
pub(crate) struct Findings(pub(crate) Vec<Diagnostic>);

impl Findings {
    pub(crate) fn error(
        &mut self,
        place: impl Into<String>,
        message: impl Into<String>,
        help: &str,
    ) {
        self.push(Diagnostic::error(message), place, help);
    }

    pub(crate) fn warn(
        &mut self,
        warning: RobotWarning,
        place: impl Into<String>,
        message: impl Into<String>,
        help: &str,
    ) {
        self.push(Diagnostic::robot_warning(warning, message), place, help);
    }

    pub(crate) fn bodies(&mut self, place: impl Into<String>, range: &Option<BodyRange>) {
        if let Some((message, help)) = range.as_ref().and_then(BodyRange::error) {
            self.error(place, message, help);
        }
    }

    fn push(&mut self, diagnostic: Diagnostic, place: impl Into<String>, help: &str) {
        let place = Place::Keys(place.into());
        self.0.push(diagnostic.with_help(help).at(place));
    }
}

pub(super) fn of_base(key: &str) -> String {
    format!("joint/#0/{key}")
}

pub(super) fn of_joint(index: usize, key: &str) -> String {
    format!("joint/#{}/{key}", index + 1)
}
