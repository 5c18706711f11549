//! Which coefficients of the dynamics vanish or repeat, and why.
//!
//! D_ik, h_ikm and c_i are outputs of one graph that was merged by
//! fingerprint: an output that vanishes is the constant zero there, and two
//! that are equal or opposite are edges to one node.

use std::collections::{BTreeMap, HashMap};
use std::fmt;

use dalembert_model::equations::Formulation;
use dalembert_model::robot::{JointKind, Robot};
use serde::Serialize;

use dalembert_codegen::workspace::function::{Function, Quantity, Sizes};
use dalembert_codegen::workspace::generate::MAX_OUTPUTS;
use dalembert_codegen::workspace::graph::{Folding, Graph, Node, NodeId};
use dalembert_codegen::workspace::scene::SceneRobot;
use dalembert_codegen::workspace::trace::trace;

/// Why a coefficient vanishes or repeats another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// h_iii = 0 for every arm.
    OwnSquare,
    /// h_iim = 0 for m ≤ i, for every arm.
    OwnProduct,
    /// h_ikm = −h_kim for m ≤ min(i, k), for every arm.
    Antisymmetry,
    /// h_ikm = 0 if joint min(k, m) is prismatic.
    Prismatic,
    /// The numbers of this robot.
    Geometry,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Reason::OwnSquare => "h_iii = 0, always",
            Reason::OwnProduct => "h_iim = 0 for m ≤ i, always",
            Reason::Antisymmetry => "h_ikm = −h_kim for m ≤ min(i, k), always",
            Reason::Prismatic => "joint min(k, m) is prismatic",
            Reason::Geometry => "this robot's geometry",
        })
    }
}

/// A finding about a coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finding {
    /// It vanishes in every state.
    Zero(Reason),
    /// It is one that was met before, or its opposite.
    Repeats {
        /// The index of the other in [`Couplings::entries`].
        entry: usize,
        /// True if it is the opposite.
        opposite: bool,
        /// Why.
        reason: Reason,
    },
    /// It is not zero and none before it is equal or opposite.
    Distinct,
}

/// One coefficient: D_ik with i ≤ k, h_ikm with k ≤ m, or c_i.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coupling {
    /// Inertia, Christoffel or Gravity.
    pub quantity: Quantity,
    /// Zero-based: i; i, k; or i, k, m.
    pub joints: Vec<usize>,
    /// The finding.
    pub finding: Finding,
    /// True if it is the same in every state.
    pub constant: bool,
}

/// The coefficients of a robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Couplings {
    /// n
    pub joints: usize,
    /// D, then h, then c, each in the order of its indices.
    pub entries: Vec<Coupling>,
}

/// Numbers of coefficients of a quantity: all, those that vanish, those that differ.
#[derive(Clone, Debug, PartialEq, Eq, Default, Serialize)]
pub struct Summary {
    /// All, symmetric ones once.
    pub total: usize,
    /// Those that vanish.
    pub zero: usize,
    /// Those that do not, equal and opposite ones once.
    pub distinct: usize,
    /// Numbers of those that vanish, and repeat another, for each reason.
    pub reasons: BTreeMap<Reason, Tally>,
}

/// Numbers of coefficients that vanish and repeat for a reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize)]
pub struct Tally {
    /// Those that vanish.
    pub zero: usize,
    /// Those that repeat another.
    pub repeats: usize,
}

/// One coefficient, as a report lists it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Listed {
    /// Its name, one-based: `h_346`.
    pub name: String,
    /// True if it vanishes.
    pub zero: bool,
    /// True if it is the same in every state.
    pub constant: bool,
    /// The one before that it equals.
    pub equals: Option<String>,
    /// The one before that it is the opposite of.
    pub opposite_of: Option<String>,
    /// Why it vanishes or repeats another.
    pub reason: Option<Reason>,
}

impl Couplings {
    /// Finds them for a robot; `None` if it has too many joints to list all h_ikm.
    pub fn of(robot: &Robot) -> Option<Couplings> {
        let function = Function::DynamicCoefficients;
        let n = robot.joints.len();
        if function.outputs(Sizes::whole(n)) > MAX_OUTPUTS {
            return None;
        }
        // Which formulation is traced does not matter to the findings: equal
        // functions have equal fingerprints. Written out, Lagrange–Euler
        // grows out of hand first.
        let formulation = match n {
            0..=6 => Formulation::LagrangeEuler,
            _ => Formulation::NewtonEulerLink,
        };
        let graph = trace(&SceneRobot::whole(robot), function, formulation)
            .graph
            .rebuild(Folding::Semantic);
        let mut couplings = Couplings {
            joints: n,
            entries: Vec::new(),
        };
        let mut classes = HashMap::new();
        for (quantity, joints) in coefficients(n) {
            let output = graph.outputs[place(quantity, &joints, n)];
            let class = Class {
                quantity,
                node: output.node(),
            };
            let finding = if graph.is_zero(output) {
                Finding::Zero(why_zero(robot, quantity, &joints))
            } else {
                let index = couplings.entries.len();
                let members: &mut Vec<(usize, bool)> = classes.entry(class).or_default();
                let finding = couplings.repeats(&joints, members, output.is_negative());
                members.push((index, output.is_negative()));
                finding
            };
            couplings.entries.push(Coupling {
                quantity,
                joints,
                finding,
                constant: is_constant(&graph, output.node()),
            });
        }
        Some(couplings)
    }

    /// Counts the coefficients of one quantity.
    pub fn summary(&self, quantity: Quantity) -> Summary {
        let mut summary = Summary::default();
        for entry in self.entries.iter().filter(|e| e.quantity == quantity) {
            summary.total += 1;
            match entry.finding {
                Finding::Zero(reason) => {
                    summary.zero += 1;
                    summary.reasons.entry(reason).or_default().zero += 1;
                }
                Finding::Distinct => summary.distinct += 1,
                Finding::Repeats { reason, .. } => {
                    summary.reasons.entry(reason).or_default().repeats += 1;
                }
            }
        }
        summary
    }

    /// Lists the coefficients by name.
    pub fn listed(&self) -> Vec<Listed> {
        let listed = self.entries.iter().map(|entry| {
            let mut listed = Listed {
                name: self.name(entry),
                zero: matches!(entry.finding, Finding::Zero(_)),
                constant: entry.constant,
                equals: None,
                opposite_of: None,
                reason: None,
            };
            match entry.finding {
                Finding::Distinct => {}
                Finding::Zero(reason) => listed.reason = Some(reason),
                Finding::Repeats {
                    entry,
                    opposite,
                    reason,
                } => {
                    let other = Some(self.name(&self.entries[entry]));
                    match opposite {
                        true => listed.opposite_of = other,
                        false => listed.equals = other,
                    }
                    listed.reason = Some(reason);
                }
            }
            listed
        });
        listed.collect()
    }

    /// Returns the name of an entry, one-based: `D_12`, `h_346`.
    pub fn name(&self, entry: &Coupling) -> String {
        let index = entry
            .joints
            .iter()
            .fold(0, |index, &joint| index * self.joints + joint);
        entry.quantity.entry(index, Sizes::whole(self.joints))
    }

    /// Returns the member of a class that a coefficient repeats: one that a rule for
    /// every arm ties it to if there is one, else the first.
    fn repeats(&self, joints: &[usize], members: &[(usize, bool)], negative: bool) -> Finding {
        let tied = members.iter().find(|(index, sign)| {
            *sign != negative && antisymmetric(joints, &self.entries[*index].joints)
        });
        match (tied, members.first()) {
            (Some(&(entry, _)), _) => Finding::Repeats {
                entry,
                opposite: true,
                reason: Reason::Antisymmetry,
            },
            (None, Some(&(entry, sign))) => Finding::Repeats {
                entry,
                opposite: sign != negative,
                reason: Reason::Geometry,
            },
            (None, None) => Finding::Distinct,
        }
    }
}

#[derive(PartialEq, Eq, Hash)]
struct Class {
    quantity: Quantity,
    node: NodeId,
}

/// Returns every coefficient once: the symmetric ones in ascending order.
fn coefficients(n: usize) -> impl Iterator<Item = (Quantity, Vec<usize>)> {
    let d = (0..n).flat_map(move |i| (i..n).map(move |k| (Quantity::Inertia, vec![i, k])));
    let h = (0..n).flat_map(move |i| {
        (0..n).flat_map(move |k| (k..n).map(move |m| (Quantity::Christoffel, vec![i, k, m])))
    });
    let c = (0..n).map(|i| (Quantity::Gravity, vec![i]));
    d.chain(h).chain(c)
}

/// Returns the place of a coefficient among the outputs of `dynamic_coefficients`.
fn place(quantity: Quantity, joints: &[usize], n: usize) -> usize {
    let before: usize = Function::DynamicCoefficients
        .quantities()
        .iter()
        .take_while(|&&q| q != quantity)
        .map(|q| q.len(Sizes::whole(n)))
        .sum();
    before + joints.iter().fold(0, |index, &joint| index * n + joint)
}

fn why_zero(robot: &Robot, quantity: Quantity, joints: &[usize]) -> Reason {
    match (quantity, joints) {
        (Quantity::Christoffel, &[i, k, m]) if i == k && k == m => Reason::OwnSquare,
        // k ≤ m: h_imi = h_iim with the other index the lesser.
        (Quantity::Christoffel, &[i, k, m]) if m == i && k <= i => Reason::OwnProduct,
        (Quantity::Christoffel, &[_, k, _]) if robot.joints[k].kind == JointKind::Prismatic => {
            Reason::Prismatic
        }
        _ => Reason::Geometry,
    }
}

/// Returns whether h_ikm = −h_kim, m ≤ min(i, k), ties the two, with the last two
/// indices of each in either order.
fn antisymmetric(a: &[usize], b: &[usize]) -> bool {
    let (&[i, x, y], &[j, u, v]) = (a, b) else {
        return false;
    };
    [(x, y), (y, x)]
        .into_iter()
        .any(|(k, m)| k == j && m <= i.min(k) && ((i, m) == (u, v) || (m, i) == (u, v)))
}

fn is_constant(graph: &Graph, node: NodeId) -> bool {
    matches!(graph.node(node), Node::Constant(_))
}
