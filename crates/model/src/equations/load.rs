//! What a payload adds to regrouped parameters.
//!
//! A body that is fixed to the last link changes the base parameters that the
//! link's own mass, first moments and tensor are part of; these are linear in them.

use alloc::vec::Vec;

use super::Link;
use super::chain::Body;
use super::matrix::{Columns, plus, times};
use super::regressor::LinkParameter;
use crate::robot::Inertia;
use crate::scalar::Scalar;

/// The numbers of a payload.
pub const PAYLOAD: usize = 10;

/// One number of a load: what the arm has of that regrouped parameter, and what a unit of each of
/// the payload's parameters adds, these about the origin and in the axes of the last link's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadRow<S> {
    /// Without a payload.
    pub own: S,
    /// The parameters that change it, each with its factor.
    pub of: Vec<(LinkParameter, S)>,
}

impl<S> LoadRow<S> {
    /// Returns every number through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> LoadRow<T> {
        let of = self.of.iter();
        LoadRow {
            own: f(&self.own),
            of: of.map(|(parameter, x)| (*parameter, f(x))).collect(),
        }
    }
}

/// A payload, and the load that it is to an arm.
#[derive(Clone, Debug)]
pub struct Loading<S> {
    /// The frame that the payload is given in, in the last link's.
    pub frame: Option<Columns<S>>,
    /// [`PAYLOAD`] numbers: the mass, three of the centre of mass, six of the tensor about it.
    pub payload: Vec<S>,
    /// A number of the load each.
    pub rows: Vec<LoadRow<S>>,
}

impl<S: Scalar> Loading<S> {
    /// Returns the numbers of the load.
    pub fn load(&self) -> Vec<S> {
        let body = Body::of(&carried(&self.payload, self.frame.as_ref()));
        let row = |row: &LoadRow<S>| {
            let terms = row.of.iter();
            let terms = terms.map(|(parameter, factor)| times(factor, &parameter.of_body(&body)));
            terms.fold(row.own.clone(), |sum, term| plus(&sum, &term))
        };
        self.rows.iter().map(row).collect()
    }
}

/// Returns a payload as a link behind the last one that does not move: its frame is the last
/// link's, in which the payload's own frame is placed. Entries that are missing are zero.
pub fn carried<S: Scalar>(payload: &[S], frame: Option<&Columns<S>>) -> Link<S> {
    let entry = |index: usize| payload.get(index).cloned().unwrap_or_else(S::zero);
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
