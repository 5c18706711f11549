//! The associations of the chain formulas; all give the same values.

use alloc::vec::Vec;

use crate::equations::link_axes::HandAxes;

/// One association of the chain formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// True if h comes from composite bodies, or from the recursion.
    pub composite_h: bool,
    /// True if C comes from composite momenta, or from the h_ikm.
    pub flows: bool,
    /// True if joints whose axes meet at the base are solved for as one.
    pub shoulder: bool,
    /// The form of quantities of the hand.
    pub hand: HandForm,
}

/// One association of the dynamics in the space of the hand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HandForm {
    /// The axes in which its velocity is.
    pub axes: HandAxes,
    /// True if J̄ and N come from normal equations, or from Λ.
    pub normal: bool,
}

/// A part of a form that a quantity reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// [`Form::composite_h`]
    CompositeH,
    /// [`Form::flows`]
    Flows,
    /// [`Form::shoulder`]
    Shoulder,
    /// [`HandForm::axes`]
    HandAxes,
    /// [`HandForm::normal`]
    NormalEquations,
}

impl Form {
    /// Returns the forms that differ in what is read, the usually cheapest first.
    pub fn all(is_read: impl Fn(Choice) -> bool) -> Vec<Form> {
        let values = |choice| &[false, true][..if is_read(choice) { 2 } else { 1 }];
        let axes = [HandAxes::Asked, HandAxes::FirstAndLast, HandAxes::Last];
        let axes = &axes[..if is_read(Choice::HandAxes) { 3 } else { 1 }];
        let mut forms = Vec::new();
        for &normal in values(Choice::NormalEquations) {
            for hand in axes.iter().map(|&axes| HandForm { axes, normal }) {
                for &flows in values(Choice::Flows) {
                    forms.extend(values(Choice::CompositeH).iter().map(|&composite_h| Form {
                        composite_h,
                        flows,
                        shoulder: false,
                        hand,
                    }));
                }
            }
        }
        if is_read(Choice::Shoulder) {
            // From torques of the recursion.
            let plain = forms.iter().filter(|form| !form.composite_h && !form.flows);
            let shoulder = plain.map(|&form| Form {
                shoulder: true,
                ..form
            });
            forms.extend(shoulder.collect::<Vec<Form>>());
        }
        forms
    }
}
