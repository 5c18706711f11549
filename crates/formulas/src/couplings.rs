//! The coefficients of a robot's dynamics that vanish, each with a proved reason.
//!
//! The reasons are tried in this order; the first that holds is given:
//!
//! 1. *Limbs*: no link is moved by all of the joints.
//! 2. *Always*: h_ikm with i = m ≥ k is zero for every arm.
//! 3. *Joint kinds*: h_ikm with k ≤ m is zero for every arm whose joint k slides. Both rules are complete: a
//!    world without any fact has the same zeros.
//! 4. *Geometry*: zero for all bodies, lengths and angles that keep some facts. The facts are as few as
//!    dropping one after the other leaves.
//! 5. *Lengths*: zero for all bodies, but only with these lengths and angles.
//! 6. *Body*, or *balance* where a base parameter is zero although its summands are not: conditions on base
//!    parameters that are exact for this geometry, with the facts that they need.

mod conditions;
mod facts;
mod inventory;
mod near;
mod world;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use dalembert_codegen::Diagnostic;
use dalembert_codegen::workspace::Setup;
use dalembert_model::equations::dalembert::Part;
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::Scalar;

use crate::arm::{PosedChain, Symbolic, SymbolicArm};
use crate::bodies::{BaseBodies, BaseMoments};
use crate::canonical::{Splits, runs};
use crate::entries::Coefficients;
use crate::expression::{Sum, with_numbers};
use crate::legend::Frames;
use crate::line::coefficients_of;
use crate::number::Number;
use crate::quantity::Quantity;
use crate::ring::Polynomial;
use crate::symbol::Symbol;
use conditions::{Condition, bodies_that_meet, conditions, in_words};
use facts::{Fact, is_zero};
use world::{Geometry, World};

pub use inventory::{Inventory, Value};
use near::Definitions;
pub use near::{Alive, Near};

/// An entry of D, h or c.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Entry {
    /// Inertia, Christoffel or Gravity.
    pub quantity: Quantity,
    /// Its indices among the results, counted from zero.
    pub indices: Vec<usize>,
}

impl Entry {
    /// Returns the name: `h_346`.
    pub fn name(&self) -> Symbol {
        self.quantity.entry(&self.indices)
    }
}

/// The reason why a coefficient vanishes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// The joints are on different limbs.
    Limbs,
    /// By its indices.
    Always,
    /// A joint slides.
    JointKinds {
        /// The joint, counted from one.
        slide: usize,
    },
    /// By the geometry alone.
    Geometry {
        /// The facts.
        facts: Vec<String>,
        /// True if other facts would do as well.
        has_others: bool,
    },
    /// For all bodies, but only with these lengths and angles.
    Lengths,
    /// By the bodies, for this geometry.
    Body {
        /// The conditions on base parameters.
        conditions: Vec<String>,
        /// The facts that they need; `None` if they hold with these lengths and angles alone.
        facts: Option<Vec<String>>,
        /// True if a base parameter is zero although its summands are not.
        is_balanced: bool,
    },
}

/// A coefficient that vanishes.
#[derive(Clone, Debug)]
pub struct ZeroEntry {
    /// The entry.
    pub entry: Entry,
    /// Its reason.
    pub reason: Reason,
    /// Its part of rotation, with numbers, if that does not vanish: the part of translation is the
    /// opposite.
    pub rotation: Option<Sum>,
}

/// The coefficients of a robot that vanish, and those that nearly do.
#[derive(Clone, Debug)]
pub struct Couplings {
    /// Those that vanish: of D, then h, then c, symmetric ones once, in the order of their indices.
    pub zeros: Vec<ZeroEntry>,
    /// The number of all.
    pub total: usize,
    /// Those that nearly vanish.
    pub near: Near,
    /// The frames in which numbers of links are taken.
    pub frames: Frames,
}

/// Lists the entries with their values.
pub(crate) fn entries<S>(coefficients: &Coefficients<S>) -> Vec<(Entry, &S)> {
    let quantities = [Quantity::Inertia, Quantity::Christoffel, Quantity::Gravity];
    let of = |quantity| {
        let entries = coefficients_of(coefficients, quantity).into_iter();
        entries.map(move |(indices, value)| (Entry { quantity, indices }, value))
    };
    quantities.into_iter().flat_map(of).collect()
}

impl Couplings {
    /// Finds the coefficients of a robot that vanish, each with its reason.
    ///
    /// # Errors
    /// The robot has no formulas.
    pub fn new(robot: &Robot) -> Result<Couplings, Diagnostic> {
        let setup = Setup::whole(robot);
        Finder::new(&setup)?.couplings()
    }

    /// Lists the reasons, each with the entries that vanish for it.
    pub fn reasons(&self) -> Vec<(&Reason, Vec<&Entry>)> {
        let mut groups: Vec<(&Reason, Vec<&Entry>)> = Vec::new();
        for zero in &self.zeros {
            let mut known = groups.iter_mut();
            match known.find(|(reason, _)| **reason == zero.reason) {
                Some((_, entries)) => entries.push(&zero.entry),
                None => groups.push((&zero.reason, vec![&zero.entry])),
            }
        }
        groups
    }
}

impl Reason {
    /// Returns its kind in a word.
    pub fn word(&self) -> &'static str {
        match self {
            Reason::Limbs => "limbs",
            Reason::Always => "always",
            Reason::JointKinds { .. } => "joint kinds",
            Reason::Geometry { .. } => "geometry",
            Reason::Lengths => "lengths",
            Reason::Body {
                is_balanced: true, ..
            } => "balance",
            Reason::Body { .. } => "body",
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Limbs => f.write_str("no link is moved by all of these joints"),
            Reason::Always => f.write_str("for every arm, by the indices"),
            Reason::JointKinds { slide } => write!(f, "joint {slide} slides"),
            Reason::Geometry { facts, has_others } => {
                let end = if *has_others {
                    " (other facts would do)"
                } else {
                    ""
                };
                write!(f, "{}{end}", facts.join(", "))
            }
            Reason::Lengths => {
                f.write_str("for all bodies, but only with these lengths and angles")
            }
            Reason::Body {
                conditions, facts, ..
            } => {
                f.write_str(&conditions.join(", "))?;
                match facts {
                    None => f.write_str("; only with these lengths and angles"),
                    Some(facts) if facts.is_empty() => Ok(()),
                    Some(facts) => write!(f, "; {}", facts.join(", ")),
                }
            }
        }
    }
}

/// The search for the reasons of zeros.
pub(crate) struct Finder<'a> {
    pub(crate) setup: &'a Setup,
    pub(crate) arm: SymbolicArm,
    pub(crate) chain: PosedChain<Polynomial>,
    geometry: Geometry<'a>,
    /// The coefficients in numbers, and in all base parameters, of which none is taken to be zero.
    pub(crate) in_numbers: Coefficients<Polynomial>,
    pub(crate) in_parameters: Coefficients<Polynomial>,
    /// The link and the moment of each base parameter, and its value.
    pub(crate) moments: BaseMoments,
    pub(crate) values: Vec<Number>,
    /// Base parameters in the symbols of the robot file; none if there are too many symbols.
    definitions: Option<Definitions>,
    kinds: Vec<JointKind>,
    /// The number of each link, counted from one.
    numbers: Vec<usize>,
    facts: Vec<Fact>,
    zeros: BTreeMap<Vec<Fact>, BTreeSet<Entry>>,
}

const SEEDS: [u64; 2] = [0x776f_726c, 0x6473_2121];

impl<'a> Finder<'a> {
    pub(crate) fn new(setup: &'a Setup) -> Result<Finder<'a>, Diagnostic> {
        let arm = SymbolicArm::new(setup, Symbolic::Nothing)?;
        let chain = arm.chain(&arm.arm);
        let bodies = BaseBodies::whole(&arm, &chain);
        let in_numbers = arm.coefficients(setup, &chain, &chain.chain)?;
        let in_parameters = arm.coefficients(setup, &chain, &bodies.chain)?;
        let geometry = Geometry::new(setup, &arm);
        let named = SymbolicArm::new(setup, Symbolic::Everything).ok();
        let definitions = named.map(|named| {
            let chain = named.chain(&named.arm);
            let parameters = BaseBodies::whole(&named, &chain).parameters.into_iter();
            Definitions {
                parameters: parameters.map(|definition| definition.value).collect(),
                arm: named,
            }
        });
        Ok(Finder {
            definitions,
            facts: geometry.facts(),
            geometry,
            kinds: chain.chain.links.iter().map(|link| link.kind).collect(),
            numbers: chain.rows.iter().map(|row| row + 1).collect(),
            in_numbers,
            in_parameters,
            moments: bodies.moments,
            values: bodies.values,
            setup,
            chain,
            arm,
            zeros: BTreeMap::new(),
        })
    }

    fn couplings(mut self) -> Result<Couplings, Diagnostic> {
        let in_numbers = self.in_numbers.clone();
        let in_parameters = self.in_parameters.clone();
        let chain = self.arm.chain(&Part::Rotation.of(&self.arm.arm));
        let rotation = self.arm.coefficients(self.setup, &chain, &chain.chain)?;
        let parts = entries(&in_parameters).into_iter().zip(entries(&rotation));
        let numeric_entries = entries(&in_numbers);
        let total = numeric_entries.len();
        let mut zeros = Vec::new();
        for ((entry, x), ((_, symbolic), (_, part))) in numeric_entries.into_iter().zip(parts) {
            if !x.is_zero() {
                continue;
            }
            let is_split = entry.quantity != Quantity::Gravity && !part.is_zero();
            zeros.push(ZeroEntry {
                rotation: is_split.then(|| self.written(part)),
                reason: self.reason(&entry, symbolic),
                entry,
            });
        }
        Ok(Couplings {
            zeros,
            total,
            near: self.near(),
            frames: Frames::of(self.setup.robot()),
        })
    }

    /// Writes a polynomial with numbers.
    fn written(&self, polynomial: &Polynomial) -> Sum {
        let runs = runs(self.setup, &self.arm, &self.chain);
        let splits = Splits::choose(&runs, std::slice::from_ref(polynomial));
        with_numbers(&splits.terms(0), &runs)
    }

    /// Finds the reason of an entry that is zero.
    fn reason(&mut self, entry: &Entry, symbolic: &Polynomial) -> Reason {
        if self.is_on_limbs(entry) {
            return Reason::Limbs;
        }
        if self.zeros(&[]).contains(entry) {
            return match *entry.indices {
                [i, _, m] if i == m => Reason::Always,
                [_, k, _] if self.slides(k) => Reason::JointKinds {
                    slide: self.setup.rows()[k] + 1,
                },
                _ => Reason::Always,
            };
        }
        let facts = self.facts.clone();
        if self.zeros(&facts).contains(entry) {
            let kept = fewest(&facts, |facts| self.zeros(facts).contains(entry));
            let mut others = kept.iter().map(|fact| without(&facts, fact));
            return Reason::Geometry {
                has_others: others.any(|rest| self.zeros(&rest).contains(entry)),
                facts: self.describe(&kept),
            };
        }
        if symbolic.is_zero() {
            return Reason::Lengths;
        }
        let conditions = conditions(symbolic);
        let facts = self.facts_of(entry, &conditions);
        Reason::Body {
            conditions: in_words(&conditions, &self.moments, &self.numbers, &self.kinds),
            facts: facts.map(|facts| self.describe(&facts)),
            is_balanced: conditions
                .iter()
                .any(|condition| self.is_balanced(condition)),
        }
    }

    fn describe(&self, facts: &[Fact]) -> Vec<String> {
        // Those that say most first.
        let describe = |fact: &Fact| self.geometry.describe(*fact);
        facts.iter().rev().map(describe).collect()
    }

    fn slides(&self, place: usize) -> bool {
        let joint = self.setup.rows()[place];
        self.setup.robot().joints[joint].kind == JointKind::Prismatic
    }

    /// True if no link is moved by all of the joints.
    fn is_on_limbs(&self, entry: &Entry) -> bool {
        let robot = self.setup.robot();
        let chain = &self.chain;
        let moves = |link: usize, place: usize| {
            let joint = self.setup.rows()[place];
            let mut way = chain.chain.way(link);
            way.any(|moved| robot.mover_of(chain.rows[moved]) == joint)
        };
        let mut links = 0..chain.rows.len();
        !links.any(|link| entry.indices.iter().all(|&place| moves(link, place)))
    }

    /// Returns the entries that are zero for all arms with these facts.
    fn zeros(&mut self, facts: &[Fact]) -> &BTreeSet<Entry> {
        if !self.zeros.contains_key(facts) {
            let of_seed = |seed: u64| World {
                facts,
                keeps_numbers: false,
                bodies: None,
                seed,
            };
            let [first, second] = SEEDS.map(|seed| self.zeros_in(of_seed(seed)));
            let both = first.intersection(&second).cloned().collect();
            self.zeros.insert(facts.to_vec(), both);
        }
        &self.zeros[facts]
    }

    fn zeros_in(&self, world: World<'_>) -> BTreeSet<Entry> {
        let coefficients = self.geometry.coefficients(world);
        let field_entries = coefficients.iter().flat_map(entries);
        let zeros = field_entries.filter_map(|(entry, x)| is_zero(x).then_some(entry));
        zeros.collect()
    }

    /// Finds the facts that conditions need; `None` if they hold with these lengths and angles alone.
    fn facts_of(&self, entry: &Entry, conditions: &[Condition]) -> Option<Vec<Fact>> {
        let bodies = bodies_that_meet(conditions, &self.moments, &self.kinds, SEEDS[0]);
        let keeps_numbers = conditions.iter().any(|condition| condition.len() > 1);
        let holds = |facts: &[Fact]| {
            let world = World {
                facts,
                keeps_numbers,
                bodies: Some(&bodies),
                seed: SEEDS[1],
            };
            self.zeros_in(world).contains(entry)
        };
        holds(&self.facts).then(|| fewest(&self.facts, holds))
    }

    /// True if a base parameter of a condition is zero, or the condition holds, although its summands do not
    /// vanish: masses of several links, or a mass and a moment of inertia, are in balance.
    fn is_balanced(&self, condition: &Condition) -> bool {
        let is_zero = |parameter: &usize| self.values[*parameter].is_zero();
        let is_balance = |parameter: &usize| match &self.definitions {
            Some(definitions) => definitions.is_balance(*parameter, &self.values[*parameter]),
            None => false,
        };
        !condition.keys().all(is_zero) || condition.keys().any(is_balance)
    }
}

/// Drops facts one after the other, as long as what is asked for holds.
fn fewest(facts: &[Fact], mut holds: impl FnMut(&[Fact]) -> bool) -> Vec<Fact> {
    let mut kept = facts.to_vec();
    for fact in facts {
        let rest = without(&kept, fact);
        if holds(&rest) {
            kept = rest;
        }
    }
    kept
}

fn without(facts: &[Fact], fact: &Fact) -> Vec<Fact> {
    let others = facts.iter().copied();
    others.filter(|other| other != fact).collect()
}

#[cfg(test)]
mod tests;
