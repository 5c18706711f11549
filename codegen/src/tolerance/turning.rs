//! D bounded from below by how the links turn, wherever the joints are.
//!
//! With ω_i the angular velocity of link i, λ_i at most its moments about axes through its centre of
//! mass, and a_i armatures, q̇ᵀD q̇ ≥ Σ λ_i |ω_i|² + Σ a_i q̇_i². A joint that turns has |q̇_i| =
//! |ω_i − ω_(i−1)| ≤ |ω_i| + |ω_(i−1)|. So D with entries that are off by e at most is positive definite
//! if diag(a) − e is, or, where all joints turn, diag(λ) − Bᵀe′B, where B has ones at (i, i) and
//! (i, i−1), and e′ is e of which a is taken off, down to zero.

use dalembert_model::number::{Rational, Rounded};
use dalembert_model::robot::{Defect, Joint, JointKind, Robot};
use num_traits::{Signed, Zero};

use super::definite::eliminated;

/// The loss of moments and sums that are rounded, many times over.
const SLACK: f64 = 1.0 - 1e-9;

pub(super) struct Turning {
    kinds: Vec<JointKind>,
    moments: Vec<f64>,
    armatures: Vec<f64>,
}

impl Turning {
    /// Returns none if a mass or a moment is negative, if joints follow others, if links branch,
    /// or if the base floats.
    pub(super) fn new(robot: &Robot) -> Option<Turning> {
        let is_body = |joint: &Joint| {
            let defect = joint.inertia.defect(&joint.mass);
            defect != Some(Defect::NegativeMoment) && !joint.mass.is_negative()
        };
        let joints = || robot.joints.iter();
        let armature = |joint: &Joint| f64::nearest_rational(&joint.armature) * SLACK;
        let is_chain = robot.followers.is_empty() && !robot.is_tree();
        (joints().all(is_body) && is_chain).then(|| Turning {
            kinds: joints().map(|joint| joint.kind).collect(),
            moments: joints().map(least_moment).collect(),
            armatures: joints().map(armature).collect(),
        })
    }

    /// Returns true if D of these joints is positive definite with errors of at most so much.
    pub(super) fn bears(&self, rows: &[usize], errors: impl Fn(usize, usize) -> f64) -> bool {
        // From the base on: rows are in any order.
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by_key(|place| rows[*place]);
        let joints: Vec<usize> = order.iter().map(|place| rows[*place]).collect();
        let errors = |i: usize, j: usize| errors(order[i], order[j]);
        let square = |entry: &dyn Fn(usize, usize) -> f64| {
            let row = |i: usize| (0..joints.len()).map(|j| entry(i, j)).collect();
            (0..joints.len()).map(row).collect::<Vec<Vec<f64>>>()
        };
        let armature = |i: usize, j: usize| match i == j {
            true => self.armatures[joints[i]],
            false => 0.0,
        };
        if eliminated(square(&|i, j| armature(i, j) - errors(i, j))).is_ok() {
            return true;
        }
        let slides = |joint: &usize| self.kinds[*joint] != JointKind::Revolute;
        if joints.iter().any(slides) {
            return false;
        }
        // Links behind a joint that stands still turn with those before it.
        let moment = |i: usize| {
            let end = joints.get(i + 1).copied().unwrap_or(self.moments.len());
            self.moments[joints[i]..end].iter().sum::<f64>() * SLACK
        };
        let left = square(&|i, j| match errors(i, j) - armature(i, j) {
            off if off <= 0.0 => 0.0,
            off => off,
        });
        let below = |i: usize, j: usize| left.get(i).and_then(|row| row.get(j)).unwrap_or(&0.0);
        eliminated(square(&|i, j| {
            let off = left[i][j] + below(i + 1, j) + below(i, j + 1) + below(i + 1, j + 1);
            if i == j { moment(i) - off } else { -off }
        }))
        .is_ok()
    }
}

/// Returns a bound from below: λ₁ = det/(λ₂λ₃), and λ₂λ₃ ≤ (½ tr)².
fn least_moment(joint: &Joint) -> f64 {
    let [[a, d, e], [_, b, f], [_, _, c]] = joint.inertia.rows();
    let two = || Rational::from_integer(2.into());
    let det = &a * &b * &c + two() * &d * &e * &f - &a * &f * &f - &b * &e * &e - &c * &d * &d;
    let half = (a + b + c) / two();
    match half.is_zero() {
        true => 0.0,
        false => f64::nearest_rational(&(det / (&half * &half))) * SLACK,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dalembert_model::read::parse;

    /// λ is 0.13 of each link: two bear a fifth of that, one bears all.
    #[test]
    fn errors_are_borne_up_to_what_links_turn_with() {
        let head = "name = \"r\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n";
        let joint = "[[joint]]\nkind = \"revolute\"\nmass = 1\ncom = [0, 0, 0]\n\
            inertia = [0.3, 0.3, 0.3, 0, 0, 0]\n";
        let robot = parse(&format!("{head}{joint}{joint}")).unwrap().robot;
        let turning = Turning::new(&robot).unwrap();
        let all = |most: f64| move |_, _| most;
        assert!(turning.bears(&[0, 1], all(0.0)) && turning.bears(&[0, 1], all(0.02)));
        assert!(!turning.bears(&[0, 1], all(0.07)) && turning.bears(&[1], all(0.1)));
        // The errors of each row go with its joint.
        let one = |place: usize| move |i, j| if i == place && j == place { 0.1 } else { 0.0 };
        let bears = |rows: [usize; 2], place| turning.bears(&rows, one(place));
        assert!(bears([0, 1], 0) && bears([1, 0], 1) && !bears([0, 1], 1) && !bears([1, 0], 0));
        assert!(!turning.bears(&[1], all(0.31)) && !turning.bears(&[1], all(f64::NAN)));
    }
}
