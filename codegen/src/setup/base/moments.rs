//! The moments of a body that base parameters are of, and what each link keeps
//! of a body where all moves inward that can.

use dalembert_model::equations::chain::body::entry;
use dalembert_model::equations::chain::{Chain, MomentBody};
use dalembert_model::number::Exact;
use dalembert_model::robot::{Inertia, JointKind};
use dalembert_model::scalar::Scalar;

/// Combinations with more monomials than this in a coefficient are not formed:
/// every odd angle between two joints multiplies them.
pub(super) const MAX_TERMS: usize = 400;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Moment {
    Mass,
    First(usize),
    Second(usize, usize),
}

impl Moment {
    /// All of a body.
    pub(super) const ALL: [Moment; 10] = [
        Moment::Mass,
        Moment::First(0),
        Moment::First(1),
        Moment::First(2),
        Moment::Second(0, 0),
        Moment::Second(1, 1),
        Moment::Second(2, 2),
        Moment::Second(0, 1),
        Moment::Second(0, 2),
        Moment::Second(1, 2),
    ];

    pub(super) fn unit(self) -> MomentBody<Exact> {
        let mut body = MomentBody::zero();
        match self {
            Moment::Mass => body.mass = Exact::one(),
            Moment::First(axis) => body.first[axis] = Exact::one(),
            Moment::Second(row, column) => {
                body.second = Inertia::symmetric(|i, j| match (i, j) == (row, column) {
                    true => Exact::one(),
                    false => Exact::zero(),
                });
            }
        }
        body
    }

    pub(super) fn read(self, body: &MomentBody<Exact>) -> &Exact {
        match self {
            Moment::Mass => &body.mass,
            Moment::First(axis) => &body.first[axis],
            Moment::Second(row, column) => entry(&body.second, row, column),
        }
    }
}

pub(super) fn kept(kind: JointKind) -> &'static [Moment] {
    match kind {
        JointKind::Revolute => &[
            Moment::Second(0, 0),
            Moment::Second(1, 1),
            Moment::Second(0, 1),
            Moment::Second(0, 2),
            Moment::Second(1, 2),
            Moment::First(0),
            Moment::First(1),
        ],
        // Its mass and first moments.
        JointKind::Prismatic => &Moment::ALL[..4],
    }
}

/// Returns the part of a body that each link keeps; behind the last, the part of a base that floats.
pub(super) fn parts(
    chain: &Chain<Exact>,
    link: Option<usize>,
    body: &MomentBody<Exact>,
) -> Option<Vec<MomentBody<Exact>>> {
    let mut parts = vec![MomentBody::zero(); chain.links.len()];
    let mut arriving = body.clone();
    for i in link.into_iter().flat_map(|link| chain.way(link)) {
        if terms(&arriving) > MAX_TERMS {
            return None;
        }
        (parts[i], arriving) = chain.links[i].split_base(&arriving);
    }
    parts.push(arriving);
    Some(parts)
}

fn terms(body: &MomentBody<Exact>) -> usize {
    let mut most = 0;
    body.map(|x| most = most.max(x.terms()));
    most
}
