//! The formulations that a function can start from, each as a graph.
//!
//! The textbook forms are traced as they stand; the chain forms
//! ([`dalembert_model::equations::chain`]) in a regrouping that is tuned to the
//! robot and the function ([`tune`]).

pub mod load;
pub mod start;
pub mod tune;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use dalembert_model::equations::chain::composite::Composite;
use dalembert_model::equations::chain::{Chain, Displacement, Regrouping, Skeleton};
use dalembert_model::equations::matrix::{Vector, scaled};
use dalembert_model::equations::regressor::{Column, LinkParameter};
use dalembert_model::equations::{Arm, Formulation, SinCosPair};
use dalembert_model::number::Exact;
use dalembert_model::outputs::{Motion, Regrouped, RuntimeParameter, Written};
use dalembert_model::scalar::Scalar;

use crate::function::{Argument, Function, Quantity};
use crate::graph::symbol::Symbol;
use crate::graph::{Builder, Folding, Graph};
use crate::program::{AngleSum, Counts, Input};
use crate::scene::Setting;
use crate::simplify::{self, Effort};
use crate::trace::{symbols, trace};
use crate::watch::{FunctionWatch, Part};
use load::Numbers;
pub use start::Start;
use tune::Tuned;

pub use dalembert_model::equations::chain::Form;

/// A quantity that the chain formulas do not give, by the recursion in link
/// axes.
fn written(
    setting: &Setting,
    quantity: Quantity,
    motion: &Motion<Symbol>,
    gravity: Option<&Vector<Symbol>>,
) -> Vec<Symbol> {
    let arm = Arm::from_robot(setting.robot(), &mut |x: &Exact| Symbol::from(x.clone()));
    let arm = match gravity {
        Some(gravity) => arm.with_gravity(gravity),
        None => arm,
    };
    let arm = arm.at_speeds(&motion.per_speed);
    quantity.written(&Written {
        formulation: Formulation::NewtonEulerLink,
        arm: &arm,
        at: &arm.at(&motion.q),
        motion,
        // Regressors the chain formulas give.
        columns: &[],
    })
}

/// Traces a function by the chain formulas; also the operations as executed.
pub fn trace_chain(
    setting: &Setting,
    function: Function,
    chain: &Chain<Exact>,
    form: Form,
    folding: Folding,
) -> (Graph, Counts) {
    let builder = Rc::new(RefCell::new(Builder::new(folding)));
    let mut numbers = Numbers::of(setting, function, &builder);
    let mut chain = chain.map(|constant| numbers.symbol(constant));
    let mut gravity = None;
    if setting.takes(function, RuntimeParameter::Gravity) {
        let taken: Vector<Symbol> = core::array::from_fn(|axis| {
            Symbol::input(&builder, Input::Entry(Argument::Gravity, axis))
        });
        chain.gravity = scaled(&chain.per_unit, &in_frame_0(setting, &taken));
        gravity = Some(taken);
    }
    drop(numbers);
    let whole = symbols(setting, &function.arguments(), &builder);
    let motion = &whole.of_joints(setting.chained());
    let chain = chain.at_speeds(&motion.per_speed);
    let (chain, at) = &chain.posed(&motion.q);
    let composite = Composite::new(chain, at);
    let regrouped = Regrouped {
        chain,
        at,
        composite,
        motion,
        form,
    };
    let mut outputs = Vec::new();
    for &quantity in function.quantities() {
        let selected = match quantity.regrouped(&regrouped) {
            Some(values) => setting.select_of(quantity, setting.chained(), values),
            None => setting.select_of(
                quantity,
                setting.joints(),
                written(setting, quantity, &whole, gravity.as_ref()),
            ),
        };
        let mut builder = builder.borrow_mut();
        outputs.extend(selected.iter().map(|output| output.value(&mut builder)));
    }
    let traced = builder.borrow().asked();
    let graph = std::mem::replace(&mut *builder.borrow_mut(), Builder::new(folding));
    (graph.finish(&outputs), traced)
}

/// What moves, with exact parameters, the base folded.
pub fn skeleton(setting: &Setting) -> Skeleton<Exact> {
    with_columns(setting, &[])
}

/// A vector of base axes in those of frame 0.
fn in_frame_0(setting: &Setting, vector: &Vector<Symbol>) -> Vector<Symbol> {
    let arm = Arm::from_robot(setting.robot(), &mut |x: &Exact| Symbol::from(x.clone()));
    arm.with_gravity(vector).gravity
}

/// The same for a function: if it is a regressor, with its columns; if it takes a
/// load, with a payload whose parameters are unknown.
pub fn skeleton_for(setting: &Setting, function: Function) -> Skeleton<Exact> {
    if !setting.takes(function, RuntimeParameter::Payload) {
        return with_columns(setting, &setting.columns(function, Exact::clone));
    }
    let last = setting.joints().len().saturating_sub(1);
    let columns = LinkParameter::ALL.map(|parameter| Column::Body {
        joint: last,
        body: parameter.unit(),
    });
    with_columns(setting, &columns).with_values(&setting.unknowns().values())
}

fn with_columns(setting: &Setting, columns: &[Column<Exact>]) -> Skeleton<Exact> {
    let arm = Arm::from_robot(setting.robot(), &mut Exact::clone).fold_base();
    Skeleton::with_columns(&arm, &setting.merged(), columns)
}

/// Where a graph comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// A formulation as the textbook has it.
    Textbook(Formulation),
    /// The chain formulas with regrouped parameters.
    Regrouped,
    /// What a load is by its definition.
    Definition,
}

impl Source {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Source::Textbook(Formulation::LagrangeEuler) => "lagrange_euler",
            Source::Textbook(Formulation::Dalembert) => "dalembert",
            Source::Textbook(_) => "newton_euler",
            Source::Regrouped => "regrouped",
            Source::Definition => "definition",
        }
    }
}

impl Source {
    /// The source of a name.
    pub fn from_name(name: &str) -> Option<Source> {
        [
            Source::Regrouped,
            Source::Textbook(Formulation::LagrangeEuler),
            Source::Textbook(Formulation::Dalembert),
            Source::Textbook(Formulation::NewtonEulerLink),
        ]
        .into_iter()
        .find(|source| source.name() == name)
    }
}

/// One graph of a function to start from.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Where it comes from.
    pub source: Source,
    /// The graph, folded as it was built.
    pub graph: Graph,
    /// The operations of the formula as executed.
    pub traced: Counts,
}

/// A textbook formulation.
pub fn textbook(setting: &Setting, function: Function, formulation: Formulation) -> Variant {
    let trace = trace(setting, function, formulation);
    Variant {
        source: Source::Textbook(formulation),
        graph: trace.graph,
        traced: trace.traced,
    }
}

/// Longer chains are tuned by the price before the search alone.
const MAX_QUICK_LINKS: usize = 10;

/// The starts of longer chains are compared without a round of the search.
const MAX_GLANCED: usize = 3;

/// How far a program is above the error that is allowed: at most one where it
/// is admitted.
pub type Limit<'a> = &'a dyn Fn(&Graph) -> f64;

/// Above every price of an admitted program. What is refused is compared by
/// its error, so that a descent from there first goes where it is admitted.
const REFUSED: u64 = 1 << 48;

/// The price of a program under a limit; `below` is the price to beat.
fn price(graph: &Graph, limit: Option<Limit<'_>>, below: u64) -> u64 {
    let cost = simplify::cost(graph);
    let Some(limit) = limit.filter(|_| cost < below) else {
        return cost;
    };
    match limit(graph) {
        admitted if admitted <= 1.0 => cost,
        refused => REFUSED + (refused * 1e6) as u64,
    }
}

/// The regrouping that is cheapest for a function within a limit, if there is one;
/// the best so far where the watch is over. `from` are regroupings to start from,
/// besides those that every robot has.
pub fn tuned(
    setting: &Setting,
    function: Function,
    effort: Effort,
    limit: Option<Limit<'_>>,
    from: &[Regrouping<Exact>],
    watch: Option<FunctionWatch<'_>>,
) -> Tuned {
    let arm = skeleton_for(setting, function);
    let forms = function.forms();
    let tried = Cell::new(0);
    let is_over = || {
        tried.set(tried.get() + 1);
        watch.is_some_and(|watch| {
            watch.step(Part::Formulations, [tried.get(), 0], None);
            watch.is_over()
        })
    };
    let merged = |chain: &Chain<Exact>, form| merged(setting, function, chain, form);
    let helpers = [angle_sums(setting, Sums::Products)];
    // What the search makes of a regrouping is not what the regrouping costs at first.
    let glance = |chain: &Chain<Exact>, form: Form, below: u64| match is_over() {
        true => u64::MAX,
        false => {
            let graph = simplify::search::glance(&merged(chain, form), &helpers);
            price(&graph, limit, below)
        }
    };
    if setting.takes(function, RuntimeParameter::Payload)
        && let Some(load) = setting.load()
    {
        // The numbers of the load are those of one regrouping, for all functions.
        return tune::form(
            &arm,
            load.regrouping.clone(),
            &forms,
            |chain, form, below| price(&merged(chain, form), limit, below),
        );
    }
    let start = tune::start(&arm);
    let with = |axes: Vec<i32>| {
        let mut from = start.clone();
        for (link, axes) in from.links.iter_mut().zip(axes) {
            link.axes = axes;
        }
        from
    };
    let mut starts: Vec<Regrouping<Exact>> = starts(&Chain::new(&arm, &start))
        .into_iter()
        .map(with)
        .collect();
    if effort == Effort::Quick && starts.len() > 1 {
        // One descent: from where the others look dearer already. Of a short chain
        // a round of the search is cheap, and tells more than the folded formula.
        starts.sort_by_cached_key(|from| {
            let chain = Chain::new(&arm, from);
            match arm.links.len() <= MAX_GLANCED {
                true => glance(&chain, forms[0], u64::MAX),
                false => price(&merged(&chain, forms[0]), limit, u64::MAX),
            }
        });
        starts.truncate(1);
    }
    starts.extend_from_slice(from);
    let mut tuned: Option<Tuned> = None;
    for from in starts {
        let mut found = tune::tune(
            &arm,
            from,
            &forms,
            effort.regrouping_rounds(),
            |chain, form, below| match is_over() {
                true => u64::MAX,
                false => price(&merged(chain, form), limit, below),
            },
        );
        if arm.links.len() <= MAX_QUICK_LINKS {
            found.price = glance(&Chain::new(&arm, &found.regrouping), found.form, u64::MAX);
        }
        if tuned.as_ref().is_none_or(|best| found.price < best.price) {
            tuned = Some(found);
        }
    }
    let mut tuned = tuned.unwrap_or(Tuned {
        regrouping: start,
        form: forms[0],
        price: u64::MAX,
    });
    if effort == Effort::Thorough && arm.links.len() <= MAX_QUICK_LINKS && !is_over() {
        tuned = tune::tune(&arm, tuned.regrouping, &[tuned.form], 2, glance);
    }
    tuned
}

/// Axes that a descent starts from: each link's own; the last link's before
/// it turns; those before each group.
fn starts(chain: &Chain<Exact>) -> Vec<Vec<i32>> {
    let n = chain.links.len();
    let freedoms = chain.freedoms();
    let before: Vec<i32> = freedoms.iter().map(|[less, _]| *less).collect();
    let mut last = vec![0; n];
    if n > 0 {
        last[n - 1] = before[n - 1].max(-1);
    }
    let mut starts = vec![vec![0; n]];
    for axes in [last, before] {
        if n <= MAX_QUICK_LINKS && !starts.contains(&axes) {
            starts.push(axes);
        }
    }
    starts
}

/// The most choices of axes that the search is offered at once.
const MAX_AXES: usize = 16;

/// A function in every chain form, in one regrouping, in the regrouping's axes and in
/// others: what is dear in one choice of axes may be cheap in another, and
/// the search mixes them.
pub fn regrouped(
    setting: &Setting,
    function: Function,
    regrouping: &Regrouping<Exact>,
) -> Vec<Variant> {
    let mut chain = Chain::new(&skeleton_for(setting, function), regrouping);
    let mut variants = Vec::new();
    for axes in axes(&chain) {
        for (link, axes) in chain.links.iter_mut().zip(axes) {
            link.axes = axes;
        }
        for form in function.forms() {
            let (graph, traced) = trace_chain(setting, function, &chain, form, Folding::Syntactic);
            variants.push(Variant {
                source: Source::Regrouped,
                graph,
                traced,
            });
        }
    }
    variants
}

/// A function in the regroupings that differ from a tuned one in one link, in its
/// form.
pub fn neighbours(setting: &Setting, function: Function, tuned: &Tuned) -> Vec<Graph> {
    let regroupings = regroupings(setting, function, &tuned.regrouping);
    let graph = |regrouping| in_regrouping(setting, function, regrouping, tuned.form);
    regroupings.iter().map(graph).collect()
}

/// The regroupings that differ from one in one link; none of chains too long to
/// look at each.
pub fn regroupings(
    setting: &Setting,
    function: Function,
    regrouping: &Regrouping<Exact>,
) -> Vec<Regrouping<Exact>> {
    let arm = skeleton_for(setting, function);
    match arm.links.len() <= MAX_QUICK_LINKS {
        true => tune::neighbours(&arm, regrouping),
        false => Vec::new(),
    }
}

/// A function in a regrouping and a form, merged by fingerprint.
pub fn in_regrouping(
    setting: &Setting,
    function: Function,
    regrouping: &Regrouping<Exact>,
    form: Form,
) -> Graph {
    merged(
        setting,
        function,
        &Chain::new(&skeleton_for(setting, function), regrouping),
        form,
    )
}

fn merged(setting: &Setting, function: Function, chain: &Chain<Exact>, form: Form) -> Graph {
    trace_chain(setting, function, chain, form, Folding::Semantic).0
}

/// The chain's own axes, each link's, those before each group of parallel
/// axes, those after it, then what differs from the first two in one link.
fn axes(chain: &Chain<Exact>) -> Vec<Vec<i32>> {
    let freedom = chain.freedoms();
    let own: Vec<i32> = chain
        .links
        .iter()
        .zip(&freedom)
        .map(|(link, &[less, more])| link.axes.clamp(less, more))
        .collect();
    let natural = vec![0; own.len()];
    let mut all = vec![own.clone(), natural.clone()];
    all.extend([0, 1].map(|side| freedom.iter().map(|bounds| bounds[side]).collect()));
    for from in [natural, own] {
        for (i, &[less, more]) in freedom.iter().enumerate() {
            for axes in less..=more {
                let mut choice = from.clone();
                choice[i] = axes;
                all.push(choice);
            }
        }
    }
    let mut different: Vec<Vec<i32>> = Vec::new();
    for choice in all {
        if different.len() < MAX_AXES && !different.contains(&choice) {
            different.push(choice);
        }
    }
    different
}

/// How the sine and cosine of a sum of angles come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sums {
    /// From those of the angles, so that large angles lose nothing.
    Products,
    /// Also as inputs: one evaluation for four products, of an angle that is
    /// rounded, which costs |q| u.
    Inputs,
}

/// Values that no recursion forms but that shorten it: the sines and cosines
/// of the angle sums of parallel joints.
pub fn angle_sums(setting: &Setting, sums: Sums) -> Graph {
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    let arm = skeleton(setting);
    let chain = Chain::new(&arm, &Regrouping::base(&arm));
    let groups = chain.parallel();
    let chain = chain.map(|constant| Symbol::from(constant.clone()));
    let motion = symbols(setting, &[], &builder).of_joints(setting.chained());
    let (_, at) = chain.posed(&motion.q);
    let mut outputs = Vec::new();
    for group in &groups {
        for first in 0..group.len() {
            let mut product: Option<SinCosPair<Symbol>> = None;
            let mut input: Option<AngleSum> = None;
            for &(link, opposite) in &group[first..] {
                let Displacement::Turn(pair) = &at[link] else {
                    continue;
                };
                // About the axis of the group's first link.
                let turn = SinCosPair {
                    sin: if opposite {
                        pair.sin.neg()
                    } else {
                        pair.sin.clone()
                    },
                    cos: pair.cos.clone(),
                };
                let joint = setting.chained()[link];
                input = match input {
                    None => Some(AngleSum::joint(joint)),
                    Some(sum) => sum.with(joint, opposite != group[first].1),
                };
                product = Some(match product {
                    None => turn,
                    Some(before) => {
                        let both = before.compose(&turn);
                        let mut shared = builder.borrow_mut();
                        outputs.extend([&both.sin, &both.cos].map(|x| x.value(&mut shared)));
                        drop(shared);
                        if let (Sums::Inputs, Some(sum)) = (sums, input) {
                            for input in [Input::Sin(sum), Input::Cos(sum)] {
                                let symbol = Symbol::input(&builder, input);
                                outputs.push(symbol.value(&mut builder.borrow_mut()));
                            }
                        }
                        both
                    }
                });
            }
        }
    }
    std::mem::replace(&mut *builder.borrow_mut(), Builder::new(Folding::Syntactic)).finish(&outputs)
}
