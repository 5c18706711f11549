//! The load's numbers: in which regrouping of the chain they are, and how formulas
//! read them.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::chain::Chain;
use dalembert_model::number::Exact;
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::scalar::Scalar;

use super::{skeleton_for, trace_chain, tuned};
use crate::function::{Argument, Function};
use crate::graph::symbol::Symbol;
use crate::graph::{Builder, Folding, Node};
use crate::program::Input;
use crate::scene::Setting;
use crate::scene::load::{LoadParameters, Unknowns, place};
use crate::simplify::Effort;

/// The numbers of a chain as symbols: those that depend on a payload are entries of
/// the load.
pub(super) struct Numbers<'a> {
    builder: &'a Rc<RefCell<Builder>>,
    unknowns: Option<Unknowns>,
    chosen: Option<&'a LoadParameters>,
    /// Where none are chosen yet: all, in the order in which they are met.
    met: Vec<Exact>,
}

impl<'a> Numbers<'a> {
    pub(super) fn of(
        setting: &'a Setting,
        function: Function,
        builder: &'a Rc<RefCell<Builder>>,
    ) -> Numbers<'a> {
        let is_loaded = setting.takes(function, RuntimeParameter::Payload);
        Numbers {
            builder,
            unknowns: is_loaded.then(|| setting.unknowns()),
            chosen: setting.load(),
            met: Vec::new(),
        }
    }

    pub(super) fn symbol(&mut self, number: &Exact) -> Symbol {
        let is_unknown = |unknowns: &Unknowns| unknowns.occur_in(number);
        if !self.unknowns.as_ref().is_some_and(is_unknown) {
            return Symbol::from(number.clone());
        }
        let found = match self.chosen {
            // What no torque depends on may be anything.
            Some(chosen) => chosen.place(number),
            None => Some(self.meet(number)),
        };
        let Some((index, is_negative)) = found else {
            return Symbol::zero();
        };
        let entry = Symbol::input(self.builder, Input::Entry(Argument::Load, index));
        match is_negative {
            true => entry.neg(),
            false => entry,
        }
    }

    fn meet(&mut self, number: &Exact) -> (usize, bool) {
        if let Some(known) = place(&self.met, number) {
            return known;
        }
        let is_negative = number.leads_negative();
        self.met.push(match is_negative {
            true => number.neg(),
            false => number.clone(),
        });
        (self.met.len() - 1, is_negative)
    }
}

/// The setting with the load's numbers, if a payload is an argument: those of the
/// regrouping in which torques cost least, as far as torques depend on them. No
/// other quantity that takes a load depends on more. The same for every request, so
/// that whoever has the parameters has the load.
#[must_use]
pub fn chosen(setting: Setting) -> Setting {
    if !setting.has(RuntimeParameter::Payload) {
        return setting;
    }
    let (full, function) = (setting.in_full_motion(), Function::InverseDynamics);
    let best = tuned(&full, function, Effort::Quick, None, &[], None);
    let chain = Chain::new(&skeleton_for(&full, function), &best.regrouping);
    let (graph, _) = trace_chain(&full, function, &chain, best.form, Folding::Semantic);
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    // As the trace meets them.
    let mut numbers = Numbers::of(&full, function, &builder);
    chain.map(|number| numbers.symbol(number));
    let met = std::mem::take(&mut numbers.met);
    let live = graph.live();
    let is_read = |index: usize| {
        let mut nodes = graph.nodes.iter().zip(&live);
        nodes.any(|(node, live)| *live && *node == Node::Input(Input::Entry(Argument::Load, index)))
    };
    let read = met
        .into_iter()
        .enumerate()
        .filter(|(index, _)| is_read(*index));
    let read: Vec<Exact> = read.map(|(_, number)| number).collect();
    let load = LoadParameters::new(&setting, read, best.regrouping);
    setting.with_load(load)
}
