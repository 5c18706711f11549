//! From a robot to the graph of one function: the equations run once with
//! symbols.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::Exact;
use dalembert_model::outputs::Motion;
use dalembert_model::scalar::Scalar;

use crate::dag::symbol::Symbol;
use crate::dag::{Builder, Dag, Folding, Node};
use crate::function::{Argument, Function};
use crate::program::{Counts, Input};
use crate::scene::SceneRobot;

/// A traced function.
#[derive(Clone, Debug)]
pub struct Trace {
    /// Folded as it was built, nothing more.
    pub graph: Dag,
    /// The operations of the formula as it was executed, before folding.
    pub traced: Counts,
}

/// Returns the motion of a robot in its scene in symbols. Of the arguments that are no part of a
/// state only these are inputs: a search pairs whatever a graph has, and what
/// nothing reads would only be in its way.
pub(crate) fn symbols(
    scene_robot: &SceneRobot,
    arguments: &[Argument],
    builder: &Rc<RefCell<Builder>>,
) -> Motion<Symbol> {
    scene_robot.motion(reader(arguments, builder), |constant| {
        Symbol::from(constant.clone())
    })
}

/// Inputs of a state or of these arguments in symbols, others zero.
fn reader(arguments: &[Argument], builder: &Rc<RefCell<Builder>>) -> impl Fn(Input) -> Symbol {
    let is_read = |argument| Argument::STATE.contains(&argument) || arguments.contains(&argument);
    move |input: Input| match is_read(input.argument()) {
        true => Symbol::input(builder, input),
        false => Symbol::zero(),
    }
}

/// Returns whether a function of a robot in its scene depends on what Coulomb friction reads of
/// speeds.
pub(crate) fn depends_on_coulomb(scene_robot: &SceneRobot, function: Function) -> bool {
    if !scene_robot.has_coulomb() {
        return false;
    }
    let graph = trace(scene_robot, function, Formulation::NewtonEulerLink).graph;
    let mut live = graph.live();
    live.any(|(_, node)| matches!(node, Node::Input(Input::PerSpeed(_))))
}

/// Runs a formulation with symbols in a scene.
pub fn trace(scene_robot: &SceneRobot, function: Function, formulation: Formulation) -> Trace {
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    let constant = |constant: &Exact| Symbol::from(constant.clone());
    let arm = Arm::from_robot(scene_robot.robot(), &mut { constant });
    // As the textbook has it, a payload is a body and no load.
    let mut arguments = scene_robot.arguments(function);
    arguments.push(Argument::Payload);
    let posed = scene_robot.posed(function, arm, reader(&arguments, &builder), constant);
    let outputs = posed.results(scene_robot, function, formulation);
    let outputs: Vec<_> = outputs
        .iter()
        .map(|output| output.edge(&mut builder.borrow_mut()))
        .collect();
    drop(posed);
    let traced = builder.borrow().asked();
    let graph = std::mem::replace(&mut *builder.borrow_mut(), Builder::new(Folding::Syntactic))
        .finish(outputs);
    Trace { graph, traced }
}
