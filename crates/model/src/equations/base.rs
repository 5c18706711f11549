//! What a fixed base cannot feel.

use super::Arm;
use crate::robot::{Convention, JointKind};
use crate::scalar::Scalar;

impl<S: Scalar + PartialEq> Arm<S> {
    /// Returns the same dynamics without the lengths that have no effect on it.
    ///
    /// While the links only slide, nothing turns: where the later links are cannot matter. While
    /// they turn about parallel axes alone, a shift of all that follows *along* these axes changes
    /// no velocity, no moment about an axis, and the potential energy by a constant. So these are
    /// set to zero:
    ///
    /// - a_i and d_i of the leading prismatic joints;
    /// - d_i of the first revolute joint (modified DH: a_i too, both act before
    ///   anything turns), and of the joints after it as long as their axes are
    ///   parallel, sin α = 0.
    ///
    /// In exact arithmetic no output changes. In floating point a base that
    /// stands 1e6 m away would take every digit of an f32 torque with it: the
    /// length cancels only after it has been multiplied and rounded.
    pub fn fold_base(mut self) -> Self {
        let is_modified = self.convention == Convention::Modified;
        let mut turned = false;
        for link in &mut self.links {
            // Modified DH: the twist comes before the joint.
            let parallel = link.alpha.sin == S::zero() && link.beta.is_none();
            if is_modified && turned && !parallel {
                break;
            }
            link.d = S::zero();
            let turns = turned || link.kind == JointKind::Revolute;
            let own_length_turns = if is_modified { turned } else { turns };
            if !own_length_turns {
                link.a = S::zero();
            }
            turned = turns;
            // Standard DH: the twist comes after it, and turns the next axis.
            if !is_modified && turned && !parallel {
                break;
            }
        }
        self
    }
}
