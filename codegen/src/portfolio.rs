//! The formulations that a function can start from, each as a graph.
//!
//! The textbook forms are traced as they stand; the chain forms
//! ([`dalembert_model::equations::chain`]) in a gauge that is tuned to the
//! robot and the function: coordinate descent over the links' choices and the
//! unit of length, each candidate traced and merged by fingerprint, which
//! takes about a millisecond.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::chain::composite::{Composite, Travel};
use dalembert_model::equations::chain::gauge::Axial;
use dalembert_model::equations::chain::recursion::{Couple, Spin};
use dalembert_model::equations::chain::{Chain, Gauge, LinkGauge};
use dalembert_model::equations::matrix::{zero_vector, zeros};
use dalembert_model::equations::Arm;
use dalembert_model::number::Exact;
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::Scalar;

use crate::function::{Function, Quantity};
use crate::graph::symbol::Symbol;
use crate::graph::{Builder, Folding, Graph, Input};
use crate::simplify;
use crate::trace::Motion;

/// One association of the chain formulas; all give the same values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// How U is formed.
    pub spin: Spin,
    /// How a link's own moment is formed.
    pub couple: Couple,
    /// Which way D and c travel.
    pub travel: Travel,
    /// Whether h comes from composite bodies, or from the recursion.
    pub composite_h: bool,
}

impl Form {
    /// The forms that differ for a function, the usually cheapest first.
    pub fn of(function: Function) -> Vec<Form> {
        let mut forms = Vec::new();
        let quantities = function.quantities();
        let recursive = quantities
            .iter()
            .any(|q| matches!(q, Quantity::Torque | Quantity::Coriolis));
        let composite = quantities
            .iter()
            .any(|q| !matches!(q, Quantity::Torque | Quantity::Christoffel));
        for travel in [Travel::Outward, Travel::Inward] {
            for composite_h in [false, true] {
                for spin in [Spin::Column, Spin::Rates] {
                    for couple in [Couple::SecondMoments, Couple::Euler] {
                        let idle = (!recursive
                            && (spin == Spin::Rates || couple == Couple::Euler || composite_h))
                            || (!composite && (travel == Travel::Inward || composite_h))
                            || (composite_h && couple == Couple::Euler)
                            || (!quantities.contains(&Quantity::Coriolis) && composite_h)
                            || (quantities == [Quantity::Coriolis] && travel == Travel::Inward);
                        if !idle {
                            forms.push(Form {
                                spin,
                                couple,
                                travel,
                                composite_h,
                            });
                        }
                    }
                }
            }
        }
        forms
    }
}

/// The outputs of a function by the chain formulas, flat.
fn evaluate<S: Scalar>(
    function: Function,
    chain: &Chain<S>,
    form: Form,
    motion: &Motion<S>,
) -> Vec<S> {
    let at = chain.at(&motion.q);
    let composite = Composite::new(chain, &at);
    let mut outputs = Vec::new();
    for quantity in function.quantities() {
        match quantity {
            Quantity::Torque => outputs.extend(chain.inverse_dynamics(
                &at,
                &motion.qd,
                &motion.qdd,
                form.spin,
                form.couple,
            )),
            Quantity::Inertia => {
                outputs.extend(composite.inertia(form.travel).into_iter().flatten());
            }
            Quantity::Coriolis if form.composite_h => {
                outputs.extend(composite.velocity_terms(&motion.qd, form.spin));
            }
            Quantity::Coriolis => {
                let mut still = chain.clone();
                still.gravity = zero_vector();
                for link in &mut still.links {
                    link.viscous = S::zero();
                }
                let rest = zeros(chain.links.len());
                outputs.extend(still.inverse_dynamics(
                    &at,
                    &motion.qd,
                    &rest,
                    form.spin,
                    form.couple,
                ));
            }
            Quantity::Christoffel => {
                outputs.extend(composite.christoffel().into_iter().flatten().flatten());
            }
            Quantity::Gravity => outputs.extend(composite.gravity(form.travel)),
        }
    }
    outputs
}

/// Traces a function by the chain formulas.
pub fn trace_chain(
    robot: &Robot,
    function: Function,
    chain: &Chain<Exact>,
    form: Form,
    folding: Folding,
) -> Graph {
    let builder = Rc::new(RefCell::new(Builder::new(folding)));
    let chain = chain.map(|constant| Symbol::from(constant.clone()));
    let motion = Motion::of(robot, |input: Input| Symbol::input(&builder, input));
    let outputs: Vec<_> = evaluate(function, &chain, form, &motion)
        .iter()
        .map(Symbol::value)
        .collect();
    std::mem::replace(&mut *builder.borrow_mut(), Builder::new(folding)).finish(&outputs)
}

/// The robot's arm with exact parameters, the base folded.
pub fn exact_arm(robot: &Robot) -> Arm<Exact> {
    Arm::from_robot(robot, &mut Exact::clone).fold_base()
}

/// The gauge that coordinate descent finds for a function, and its graphs in
/// every form: the cheapest form first.
pub fn tuned(robot: &Robot, function: Function, rounds: usize) -> Vec<Graph> {
    let arm = exact_arm(robot);
    let forms = Form::of(function);
    let price = |gauge: &Gauge<Exact>, form: Form| {
        let chain = Chain::new(&arm, gauge);
        simplify::cost(&trace_chain(robot, function, &chain, form, Folding::Semantic))
    };
    let mut gauge = Gauge::base(robot.joints.len());
    let mut best = (u64::MAX, forms[0]);
    for &form in &forms {
        let cost = price(&gauge, form);
        if cost < best.0 {
            best = (cost, form);
        }
    }
    for _ in 0..rounds {
        let before = best.0;
        for unit in units(&arm) {
            let Some(per_unit) = unit.as_rational().map(|r| Exact::from(r.recip())) else {
                continue;
            };
            let candidate = Gauge {
                unit,
                per_unit,
                ..gauge.clone()
            };
            try_gauge(&mut gauge, candidate, &mut best, &price);
        }
        for i in (0..robot.joints.len()).rev() {
            for choice in choices(robot.joints[i].kind) {
                let mut candidate = gauge.clone();
                candidate.links[i] = choice;
                try_gauge(&mut gauge, candidate, &mut best, &price);
            }
        }
        for &form in &forms {
            let cost = price(&gauge, form);
            if cost < best.0 {
                best = (cost, form);
            }
        }
        if best.0 >= before {
            break;
        }
    }
    let chain = Chain::new(&arm, &gauge);
    let mut graphs: Vec<Graph> = forms
        .iter()
        .map(|&form| trace_chain(robot, function, &chain, form, Folding::Syntactic))
        .collect();
    if let Some(first) = forms.iter().position(|&form| form == best.1) {
        graphs.swap(0, first);
    }
    graphs
}

fn try_gauge(
    gauge: &mut Gauge<Exact>,
    candidate: Gauge<Exact>,
    best: &mut (u64, Form),
    price: &impl Fn(&Gauge<Exact>, Form) -> u64,
) {
    let cost = price(&candidate, best.1);
    if cost < best.0 {
        best.0 = cost;
        *gauge = candidate;
    }
}

/// Metres, and every length of the table.
fn units(arm: &Arm<Exact>) -> Vec<Exact> {
    let mut units = vec![Exact::one()];
    for link in &arm.links {
        for length in [&link.a, &link.d] {
            let length = if length.leads_negative() {
                length.neg()
            } else {
                length.clone()
            };
            if !length.is_zero() && !units.contains(&length) {
                units.push(length);
            }
        }
    }
    units
}

fn choices(kind: JointKind) -> Vec<LinkGauge> {
    let mut choices = Vec::new();
    for far_origin in [true, false] {
        match kind {
            JointKind::Prismatic => {
                for axial in [Axial::None, Axial::All] {
                    choices.push(LinkGauge {
                        far_origin,
                        axial,
                        ..LinkGauge::default()
                    });
                }
            }
            JointKind::Revolute => {
                for keep_mass in [false, true] {
                    for keep_first in [false, true] {
                        for axial in [Axial::None, Axial::All, Axial::MinusXx, Axial::MinusYy] {
                            choices.push(LinkGauge {
                                far_origin,
                                keep_mass,
                                keep_first,
                                axial,
                            });
                        }
                    }
                }
            }
        }
    }
    choices
}
