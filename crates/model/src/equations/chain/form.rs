//! The associations of the chain formulas; all give the same values.

use alloc::vec::Vec;

use super::composite::CompositeOrder;
use super::recursion::{AccelerationForm, MomentForm};
use crate::equations::link_axes::HandAxes;

/// One association of the chain formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// The form of U.
    pub spin: AccelerationForm,
    /// The form of a link's own moment.
    pub couple: MomentForm,
    /// The direction in which D and c travel.
    pub travel: CompositeOrder,
    /// True if h comes from composite bodies, or from the recursion.
    pub composite_h: bool,
    /// True if C comes from composite momenta, or from the h_ikm.
    pub flows: bool,
    /// True if joints whose axes meet at the base are solved for as one; of a base that floats, if its
    /// turns are eliminated after its shifts.
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

/// The parts of a hand's form that a quantity reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum HandChoice {
    /// Nothing.
    None,
    /// The axes.
    Axes,
    /// The axes, and where J̄ and N come from.
    Normal,
}

impl HandForm {
    fn all(choice: HandChoice) -> Vec<HandForm> {
        let axes = [HandAxes::Asked, HandAxes::FirstAndLast, HandAxes::Last];
        let axes = &axes[..if choice == HandChoice::None { 1 } else { 3 }];
        let normals = &[false, true][..if choice == HandChoice::Normal { 2 } else { 1 }];
        let of = |&normal: &bool| axes.iter().map(move |&axes| HandForm { axes, normal });
        normals.iter().flat_map(of).collect()
    }
}

impl Form {
    /// Returns the forms that differ if the recursion over velocities is read, something travels or
    /// C is wanted, and by what is read of the hand; the usually cheapest first.
    pub fn all(recursion: bool, travels: bool, flows: bool, hand: HandChoice) -> Vec<Form> {
        let hands = HandForm::all(hand).into_iter();
        let of = |hand| {
            let forms = Form::of_joints(recursion, travels, flows).into_iter();
            forms.map(move |form| Form { hand, ..form })
        };
        hands.flat_map(of).collect()
    }

    /// Returns those of the recursion, with joints whose axes meet at the base solved for as one.
    pub fn with_shoulder(forms: &[Form]) -> Vec<Form> {
        let forms = forms.iter().filter(|form| !form.composite_h && !form.flows);
        let shoulder = true;
        forms.map(|&form| Form { shoulder, ..form }).collect()
    }

    fn of_joints(recursion: bool, travels: bool, flows: bool) -> Vec<Form> {
        let mut forms = Vec::new();
        for flows in [false, true].into_iter().take(1 + usize::from(flows)) {
            for travel in [CompositeOrder::Outward, CompositeOrder::Inward] {
                for composite_h in [false, true] {
                    for spin in [AccelerationForm::Column, AccelerationForm::Rates] {
                        for couple in [MomentForm::SecondMoments, MomentForm::Euler] {
                            forms.push(Form {
                                spin,
                                couple,
                                travel,
                                composite_h,
                                flows,
                                shoulder: false,
                                hand: HandForm::default(),
                            });
                        }
                    }
                }
            }
        }
        forms.retain(|form| !form.is_idle(recursion, travels));
        forms
    }

    /// True if a choice that nothing reads is not the first one.
    fn is_idle(self, recursion: bool, travels: bool) -> bool {
        let rates = self.spin == AccelerationForm::Rates;
        let euler = self.couple == MomentForm::Euler;
        let inward = self.travel == CompositeOrder::Inward;
        (!recursion && (rates || euler || self.composite_h))
            || (!travels && !self.flows && inward)
            || (self.composite_h && euler)
    }
}
