//! The e-graph of one function: every equality that the search knows.
//!
//! It is egg's, with fingerprints as its analysis. A class is a value up to sign, an
//! e-node computes it from the canonical values of other classes. E-nodes of equal
//! prints are united as the second one is added, so congruence has nothing left to
//! unite, and the root of a class is its first e-node for good.
//!
//! Formulations, [`rules`](super::rules) and [`discover`](super::discover) add e-nodes;
//! [`extract`](super::extract) chooses one for each class that the outputs need.
//!
//! - this file: classes and what is known of them
//! - `language`: e-nodes, as egg reads them
//! - `graphs`: from graphs to e-nodes, and back

mod graphs;
mod language;

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;
use egg::{Analysis, DidMerge, Id, Pattern, SearchMatches, Searcher};
use rustc_hash::FxHashMap;

use crate::graph::{Fingerprint, Points};
pub(crate) use language::{ENode, Leaf, Operator, Way};

/// A class: its root in the e-graph.
pub(crate) type ClassId = Id;

/// The facts of a class.
#[derive(Clone, Copy, Debug)]
struct Known {
    /// Its canonical print.
    print: Fingerprint,
    /// The leaf that it is, if it is one.
    leaf: Option<u32>,
}

/// The analysis: what is known of each class, and the class of each print. It is a table by
/// number and not egg's data of a class, which a hash map would have to find.
#[derive(Clone, Debug, Default)]
struct Fingerprints {
    known: Vec<Known>,
    leaves: Vec<Leaf>,
    by_print: FxHashMap<Fingerprint, ClassId>,
    /// The classes, first made first.
    roots: Vec<ClassId>,
}

impl Analysis<ENode> for Fingerprints {
    type Data = ();

    fn make(egraph: &mut egg::EGraph<ENode, Self>, node: &ENode, id: Id) {
        let analysis = &mut egraph.analysis;
        let (print, leaf) = match *node {
            ENode::Leaf(leaf) => (leaf_print(&analysis.leaves[leaf as usize]), Some(leaf)),
            ENode::Way(way) => {
                let operands = way
                    .operands
                    .map(|id| &analysis.known[usize::from(id)].print);
                (way.operator.print(operands), None)
            }
        };
        let print = print.canonical().0;
        // E-nodes are numbered one after the other.
        debug_assert_eq!(analysis.known.len(), usize::from(id));
        analysis.known.push(Known { print, leaf });
    }

    /// Merges nothing: only classes of equal prints are united, and `modify` says which is a leaf.
    fn merge(&mut self, (): &mut (), (): ()) -> DidMerge {
        DidMerge(false, false)
    }

    /// Unites the class of a new e-node with the one that has its print.
    fn modify(egraph: &mut egg::EGraph<ENode, Self>, id: Id) {
        let Fingerprints {
            known,
            by_print,
            roots,
            ..
        } = &mut egraph.analysis;
        let Known { print, leaf } = known[usize::from(id)];
        match by_print.get(&print) {
            None => {
                by_print.insert(print, id);
                roots.push(id);
            }
            Some(&root) if root != id => {
                let own = &mut known[usize::from(root)].leaf;
                *own = own.or(leaf);
                egraph.union(root, id);
            }
            Some(_) => {
                // A leaf needs no operation any more.
                if let Some(leaf) = leaf {
                    egraph[id].nodes = vec![ENode::Leaf(leaf)];
                }
            }
        }
    }
}

/// Returns the print of a leaf. One that has none is zero, as are the values that it is read for:
/// the proof refuses what comes of it.
fn leaf_print(leaf: &Leaf) -> Fingerprint {
    match leaf {
        Leaf::Constant(constant) => Points::SEARCH
            .constant(constant)
            .unwrap_or_else(Fingerprint::zero),
        Leaf::Input(input) => Points::SEARCH.input(*input),
    }
}

/// A class with a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Signed {
    /// The class.
    pub class: ClassId,
    /// True if the value is the negated canonical one.
    pub negative: bool,
}

/// A program: how each class is computed, by the index of the class.
pub(crate) type Choice = Vec<Option<Way>>;

/// All classes of one function.
#[derive(Clone, Debug, Default)]
pub(crate) struct Classes {
    egraph: egg::EGraph<ENode, Fingerprints>,
    /// The function's results; `None` is zero.
    pub outputs: Vec<Option<Signed>>,
}

impl Classes {
    /// Returns the classes, first made first.
    pub(crate) fn ids(&self) -> &[ClassId] {
        &self.egraph.analysis.roots
    }

    /// Returns a number above the index of every class.
    pub(crate) fn bound(&self) -> usize {
        self.egraph.nodes().len()
    }

    /// Returns the number of e-nodes.
    pub(crate) fn size(&self) -> usize {
        self.egraph.total_size()
    }

    /// Returns the canonical print of a class.
    pub(crate) fn print(&self, id: ClassId) -> &Fingerprint {
        &self.egraph.analysis.known[usize::from(id)].print
    }

    /// Returns the leaf that a class is, if it is one: then there are no ways.
    pub(crate) fn leaf(&self, id: ClassId) -> Option<&Leaf> {
        let leaf = self.egraph.analysis.known[usize::from(id)].leaf?;
        self.egraph.analysis.leaves.get(leaf as usize)
    }

    /// Returns every way and the class that it computes, in the order they were found.
    pub(crate) fn ways(&self) -> impl Iterator<Item = (ClassId, Way)> {
        let nodes = self.egraph.nodes().iter().enumerate();
        nodes.filter_map(move |(place, node)| {
            let ENode::Way(way) = node else { return None };
            let class = self.egraph.find(ClassId::from(place));
            self.leaf(class).is_none().then_some((class, *way))
        })
    }

    /// Returns the ways to compute one class.
    #[cfg(test)]
    pub(crate) fn ways_of(&self, id: ClassId) -> impl Iterator<Item = Way> {
        let ways = self.ways().filter(move |(class, _)| *class == id);
        ways.map(|(_, way)| way)
    }

    /// Returns the class of a print, and whether the print is its negative.
    pub(crate) fn find(&self, print: &Fingerprint) -> Option<Signed> {
        let (canonical, negative) = print.canonical();
        let &class = self.egraph.analysis.by_print.get(&canonical)?;
        Some(Signed { class, negative })
    }

    /// Adds a leaf and returns its class: it needs no operation any more.
    pub(crate) fn add_leaf(&mut self, leaf: Leaf) -> Signed {
        let print = leaf_print(&leaf);
        if let Some(known) = self.find(&print)
            && self.leaf(known.class).is_some()
        {
            return known;
        }
        let (_, negative) = print.canonical();
        // The class stands for its canonical value.
        let leaf = match leaf {
            Leaf::Constant(constant) if negative => Leaf::Constant(constant.neg()),
            leaf => leaf,
        };
        let leaves = &mut self.egraph.analysis.leaves;
        leaves.push(leaf);
        let node = ENode::Leaf(leaves.len() as u32 - 1);
        let class = self.egraph.add(node);
        Signed { class, negative }
    }

    /// Adds a way to compute a class, and returns the class with the sign of the result;
    /// `None` of what is zero.
    pub(crate) fn add(&mut self, way: Way) -> Option<Signed> {
        if let Some(constant) = self.folded(way) {
            return match constant.is_zero() {
                true => None,
                false => Some(self.add_leaf(Leaf::Constant(constant))),
            };
        }
        let print = self.way_print(way);
        if print == Fingerprint::zero() {
            return None;
        }
        match self.find(&print) {
            Some(known) if self.is_done(known.class, way) => Some(known),
            _ => {
                let (_, negative) = print.canonical();
                let class = self.egraph.add(ENode::Way(way));
                Some(Signed { class, negative })
            }
        }
    }

    /// Returns whether a way is none for a class: a leaf needs none, and no value of its own
    /// helps.
    fn is_done(&self, class: ClassId, way: Way) -> bool {
        way.operands.contains(&class) || self.leaf(class).is_some()
    }

    /// Adds a way to compute a class, if it is one.
    pub(crate) fn add_to(&mut self, class: ClassId, way: Way) {
        let hit = self.find(&self.way_print(way));
        if hit.is_some_and(|hit| hit.class == class) {
            self.add(way);
        }
    }

    /// Returns the value of an operation on two constants.
    fn folded(&self, way: Way) -> Option<Exact> {
        let constant = |id| match self.leaf(id)? {
            Leaf::Constant(constant) => Some(constant),
            Leaf::Input(_) => None,
        };
        let (a, b) = (constant(way.operands[0])?, constant(way.operands[1])?);
        Some(match way.operator {
            Operator::Sum => a.add(b),
            Operator::Difference => a.sub(b),
            Operator::Product => a.mul(b),
            Operator::Quotient => return a.divide(b.as_rational()?),
        })
    }

    /// Returns the print of a way's result.
    pub(crate) fn way_print(&self, way: Way) -> Fingerprint {
        way.operator.print(way.operands.map(|id| self.print(id)))
    }

    /// Returns where each of the patterns matches.
    pub(super) fn matches<'a>(
        &mut self,
        patterns: impl Iterator<Item = &'a Pattern<ENode>>,
    ) -> Vec<Vec<SearchMatches<'a, ENode>>> {
        self.egraph.rebuild();
        patterns
            .map(|pattern| pattern.search(&self.egraph))
            .collect()
    }
}

impl Signed {
    fn negated_if(self, negative: bool) -> Signed {
        Signed {
            negative: self.negative != negative,
            ..self
        }
    }
}

#[cfg(test)]
mod tests;
