//! Functions by the chain formulas, traced in a regrouping and a form.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

use dalembert_model::equations::chain::composite::Composite;
use dalembert_model::equations::chain::{Chain, Skeleton};
use dalembert_model::equations::matrix::{Vector, scaled};
use dalembert_model::equations::regressor::Column;
use dalembert_model::equations::{Arm, DhVariables, Formulation};
use dalembert_model::number::Exact;
use dalembert_model::outputs::{Motion, Regrouped, RuntimeParameter, Written};

use super::load::symbols;
use super::{ChainChoice, Form, Seed, Source, reader};
use crate::dag::symbol::Symbol;
use crate::dag::{Builder, Dag, Folding, Leaves};
use crate::function::{Argument, Quantity};
use crate::program::{Counts, Input};
use crate::scalar::{AnyLeaves, Erase, restored};
use crate::setup::{Setup, Task};

/// Traces a function by the chain formulas; also the operations as executed.
pub fn trace_chain(
    task: Task<'_>,
    chain: &Chain<Exact>,
    form: Form,
    folding: Folding,
) -> (Dag, Counts) {
    trace_symbols(task, form, folding, |builder| symbols(task, chain, builder))
}

/// Traces a function by the chain formulas, of a chain of symbols.
pub(crate) fn trace_symbols(
    task: Task<'_>,
    form: Form,
    folding: Folding,
    chain: impl FnOnce(&Rc<RefCell<Builder>>) -> Chain<Symbol>,
) -> (Dag, Counts) {
    let Task { setup, function } = task;
    let builder = Rc::new(RefCell::new(Builder::new(folding)));
    let mut chain = chain(&builder);
    let mut gravity = None;
    if setup.takes(function, RuntimeParameter::Gravity) {
        let entry = |axis| Symbol::input(&builder, Input::Entry(Argument::Gravity, axis));
        let gravity_entries = [0, 1, 2].map(entry);
        let arm = setup.arm(Symbol::constant).with_gravity(&gravity_entries);
        chain.gravity = scaled(&chain.per_unit, &arm.gravity);
        gravity = Some(gravity_entries);
    }
    let arguments = function.arguments();
    let leaves = (Symbol::constant, reader(&arguments, &builder));
    let whole = setup.motion(&leaves.1, leaves.0);
    let rows = &setup.chained_rows();
    let following = &setup.following(Symbol::constant);
    let motion = &whole.of_joints(rows);
    let chain = chain.at_speeds(&motion.per_speed);
    let (chain, at) = &chain.posed(chain.of_joints(&motion.q));
    let composite = Composite::new(chain, at);
    let of_frame = |quantity: &Quantity| quantity.is_regrouped() && quantity.is_of_frame();
    let arm = (function.quantities().iter().any(of_frame)).then(|| moving(setup, None, &leaves).0);
    let position = arm.as_ref().map_or_else(Vec::new, |arm| arm.at(&whole.q));
    let among = following.iter().filter_map(|follower| follower.among(rows));
    let regrouped = Regrouped {
        chain,
        at,
        composite,
        motion,
        form,
        textbook: arm.as_ref().map(|arm| textbook(arm, &position, &whole)),
        joints: rows,
        following: &among.collect::<Vec<_>>(),
        shared: Default::default(),
    };
    let sizes = setup.sizes(function);
    let mut outputs = Vec::new();
    for &quantity in function.quantities() {
        let (rows, values) = match quantity.regrouped(&regrouped) {
            Some(values) => (rows.clone(), values),
            None => {
                let gravity = gravity.clone().map(|taken| taken.map(Symbol::erase));
                let (any, motion) = moving(setup, gravity.as_ref(), &AnyLeaves(&leaves));
                let values = quantity.written(&textbook(&any, &any.at(&motion.q), &motion));
                ((0..whole.q.len()).collect(), restored(values))
            }
        };
        let selected = setup.select(quantity, sizes, &rows, following, values);
        let mut builder = builder.borrow_mut();
        outputs.extend(selected.iter().map(|output| output.edge(&mut builder)));
    }
    let builder = builder.replace(Builder::new(folding));
    let traced = builder.asked();
    (builder.finish(outputs), traced)
}

fn moving<L: Leaves>(
    setup: &Setup,
    gravity: Option<&Vector<L::Value>>,
    leaves: &L,
) -> (Arm<L::Value>, Motion<L::Value>) {
    let constant = |constant: &Exact| leaves.constant(constant);
    let motion = setup.motion(|input| leaves.input(input), constant);
    let mut arm = setup.arm(constant);
    if let Some(gravity) = gravity {
        arm = arm.with_gravity(gravity);
    }
    (arm.at_speeds(&motion.per_speed), motion)
}

fn textbook<'a, S>(
    arm: &'a Arm<S>,
    at: &'a [DhVariables<S>],
    motion: &'a Motion<S>,
) -> Written<'a, S> {
    Written {
        formulation: Formulation::NewtonEulerLink,
        arm,
        at,
        motion,
        columns: &[],
    }
}

/// Returns the moving links, with exact parameters, the base folded.
pub fn skeleton(setup: &Setup) -> Skeleton<Exact> {
    of_arm(setup, setup.arm(Exact::clone), &[])
}

/// Builds the skeleton of a function: of a regressor with its columns; of one that takes a
/// load, with parameters that are unknown.
pub(crate) fn skeleton_for(task: Task<'_>) -> Skeleton<Exact> {
    let Task { setup, function } = task;
    if !setup.takes_load(function) {
        let columns = setup.columns(function, Exact::clone);
        return of_arm(setup, setup.arm(Exact::clone), &columns);
    }
    let unknowns = setup.unknowns();
    let arm = setup.without_given(setup.arm(Exact::clone));
    of_arm(setup, arm, &unknowns.columns).with_values(&unknowns.values())
}

fn of_arm(setup: &Setup, arm: Arm<Exact>, columns: &[Column<Exact>]) -> Skeleton<Exact> {
    let mut skeleton = Skeleton::with_columns(&arm.fold_base(), &setup.merged(), columns);
    let fitted = setup.fitted_links().unwrap_or_default();
    for (segment, fitted) in skeleton.links.iter_mut().zip(fitted) {
        let link = &mut segment.link;
        link.body = fitted.body.clone();
        link.armature = fitted.armature.clone();
        link.friction.viscous = fitted.viscous.clone();
    }
    skeleton
}

const MAX_SEEDS: usize = 16;

/// Forms that are dear in one choice of axes may be cheap in another, and the search mixes them. If
/// there are too many, only the cheapest form is told in other axes than the chain's own.
pub(crate) fn regrouped(task: Task<'_>, forms: &[Form], tuned: &ChainChoice) -> Vec<Seed> {
    let mut chain = Chain::new(&skeleton_for(task), &tuned.regrouping);
    let axes = axes(&chain);
    let initial = forms.iter().map(|form| (0, *form));
    let others = 1..axes.len();
    let cheapest = others.clone().map(|place| (place, tuned.form));
    let dearer = forms.iter().filter(|form| **form != tuned.form);
    let rest = others.flat_map(|place| dearer.clone().map(move |form| (place, *form)));
    let mut seeds: Vec<Seed> = Vec::new();
    for (place, form) in initial.chain(cheapest).chain(rest) {
        if seeds.len() == MAX_SEEDS {
            break;
        }
        for (link, axes) in chain.links.iter_mut().zip(&axes[place]) {
            link.axes = *axes;
        }
        let (graph, traced) = trace_chain(task, &chain, form, Folding::Syntactic);
        // An arm with few links has several forms that are one.
        if seeds.iter().all(|seed| seed.graph != graph) {
            seeds.push(Seed {
                source: Source::Regrouped,
                graph,
                traced,
            });
        }
    }
    seeds
}

pub(super) fn merged(task: Task<'_>, chain: &Chain<Exact>, form: Form) -> Dag {
    trace_chain(task, chain, form, Folding::Semantic).0
}

/// Returns the chain's own axes, each link's, those before each group of parallel
/// axes, those after it, then what differs from the first two in one link.
fn axes(chain: &Chain<Exact>) -> Vec<Vec<i32>> {
    let freedom = chain.freedoms();
    let links = chain.links.iter().zip(&freedom);
    let current: Vec<i32> = links
        .map(|(link, &[less, more])| link.axes.clamp(less, more))
        .collect();
    let natural = vec![0; current.len()];
    let mut choices = vec![current.clone(), natural.clone()];
    choices.extend([0, 1].map(|side| freedom.iter().map(|bounds| bounds[side]).collect()));
    for from in [current, natural] {
        for (i, &[less, more]) in freedom.iter().enumerate() {
            for axes in less..=more {
                let mut choice = from.clone();
                choice[i] = axes;
                choices.push(choice);
            }
        }
    }
    let mut unique_choices = BTreeSet::new();
    choices.retain(|choice| unique_choices.insert(choice.clone()));
    choices
}
