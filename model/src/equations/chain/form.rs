//! The associations of the chain formulas; all give the same values.

use alloc::vec::Vec;

use super::composite::CompositeOrder;
use super::recursion::{AccelerationForm, MomentForm};

/// One association of the chain formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// How U is formed.
    pub spin: AccelerationForm,
    /// How a link's own moment is formed.
    pub couple: MomentForm,
    /// Which way D and c travel.
    pub travel: CompositeOrder,
    /// Whether h comes from composite bodies, or from the recursion.
    pub composite_h: bool,
}

impl Form {
    /// The forms that differ where the recursion over velocities is read, or
    /// not, and where something travels, or not; the usually cheapest first.
    pub fn all(recursion: bool, travels: bool) -> Vec<Form> {
        let mut forms = Vec::new();
        for travel in [CompositeOrder::Outward, CompositeOrder::Inward] {
            for composite_h in [false, true] {
                for spin in [AccelerationForm::Column, AccelerationForm::Rates] {
                    for couple in [MomentForm::SecondMoments, MomentForm::Euler] {
                        // A choice that nothing reads.
                        let idle = (!recursion
                            && (spin == AccelerationForm::Rates
                                || couple == MomentForm::Euler
                                || composite_h))
                            || (!travels && travel == CompositeOrder::Inward)
                            || (composite_h && couple == MomentForm::Euler);
                        if !idle {
                            forms.push(Form {
                                spin,
                                couple,
                                travel,
                                composite_h,
                            });
                        }
                    }
                }
            }
        }
        forms
    }
}
