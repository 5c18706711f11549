//! The numbers of a chain as formulas read them.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::number::Exact;
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::scalar::Scalar;

use crate::dag::symbol::Symbol;
use crate::dag::{Builder, signed};
use crate::function::Argument;
use crate::program::Input;
use crate::setup::Task;
use crate::setup::load::{LoadParameters, Unknowns, place};

/// The numbers of a chain as symbols: those that depend on a payload are entries of
/// the load.
pub(super) struct Numbers<'a> {
    builder: &'a Rc<RefCell<Builder>>,
    unknowns: Option<Unknowns>,
    chosen: Option<&'a LoadParameters>,
    /// All numbers, in the order in which they are met, as long as none are chosen.
    met: Vec<Exact>,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(task: Task<'a>, builder: &'a Rc<RefCell<Builder>>) -> Numbers<'a> {
        let Task { setup, function } = task;
        let is_loaded = setup.takes(function, RuntimeParameter::Payload);
        Numbers {
            builder,
            unknowns: is_loaded.then(|| setup.unknowns()),
            chosen: setup.load(),
            met: Vec::new(),
        }
    }

    /// Returns where none were chosen: those that depend on a payload, as they were met.
    pub(super) fn met(self) -> Vec<Exact> {
        self.met
    }

    pub(super) fn symbol(&mut self, number: &Exact) -> Symbol {
        let is_unknown = |unknowns: &Unknowns| unknowns.occur_in(number);
        if !self.unknowns.as_ref().is_some_and(is_unknown) {
            return Symbol::constant(number);
        }
        let found = match self.chosen {
            // A number that no torque depends on may have any value.
            Some(chosen) => chosen.place(number),
            None => Some(self.meet(number)),
        };
        let Some((index, is_negative)) = found else {
            return Symbol::zero();
        };
        let entry = Symbol::input(self.builder, Input::Entry(Argument::Load, index));
        signed(&entry, is_negative)
    }

    fn meet(&mut self, number: &Exact) -> (usize, bool) {
        if let Some(known) = place(&self.met, number) {
            return known;
        }
        let is_negative = number.leads_negative();
        self.met.push(signed(number, is_negative));
        (self.met.len() - 1, is_negative)
    }
}
