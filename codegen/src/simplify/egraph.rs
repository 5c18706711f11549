//! One e-graph for all outputs of a function: equality saturation in phases.
//!
//! Budgets are nodes and iterations, never time. After every iteration
//! e-classes with equal fingerprints are merged (opposite ones through a
//! negation) and a class that is a leaf is pruned to that leaf, or products
//! with constants would flood it. What the e-graph found is handed back as
//! ways to compute classes; extraction is [`extract`](super::extract)'s.

use std::fmt;
use std::str::FromStr;

use egg::{Analysis, DidMerge, EGraph, Id, Language, Rewrite, SimpleScheduler, define_language};
use rustc_hash::FxHashMap;

use super::classes::{ClassId, Classes, ENode};
use super::rules::{Phase, SATURATION};
use crate::graph::Fingerprint;

/// How far saturation goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SaturationLimits {
    /// E-nodes at which it stops.
    pub nodes: usize,
    /// Iterations of each phase in each round.
    pub iterations: usize,
    /// Rounds over the phases.
    pub rounds: usize,
}

/// E-nodes at most, for each one of the program that went in.
const NODES_PER_TERM: usize = 50;

/// A class of [`Classes`] as a leaf of the e-graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct LeafRef(ClassId);

impl fmt::Display for LeafRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "leaf{}", self.0)
    }
}

impl FromStr for LeafRef {
    type Err = ();
    fn from_str(text: &str) -> Result<Self, ()> {
        let digits = text.strip_prefix("leaf").ok_or(())?;
        digits.parse().map(LeafRef).map_err(|_| ())
    }
}

define_language! {
    /// The e-graph's terms.
    pub enum Term {
        "+" = Add([Id; 2]),
        "-" = Sub([Id; 2]),
        "*" = Mul([Id; 2]),
        "/" = Div([Id; 2]),
        "neg" = Neg([Id; 1]),
        Leaf(LeafRef),
    }
}

/// Carries every e-class's fingerprint.
#[derive(Clone, Debug, Default)]
pub(crate) struct Prints {
    leaves: FxHashMap<ClassId, Fingerprint>,
}

impl Analysis<Term> for Prints {
    type Data = Fingerprint;

    fn make(egraph: &mut EGraph<Term, Self>, term: &Term, _: Id) -> Fingerprint {
        let of = |id: Id| &egraph[id].data;
        match *term {
            Term::Add([a, b]) => of(a).add(of(b)),
            Term::Sub([a, b]) => of(a).sub(of(b)),
            Term::Mul([a, b]) => of(a).mul(of(b)),
            Term::Div([a, b]) => of(a).div(of(b)),
            Term::Neg([a]) => of(a).neg(),
            Term::Leaf(LeafRef(class)) => {
                let known = egraph.analysis.leaves.get(&class);
                known.copied().unwrap_or_else(Fingerprint::zero)
            }
        }
    }

    fn merge(&mut self, _: &mut Fingerprint, _: Fingerprint) -> DidMerge {
        // Rules are sound, so both prints are equal.
        DidMerge(false, false)
    }
}

/// Saturates from the chosen program and adds what it finds to the classes.
///
/// `choice` names the way that each needed class is computed by now.
pub(crate) fn saturate(classes: &mut Classes, choice: &[Option<ENode>], budget: SaturationLimits) {
    let mut egraph = EGraph::new(Prints {
        leaves: (0..classes.len() as ClassId)
            .filter(|&id| classes.get(id).leaf.is_some())
            .map(|id| (id, classes.get(id).print))
            .collect(),
    });
    insert(&mut egraph, classes, choice);
    merge_by_print(&mut egraph);
    // A small program saturates into more regroupings than anyone can weigh.
    let nodes = budget.nodes.min(NODES_PER_TERM * egraph.total_size());
    let budget = SaturationLimits { nodes, ..budget };
    for _ in 0..budget.rounds {
        for phase in [Phase::Sign, Phase::Factor, Phase::Regroup, Phase::Factor] {
            run_phase(&mut egraph, phase, budget);
        }
    }
    harvest(&egraph, classes);
}

/// Returns the rules of a phase; signs are always among them.
fn rewrites(phase: Phase) -> Vec<Rewrite<Term, Prints>> {
    SATURATION
        .iter()
        .filter(|(own, _)| *own == phase || *own == Phase::Sign)
        .filter_map(|(_, rule)| {
            let from: egg::Pattern<Term> = rule.from.parse().ok()?;
            let to: egg::Pattern<Term> = rule.to.parse().ok()?;
            Rewrite::new(rule.name, from, to).ok()
        })
        .collect()
}

fn run_phase(egraph: &mut EGraph<Term, Prints>, phase: Phase, budget: SaturationLimits) {
    let rules = rewrites(phase);
    for _ in 0..budget.iterations {
        let before = (egraph.total_size(), egraph.number_of_classes());
        if before.0 >= budget.nodes {
            return;
        }
        // One iteration at a time: the runner checks its limits only between
        // rules, and its clock must not decide anything.
        let runner = egg::Runner::default()
            .with_egraph(std::mem::take(egraph))
            .with_scheduler(SimpleScheduler)
            .with_iter_limit(1)
            .with_node_limit(budget.nodes)
            .with_time_limit(std::time::Duration::from_secs(u64::MAX / 4))
            .run(&rules);
        *egraph = runner.egraph;
        merge_by_print(egraph);
        if (egraph.total_size(), egraph.number_of_classes()) == before {
            return;
        }
    }
}

/// Inserts the chosen program as terms.
fn insert(egraph: &mut EGraph<Term, Prints>, classes: &Classes, choice: &[Option<ENode>]) {
    let mut ids: FxHashMap<ClassId, Id> = FxHashMap::default();
    let mut pending: Vec<ClassId> = Vec::new();
    for output in classes.outputs.iter().flatten() {
        pending.push(output.class);
        while let Some(&class) = pending.last() {
            if ids.contains_key(&class) {
                pending.pop();
                continue;
            }
            let term = match (
                &classes.get(class).leaf,
                choice.get(class as usize).copied().flatten(),
            ) {
                (None, Some(way)) => {
                    let [a, b] = way.operands();
                    let (Some(&x), Some(&y)) = (ids.get(&a), ids.get(&b)) else {
                        pending.extend([a, b].iter().filter(|i| !ids.contains_key(i)));
                        continue;
                    };
                    match way {
                        ENode::Sum(..) => Term::Add([x, y]),
                        ENode::Difference(..) => Term::Sub([x, y]),
                        ENode::Product(..) => Term::Mul([x, y]),
                        ENode::Quotient(..) => Term::Div([x, y]),
                    }
                }
                _ => Term::Leaf(LeafRef(class)),
            };
            let mut id = egraph.add(term);
            // The way gives the class up to sign.
            if egraph[id].data != classes.get(class).print {
                id = egraph.add(Term::Neg([id]));
            }
            ids.insert(class, id);
            pending.pop();
        }
    }
    egraph.rebuild();
}

/// Merges e-classes of equal print, links opposite ones, prunes leaves.
fn merge_by_print(egraph: &mut EGraph<Term, Prints>) {
    let mut ids: Vec<Id> = egraph.classes().map(|class| class.id).collect();
    ids.sort_unstable();
    let mut by_print: FxHashMap<Fingerprint, Id> = FxHashMap::default();
    for id in ids {
        let print = egraph[id].data;
        if let Some(&other) = by_print.get(&print) {
            egraph.union(other, id);
        } else {
            by_print.insert(print, id);
            if let Some(&opposite) = by_print.get(&print.neg()) {
                let negated = egraph.add(Term::Neg([opposite]));
                egraph.union(negated, id);
            }
        }
    }
    egraph.rebuild();
    for class in egraph.classes_mut() {
        if class.nodes.iter().any(|term| matches!(term, Term::Leaf(_))) {
            class.nodes.retain(|term| matches!(term, Term::Leaf(_)));
        }
    }
}

/// Takes every e-node as a way to compute its class.
fn harvest(egraph: &EGraph<Term, Prints>, classes: &mut Classes) {
    let mut ids: Vec<Id> = egraph.classes().map(|class| class.id).collect();
    ids.sort_unstable();
    let zero = Fingerprint::zero();
    for id in ids {
        let eclass = &egraph[id];
        if eclass.data == zero {
            continue;
        }
        let class = classes.intern(&eclass.data).class;
        for term in &eclass.nodes {
            let mut operands = term.children().iter().map(|&child| egraph[child].data);
            let (Some(x), Some(y)) = (operands.next(), operands.next()) else {
                continue;
            };
            if x == zero || y == zero {
                continue;
            }
            let (x, y) = (classes.intern(&x), classes.intern(&y));
            let same = x.negative == y.negative;
            let way = match term {
                Term::Mul(_) => ENode::Product(x.class, y.class),
                Term::Div(_) => ENode::Quotient(x.class, y.class),
                Term::Add(_) if same => ENode::Sum(x.class, y.class),
                Term::Sub(_) if !same => ENode::Sum(x.class, y.class),
                _ => ENode::Difference(x.class, y.class),
            };
            classes.add_way(class, way);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn egg_reads_every_rule() {
        for phase in [Phase::Sign, Phase::Factor, Phase::Regroup] {
            let listed = SATURATION.iter();
            let listed = listed.filter(|(own, _)| *own == phase || *own == Phase::Sign);
            assert_eq!(rewrites(phase).len(), listed.count(), "{phase:?}");
        }
    }
}
