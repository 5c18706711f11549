//! Limbs side by side: limbs of one structure share a program, which a loop runs once for each of
//! them, so that a compiler makes vectors of it.
//!
//! - `structure`: which limbs have one structure, and the numbers in which they differ
//! - `rolled`: which operations of a traced function are the same in each limb
//! - `parts`: what lanes compute and what they share, in turns; each part is searched by itself
//! - `composed`: the parts as one program, whose [`Loop`](crate::program::Loop)s say what is a lane
//!
//! Enters a function of a robot, leaves a [`Program`]: one of single operations as any other, which is
//! proved, bounded and counted as such. Only its text has loops.

mod composed;
mod parts;
mod rolled;
mod structure;
mod sums;

use dalembert_model::equations::chain::{Chain, Form};
use dalembert_model::number::Exact;

use crate::dag::{Dag, Folding};
use crate::program::{Counts, Loop, Program};
use crate::search::{self, Effort, cost};
use crate::seeds::descent::with_zero_origins;
use crate::seeds::{skeleton_for, trace_symbols, tune};
use crate::setup::Task;
use crate::words::words;
use composed::Composer;
use parts::{Part, Parts};
use rolled::LimbRows;
use structure::{Limbs, classes};

words! {
    /// The layout of limbs of one structure in a function.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub enum LimbLayout: "layout of limbs" {
        /// The layout with fewer operations, of which one does for a vector of two lanes.
        #[default]
        Auto = "auto",
        /// Limbs are lanes of a loop.
        Lanes = "lanes",
        /// Each limb has operations of its own.
        Apart = "apart",
    }
}

/// The numbers of every vector: those of the least processor that has any.
const VECTOR: usize = 2;

/// The formulations that are searched, of those that are cheapest before.
const SEARCHED: usize = 3;

/// Returns the price of a program: an operation of a loop costs one for each vector of lanes.
pub(crate) fn price(program: &Program) -> u64 {
    let spared = program.loops.iter().map(|block| {
        let rows = program.dag.operations().skip(block.first).take(block.rows);
        let rows = Counts::of_operations(rows.map(|(_, operation, _)| operation));
        search::price(&rows) * (block.lanes - block.lanes.div_ceil(VECTOR)) as u64
    });
    cost(&program.dag) - spared.sum::<u64>()
}

/// True of a function that is traced as a chain.
pub(crate) fn is_traced(task: Task<'_>) -> bool {
    let mut quantities = task.function.quantities().iter();
    let is_chain = quantities.all(|quantity| quantity.is_regrouped() && !quantity.is_of_frame());
    is_chain && !task.setup.takes_load(task.function)
}

/// Returns the cheapest program of a function whose limbs are lanes; none where no limbs have one
/// structure, or the function is not traced as a chain.
pub(crate) fn side_by_side(task: Task<'_>, effort: Effort) -> Option<Program> {
    if !is_traced(task) {
        return None;
    }
    let chains = chains(task);
    let forms = task.function.forms();
    let mut candidates: Vec<(u64, &Chain<Exact>, Form)> = Vec::new();
    for chain in chains.iter().filter(|chain| !classes(chain).is_empty()) {
        for &form in forms.iter().filter(|form| !form.shoulder) {
            let price = with_parts(task, chain, form, |_, limbs, parts| {
                let price = |part: &Part| weight(part, limbs) * merged_cost(&part.graph);
                parts.parts.iter().map(price).sum()
            });
            candidates.push((price, chain, form));
        }
    }
    candidates.sort_by_key(|(price, ..)| *price);
    candidates.dedup_by_key(|(price, ..)| *price);
    candidates.truncate(SEARCHED);
    let programs = candidates.iter().filter_map(|&(_, chain, form)| {
        let (dag, loops) = with_parts(task, chain, form, |rolled, limbs, parts| {
            for part in &mut parts.parts {
                part.graph = searched(&part.graph, effort).scheduled();
            }
            Composer::new(rolled, limbs, parts, base(task)).compose()
        });
        let program = with_loops(&task.program(&dag), dag, loops)?;
        Some((price(&program), program))
    });
    let best = programs.min_by_key(|(price, _)| *price);
    best.map(|(_, program)| program)
}

fn base(task: Task<'_>) -> usize {
    task.setup.robot().base_coordinates()
}

fn weight(part: &Part, limbs: &Limbs) -> u64 {
    let vectors = |class: usize| limbs.classes[class].len().div_ceil(VECTOR);
    part.class.map_or(1, vectors) as u64
}

fn merged_cost(graph: &Dag) -> u64 {
    let mut counts = graph.rebuild(Folding::Semantic).counts();
    counts.sincos = 0;
    search::price(&counts)
}

fn searched(graph: &Dag, effort: Effort) -> Dag {
    let limits = |operations| effort.limits(operations);
    let result = search::search(
        std::slice::from_ref(graph),
        &[],
        &limits,
        &|_| true,
        &|_, _| true,
    );
    result.map_or_else(|| graph.clone(), |result| result.graph)
}

/// No loop may hold what the checker would refuse: steps that no result depends on, as where a number
/// of one lane is zero.
fn with_loops(whole: &Program, dag: Dag, loops: Vec<Loop>) -> Option<Program> {
    let operations = dag.operations().count();
    let program = whole.with_code(dag);
    let is_whole = program.dag.operations().count() == operations;
    let row = |operation: usize| {
        let row = |block: &Loop| Some(block.first + block.place(operation)?[1]);
        loops.iter().find_map(row).unwrap_or(operation)
    };
    let is_plain = !program.divides() || program.dag.has_needed_steps_alone(row);
    (is_whole && is_plain).then_some(Program { loops, ..program })
}

fn with_parts<T>(
    task: Task<'_>,
    chain: &Chain<Exact>,
    form: Form,
    then: impl FnOnce(&LimbRows<'_>, &mut Limbs, &mut Parts) -> T,
) -> T {
    let mut limbs = Limbs::of(chain, task.setup);
    let (dag, _) = trace_symbols(task, form, Folding::Syntactic, |builder| {
        limbs.symbols(chain, builder)
    });
    let dag = sums::by_limbs(&LimbRows::new(&dag, &limbs, base(task)));
    let rolled = LimbRows::new(&dag, &limbs, base(task));
    let mut parts = Parts::of(&rolled, &mut limbs, base(task));
    then(&rolled, &mut limbs, &mut parts)
}

/// Lists the chain with base parameters, with origins after the constant steps and beside those of the
/// links before, in all axes that are the same in each limb.
fn chains(task: Task<'_>) -> Vec<Chain<Exact>> {
    let arm = skeleton_for(task);
    let start = tune::start(&arm);
    let beside = with_zero_origins(&start);
    let mut chains = Vec::new();
    for regrouping in [start, beside] {
        let mut chain = Chain::new(&arm, &regrouping);
        let freedoms = chain.freedoms();
        let mut choices = vec![vec![0; freedoms.len()]];
        for side in [0, 1] {
            let choice: Vec<i32> = freedoms.iter().map(|bounds| bounds[side]).collect();
            if !choices.contains(&choice) {
                choices.push(choice);
            }
        }
        for choice in choices {
            for (link, axes) in chain.links.iter_mut().zip(choice) {
                link.axes = axes;
            }
            chains.push(chain.clone());
        }
    }
    chains
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seeds;
    use crate::setup::Setup;

    /// Sums by limbs, and the parts before any search, are the function: in every form.
    #[test]
    fn the_parts_are_the_function() {
        let robots = [
            include_str!("../../../gallery/robots/g1_hand.toml"),
            include_str!("../../../gallery/robots/go2.toml"),
        ];
        let names = ["inverse_dynamics", "forward_dynamics"];
        for (source, name) in robots.into_iter().zip(names) {
            let robot = dalembert_model::read::parse(source).unwrap().robot;
            let function = crate::function::Function::parse(name).unwrap();
            let setup = Setup::in_scene(&robot, None).unwrap().taking(&[]);
            let task = setup.task(function);
            let chain = &chains(task)[0];
            for form in function.forms() {
                let mut limbs = Limbs::of(chain, task.setup);
                let (lanes, _) = trace_symbols(task, form, Folding::Syntactic, |builder| {
                    limbs.symbols(chain, builder)
                });
                let sums = sums::by_limbs(&LimbRows::new(&lanes, &limbs, base(task)));
                assert_eq!(sums.result_prints(), lanes.result_prints(), "{form:?}");
                let rolled = LimbRows::new(&sums, &limbs, base(task));
                let parts = Parts::of(&rolled, &mut limbs, base(task));
                let (composed, loops) =
                    Composer::new(&rolled, &limbs, &parts, base(task)).compose();
                let (apart, _) = seeds::trace_chain(task, chain, form, Folding::Syntactic);
                assert_eq!(composed.result_prints(), apart.result_prints(), "{form:?}");
                assert!(!loops.is_empty());
            }
        }
    }
}
