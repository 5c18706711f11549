//! Regrouped parameters that depend on bodies, rotors and friction which are arguments.
//!
//! Regrouped parameters are linear in the mass, the first moments and the tensor of each link about the
//! origin of its row's frame, in armatures and in viscous friction. So a *load*, the numbers of a
//! regrouped chain that depend on arguments, follows from these by a matrix. A payload is one body more
//! on the last link.

use alloc::vec::Vec;

use super::Link;
use super::chain::MomentBody;
use super::matrix::{Columns, plus, times};
use super::regressor::LinkParameter;
use crate::robot::Inertia;
use crate::scalar::Scalar;

/// The numbers of a body: its mass, three of the centre of mass, six of the tensor about it.
pub const BODY: usize = 10;

/// A number of a load: what the arm has of that regrouped parameter, and what units of arguments add.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadRow<S> {
    /// The number where all arguments are zero.
    pub constant: S,
    /// The places of parameters that change it among [`LoadArguments::parameters`], each with its factor.
    pub of: Vec<(usize, S)>,
}

impl<S> LoadRow<S> {
    /// Returns every number through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> LoadRow<T> {
        let of = self.of.iter();
        LoadRow {
            constant: f(&self.constant),
            of: of.map(|(place, x)| (*place, f(x))).collect(),
        }
    }
}

/// Parameters that are arguments, and the load that they are to an arm.
#[derive(Clone, Debug)]
pub struct LoadArguments<S> {
    /// Those of each body in the order of [`LinkParameter::ALL`], about the origin and in the axes of its
    /// row's frame; then armatures and viscous friction.
    pub parameters: Vec<S>,
    /// A number of the load each.
    pub rows: Vec<LoadRow<S>>,
}

impl<S: Scalar> LoadArguments<S> {
    /// Makes it of links that bodies are on, and of the parameters of drives.
    pub fn new(bodies: &[Link<S>], drives: Vec<S>, rows: Vec<LoadRow<S>>) -> LoadArguments<S> {
        let of_body = |link: &Link<S>| {
            let body = MomentBody::of(link);
            LinkParameter::ALL.map(|parameter| parameter.of_body(&body))
        };
        let parameters = bodies.iter().flat_map(of_body).chain(drives);
        LoadArguments {
            parameters: parameters.collect(),
            rows,
        }
    }

    /// Returns the numbers of the load.
    pub fn load(&self) -> Vec<S> {
        let row = |row: &LoadRow<S>| {
            let of = row.of.iter();
            let terms = of.map(|(place, factor)| times(factor, &self.parameters[*place]));
            terms.fold(row.constant.clone(), |sum, term| plus(&sum, &term))
        };
        self.rows.iter().map(row).collect()
    }
}

/// Returns a body of [`BODY`] numbers as a link that does not move: its frame is that of a row, in
/// which the frame that the numbers are given in is placed. Entries that are missing are zero.
pub fn carried<S: Scalar>(numbers: &[S], frame: Option<&Columns<S>>) -> Link<S> {
    let entry = |index: usize| numbers.get(index).cloned().unwrap_or_else(S::zero);
    let com = [1, 2, 3].map(entry);
    let inertia = Inertia::of([4, 5, 6, 7, 8, 9].map(entry));
    let (com, inertia) = match frame {
        None => (com, inertia),
        Some(frame) => (frame.apply(&com, &S::one()), frame.turn_tensor(&inertia)),
    };
    Link {
        mass: entry(0),
        com,
        inertia,
        ..Link::still()
    }
}
