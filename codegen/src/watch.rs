//! Watching a long search, and ending it early.
//!
//! The library reads no clock and no signal: the caller brings an [`Observer`]. It is told what
//! was reached, and it may ask for an end; the search then finishes its round and the best program
//! so far, if the quick search has none cheaper, goes on to be proved like any other. As long as
//! it does not ask, watching changes nothing.

use std::fmt;
use std::sync::Arc;

use crate::function::Function;
use crate::program::Counts;
use crate::words::words;

words! {
    /// A part of the search for a function.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Part: "part of a search" {
        /// The formulations are traced and their regrouping is tuned.
        Formulations = "formulations",
        /// Discovery and extraction in turns.
        Search = "search",
        /// The program is proved and measured.
        Proof = "proof",
        /// Searching for what a tolerance allows to leave out.
        Omissions = "omissions",
        /// Errors are bounded.
        Bounds = "bounds",
    }
}

/// The progress of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// For which function.
    pub function: Function,
    /// The part that begins or goes on.
    pub part: Part,
    /// Rounds of the part that are done.
    pub round: usize,
    /// Its rounds at most, zero if that is not known: it ends earlier where nothing more is gained.
    pub rounds: usize,
    /// The best program so far, once there is one.
    pub best: Option<Counts>,
}

/// An observer of a search.
pub trait Observer: Send + Sync {
    fn step(&self, progress: &Progress);

    /// True if the search should end. Once `true` it should stay so: functions that
    /// were not searched yet then get the quick search.
    fn stop(&self) -> bool;
}

/// An observer, or none. It prints the same with and without one: generated code does not depend on
/// the observer, and neither may a hash of the request.
#[derive(Clone, Default)]
pub struct Watch(Option<Arc<dyn Observer>>);

impl Watch {
    /// Makes a watch with an observer.
    pub fn new(observer: Arc<dyn Observer>) -> Watch {
        Watch(Some(observer))
    }

    /// True if the observer wants the search to end.
    pub fn is_over(&self) -> bool {
        self.0.as_deref().is_some_and(Observer::stop)
    }

    /// Returns the watch over the search for one function.
    pub fn over(&self, function: Function) -> FunctionWatch<'_> {
        FunctionWatch(Some((self, function)))
    }
}

impl fmt::Debug for Watch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Watch")
    }
}

/// The watch over the search for one function; by default without an observer.
#[derive(Clone, Copy, Debug, Default)]
pub struct FunctionWatch<'a>(Option<(&'a Watch, Function)>);

impl FunctionWatch<'_> {
    pub fn step(&self, part: Part, [round, rounds]: [usize; 2], best: Option<Counts>) {
        if let Some((Watch(Some(observer)), function)) = self.0 {
            observer.step(&Progress {
                function,
                part,
                round,
                rounds,
                best,
            });
        }
    }

    pub fn is_over(&self) -> bool {
        self.0.is_some_and(|(watch, _)| watch.is_over())
    }
}
