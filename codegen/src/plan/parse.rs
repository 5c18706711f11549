//! Reads a plan. Whatever the text says, the program is proved before use;
//! reading only makes sure that it is one.

use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;

use super::{Edited, Entry, Plan, PlanError};
use crate::edits::Omission;
use crate::function::{BundleError, Function};
use crate::program::text::{read_results, read_step, without_quotient};
use crate::program::{Counts, Program, ScalarType, Steps};
use crate::search::Pass;
use crate::seeds::{Source, Start};
use crate::setup::{ParametersKey, SceneKey};
use crate::words::{Complaint, Word, complaint};

/// The complaints about lines of parameters and of stages.
const PARAMETERS: &str = "expected `payload`, `gravity` or both, the load's length and its hash";
const STAGE: &str = "expected a stage and four counts";
const LEFT: &str = "expected what was left out: operations, sines and words";

/// The longest plan that is read.
pub(crate) const MAX_BYTES: usize = 64 << 20;

impl Plan {
    /// Reads a plan.
    ///
    /// # Errors
    /// The first line that is not as [`Plan::write`] writes it.
    pub fn parse(text: &str) -> Result<Plan, PlanError> {
        if text.len() > MAX_BYTES {
            let why = complaint(format!("the plan is longer than {MAX_BYTES} bytes"));
            return Err(PlanError { line: 1, why });
        }
        let mut reader = Reader::default();
        for (index, line) in text.lines().enumerate() {
            let read = reader.line(line.trim());
            let line = index + 1;
            read.map_err(|why| PlanError { line, why })?;
        }
        let end = text.lines().count().max(1);
        reader.finish().map_err(|why| PlanError { line: end, why })
    }
}

#[derive(Default)]
struct Reader {
    versioned: bool,
    robot: Option<String>,
    input: Option<String>,
    entries: Vec<Entry>,
    /// The program that is being read: not returned yet.
    open: Option<Entry>,
    /// Its steps so far.
    steps: Steps,
    /// What is being read of the last entry's variant.
    variant: Option<Edited>,
}

impl Reader {
    fn line(&mut self, line: &str) -> Result<(), Complaint> {
        if line.is_empty() || line.starts_with('#') && !line.contains(' ') {
            return Ok(());
        }
        if line.starts_with("# ") {
            return Ok(());
        }
        let words: Vec<&str> = line.split(' ').collect();
        if self.variant.is_some() {
            return self.variant(line, &words);
        }
        if let ("edited", None, Some(entry)) = (words[0], &self.open, self.entries.last()) {
            self.variant = Some(Edited {
                program: entry.program.clone(),
                left_out: Vec::new(),
            });
            return Ok(());
        }
        let is_late = !self.steps.steps.is_empty();
        match (words[0], &mut self.open) {
            ("plan", None) => {
                if words[1..] != ["1"] {
                    return Err(complaint("this version reads plans of version 1"));
                }
                self.versioned = true;
            }
            _ if !self.versioned => return Err(complaint("expected `plan 1`")),
            ("robot", None) => self.robot = words.get(1).map(|&w| w.to_owned()),
            ("input", None) => self.input = words.get(1).map(|&w| w.to_owned()),
            ("program", None) => self.open = Some(program(&words[1..])?),
            ("scene", Some(entry)) => scene(&words[1..], entry, is_late)?,
            ("parameters", Some(entry)) => parameters(&words[1..], entry, is_late)?,
            ("stage", Some(entry)) => entry.passes.push(pass(&words[1..])?),
            ("return", Some(entry)) => {
                read_results(
                    &words[1..],
                    std::mem::take(&mut self.steps),
                    &mut entry.program,
                )?;
                self.entries.extend(self.open.take());
            }
            (_, Some(entry)) => {
                let step = read_step(&words, &entry.program, self.steps.steps.len())?;
                self.steps.steps.push(step);
            }
            (word, None) => return Err(complaint(format!("expected `program`, found `{word}`"))),
        }
        Ok(())
    }

    /// Reads a line of a variant: `left OPERATIONS SINES WORDS`, a step, or its results.
    fn variant(&mut self, line: &str, words: &[&str]) -> Result<(), Complaint> {
        let Some(variant) = &mut self.variant else {
            return Ok(());
        };
        match words[0] {
            "left" if self.steps.steps.is_empty() => {
                let omission = left_out(line).ok_or_else(|| complaint(LEFT))?;
                variant.left_out.push(omission);
            }
            "return" => {
                let steps = std::mem::take(&mut self.steps);
                read_results(&words[1..], steps, &mut variant.program)?;
                if let Some(entry) = self.entries.last_mut() {
                    entry.edited = self.variant.take();
                }
            }
            _ => {
                let step = read_step(words, &variant.program, self.steps.steps.len())?;
                self.steps.steps.push(without_quotient(step)?);
            }
        }
        Ok(())
    }

    fn finish(self) -> Result<Plan, Complaint> {
        if self.open.is_some() {
            return Err(complaint("the last program has no `return`"));
        }
        if self.variant.is_some() {
            return Err(complaint("the last variant has no `return`"));
        }
        Ok(Plan {
            robot: self
                .robot
                .ok_or_else(|| complaint("there is no line `robot`"))?,
            input: self
                .input
                .ok_or_else(|| complaint("there is no line `input`"))?,
            entries: self.entries,
        })
    }
}

/// Reads what was left out; its words go into documentation, in every language.
fn left_out(line: &str) -> Option<Omission> {
    let mut parts = line.splitn(4, ' ').skip(1);
    let (operations, sincos) = (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
    let words = parts.next()?.to_owned();
    let is_plain = !words.contains("*/") && !words.contains(char::is_control);
    is_plain.then_some(Omission {
        words,
        operations,
        sincos,
    })
}

fn program(words: &[&str]) -> Result<Entry, Complaint> {
    let &[function, start, scalar, source, joints] = words else {
        return Err(complaint(
            "expected a function, formulation, scalar, source and n",
        ));
    };
    let unknown = |what, word: &str| complaint(format!("`{word}` is no {what}"));
    let joints = joints
        .parse()
        .ok()
        .filter(|n| (1..=Robot::MAX_JOINTS).contains(n))
        .ok_or_else(|| unknown("number of joints", joints))?;
    let function = Function::parse(function).map_err(|error| match error {
        BundleError::Unknown(name) => unknown("function", &name),
        // A plan is written by the command: nobody has to be told the fix.
        error => complaint(error.message()),
    })?;
    Ok(Entry {
        scene: None,
        parameters: None,
        edited: None,
        start: Start::from_name(start).ok_or_else(|| unknown("formulation", start))?,
        scalar: ScalarType::from_name(scalar).ok_or_else(|| unknown("scalar", scalar))?,
        source: Source::from_name(source).ok_or_else(|| unknown("source", source))?,
        passes: Vec::new(),
        // Speeds are the robot's, which the plan's text does not have.
        program: Program::empty(function, joints),
    })
}

/// Reads `scene NAME HASH ROWS ARGUMENTS`: what a scene leaves of the program.
fn scene(words: &[&str], entry: &mut Entry, is_late: bool) -> Result<(), Complaint> {
    let &[name, hash, rows, arguments] = words else {
        return Err(complaint(
            "expected a scene's name, hash, rows and arguments",
        ));
    };
    let program = &mut entry.program;
    if is_late {
        return Err(complaint("the scene comes before the steps"));
    }
    let row = |word: &str| {
        let number = word.parse::<usize>().ok()?.checked_sub(1)?;
        (number < program.joints).then_some(number)
    };
    let rows: Option<Vec<usize>> = rows.split(',').map(row).collect();
    program.rows = rows
        .filter(|rows| rows.len() <= program.joints)
        .ok_or_else(|| complaint("expected joints such as `1,2,3`"))?;
    program
        .arguments
        .retain(|a| arguments.split(',').any(|word| word == a.name()));
    entry.scene = Some(SceneKey {
        name: name.to_owned(),
        hash: hash.to_owned(),
    });
    Ok(())
}

/// Reads `parameters NAMES LOAD HASH`: which parameters of the robot are arguments, and how many
/// numbers the load has.
fn parameters(words: &[&str], entry: &mut Entry, is_late: bool) -> Result<(), Complaint> {
    let &[names, load, hash] = words else {
        return Err(complaint(PARAMETERS));
    };
    let program = &mut entry.program;
    if is_late || entry.parameters.is_some() {
        return Err(complaint("the parameters come once, before the steps"));
    }
    let all = RuntimeParameter::ALL.into_iter();
    let taken: Vec<RuntimeParameter> = all
        .filter(|parameter| names.split(',').any(|word| word == parameter.name()))
        .collect();
    if taken.len() != names.split(',').count() {
        return Err(complaint(PARAMETERS));
    }
    program.load = load
        .parse()
        .ok()
        .filter(|&load| load <= MAX_LOAD)
        .ok_or_else(|| complaint(PARAMETERS))?;
    let arguments = taken.iter().map(|parameter| parameter.argument());
    program.arguments.extend(arguments);
    program.arguments.sort();
    entry.parameters = Some(ParametersKey {
        taken,
        load: program.load,
        hash: hash.to_owned(),
    });
    Ok(())
}

/// A load has no more numbers: ten of each link, and differences of two of them.
const MAX_LOAD: usize = 100 * Robot::MAX_JOINTS;

fn pass(words: &[&str]) -> Result<Pass, Complaint> {
    let (name, counts) = words.split_first().ok_or_else(|| complaint(STAGE))?;
    let counts: Vec<usize> = counts.iter().filter_map(|word| word.parse().ok()).collect();
    let &[mul, add, div, sincos] = counts.as_slice() else {
        return Err(complaint(STAGE));
    };
    let name = Pass::NAMES
        .into_iter()
        .find(|known| known == name)
        .ok_or_else(|| complaint(format!("`{name}` is no stage")))?;
    Ok(Pass {
        name,
        counts: Counts {
            mul,
            add,
            div,
            sincos,
            ..Counts::default()
        },
    })
}
