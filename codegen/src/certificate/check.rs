//! The check of a certificate, part by part.

use std::rc::Rc;

use dalembert_model::scene::{Scale, Tolerance};

use super::bounds::Shared;
use super::subject::{direct, printed};
use super::{Certificate, Checked, Ran, Refuted, run, shape, work};
use crate::bound::input_box::InputBox;
use crate::bound::ranges::{RANGE_BOXES, ranges};
use crate::bound::scale;
use crate::graph::Folding;
use crate::program::Trig;
use crate::scene::SceneRobot;
use crate::scene::{SceneKey, input_hash};
use crate::sincos;
use crate::sincos::proof;
use crate::split::ErrorByCause;
use crate::verify::exact::{prove, prove_same};

impl Certificate {
    /// Checks every part of the claim. In a scene with a tolerance, it must
    /// also be met, whether the claim is about the scene with it or without.
    ///
    /// # Errors
    /// The first part that is not so.
    pub fn check(&self, scene_robot: &SceneRobot) -> Result<Checked, Refuted> {
        let tolerance = scene_robot
            .scene()
            .and_then(|scene| scene.tolerance.as_ref());
        self.check_within(scene_robot, tolerance)
    }

    /// The same with another tolerance than the scene's, or with none.
    ///
    /// # Errors
    /// As [`Certificate::check`].
    pub fn check_within(
        &self,
        scene_robot: &SceneRobot,
        tolerance: Option<&Tolerance>,
    ) -> Result<Checked, Refuted> {
        self.check_subject(scene_robot)?;
        work::check(self).map_err(Refuted::Work)?;
        shape::check(self, scene_robot)?;
        self.check_box(scene_robot)?;
        self.check_text()?;
        self.check_scales(scene_robot)?;
        self.check_tolerance(tolerance)?;
        let equal = prove(scene_robot, &self.stages[0].program).map_err(Refuted::Exact)?;
        self.check_edits()?;
        self.check_sines()?;
        let table = ranges(
            &self.emitted,
            self.scalar,
            &self.sines,
            &self.limits,
            RANGE_BOXES,
        );
        let findings = table.findings;
        if let Some(&finding) = findings.iter().find(|finding| finding.is_error()) {
            return Err(Refuted::Range(finding));
        }
        let sines = [(self.scalar, self.sines.clone())];
        let subject = self.subject(scene_robot, &sines);
        let sensitivity = |bound_effort| Rc::new(subject.sensitivity(bound_effort));
        let found = self.check_claims(&Shared::new(subject, &sensitivity))?;
        Ok(Checked {
            proof: equal,
            bounds: found,
            ran: run::check(self, scene_robot)?,
            findings,
        })
    }

    /// The robot and the scene, which may have had no tolerance: a claim about
    /// that scene is one about this, as far as it goes.
    fn check_subject(&self, scene_robot: &SceneRobot) -> Result<(), Refuted> {
        let scene = scene_robot.scene();
        let own = scene.map(SceneKey::of);
        let bare = scene.map(|scene| SceneKey::of(&scene.without_tolerance()));
        if self.scene != own && self.scene != bare {
            return Err(Refuted::Scene);
        }
        if self.input != input_hash(scene_robot.robot()) || self.robot != scene_robot.robot().name {
            return Err(Refuted::Robot);
        }
        Ok(())
    }

    /// Runs the text at so many states, and nothing else.
    ///
    /// # Errors
    /// [`Refuted::Ran`] where it errs more than is claimed.
    pub fn run(&self, scene_robot: &SceneRobot, states: usize) -> Result<Ran, Refuted> {
        work::check(self).map_err(Refuted::Work)?;
        shape::check(self, scene_robot)?;
        run::check_at(self, scene_robot, states)
    }

    /// Before anything is proved of it: what a plan keeps is of this robot and scene,
    /// and its edits give its programs.
    pub(crate) fn check_programs(&self, scene_robot: &SceneRobot) -> Result<(), Refuted> {
        work::check(self).map_err(Refuted::Work)?;
        shape::check(self, scene_robot)?;
        self.check_edits()
    }

    /// The text is what the one function that prints makes of the claim.
    fn check_text(&self) -> Result<(), Refuted> {
        let expected = printed(&self.emitted, self.scalar, self.library, &self.sines);
        if self.text == expected {
            return Ok(());
        }
        let (mut found, mut expected) = (self.text.split('\n'), expected.split('\n'));
        for line in 1.. {
            let pair = (expected.next(), found.next());
            if pair.0 != pair.1 || pair.0.is_none() {
                let word = |line: Option<&str>| line.unwrap_or_default().to_owned();
                return Err(Refuted::Text {
                    line,
                    expected: word(pair.0),
                    found: word(pair.1),
                });
            }
        }
        Ok(())
    }

    /// Each polynomial's errors are proved again, from its literals and over
    /// all values that its angle takes.
    fn check_sines(&self) -> Result<(), Refuted> {
        for (index, sine) in self.sines.iter().enumerate() {
            let trig = &self.emitted.trig;
            let angle = sincos::angle_name(sine.angle);
            let (sin, cos) = (sine.kernel.sin.is_some(), sine.kernel.cos.is_some());
            let fits = |trig: &Trig| trig.angle == sine.angle && (trig.sin, trig.cos) == (sin, cos);
            let mut before = self.sines[..index].iter();
            if !trig.iter().any(fits) || before.any(|before| before.angle == sine.angle) {
                return Err(Refuted::Polynomials { angle });
            }
            let whole = sincos::range_of(sine.angle, &self.limits.position, self.scalar);
            let found = proof::prove(&sine.kernel, self.scalar, sine.range);
            let claimed = sine.errors;
            match found {
                _ if !sine.range.encloses(whole) => return Err(Refuted::SineRange { angle }),
                Some(found) if found.sin <= claimed.sin && found.cos <= claimed.cos => {}
                found => {
                    return Err(Refuted::Sine {
                        angle,
                        claimed,
                        found,
                    });
                }
            }
        }
        Ok(())
    }

    /// Each stage's edits apply and give the program that follows.
    /// A function that is bounded against the exact one need not come of it by edits.
    fn check_edits(&self) -> Result<(), Refuted> {
        if direct(&self.stages, &self.emitted).is_some() {
            return Ok(());
        }
        for (index, stage) in self.stages.iter().enumerate() {
            stage.check().map_err(|bad| Refuted::Edits(index, bad))?;
            let next = self.stages.get(index + 1).map(|next| &next.program);
            let edited = stage.program(Folding::Syntactic);
            let next = next.unwrap_or(&self.emitted);
            prove_same(&edited, next).map_err(|_| Refuted::Step(index))?;
        }
        Ok(())
    }

    /// A claim about a scene is one about all of its box.
    fn check_box(&self, scene_robot: &SceneRobot) -> Result<(), Refuted> {
        if scene_robot.scene().is_none() {
            return Ok(());
        }
        let whole = InputBox::within(scene_robot, self.emitted.function);
        match whole {
            Ok(whole) if self.limits.holds(&whole) => Ok(()),
            _ => Err(Refuted::Box),
        }
    }

    /// E of every output is within the tolerance, against the same scale.
    fn check_tolerance(&self, tolerance: Option<&Tolerance>) -> Result<(), Refuted> {
        let Some(tolerance) = tolerance else {
            return Ok(());
        };
        let allowed = scale::tolerances(&self.emitted, tolerance);
        let alike = self.relative_to == Some(tolerance.relative_to);
        let mut pairs = self.bounds.iter().zip(&allowed);
        // No number is within nothing.
        let within = |bound: &ErrorByCause, allowed: f64| alike && bound.total() <= allowed;
        match pairs.position(|(bound, &allowed)| !within(bound, allowed)) {
            None => Ok(()),
            Some(index) => Err(Refuted::Tolerance {
                entry: self.emitted.entry(index),
                allowed: (allowed[index], tolerance.relative_to),
                claimed: (self.bounds[index].total(), self.relative_to),
            }),
        }
    }

    /// A larger T would make E smaller.
    fn check_scales(&self, scene_robot: &SceneRobot) -> Result<(), Refuted> {
        let exact = &self.stages[0].program;
        let found = match self.relative_to {
            None => return Ok(()),
            Some(Scale::Actuator) => scale::actuator(scene_robot.robot(), exact).ok(),
            Some(Scale::Range) => Some(scale::range(exact, &self.limits)),
        };
        let found = found.ok_or(Refuted::Shape)?;
        let mut pairs = self.scales.iter().zip(&found);
        match pairs.position(|(claimed, found)| claimed.is_nan() || claimed > found) {
            None => Ok(()),
            Some(index) => Err(Refuted::Scale {
                entry: self.emitted.entry(index),
            }),
        }
    }
}
