//! The coefficients of the dynamics from the equations of the model, over any scalar.

use dalembert_codegen::Diagnostic;
use dalembert_codegen::workspace::{Quantity, Setup, Sizes};
use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::Chain;
use dalembert_model::equations::chain::composite::{Composite, CompositeOrder};
use dalembert_model::equations::following::{FollowerLine, gathered_rows};
use dalembert_model::equations::matrix::Columns;
use dalembert_model::scalar::Scalar;

use crate::arm::{PosedChain, SymbolicArm};
use crate::error;
use crate::ring::Polynomial;

/// D_ik, h_ikm and c_i of the joints that results are over.
#[derive(Clone, Debug, Default)]
pub struct Coefficients<S> {
    /// n×n, symmetric.
    pub inertia: Vec<Vec<S>>,
    /// n×n×n, symmetric in the last two.
    pub christoffel: Vec<Vec<Vec<S>>>,
    /// n.
    pub gravity: Vec<S>,
}

impl<S: Scalar> Coefficients<S> {
    /// Computes them from the composite bodies of a chain, whose frames are those of a posed one; `None` as
    /// soon as a number is lost.
    pub fn new(
        setup: &Setup,
        following: &[FollowerLine<S>],
        posed: &PosedChain<S>,
        chain: &Chain<S>,
        is_lost: impl Fn(&S) -> bool,
    ) -> Option<Coefficients<S>> {
        let composite = Composite::new(chain, &posed.at);
        let n = setup.rows().len();
        let sizes = Sizes::of(setup.robot());
        let select = |quantity: Quantity, values: Vec<S>| {
            let selected = setup.select(quantity, sizes, &posed.rows, following, values);
            (!selected.iter().any(&is_lost)).then_some(selected)
        };
        let square = |values: &[S]| values.chunks(n).map(<[S]>::to_vec).collect();
        let of_links = composite.gravity(CompositeOrder::Outward);
        let gravity = select(Quantity::Gravity, of_links)?;
        // A lost number shows here, before most of the work.
        let inertia = composite.inertia(CompositeOrder::Inward);
        let inertia = select(Quantity::Inertia, inertia.concat())?;
        let christoffel = composite.christoffel().into_iter().flatten().flatten();
        let christoffel = select(Quantity::Christoffel, christoffel.collect())?;
        Some(Coefficients {
            inertia: square(&inertia),
            christoffel: christoffel.chunks(n * n).map(square).collect(),
            gravity,
        })
    }
}

impl SymbolicArm {
    /// Computes the coefficients of a chain with the frames of a posed one.
    pub fn coefficients(
        &self,
        setup: &Setup,
        posed: &PosedChain<Polynomial>,
        chain: &Chain<Polynomial>,
    ) -> Result<Coefficients<Polynomial>, Diagnostic> {
        let following = &self.arm.following;
        Coefficients::new(setup, following, posed, chain, Polynomial::is_lost)
            .ok_or_else(error::large)
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
    let by_rows = Formulation::Dalembert.jacobian(&arm.arm, &at);
    let gathered = gathered_rows(&arm.arm.following, by_rows);
    let joints = setup.rows().iter();
    let columns: Vec<usize> = joints.map(|&joint| setup.robot().row_of(joint)).collect();
    let picked = |row: Vec<Polynomial>| columns.iter().map(|&k| row[k].clone()).collect();
    gathered.into_iter().map(picked).collect()
}

/// Returns U = −Σ m_j g·r_j, r_j from the origin of the base.
pub fn potential_energy(arm: &SymbolicArm) -> Polynomial {
    let at = arm.arm.at(&arm.position);
    Formulation::NewtonEulerLink.potential_energy(&arm.arm, &at)
}
