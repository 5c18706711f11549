//! The parameters that torques are linear in: a column for each of each link.

use dalembert_model::equations::chain::{Chain, MomentBody, Regrouping, Skeleton};
use dalembert_model::number::{Exact, Rational};
use dalembert_model::robot::{Inertia, JointKind};
use dalembert_model::scalar::Scalar;

use crate::dag::{Dag, Folding};
use crate::function::Function;
use crate::program::Program;
use crate::seeds::{skeleton, trace_chain};
use crate::setup::{FittedLink, Setup};
use crate::tolerance::net::Net;
use crate::tolerance::samples::Samples;
use crate::tolerance::search::Target;

/// An output that is never more than this part of its allowance is zero.
const NOTHING: f64 = 0.97;

#[derive(Clone, Debug)]
pub(super) struct Term {
    pub link: usize,
    pub unit: FittedLink,
    /// Those that together can do what it does: it may stand in their place.
    pub stands_for: Option<[usize; 2]>,
    /// Its column: outputs, positions, monomials; relative to the allowances.
    pub column: Vec<f64>,
}

pub(super) struct Terms {
    pub all: Vec<Term>,
    pub whole: Vec<f64>,
    pub outputs: Vec<usize>,
    pub samples: Samples,
}

impl Terms {
    /// `None` unless the results are linear in the links' parameters, and one a row.
    pub(super) fn new(target: Target<'_>, samples: Samples) -> Option<Terms> {
        let (setup, exact, allowances) = (target.setup, target.exact, target.allowances);
        let function = exact.function;
        let mut quantities = function.quantities().iter();
        let is_regrouped = quantities.all(|quantity| quantity.is_regrouped());
        // A base that floats adds terms of no link.
        let is_fixed = setup.robot().floating.is_none();
        let is_plain = setup.load().is_none() && !setup.takes_any(function) && is_fixed;
        if exact.dag.outputs.len() != exact.rows.len() || !is_regrouped || !is_plain {
            return None;
        }
        let m = samples.len();
        let mut terms = Terms {
            all: Vec::new(),
            whole: Vec::new(),
            outputs: Vec::new(),
            samples,
        };
        let whole = terms.values(exact);
        for (output, (values, &allowance)) in whole.chunks_exact(m).zip(allowances).enumerate() {
            let largest = terms.samples.blocks(values).into_iter().fold(0.0, f64::max);
            if largest > NOTHING * allowance {
                // A result that may not err at all cannot be fitted.
                if allowance <= 0.0 {
                    return None;
                }
                terms.outputs.push(output);
                terms.whole.extend(values.iter().map(|x| x / allowance));
            }
        }
        let skeleton = skeleton(setup);
        for (link, unit, stands_for) in units(&skeleton) {
            let mut links = nothing(&skeleton);
            links[link] = unit.clone();
            let fitted = setup.fitted(links, &exact.rows);
            let graph = traced(&fitted, function)?;
            let values = terms.values(&fitted.task(function).program(&graph));
            let mut column = Vec::new();
            for &output in &terms.outputs {
                let entries = values[output * m..][..m].iter();
                column.extend(entries.map(|x| x / allowances[output]));
            }
            terms.all.push(Term {
                link,
                unit,
                stands_for,
                column,
            });
        }
        Some(terms)
    }

    fn values(&self, program: &Program) -> Vec<f64> {
        let mut values = Net::at(program, &self.samples);
        self.samples.coefficients(&mut values);
        values
    }
}

pub(super) fn traced(setup: &Setup, function: Function) -> Option<Dag> {
    let skeleton = skeleton(setup);
    let chain = Chain::new(&skeleton, &Regrouping::base(&skeleton));
    let form = *function.forms().first()?;
    Some(trace_chain(setup.task(function), &chain, form, Folding::Semantic).0)
}

pub(super) fn nothing(skeleton: &Skeleton<Exact>) -> Vec<FittedLink> {
    skeleton.links.iter().map(|_| zero()).collect()
}

fn zero() -> FittedLink {
    FittedLink {
        body: MomentBody::zero(),
        armature: Exact::zero(),
        viscous: Exact::zero(),
    }
}

/// Returns the terms of every link: about a point on its axis what cannot move to the link
/// before, and ties of the two squares across the axis: a disc, and its opposite.
fn units(skeleton: &Skeleton<Exact>) -> Vec<(usize, FittedLink, Option<[usize; 2]>)> {
    let mut units: Vec<(usize, FittedLink, Option<[usize; 2]>)> = Vec::new();
    // By its entries xx, yy, zz, xy, yz and xz.
    let second = |entries: [i64; 6]| MomentBody {
        second: Inertia::of(entries.map(|x| Exact::from(Rational::from_integer(x.into())))),
        ..MomentBody::zero()
    };
    let first = |axis: usize| {
        let mut body = MomentBody::zero();
        body.first[axis] = Exact::one();
        body
    };
    for (link, segment) in skeleton.links.iter().enumerate() {
        let start = units.len();
        let bodies = match segment.link.kind {
            JointKind::Revolute => {
                let about = [Exact::zero(), Exact::zero(), segment.d.clone()];
                let bodies = vec![
                    second([1, 0, 0, 0, 0, 0]),
                    second([0, 1, 0, 0, 0, 0]),
                    second([1, 1, 0, 0, 0, 0]),
                    second([1, -1, 0, 0, 0, 0]),
                    second([0, 0, 0, 1, 0, 0]),
                    second([0, 0, 0, 0, 0, 1]),
                    second([0, 0, 0, 0, 1, 0]),
                    first(0),
                    first(1),
                ];
                bodies.iter().map(|body| body.moved(&about)).collect()
            }
            JointKind::Prismatic => {
                let mut mass = MomentBody::zero();
                mass.mass = Exact::one();
                vec![mass, first(0), first(1), first(2)]
            }
        };
        for (index, body) in bodies.into_iter().enumerate() {
            let is_tied = segment.link.kind == JointKind::Revolute && (2..4).contains(&index);
            let unit = FittedLink { body, ..zero() };
            units.push((link, unit, is_tied.then_some([start, start + 1])));
        }
        if !segment.link.armature.is_zero() {
            let armature = Exact::one();
            units.push((link, FittedLink { armature, ..zero() }, None));
        }
        if !segment.link.friction.viscous.is_zero() {
            let viscous = Exact::one();
            units.push((link, FittedLink { viscous, ..zero() }, None));
        }
    }
    units
}
