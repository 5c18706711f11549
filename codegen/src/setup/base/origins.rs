//! About which points base parameters are taken.
//!
//! A link that turns may have its origin anywhere on its axis, one that slides anywhere at all:
//! another origin adds columns to others, and the columns stay as many. Where axes of earlier
//! joints pass through it, though, these have no lever, and a column costs less. So the operations
//! of all columns are counted as they are written, for the points where frames are anyway.

use dalembert_model::equations::chain::composite::CompositeOrder;
use dalembert_model::equations::chain::{Chain, MomentBody, Probe, Probed, Regrouping, Skeleton};
use dalembert_model::equations::matrix::{Vector, opposite, zero_vector};
use dalembert_model::equations::{JointPosition, SinCosPair};
use dalembert_model::number::Exact;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::count::{Count, Counter};

use super::moments::kept;

pub(super) fn chosen(skeleton: &Skeleton<Exact>) -> Regrouping<Exact> {
    let frames = without_bodies(skeleton);
    let mut best = Regrouping::base(&frames);
    let mut least = cost(&frames, &best);
    for link in (0..frames.links.len()).rev() {
        for origin in candidates(&frames, link) {
            let mut other = best.clone();
            other.links[link].origin = origin;
            let cost = cost(&frames, &other);
            if cost < least {
                (best, least) = (other, cost);
            }
        }
    }
    best
}

pub(super) fn without_bodies(skeleton: &Skeleton<Exact>) -> Skeleton<Exact> {
    let mut empty = skeleton.clone();
    empty.base = empty.base.map(|_| MomentBody::zero());
    for segment in &mut empty.links {
        segment.link.body = MomentBody::zero();
    }
    empty
}

fn candidates(skeleton: &Skeleton<Exact>, link: usize) -> Vec<Vector<Exact>> {
    let chain_link = &skeleton.links[link].link;
    let links = skeleton.links.iter().map(|segment| &segment.link);
    let behind = links.filter(|next| next.parent == Some(link));
    let next = behind.map(|next| next.offset.clone());
    let mut candidates = vec![zero_vector()];
    match chain_link.kind {
        JointKind::Revolute => {
            candidates.extend(next.map(|[_, _, z]| [Exact::zero(), Exact::zero(), z]));
        }
        JointKind::Prismatic => {
            candidates.push(opposite(&chain_link.offset));
            candidates.extend(next);
        }
    }
    candidates
}

fn cost(frames: &Skeleton<Exact>, regrouping: &Regrouping<Exact>) -> u64 {
    let mut chain = Chain::new(frames, regrouping);
    for link in &mut chain.links {
        let moments = kept(link.kind).iter().enumerate();
        link.probes = moments
            .map(|(column, moment)| Probe {
                column,
                of: Probed::Body(moment.unit()),
            })
            .collect();
    }
    chain.base_probes.clear();
    chain.columns = kept(JointKind::Revolute).len();
    let counter = Counter::new();
    let chain = chain.map(Exact::counted);
    let value = || counter.value();
    let of_kind = |kind: JointKind| match kind {
        JointKind::Revolute => JointPosition::Revolute(SinCosPair {
            sin: value(),
            cos: value(),
        }),
        JointKind::Prismatic => JointPosition::Prismatic(value()),
    };
    let position: Vec<_> = chain.links.iter().map(|link| of_kind(link.kind)).collect();
    let rates: Vec<Count<'_>> = (0..chain.coordinates()).map(|_| value()).collect();
    let (chain, at) = chain.posed(&position);
    chain.regressor(&at, &rates, &rates, CompositeOrder::Outward);
    let (multiplications, additions) = counter.counts();
    multiplications + additions
}
