//! The associations of the chain formulas; all give the same values.

use alloc::vec::Vec;

use super::composite::CompositeOrder;
use super::recursion::{AccelerationForm, MomentForm};

/// One association of the chain formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// The form of U.
    pub spin: AccelerationForm,
    /// The form of a link's own moment.
    pub couple: MomentForm,
    /// Which way D and c travel.
    pub travel: CompositeOrder,
    /// True if h comes from composite bodies, or from the recursion.
    pub composite_h: bool,
    /// True if C comes from composite momenta, or from the h_ikm.
    pub flows: bool,
}

impl Form {
    /// The forms that differ where the recursion over velocities is read, or not, where
    /// something travels, or not, and where C is wanted, or not; the usually cheapest first.
    pub fn all(recursion: bool, travels: bool, flows: bool) -> Vec<Form> {
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
                            });
                        }
                    }
                }
            }
        }
        forms.retain(|form| !form.is_idle(recursion, travels));
        forms
    }

    /// Returns whether it has a choice that nothing reads, made otherwise than
    /// the first.
    fn is_idle(self, recursion: bool, travels: bool) -> bool {
        let rates = self.spin == AccelerationForm::Rates;
        let euler = self.couple == MomentForm::Euler;
        let inward = self.travel == CompositeOrder::Inward;
        (!recursion && (rates || euler || self.composite_h))
            || (!travels && !self.flows && inward)
            || (self.composite_h && euler)
    }
}
