//! A generated function.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
#[cfg(feature = "std")]
use std::{
    collections::BTreeMap,
    sync::{Mutex, PoisonError},
};

use super::quantity::Choice;
use super::{
    Argument, Axis, Function, Motion, PayloadDependence, Quantity, RuntimeParameter, Sizes, Written,
};
use crate::equations::chain::{Form, HandChoice};
use crate::equations::regressor::Column;
use crate::equations::{Arm, Formulation};
use crate::robot::Robot;
use crate::scalar::Divide;

#[derive(Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Definition {
    /// Its name in generated code, on the command line and in the macro.
    pub name: &'static str,
    /// A line for its documentation.
    pub summary: &'static str,
    /// The quantities that it returns.
    pub results: &'static [Quantity],
    /// The struct it returns, if it returns several quantities.
    pub structure: Option<&'static str>,
    /// True if it is generated where a request names no functions.
    pub by_default: bool,
    /// The functions whose results these are; empty unless it is a bundle.
    pub parts: &'static [Function],
}

impl Definition {
    pub(super) const fn of(
        name: &'static str,
        in_rust: &'static str,
        summary: &'static str,
        results: &'static [Quantity],
    ) -> Definition {
        Definition {
            name,
            summary,
            results,
            structure: match results.len() > 1 {
                true => Some(in_rust),
                false => None,
            },
            by_default: false,
            parts: &[],
        }
    }
}

/// A function that a user puts together: of the results of several others, or at a frame.
///
/// Its definition is kept for as long as the process runs: so a function is as small a
/// value as a case of an enumeration, and a process names few. Two are equal if they say the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NamedFunction(pub(super) &'static Definition);

impl NamedFunction {
    /// Remembered by text, so that loading a robot again leaks nothing; not without `std`.
    pub(super) fn once(text: String, make: impl FnOnce() -> Definition) -> NamedFunction {
        let made = || NamedFunction(Box::leak(Box::new(make())));
        #[cfg(feature = "std")]
        {
            static KNOWN: Mutex<BTreeMap<String, NamedFunction>> = Mutex::new(BTreeMap::new());
            let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
            *known.entry(text).or_insert_with(made)
        }
        #[cfg(not(feature = "std"))]
        {
            drop(text);
            made()
        }
    }
}

/// The columns of a regressor that a function's results are over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RegressorColumns {
    /// None: it is no regressor.
    None,
    /// Every inertial parameter of every link.
    Links,
    /// The base parameters of this result.
    Base(Quantity),
}

impl Function {
    /// Returns the functions that are generated where a request names none.
    pub fn by_default() -> Vec<Function> {
        let wanted = |function: &Function| function.definition().by_default;
        Function::ALL.into_iter().filter(wanted).collect()
    }

    /// Returns every function that a robot has by its name alone, in the order of files.
    pub fn of(robot: &Robot) -> Vec<Function> {
        let has = |function: &Function| match robot.floating {
            Some(_) => function.takes_floating_base(),
            None => function.takes_fixed_base(),
        };
        let follows = |f: &Function| robot.followers.is_empty() || f.takes_followers();
        let functions = Function::ALL.into_iter().filter(has);
        functions.filter(follows).collect()
    }

    /// Returns its name in generated code, on the command line and in the macro.
    pub fn name(self) -> &'static str {
        self.definition().name
    }

    /// Returns the function of a name, of those that always are.
    pub fn from_name(name: &str) -> Option<Function> {
        Function::ALL.into_iter().find(|f| f.name() == name)
    }

    /// Returns one line for its documentation.
    pub fn summary(self) -> &'static str {
        self.definition().summary
    }

    /// Lists its arguments: all that its results depend on.
    pub fn arguments(self) -> Vec<Argument> {
        let read = |argument: &Argument| {
            let mut results = self.quantities().iter();
            results.any(|quantity| quantity.arguments().contains(argument))
        };
        Argument::ALL.into_iter().filter(read).collect()
    }

    /// Returns true if arms with followers have it: nothing of links, and no second derivatives.
    pub fn takes_followers(self) -> bool {
        let is_second = self.arguments().contains(&Argument::Multiplier);
        !is_second && !self.quantities().iter().any(|q| q.is_of_links())
    }

    /// Returns true if robots whose base floats have it: nothing of the symbols h_ikm, no parts of
    /// rotation and translation, and no second derivatives.
    pub fn takes_floating_base(self) -> bool {
        let is_second = self.arguments().contains(&Argument::Multiplier);
        !is_second && !self.quantities().iter().any(|q| q.facts().on_fixed_base)
    }

    /// Returns true if robots whose base is fixed have it.
    pub fn takes_fixed_base(self) -> bool {
        !self.quantities().iter().any(|q| q.facts().on_floating_base)
    }

    /// Returns its dependence on a payload: the strongest of its results.
    pub fn payload_dependence(self) -> PayloadDependence {
        let quantities = self.quantities().iter();
        let most = quantities.map(|q| q.facts().payload_dependence).max();
        most.unwrap_or(PayloadDependence::None)
    }

    /// True if it depends on a parameter that can be an argument.
    pub fn depends_on(self, parameter: RuntimeParameter) -> bool {
        match parameter {
            RuntimeParameter::Gravity => self.quantities().iter().any(|q| q.facts().gravity),
            _ => self.payload_dependence() == PayloadDependence::Torque,
        }
    }

    /// Returns its results.
    pub fn quantities(self) -> &'static [Quantity] {
        self.definition().results
    }

    /// Returns the struct it returns, if it returns several quantities.
    pub fn structure(self) -> Option<&'static str> {
        self.definition().structure
    }

    /// Returns how many numbers it returns.
    pub fn outputs(self, sizes: Sizes) -> usize {
        self.quantities().iter().map(|q| q.len(sizes)).sum()
    }

    /// Returns the columns of a regressor that a result is over.
    pub fn columns(self) -> RegressorColumns {
        let over = |axis| {
            let mut results = self.quantities().iter();
            results.find(|quantity| quantity.shape().0.contains(&axis))
        };
        match (over(Axis::BaseParameters), over(Axis::LinkParameters)) {
            (Some(&quantity), _) => RegressorColumns::Base(quantity),
            (None, Some(_)) => RegressorColumns::Links,
            (None, None) => RegressorColumns::None,
        }
    }

    /// Returns its results by one formulation, flat, in the order of its quantities;
    /// each array row by row. `columns` are those of [`Function::columns`].
    pub fn evaluate<S: Divide>(
        self,
        formulation: Formulation,
        arm: &Arm<S>,
        motion: &Motion<S>,
        columns: &[Column<S>],
    ) -> Vec<S> {
        let written = Written {
            formulation,
            arm,
            at: &arm.at(&motion.q),
            motion,
            columns,
        };
        let results = self.quantities().iter();
        results.flat_map(|q| q.written(&written)).collect()
    }

    /// Returns the residuals of the equations that these results over all joints solve.
    pub fn residual<S: Divide>(
        self,
        formulation: Formulation,
        arm: &Arm<S>,
        motion: &Motion<S>,
        results: &[S],
    ) -> Vec<S> {
        let written = Written {
            formulation,
            arm,
            at: &arm.at(&motion.q),
            motion,
            columns: &[],
        };
        let (rows, floating) = (arm.links.len(), arm.base_joints());
        let sizes = Sizes::floating(floating, rows - floating, 0).over_all(rows);
        let mut rest = results;
        let mut residual = Vec::new();
        for quantity in self.quantities() {
            let (entries, others) = rest.split_at(quantity.len(sizes).min(rest.len()));
            residual.extend(quantity.residual(&written, entries));
            rest = others;
        }
        residual
    }

    /// True if it exists only where D has an inverse.
    pub fn inverts_inertia(self) -> bool {
        self.quantities().iter().any(|q| q.facts().inverts_inertia)
    }

    /// Returns the forms of the chain formulas that differ for it, the usually cheapest first.
    pub fn forms(self) -> Vec<Form> {
        let quantities = || self.quantities().iter();
        let matters = |choice| {
            let mut choices = quantities().filter_map(|q| q.facts().choices).flatten();
            choices.any(|candidate| *candidate == choice)
        };
        let hand = quantities().map(|q| q.facts().hand).max();
        let mut forms = Form::all(
            matters(Choice::Recursion),
            matters(Choice::Travel),
            matters(Choice::Flows),
            hand.unwrap_or(HandChoice::None),
        );
        if quantities().any(|q| q.facts().has_shoulder) {
            forms.extend(Form::with_shoulder(&forms));
        }
        forms
    }
}

impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
