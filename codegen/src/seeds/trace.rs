//! From a robot to the graph of one function: the equations run once with symbols.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::Formulation;
use dalembert_model::scalar::Scalar;

use super::{Seed, Source};
use crate::dag::symbol::Symbol;
use crate::dag::{Builder, Folding, Node};
use crate::function::Argument;
use crate::program::Input;
use crate::scalar::{Erased, restored};
use crate::setup::Task;

/// Other inputs are zero: a search pairs all that a graph has, and they would be in its way.
pub(crate) fn reader(
    arguments: &[Argument],
    builder: &Rc<RefCell<Builder>>,
) -> impl Fn(Input) -> Symbol {
    let is_read = |argument| Argument::STATE.contains(&argument) || arguments.contains(&argument);
    move |input: Input| match is_read(input.argument()) {
        true => Symbol::input(builder, input),
        false => Symbol::zero(),
    }
}

pub(crate) fn depends_on_coulomb(task: Task<'_>) -> bool {
    if !task.setup.has_coulomb() {
        return false;
    }
    let graph = trace(task, Formulation::NewtonEulerLink).graph;
    let mut live = graph.live();
    live.any(|(_, node)| matches!(node, Node::Input(Input::PerSpeed(_))))
}

/// Returns a textbook formulation as it stands, run with symbols in a scene.
pub fn trace(task: Task<'_>, formulation: Formulation) -> Seed {
    let Task { setup, function } = task;
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    // As the textbook has it, a payload is a body and no load.
    let mut arguments = setup.arguments(function);
    arguments.push(Argument::Payload);
    let leaves = (Symbol::constant, reader(&arguments, &builder));
    let outputs: Vec<Symbol> = restored(task.textbook(formulation, &Erased(&leaves)));
    let mut builder = builder.replace(Builder::new(Folding::Syntactic));
    let outputs = outputs.iter().map(|output| output.edge(&mut builder));
    let outputs = outputs.collect();
    Seed {
        source: Source::Textbook(formulation),
        traced: builder.asked(),
        graph: builder.finish(outputs),
    }
}
