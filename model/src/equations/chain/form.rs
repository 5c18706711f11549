//! The associations of the chain formulas; all give the same values.

use alloc::vec::Vec;

use super::composite::Travel;
use super::recursion::{Couple, Spin};

/// One association of the chain formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// How U is formed.
    pub spin: Spin,
    /// How a link's own moment is formed.
    pub couple: Couple,
    /// Which way D and c travel.
    pub travel: Travel,
    /// Whether h comes from composite bodies, or from the recursion.
    pub composite_h: bool,
}

impl Form {
    /// The forms that differ where the recursion over velocities is read, or
    /// not, and where something travels, or not; the usually cheapest first.
    pub fn all(recursion: bool, travels: bool) -> Vec<Form> {
        let mut forms = Vec::new();
        for travel in [Travel::Outward, Travel::Inward] {
            for composite_h in [false, true] {
                for spin in [Spin::Column, Spin::Rates] {
                    for couple in [Couple::SecondMoments, Couple::Euler] {
                        // A choice that nothing reads.
                        let idle = (!recursion
                            && (spin == Spin::Rates || couple == Couple::Euler || composite_h))
                            || (!travels && travel == Travel::Inward)
                            || (composite_h && couple == Couple::Euler);
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
