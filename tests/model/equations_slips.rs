//! Comparing formulations catches any single slip in a formula: a wrong sign, or a dropped term.

use std::cell::Cell;

use crate::equations_support::random::{CONVENTIONS, Case, case, known};
use dalembert_model::equations::{DhVariables, Formulation};
use dalembert_model::scalar::field::{Field, Points};
use dalembert_model::scalar::{Divide, Scalar};

#[derive(Clone, Copy, PartialEq)]
enum Slip {
    None,
    Sign,
    Dropped,
    /// a + b becomes anything: harmless only if nothing depends on it.
    Random,
}

thread_local! {
    /// Additions still to come before the slip, and the slip.
    static PLAN: Cell<(u64, Slip)> = const { Cell::new((0, Slip::None)) };
    static ADDITIONS: Cell<u64> = const { Cell::new(0) };
}

fn added(a: Field, b: Field) -> Field {
    ADDITIONS.set(ADDITIONS.get() + 1);
    let (left, slip) = PLAN.get();
    PLAN.set((left.saturating_sub(1), slip));
    match (left, slip) {
        (1, Slip::Sign) => a.sub(&b),
        (1, Slip::Dropped) => a,
        (1, Slip::Random) => Field::new(0x1234_5678_9abc),
        _ => a.add(&b),
    }
}

/// A residue that knows when it is zero or one: which axes are parallel, or meet, is a matter of
/// structure. One of its additions slips where a test asks for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known(pub Field);

impl Scalar for Known {
    fn zero() -> Self {
        Known(Field::ZERO)
    }
    fn one() -> Self {
        Known(Field::ONE)
    }
    fn add(&self, other: &Self) -> Self {
        Known(added(self.0, other.0))
    }
    fn mul(&self, other: &Self) -> Self {
        Known(self.0.mul(&other.0))
    }
    fn neg(&self) -> Self {
        Known(self.0.neg())
    }
    fn half(&self) -> Self {
        Known(self.0.half())
    }
    fn is_zero(&self) -> bool {
        self.0 == Field::ZERO
    }
    fn is_one(&self) -> bool {
        self.0 == Field::ONE
    }
}

impl Divide for Known {
    fn div(&self, other: &Self) -> Self {
        Known(self.0.div(&other.0))
    }
}

#[test]
fn every_single_slip_is_caught() {
    let mut points = Points::new(30);
    let kinds = CONVENTIONS.map(|convention| [0b000, 0b010, 0b101].map(|bits| (convention, bits)));
    for (convention, bits) in kinds.concat() {
        let Case { arm, at, qd, qdd } = case(convention, 3, bits, &mut points);
        let exact = Formulation::LagrangeEuler;
        let truth = known(&exact.inverse_dynamics(&arm, &at, &qd, &qdd));
        let (arm, [qd, qdd]) = (arm.map(|x| Known(*x)), [qd, qdd].map(|x| known(&x)));
        let variables = at.iter().map(|at| {
            let (theta, d) = (at.theta.map(|x| Known(*x)), Known(at.d));
            DhVariables { theta, d }
        });
        let at: Vec<_> = variables.collect();
        for formulation in Formulation::ALL {
            let with = |position: u64, slip: Slip| {
                PLAN.set((position, slip));
                formulation.inverse_dynamics(&arm, &at, &qd, &qdd)
            };
            ADDITIONS.set(0);
            assert_eq!(with(0, Slip::None), truth);
            let additions = ADDITIONS.get();
            let matters = |position: &u64| with(*position, Slip::Random) != truth;
            let caught: Vec<u64> = (1..=additions).filter(matters).collect();
            let what = format!("{formulation:?} {convention:?} {bits:03b}");
            for &position in &caught {
                for slip in [Slip::Sign, Slip::Dropped] {
                    assert_ne!(with(position, slip), truth, "{what}: addition {position}");
                }
            }
            println!("{what}: {} of {additions}", caught.len());
            assert!(caught.len() as u64 * 2 > additions);
        }
    }
}
