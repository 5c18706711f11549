//! A plan as a document: what is claimed of each program, and what was searched for.

use dalembert_checker::Fault;
use dalembert_checker::claim::{Claim, FunctionClaim, SearchRecord, ToleranceClaim};
use dalembert_checker::program::Program as Straight;
use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::equations::BASE_COORDINATES;
use dalembert_model::number::Exact;
use dalembert_model::outputs::{Axis, Sizes};
use dalembert_model::robot::Robot;

use super::{Entry, Plan};
use crate::claim::{ConstantTable, claimed, code};
use crate::function::{Argument, Function};
use crate::language::read::{graph, input};
use crate::program::{Counts, Input, Loop, Program, ScalarType};
use crate::search::Pass;
use crate::seeds::{Source, Start};
use crate::setup::{ParametersKey, SceneKey};
use crate::words::Word;

/// A load has no more numbers: ten of each link, and differences of two of them.
const MAX_LOAD: usize = 100 * Robot::MAX_JOINTS;

impl Plan {
    /// Returns the text; [`Plan::parse`] reads it back.
    pub fn write(&self) -> String {
        let mut constants = ConstantTable::default();
        let entries = self.entries.iter();
        let functions = entries.map(|entry| entry.claimed(&mut constants)).collect();
        let mut document = constants.document(functions);
        document.robot.clone_from(&self.robot);
        document.input.clone_from(&self.input);
        document.write()
    }

    /// Reads a plan: it only makes sure that there are programs, which are proved before use.
    ///
    /// # Errors
    /// The first word that is not as [`Plan::write`] writes it.
    pub fn parse(text: &str) -> Result<Plan, Diagnostic> {
        if text.starts_with("# Programs kept by") {
            let why = "a plan of an earlier version: delete it, and save it again";
            return Err(Diagnostic::error(why));
        }
        let document = Claim::read(text).map_err(refused)?;
        if document.input.is_empty() {
            let why = "there is no `input`, the hash of the robot";
            return Err(Diagnostic::error(why));
        }
        let (mut constants, mut entries) = (Vec::new(), Vec::new());
        for text in &document.constants {
            let wrong = |error| Diagnostic::error(format!("`{text:.40}`: {error}"));
            constants.push(text.parse::<Exact>().map_err(wrong)?);
        }
        for claim in &document.functions {
            let wrong = |why: Diagnostic| Diagnostic::error(format!("`{}`: {why}", claim.function));
            entries.push(entry(claim, &constants).map_err(wrong)?);
        }
        Ok(Plan {
            entries,
            robot: document.robot,
            input: document.input,
        })
    }
}

fn refused(fault: Fault) -> Diagnostic {
    Diagnostic::error(match fault {
        Fault::Claim(why) => why,
        fault => fault.to_string(),
    })
}

impl Entry {
    fn claimed(&self, constants: &mut ConstantTable) -> FunctionClaim {
        let (exact, edited) = (&self.program, self.edited.as_ref());
        let emitted = edited.unwrap_or(exact);
        let (scene, hash) = match &self.scene {
            Some(scene) => (Some(&*scene.name), scene.hash.clone()),
            None => (None, String::new()),
        };
        let passes = self.passes.iter().map(|pass| {
            let counts = pass.counts;
            let name = pass.name.to_owned();
            (name, [counts.mul, counts.add, counts.div, counts.sincos])
        });
        let planned = SearchRecord {
            asked: exact.function.text(),
            formulation: self.start.name().to_owned(),
            scalar: self.scalar.name().to_owned(),
            source: self.source.name().to_owned(),
            passes: passes.collect(),
            joints: exact.joints,
            floats: exact.floating > 0,
            limbs: limbs(exact),
            rows: exact.rows.iter().map(|row| row + 1).collect(),
            loops: (emitted.loops.iter())
                .map(|block| [block.first, block.rows, block.lanes])
                .collect(),
            scene: hash,
            load: (self.parameters.as_ref()).map(|key| (key.load, key.hash.clone())),
        };
        FunctionClaim {
            planned: Some(planned),
            tolerated: edited.map(|_| {
                let [steps, returns] = code(exact, constants);
                ToleranceClaim {
                    steps,
                    returns,
                    ..ToleranceClaim::default()
                }
            }),
            ..claimed(emitted, scene, constants)
        }
    }
}

/// Lists the joints with which limbs begin, from one, if results are over limbs.
fn limbs(program: &Program) -> Vec<usize> {
    let mut quantities = program.function.quantities().iter();
    if !quantities.any(|quantity| quantity.shape().0.contains(&Axis::Limbs)) {
        return Vec::new();
    }
    let starts = program.sizes().limb_starts();
    starts.map(|joint| joint + 1).collect()
}

fn entry(claim: &FunctionClaim, constants: &[Exact]) -> Result<Entry, Diagnostic> {
    let unknown = |what: &str, word: &str| Diagnostic::error(format!("`{word:.40}` is no {what}"));
    let planned = (claim.planned.as_ref())
        .ok_or_else(|| Diagnostic::error("there is no `planned`: what was searched for"))?;
    let asked = Function::parse(&planned.asked);
    let function = asked.map_err(|error| Diagnostic::error(error.message))?;
    if !(1..=Robot::MAX_JOINTS).contains(&planned.joints) {
        return Err(unknown("number of joints", &planned.joints.to_string()));
    }
    // Speeds are the robot's, which a plan does not have.
    let floating = if planned.floats { BASE_COORDINATES } else { 0 };
    let mut limbs = 0;
    for start in &planned.limbs {
        let joint = start.checked_sub(1).filter(|joint| *joint < planned.joints);
        let wrong = || Diagnostic::error("expected the joints with which limbs begin");
        limbs |= 1u64 << joint.ok_or_else(wrong)?;
    }
    let sizes = Sizes::floating(floating, planned.joints, limbs);
    let mut empty = Program::empty(function, sizes);
    let most = sizes.coordinates();
    let rows = planned.rows.iter().map(|row| {
        let row = row.checked_sub(1).filter(|row| *row < most);
        row.ok_or_else(|| Diagnostic::error("expected joints such as `[1, 2, 3]`"))
    });
    empty.rows = rows.take(most + 1).collect::<Result<_, _>>()?;
    if empty.rows.len() > most {
        return Err(Diagnostic::error("more rows than joints"));
    }
    let taken = taken(claim, &mut empty)?;
    let parameters = match (&planned.load, taken.is_empty()) {
        (None, true) => None,
        (Some((load, hash)), false) if *load <= MAX_LOAD => {
            let (load, hash) = (*load, hash.clone());
            Some(ParametersKey { taken, load, hash })
        }
        _ => {
            let why = "expected the load's length and hash where parameters are arguments";
            return Err(Diagnostic::error(why));
        }
    };
    empty.load = parameters.as_ref().map_or(0, |key| key.load);
    let emitted = claim.program(constants).map_err(refused)?;
    let exact = claim.exact(constants).map_err(refused)?;
    let mut program = program(&empty, exact.as_ref().unwrap_or(&emitted))?;
    for &[first, rows, lanes] in &planned.loops {
        program.loops.push(Loop { first, rows, lanes });
    }
    if !program.has_lanes() {
        let why = "a loop whose lanes have different operations";
        return Err(Diagnostic::error(why));
    }
    let edited = exact.map(|_| edited(&empty, &emitted)).transpose()?;
    Ok(Entry {
        start: Start::from_name(&planned.formulation)
            .ok_or_else(|| unknown("formulation", &planned.formulation))?,
        scalar: ScalarType::from_name(&planned.scalar)
            .ok_or_else(|| unknown("scalar", &planned.scalar))?,
        source: Source::from_name(&planned.source)
            .ok_or_else(|| unknown("source", &planned.source))?,
        passes: (planned.passes.iter())
            .map(|record| pass(record).ok_or_else(|| unknown("pass of a search", &record.0)))
            .collect::<Result<_, _>>()?,
        scene: claim.scene.as_ref().map(|name| SceneKey {
            name: name.clone(),
            hash: planned.scene.clone(),
        }),
        parameters,
        program,
        edited,
    })
}

fn taken(claim: &FunctionClaim, empty: &mut Program) -> Result<Vec<Argument>, Diagnostic> {
    const TAKEN: [Argument; 2] = [Argument::Gravity, Argument::Load];
    empty.arguments.extend(TAKEN);
    empty.arguments.sort();
    let is_taken = |argument: Argument| claim.arguments.iter().any(|word| word == argument.name());
    empty.arguments.retain(|argument| is_taken(*argument));
    if empty.arguments.len() != claim.arguments.len() {
        let why = "expected arguments of the function, each once, `load` or `g`";
        return Err(Diagnostic::error(why));
    }
    let taken = TAKEN.into_iter();
    Ok(taken.filter(|argument| is_taken(*argument)).collect())
}

fn program(empty: &Program, read: &Straight<Exact>) -> Result<Program, Diagnostic> {
    let mut program = empty.clone();
    program.dag = graph(read, Exact::clone, input);
    let sizes = program.sizes();
    let is_own = |input: &Input| match *input {
        Input::Sin(joint) | Input::Cos(joint) => joint < program.joints,
        Input::PerSpeed(coordinate) => coordinate < sizes.coordinates(),
        Input::Entry(argument, index) => index < argument.length(sizes),
    };
    if let Some(input) = program.dag.inputs().find(|input| !is_own(input)) {
        let why = format!("`{}` is not one of its inputs", input.name());
        return Err(Diagnostic::error(why));
    }
    let (expected, actual) = (program.function.outputs(sizes), program.dag.outputs.len());
    if actual != expected {
        let why = format!("expected {expected} results, found {actual}");
        return Err(Diagnostic::error(why));
    }
    Ok(program)
}

fn edited(empty: &Program, emitted: &Straight<Exact>) -> Result<Program, Diagnostic> {
    let program = program(empty, emitted)?;
    match program.divides() {
        true => Err(Diagnostic::error("a quotient, for which no bound is known")),
        false => Ok(program),
    }
}

fn pass((name, numbers): &(String, [usize; 4])) -> Option<Pass> {
    let name = Pass::NAMES.into_iter().find(|known| known == name)?;
    let mut counts = Counts::default();
    [counts.mul, counts.add, counts.div, counts.sincos] = *numbers;
    Some(Pass { name, counts })
}
