//! Choosing: the cheapest edits that a certificate admits.
//!
//! A greedy search ranks edits of the *emitted* program at sampled states by
//! error for each operation saved; parts of what it chose are taken back at
//! random and chosen anew. What it finds counts only if [`bound`] certifies
//! it. The edited program is then simplified, which may save more, and edited
//! again.
//!
//! - `columns`: programs at many states
//! - `price`: operations that stay
//! - `greedy`: the ranking
//! - `omissions`: what was left out, for reports

mod columns;
mod greedy;
mod omissions;
mod price;

use super::bound::{self, Budget};
use super::edits::{Stage, difference};
use super::input_box::InputBox;
use super::sample;
use crate::graph::{Folding, Graph};
use crate::schedule::Program;
use crate::simplify::random::Random;
use crate::simplify::{Effort, simplify};
use crate::verify::states::JointState;
use columns::{Nodes, Value};
use greedy::Greedy;
pub use omissions::{Omission, omissions};

/// How hard to search, counted, never timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Sampled states.
    pub samples: usize,
    /// Guesses of how far sampled and certified errors are apart.
    pub guesses: usize,
    /// Times that a part is taken back and chosen anew.
    pub retries: usize,
    /// Programs to edit one after the other.
    pub stages: usize,
    /// For the certificates that decide.
    pub budget: Budget,
    /// How much the simplifier may do between stages.
    pub effort: Effort,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            samples: 256,
            guesses: 8,
            retries: 40,
            stages: 2,
            budget: Budget::GLANCE,
            effort: Effort::Quick,
        }
    }
}

/// A cheaper program within its tolerance.
#[derive(Clone, Debug)]
pub struct Pruned {
    /// What was edited, program after program.
    pub stages: Vec<Stage>,
    /// The program to emit: the last stage's edited program, simplified.
    pub program: Program,
    /// The certified largest |pruned − full| of each output.
    pub errors: Vec<f64>,
}

/// The cheapest variant found of which every output is certified to stay
/// within its allowance (in the output's unit) over the box.
pub fn prune(
    program: &Program,
    limits: &InputBox,
    allowances: &[f64],
    settings: &Settings,
) -> Pruned {
    let mut best = Pruned {
        stages: Vec::new(),
        program: program.clone(),
        errors: vec![0.0; program.outputs.len()],
    };
    let mut random = Random::new(0x9121);
    let mut states: Vec<JointState> = (0..settings.samples)
        .map(|_| sample::draw(limits, &mut random))
        .collect();
    for _ in 0..settings.stages {
        let mut search = Search {
            full: program,
            base: best.clone(),
            limits,
            allowances,
            settings,
        };
        match search.run(&mut states, &mut random) {
            Some(found) => best = found,
            None => break,
        }
    }
    best
}

struct Search<'a> {
    full: &'a Program,
    base: Pruned,
    limits: &'a InputBox,
    allowances: &'a [f64],
    settings: &'a Settings,
}

impl Search<'_> {
    fn run(&mut self, states: &mut Vec<JointState>, random: &mut Random) -> Option<Pruned> {
        // How much of the allowance sampled errors may use.
        let mut share = 0.75;
        let mut found: Option<(Pruned, Vec<Option<Value>>, f64)> = None;
        for guess in 0..self.settings.guesses {
            let nodes = Nodes::new(&self.base.program, states);
            let truth = self.truth(states);
            let mut greedy = Greedy::new(&nodes, &truth, self.shared(share), 1 + guess as i32 % 2);
            let mut edits = vec![None; nodes.len()];
            greedy.drop_all(&mut edits, 0.0, random);
            greedy.restore_idle(&mut edits);
            let (stages, errors, ratio) = self.certify(&nodes, &edits);
            self.adversaries(&stages, states, random);
            let cheaper = |p: &Program| found.as_ref().is_none_or(|f| cost(p) < cost(&f.0.program));
            let program = finish(&stages, Effort::Quick, false);
            if ratio <= 1.0 && cheaper(&program) {
                let pruned = Pruned {
                    stages,
                    program,
                    errors,
                };
                found = Some((pruned, edits, share));
            }
            // Both rankings are tried before the share is corrected.
            if guess % 2 == 1 {
                share = (share / libm::pow(ratio.clamp(0.2, 5.0), 0.9) * 0.99).min(1.5);
            }
        }
        let (mut best, mut edits, share) = found?;
        let nodes = Nodes::new(&self.base.program, states);
        let truth = self.truth(states);
        // The samples have grown since: what is certified must rank as within.
        let worst = Greedy::new(&nodes, &truth, self.shared(1.0), 1).worst(&edits);
        let share = f64::max(share, 1.001 * worst);
        let mut greedy = Greedy::new(&nodes, &truth, self.shared(share), 1);
        let mut paid = greedy.price(&edits);
        for round in 0..self.settings.retries {
            let mut trial = edits.clone();
            let part = 0.05 + 0.3 * random.unit();
            for edit in &mut trial {
                if random.unit() < part {
                    *edit = None;
                }
            }
            let noise = if round % 3 == 0 { 0.0 } else { 0.6 };
            greedy.drop_all(&mut trial, noise, random);
            greedy.restore_idle(&mut trial);
            let price = greedy.price(&trial);
            if price <= paid && trial != edits {
                let (stages, errors, ratio) = self.certify(&nodes, &trial);
                if ratio <= 1.0 {
                    (edits, paid) = (trial, price);
                    let program = finish(&stages, Effort::Quick, false);
                    best = Pruned {
                        stages,
                        program,
                        errors,
                    };
                }
            }
        }
        best.program = finish(&best.stages, self.settings.effort, true);
        (cost(&best.program) < cost(&self.base.program)).then_some(best)
    }

    fn shared(&self, share: f64) -> Vec<f64> {
        self.allowances.iter().map(|a| a * share).collect()
    }

    /// The full model's outputs, output after output.
    fn truth(&self, states: &[JointState]) -> Vec<f64> {
        outputs(self.full, states)
    }

    fn certify(&self, nodes: &Nodes, edits: &[Option<Value>]) -> (Vec<Stage>, Vec<f64>, f64) {
        let mut stages = self.base.stages.clone();
        stages.push(Stage {
            program: self.base.program.clone(),
            edits: nodes.edits(edits),
        });
        let graph = difference(&stages);
        let errors = bound::magnitudes(
            &graph,
            self.limits,
            self.allowances,
            1.0,
            self.settings.budget,
        );
        let pairs = errors.iter().zip(self.allowances);
        let ratio = pairs.fold(0.0f64, |r, (&e, &a)| r.max(bound::relative(e, a)));
        (stages, errors, ratio)
    }

    /// States where the error is large join the samples.
    fn adversaries(&self, stages: &[Stage], states: &mut Vec<JointState>, random: &mut Random) {
        let Some(last) = stages.last() else { return };
        let edited = last.program(Folding::Syntactic);
        for output in 0..self.allowances.len() {
            for _ in 0..4 {
                let mut error = |state: &JointState| {
                    let one = std::slice::from_ref(state);
                    (outputs(self.full, one)[output] - outputs(&edited, one)[output]).abs()
                };
                let from = sample::draw(self.limits, random);
                let (state, _) = sample::climb(self.limits, from, 400, random, &mut error);
                states.push(state);
            }
        }
    }
}

/// A program's outputs at states, output after output.
fn outputs(program: &Program, states: &[JointState]) -> Vec<f64> {
    let nodes = Nodes::new(program, states);
    let columns = nodes.run(&vec![None; nodes.len()]);
    let m = states.len();
    nodes
        .outputs
        .iter()
        .flat_map(|value| match *value {
            Value::Known(c) => vec![c; m],
            Value::Node(node, negative) => {
                let sign = if negative { -1.0 } else { 1.0 };
                let column = &columns[node as usize * m..][..m];
                column.iter().map(|x| sign * x).collect()
            }
        })
        .collect()
}

/// The last stage's edited program, simplified if asked.
fn finish(stages: &[Stage], effort: Effort, search: bool) -> Program {
    let last = &stages[stages.len() - 1];
    let graph = last.edited(Folding::Semantic);
    let program = |graph: &Graph| last.program.with_graph(graph);
    if !search {
        return program(&graph);
    }
    match simplify(std::slice::from_ref(&graph), &[], effort, &|_| true) {
        Some(simplified) => program(&simplified.graph),
        None => program(&graph),
    }
}

/// Operations, and a few more for each sine and cosine.
fn cost(program: &Program) -> usize {
    let counts = program.counts();
    counts.operations() + 8 * counts.sincos
}
