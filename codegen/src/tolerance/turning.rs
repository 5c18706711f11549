//! D bounded from below by how the links turn, wherever the joints are.
//!
//! With ω_i the angular velocity of link i, λ_i at most its moments about axes through its centre of
//! mass, and a_i armatures, q̇ᵀD q̇ ≥ Σ λ_i |ω_i|² + Σ a_i q̇_i². A joint that turns has |q̇_i| =
//! |ω_i − ω_c| ≤ |ω_i| + |ω_c|, c being the link that carries i. A base that floats adds m |u|², u being
//! the velocity of its centre of mass: each component of its origin's is at most |u| + |s| |ω|, s being
//! where that centre is. So D with entries that are off by e at most is positive definite if diag(a) − e
//! is, or, where all joints turn, diag(λ) − Bᵀe′B, where each row of B has these factors of a
//! coordinate, and e′ is e of which a is taken off, down to zero.

use std::iter::successors;

use dalembert_model::number::{Rational, Rounded};
use dalembert_model::robot::{Defect, FloatingBase, Joint, JointKind, Robot};
use num_traits::{Signed, Zero};

use super::definite::eliminated;

/// The loss of moments and sums that are rounded, many times over.
const SLACK: f64 = 1.0 - 1e-9;

pub(super) struct AxisLosses {
    kinds: Vec<JointKind>,
    moments: Vec<f64>,
    armatures: Vec<f64>,
    /// The links that carry those of the joints.
    carriers: Vec<Option<usize>>,
    /// The mass of a base that floats, its least moment, and the distance of its centre of mass.
    base: Option<[f64; 3]>,
}

impl AxisLosses {
    /// Returns none if a mass or a moment is negative, or if joints follow others.
    pub(super) fn new(robot: &Robot) -> Option<AxisLosses> {
        let is_body = |joint: &Joint| {
            let defect = joint.inertia.defect(&joint.mass);
            defect != Some(Defect::NegativeMoment) && !joint.mass.is_negative()
        };
        let joints = || robot.joints.iter();
        let armature = |joint: &Joint| f64::nearest_rational(&joint.armature) * SLACK;
        let base = robot.floating.as_ref().map(FloatingBase::body);
        let are_bodies = joints().chain(&base).all(is_body);
        let of_base = |body: &Joint| {
            let square: Rational = body.com.iter().map(|x| x * x).sum();
            let away = libm::sqrt(f64::nearest_rational(&square)) / SLACK;
            let mass = f64::nearest_rational(&body.mass) * SLACK;
            [mass, least_moment(body), away]
        };
        let rows = 0..robot.joints.len();
        (are_bodies && robot.followers.is_empty()).then(|| AxisLosses {
            kinds: joints().map(|joint| joint.kind).collect(),
            moments: joints().map(least_moment).collect(),
            armatures: joints().map(armature).collect(),
            carriers: rows.map(|row| robot.carrier(row)).collect(),
            base: base.as_ref().map(of_base),
        })
    }

    /// Returns true if D of these coordinates is positive definite with errors of at most so much.
    pub(super) fn bears(&self, rows: &[usize], errors: impl Fn(usize, usize) -> f64) -> bool {
        let count = rows.len();
        let first = self.base.map_or(0, |_| FloatingBase::COORDINATES);
        let square = |size: usize, entry: &dyn Fn(usize, usize) -> f64| {
            let row = |i: usize| (0..size).map(|j| entry(i, j)).collect();
            (0..size).map(row).collect::<Vec<Vec<f64>>>()
        };
        let joint = |place: usize| rows[place].checked_sub(first);
        let armature = |i: usize, j: usize| match joint(i) {
            Some(joint) if i == j => self.armatures[joint],
            _ => 0.0,
        };
        if eliminated(square(count, &|i, j| armature(i, j) - errors(i, j))).is_ok() {
            return true;
        }
        let slides = |joint: &usize| self.kinds[*joint] != JointKind::Revolute;
        if (0..count).filter_map(joint).any(|joint| slides(&joint)) {
            return false;
        }
        // The motions: of a base that floats |u| and |ω|, then |ω| of each joint's link. Links behind
        // a joint that stands still turn with those before it.
        let base_motions: usize = if first > 0 { 2 } else { 0 };
        let joints: Vec<usize> = (0..count).filter_map(joint).collect();
        let turning = |link: Option<usize>| {
            let mut links = successors(link, |&link| self.carriers[link]);
            let place = links.find_map(|link| joints.iter().position(|joint| *joint == link));
            place.map_or(base_motions.checked_sub(1), |place| {
                Some(base_motions + place)
            })
        };
        let mut least = vec![0.0; base_motions + joints.len()];
        let mut shares = vec![vec![0.0; least.len()]; count];
        if let Some([mass, moment, away]) = self.base {
            (least[0], least[1]) = (mass, moment);
            for (place, share) in shares.iter_mut().enumerate() {
                match rows[place] {
                    0..3 => (share[0], share[1]) = (1.0, away),
                    3..6 => share[1] = 1.0,
                    _ => {}
                }
            }
        }
        for (link, moment) in self.moments.iter().enumerate() {
            if let Some(motion) = turning(Some(link)) {
                least[motion] += moment;
            }
        }
        for (place, share) in shares.iter_mut().enumerate() {
            let Some(joint) = joint(place) else { continue };
            let motions = [Some(joint), self.carriers[joint]].map(turning);
            for motion in motions.into_iter().flatten() {
                share[motion] += 1.0;
            }
        }
        let left = square(count, &|i, j| match errors(i, j) - armature(i, j) {
            off if off <= 0.0 => 0.0,
            off => off,
        });
        let taken = |i: usize, j: usize| {
            let of_row = |(share, errors): (&Vec<f64>, &Vec<f64>)| {
                let columns = shares.iter().zip(errors);
                share[i] * columns.map(|(other, off)| off * other[j]).sum::<f64>()
            };
            shares.iter().zip(&left).map(of_row).sum::<f64>() / SLACK
        };
        let energy = |i: usize, j: usize| if i == j { least[i] * SLACK } else { 0.0 };
        let rest = square(least.len(), &|i, j| energy(i, j) - taken(i, j));
        eliminated(rest).is_ok()
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
        let turning = AxisLosses::new(&robot).unwrap();
        let uniform = |most: f64| move |_, _| most;
        assert!(turning.bears(&[0, 1], uniform(0.0)) && turning.bears(&[0, 1], uniform(0.02)));
        assert!(!turning.bears(&[0, 1], uniform(0.07)) && turning.bears(&[1], uniform(0.1)));
        // The errors of each row go with its joint.
        let one = |place: usize| move |i, j| if i == place && j == place { 0.1 } else { 0.0 };
        let bears = |rows: [usize; 2], place| turning.bears(&rows, one(place));
        assert!(bears([0, 1], 0) && bears([1, 0], 1) && !bears([0, 1], 1) && !bears([1, 0], 0));
        assert!(!turning.bears(&[1], uniform(0.31)) && !turning.bears(&[1], uniform(f64::NAN)));
    }
}
