//! The load's numbers: in which regrouping of the chain they are, and how formulas read them.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::chain::Chain;
use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

use super::chain::{skeleton_for, trace_chain};
use super::descent::tuned;
use super::start::Tuning;
use crate::dag::symbol::Symbol;
use crate::dag::{Builder, Folding, Node, signed};
use crate::function::{Argument, Function};
use crate::program::Input;
use crate::search::Effort;
use crate::setup::load::Unknowns;
use crate::setup::{Setup, Task};

/// The load's numbers are those of the regrouping in which torques cost least. Every request gets
/// these, so that the parameters alone determine the load.
#[must_use]
pub(crate) fn chosen(setup: Setup) -> Setup {
    if !setup.has_load() {
        return setup;
    }
    let full = setup.in_full_motion();
    let task = full.task(Function::InverseDynamics);
    let best = tuned(&Tuning::new(task, Effort::Quick), &task.function.forms());
    let chain = Chain::new(&skeleton_for(task), &best.regrouping);
    let (graph, _) = trace_chain(task, &chain, best.form, Folding::Semantic);
    let is_read = |index: usize| {
        let entry = Node::Input(Input::Entry(Argument::Load, index));
        graph.live().any(|(_, node)| *node == entry)
    };
    let met = (0..).zip(unknown_numbers(&chain, &full.unknowns()));
    let read = met.filter_map(|(index, number)| is_read(index).then_some(number));
    setup.with_load(read.collect(), best.regrouping)
}

fn unknown_numbers(chain: &Chain<Exact>, unknowns: &Unknowns) -> Vec<Exact> {
    let mut met: Vec<Exact> = Vec::new();
    chain.map(|number| {
        if unknowns.occur_in(number) && place(&met, number).is_none() {
            met.push(signed(number, number.leads_negative()));
        }
    });
    met
}

fn place(numbers: &[Exact], number: &Exact) -> Option<(usize, bool)> {
    let is_negative = number.leads_negative();
    let size = signed(number, is_negative);
    let at = numbers.iter().position(|known| *known == size)?;
    Some((at, is_negative))
}

/// Numbers that depend on a payload become entries of the load.
pub(super) fn symbols(
    task: Task<'_>,
    chain: &Chain<Exact>,
    builder: &Rc<RefCell<Builder>>,
) -> Chain<Symbol> {
    let Task { setup, function } = task;
    if !setup.takes_load(function) {
        return chain.map(Symbol::constant);
    }
    let unknowns = setup.unknowns();
    let known = setup.load().map(|load| load.numbers.clone());
    let numbers = known.unwrap_or_else(|| unknown_numbers(chain, &unknowns));
    chain.map(|number| {
        if !unknowns.occur_in(number) {
            return Symbol::constant(number);
        }
        // A number that no torque depends on may have any value.
        let Some((index, is_negative)) = place(&numbers, number) else {
            return Symbol::zero();
        };
        let entry = Symbol::input(builder, Input::Entry(Argument::Load, index));
        signed(&entry, is_negative)
    })
}
