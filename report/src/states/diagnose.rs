//! Which usual mistake explains a disagreement: each is made on trial, and the
//! generic runtime says whether every state agrees then.

use dalembert_model::robot::Robot;

use super::case::{Case, Load};
use super::causes::{Cause, causes};
use super::{BOUND, GivenState};

/// States that a mistake is tried at before all of them are looked at.
const TRIAL: usize = 8;

/// A mistake that is not all of it must make the error this much smaller to be
/// named.
const NEAR: f64 = 1e-4;

/// The outcome of trying the usual mistakes.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Number of mistakes that were tried, pairs included.
    pub tried: usize,
    /// Those that explain the disagreement: every state agrees with the change
    /// that each names. Several only if they mean the same for this robot.
    pub explained_by: Vec<String>,
    /// If there is none: the mistake that brings the states closest, and the
    /// error that remains, if that is small.
    pub near: Option<(String, f64)>,
    /// The generic runtime agrees as it is: the robot is not at fault.
    pub agrees: bool,
    /// The error of the robot as it is.
    pub error: f64,
}

impl Diagnosis {
    /// Returns what to look at, a line or several.
    pub fn help(&self) -> String {
        let digits = |error: f64| -error.log10();
        if self.agrees {
            return "the generic runtime of this robot agrees with every state: \
                    the generated code is wrong, a defect of this program"
                .into();
        }
        if !self.explained_by.is_empty() {
            return format!(
                "every state agrees if {}",
                self.explained_by.join(", or if ")
            );
        }
        if let Some((cause, error)) = &self.near {
            return format!(
                "every state agrees to {:.1} digits if {cause}: the rest may be \
                 numbers written with too few digits",
                digits(*error)
            );
        }
        if self.error < NEAR {
            return format!(
                "all values agree to {:.1} digits: were they written with fewer than 17, \
                 or with another value of a parameter?",
                digits(self.error)
            );
        }
        format!(
            "none of {} usual causes alone makes every state agree: units (degrees, mm, g), signs \
             and axes of gravity, the DH convention, inertia about the origin instead of the centre \
             of mass, products of inertia, axes and zeros of single joints, damping and armature; \
             compare `c` at q = 0 first, then `D`, then `h`",
            self.tried
        )
    }
}

/// Tries the usual mistakes, and pairs of them.
pub fn diagnose(robot: &Robot, states: &[GivenState]) -> Diagnosis {
    let whole = Case {
        robot: robot.clone(),
        states: states.to_vec(),
        load: Load::default(),
    };
    let few = Case {
        states: trial(states),
        ..whole.clone()
    };
    let error = whole.error(f64::INFINITY);
    let mut diagnosis = Diagnosis {
        tried: 0,
        explained_by: Vec::new(),
        near: None,
        agrees: error <= BOUND,
        error,
    };
    if diagnosis.agrees {
        return diagnosis;
    }
    let causes = causes(robot);
    let limit = NEAR * error.min(1.0);
    let mut attempt = |made: &[&Cause]| {
        diagnosis.tried += 1;
        let changed = |case: &Case| {
            let mut case = case.clone();
            made.iter().for_each(|cause| (cause.change)(&mut case));
            case
        };
        if changed(&few).error(limit) > limit {
            return false;
        }
        let error = changed(&whole).error(f64::INFINITY);
        let words: Vec<&str> = made.iter().map(|cause| cause.text.as_str()).collect();
        let words = words.join(", and ");
        let nearest = diagnosis.near.as_ref().map_or(limit, |(_, error)| *error);
        if error <= BOUND {
            diagnosis.explained_by.push(words);
            return true;
        } else if error < nearest {
            diagnosis.near = Some((words, error));
        }
        false
    };
    let mut found = false;
    for cause in &causes {
        found |= attempt(&[cause]);
    }
    for (index, first) in causes.iter().enumerate() {
        // Two mistakes are a guess only as long as one explains nothing.
        if found {
            break;
        }
        let others = causes[index + 1..].iter();
        for second in others.filter(|second| first.of_all || second.of_all) {
            found |= attempt(&[first, second]);
        }
    }
    diagnosis
}

/// Returns a few states, spread over all of them.
fn trial(states: &[GivenState]) -> Vec<GivenState> {
    let step = states.len().div_ceil(TRIAL).max(1);
    states.iter().step_by(step).cloned().collect()
}
