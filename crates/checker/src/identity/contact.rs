//! The momentum about the centre of mass, a base that nothing holds, points that the ground holds, and
//! the space of the hand.

use super::matrix::{Matrix, minus, plus, solve, times, transposed};
use super::number::Number;
use super::outputs::At;
use super::screw::{Screw, Vector, cross, sum};
use super::table::View;

impl At<'_> {
    pub(super) fn centre(&self) -> Vector {
        let base = self.base.unwrap_or_default();
        let bodies = self.bodies.iter();
        let whole = bodies.fold(base, |total, body| total.plus(body));
        whole.first.map(|moment| moment / whole.mass)
    }

    /// Returns the rate of momentum about the centre of mass, without gravity, linear over angular.
    pub(super) fn about_centre(&self, qd: &[Number], qdd: &[Number]) -> Vec<Number> {
        let (Screw(moment, force), _) = self.wrenches(qd, qdd, Vector::default());
        [force, sum(moment, cross(force, self.centre()))].concat()
    }

    /// Returns accelerations at which nothing holds the base; those of the joints are given.
    pub(super) fn in_flight(&self) -> Vec<Number> {
        let first = self.first();
        let mut qdd = self.given("qdd").to_vec();
        qdd[..first].fill(0.into());
        let lacking = minus(&self.zeros(), &self.torques(&qdd))[..first].to_vec();
        let rows = self.inertia().into_iter().take(first);
        let block = rows.map(|row| row[..first].to_vec()).collect();
        qdd[..first].copy_from_slice(&solve(block, vec![lacking]).concat());
        qdd
    }

    /// Returns the rows that are asked of each point in contact; none without one.
    pub(super) fn of_points(&self, of: impl Fn(&At) -> Matrix) -> Option<Matrix> {
        let mut rows = Vec::new();
        for frame in self.view.frame.split(',') {
            let view = View {
                frame: frame.to_owned(),
                axes: String::new(),
                rows: vec![0, 1, 2],
            };
            let at = self.seen_as(&view);
            at.hand()?;
            rows.extend(of(&at));
        }
        Some(rows)
    }

    pub(super) fn contact_jacobians(&self) -> Matrix {
        self.of_points(|at| at.jacobian()).unwrap_or_default()
    }

    pub(super) fn contact_bias(&self) -> Vec<Number> {
        let rates = self.of_points(|at| vec![at.rate()]);
        rates.unwrap_or_default().concat()
    }

    /// Returns accelerations, and the forces that hold points in contact.
    pub(super) fn held(&self) -> [Vec<Number>; 2] {
        let j = self.moving(self.contact_jacobians());
        let [driven, mobility] = self.mobility_of(&j);
        let free = self.accelerations(self.given("tau"));
        let escape = plus(&times(&j, &free), &self.contact_bias());
        let opposite = escape.into_iter().map(|rate| -rate).collect();
        let forces = solve(self.damped(mobility), vec![opposite]).concat();
        [plus(&free, &times(&transposed(&driven), &forces)), forces]
    }

    /// Returns Jᵀw.
    pub(super) fn of_wrench(&self) -> Vec<Number> {
        times(&transposed(&self.jacobian()), self.given("wrench"))
    }

    /// Returns M + λ² 1.
    pub(super) fn damped(&self, mut matrix: Matrix) -> Matrix {
        for (k, row) in matrix.iter_mut().enumerate() {
            row[k] = row[k] + self.given("damping")[0];
        }
        matrix
    }

    /// Returns J D⁻¹ and Λ⁻¹ = J D⁻¹ Jᵀ.
    pub(super) fn mobility(&self) -> [Matrix; 2] {
        self.mobility_of(&self.moving_jacobian())
    }

    fn mobility_of(&self, j: &Matrix) -> [Matrix; 2] {
        let driven = self.driven(j.clone());
        let mobility = driven.iter().map(|row| times(j, row)).collect();
        [driven, mobility]
    }

    /// Returns J̄ = D⁻¹ Jᵀ Λ.
    pub(super) fn consistent(&self) -> Matrix {
        let [driven, mobility] = self.mobility();
        solve(self.damped(mobility), transposed(&driven))
    }

    pub(super) fn moving_jacobian(&self) -> Matrix {
        self.moving(self.jacobian())
    }
}
