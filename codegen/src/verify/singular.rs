//! Whether D has an inverse in almost every state, exactly.
//!
//! D of the joints that move is factorised from the hand inward at random
//! points, as proofs draw them. A pivot that is zero at every one of them is
//! zero in every state but for the chance of a miss, and says which joint
//! moves no inertia while the joints beyond it are free.

use dalembert_model::equations::factor::{Factor, among};
use dalembert_model::equations::forward::free;
use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::residue::Residue;

use super::challenge::{Point, Transcript};
use super::exact::{MAX_DRAWS, PRIMES, WRITTEN_LIMIT};
use crate::function::Function;
use crate::scene::Setting;

/// The joint nearest to the hand that moves no inertia in any state; none if
/// D has an inverse almost everywhere.
pub fn without_inertia(setting: &Setting, function: Function) -> Option<usize> {
    let mut transcript = Transcript::new("inertia");
    transcript.setting(setting);
    let challenge = transcript.seal();
    let mut drawn = (0..MAX_DRAWS).filter_map(|index| challenge.draw(index));
    let mut found = None;
    let mut seen = 0;
    while seen < PRIMES {
        // An unfit prime tells nothing; without fit ones the proof will say so.
        match zero_pivot(setting, function, &drawn.next()?) {
            None => continue,
            Some(None) => return None,
            Some(joint) => found = joint,
        }
        seen += 1;
    }
    found
}

/// The first zero pivot's joint, if there is one; nothing at an unfit point.
fn zero_pivot(setting: &Setting, function: Function, point: &Point) -> Option<Option<usize>> {
    let lost = std::cell::Cell::new(false);
    let constant = |value: &Exact| {
        point.constant(value).unwrap_or_else(|| {
            lost.set(true);
            Residue::zero()
        })
    };
    let arm = Arm::from_robot(setting.robot(), &mut { constant });
    let posed = setting.posed(function, arm, |input| point.input(input), constant);
    let (arm, motion) = (&posed.arm, &posed.motion);
    let formulation = match arm.links.len() <= WRITTEN_LIMIT {
        true => Formulation::LagrangeEuler,
        false => Formulation::NewtonEulerLink,
    };
    let free = free(&motion.moves);
    let d = formulation.inertia(arm, &arm.at(&motion.q));
    if lost.get() {
        return None;
    }
    let factor = Factor::new(&among(&d, &free));
    let pivots = factor.pivots().iter().zip(&free).rev();
    for (pivot, &joint) in pivots {
        if pivot.value(point.prime())? == 0 {
            return Some(Some(joint));
        }
    }
    Some(None)
}
