//! Any single slip in a formula is caught by comparing formulations: a wrong
//! sign anywhere, a dropped term anywhere.

use std::cell::Cell;

use crate::equations_support::random::{Case, case, kinds};
use dalembert_model::equations::{Arm, DhVariables, Formulation};
use dalembert_model::robot::Convention;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

/// What happens to one addition or subtraction of a formula.
#[derive(Clone, Copy, PartialEq)]
enum Slip {
    None,
    /// a + b becomes a − b.
    Sign,
    /// a + b becomes a.
    Dropped,
    /// a + b becomes anything: harmless only if nothing depends on it.
    Random,
}

thread_local! {
    /// Additions still to come before the slip, and the slip.
    static PLAN: Cell<(u64, Slip)> = const { Cell::new((0, Slip::None)) };
    static ADDITIONS: Cell<u64> = const { Cell::new(0) };
}

/// A residue whose arithmetic slips once.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Slipping(Field);

impl Scalar for Slipping {
    fn zero() -> Self {
        Slipping(Field::ZERO)
    }
    fn one() -> Self {
        Slipping(Field::ONE)
    }
    fn add(&self, other: &Self) -> Self {
        ADDITIONS.set(ADDITIONS.get() + 1);
        let (left, slip) = PLAN.get();
        if left > 0 {
            PLAN.set((left - 1, slip));
        }
        Slipping(match (left, slip) {
            (1, Slip::Sign) => self.0.sub(&other.0),
            (1, Slip::Dropped) => self.0,
            (1, Slip::Random) => Field::new(0x1234_5678_9abc),
            _ => self.0.add(&other.0),
        })
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        Slipping(self.0.mul(&other.0))
    }
    fn neg(&self) -> Self {
        Slipping(self.0.neg())
    }
    fn half(&self) -> Self {
        Slipping(self.0.half())
    }
    // Zero terms are skipped, as no slip in them shows.
    fn is_zero(&self) -> bool {
        self.0 == Field::ZERO
    }
}

fn slipping(
    case: &Case,
) -> (
    Arm<Slipping>,
    Vec<DhVariables<Slipping>>,
    Vec<Slipping>,
    Vec<Slipping>,
) {
    let at = case.at.iter().map(|at| DhVariables {
        theta: at.theta.map(|x| Slipping(*x)),
        d: Slipping(at.d),
    });
    let at = at.collect();
    let wrap = |v: &[Field]| v.iter().map(|x| Slipping(*x)).collect();
    (
        case.arm.map(|x| Slipping(*x)),
        at,
        wrap(&case.qd),
        wrap(&case.qdd),
    )
}

#[test]
fn every_single_slip_is_caught() {
    let mut points = Points::new(30);
    for convention in [Convention::Standard, Convention::Modified] {
        for bits in [0b000, 0b010, 0b101] {
            let case = case(convention, &kinds(3, bits), &mut points);
            let (arm, at, qd, qdd) = slipping(&case);
            let truth = Formulation::LagrangeEuler
                .inverse_dynamics(&case.arm, &case.at, &case.qd, &case.qdd)
                .into_iter()
                .map(Slipping)
                .collect::<Vec<_>>();
            for formulation in Formulation::ALL {
                let with = |position: u64, slip: Slip| {
                    PLAN.set((position, slip));
                    formulation.inverse_dynamics(&arm, &at, &qd, &qdd)
                };
                ADDITIONS.set(0);
                assert!(with(0, Slip::None) == truth);
                let additions = ADDITIONS.get();
                let mut caught = 0;
                for position in 1..=additions {
                    if with(position, Slip::Random) == truth {
                        continue;
                    }
                    caught += 1;
                    for slip in [Slip::Sign, Slip::Dropped] {
                        assert!(
                            with(position, slip) != truth,
                            "{formulation:?} {convention:?} {bits:b}: addition {position}"
                        );
                    }
                }
                println!("{formulation:?} {convention:?} {bits:03b}: {caught} of {additions}");
                assert!(caught * 2 > additions);
            }
        }
    }
}

#[test]
fn gravity_of_the_wrong_sign_is_caught() {
    let mut points = Points::new(31);
    let Case { arm, at, qd, qdd } = case(Convention::Standard, &kinds(4, 0b0100), &mut points);
    let up = Arm {
        gravity: arm.gravity.map(|g| g.neg()),
        ..arm.clone()
    };
    let truth = Formulation::LagrangeEuler.inverse_dynamics(&arm, &at, &qd, &qdd);
    for formulation in Formulation::ALL {
        let tau = formulation.inverse_dynamics(&up, &at, &qd, &qdd);
        assert!(tau.iter().zip(&truth).all(|(a, b)| a != b));
    }
}
