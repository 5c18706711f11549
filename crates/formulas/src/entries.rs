//! The coefficients of the dynamics as polynomials, from the equations of the model.

use dalembert_codegen::workspace::{Quantity, Setup, Sizes};
use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::composite::{Composite, CompositeOrder};
use dalembert_model::equations::chain::{Chain, Displacement};
use dalembert_model::equations::following::gathered_rows;
use dalembert_model::equations::matrix::Columns;

use crate::arm::SymbolicArm;
use crate::ring::Polynomial;

/// D_ik, h_ikm and c_i of the joints that results are over.
#[derive(Clone, Debug)]
pub struct Coefficients {
    /// n×n, symmetric.
    pub inertia: Vec<Vec<Polynomial>>,
    /// n×n×n, symmetric in the last two.
    pub christoffel: Vec<Vec<Vec<Polynomial>>>,
    /// n.
    pub gravity: Vec<Polynomial>,
}

impl Coefficients {
    /// Computes them from the composite bodies of a chain.
    pub fn new(
        setup: &Setup,
        arm: &SymbolicArm,
        chain: &Chain<Polynomial>,
        at: &[Displacement<Polynomial>],
        rows: &[usize],
    ) -> Coefficients {
        let composite = Composite::new(chain, at);
        let n = setup.rows().len();
        let sizes = Sizes::of(setup.robot());
        let over = |quantity: Quantity, values: Vec<Polynomial>| {
            setup.select(quantity, sizes, rows, arm.following(), values)
        };
        let inertia = composite.inertia(CompositeOrder::Inward);
        let inertia = over(Quantity::Inertia, inertia.into_iter().flatten().collect());
        let christoffel = composite.christoffel().into_iter().flatten().flatten();
        let christoffel = over(Quantity::Christoffel, christoffel.collect());
        let gravity = over(
            Quantity::Gravity,
            composite.gravity(CompositeOrder::Outward),
        );
        let square = |values: &[Polynomial]| values.chunks(n).map(<[_]>::to_vec).collect();
        Coefficients {
            inertia: square(&inertia),
            christoffel: christoffel.chunks(n * n).map(square).collect(),
            gravity,
        }
    }
}

/// Returns the pose of the hand in base axes.
pub fn hand(arm: &SymbolicArm) -> Columns<Polynomial> {
    let at = arm.arm.at(&arm.position);
    Formulation::LagrangeEuler.hand(&arm.arm, &at)
}

/// Returns the Jacobian of the hand, 6×n, linear velocity first, in base axes.
pub fn jacobian(setup: &Setup, arm: &SymbolicArm) -> Vec<Vec<Polynomial>> {
    let at = arm.arm.at(&arm.position);
    let rows = Formulation::Dalembert.jacobian(&arm.arm, &at);
    let gathered = gathered_rows(arm.following(), rows);
    let columns = setup
        .rows()
        .iter()
        .map(|&joint| setup.robot().row_of(joint));
    let columns: Vec<usize> = columns.collect();
    let picked = |row: Vec<Polynomial>| columns.iter().map(|&k| row[k].clone()).collect();
    gathered.into_iter().map(picked).collect()
}

/// Returns U = −Σ m_j g·r_j, r_j from the origin of the base.
pub fn potential_energy(arm: &SymbolicArm) -> Polynomial {
    let at = arm.arm.at(&arm.position);
    Formulation::NewtonEulerLink.potential_energy(&arm.arm, &at)
}
