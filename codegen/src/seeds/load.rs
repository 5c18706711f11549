//! The load's numbers: in which regrouping of the chain they are.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::chain::Chain;
use dalembert_model::number::Exact;
use dalembert_model::outputs::RuntimeParameter;

use super::chain::{skeleton_for, trace_chain};
use super::descent::tuned;
use super::numbers::Numbers;
use super::start::Problem;
use crate::dag::{Builder, Folding, Node};
use crate::function::{Argument, Function};
use crate::program::Input;
use crate::search::Effort;
use crate::setup::Setup;
use crate::setup::load::LoadParameters;

/// Returns the robot in its scene with the load's numbers, if a payload is an argument:
/// those of the regrouping in which torques cost least, as far as torques depend on them. No
/// other quantity that takes a load depends on more. The same for every request, so that
/// whoever has the parameters has the load.
#[must_use]
pub(crate) fn chosen(setup: Setup) -> Setup {
    if !setup.has(RuntimeParameter::Payload) {
        return setup;
    }
    let full = setup.in_full_motion();
    let task = full.task(Function::InverseDynamics);
    let forms = task.function.forms();
    let best = tuned(&Problem::new(task, Effort::Quick), &forms);
    let chain = Chain::new(&skeleton_for(task), &best.regrouping);
    let (graph, _) = trace_chain(task, &chain, best.form, Folding::Semantic);
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    // As the trace meets them.
    let mut numbers = Numbers::new(task, &builder);
    chain.map(|number| numbers.symbol(number));
    let met = numbers.met();
    let is_read = |index: usize| {
        let entry = Node::Input(Input::Entry(Argument::Load, index));
        graph.live().any(|(_, node)| *node == entry)
    };
    let read = met
        .into_iter()
        .enumerate()
        .filter(|(index, _)| is_read(*index));
    let read: Vec<Exact> = read.map(|(_, number)| number).collect();
    let load = LoadParameters::new(&setup, read, best.regrouping);
    setup.with_load(load)
}
