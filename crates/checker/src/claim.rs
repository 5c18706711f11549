//! The document beside a file: of each function what it is said to compute, and the exact program
//! that its text has to be.
//!
//! ```json
//! { "claim": 2,
//!   "constants": ["981/100", "1/2*cos(3/10)"],
//!   "functions": [
//!     { "function": "gravity", "arguments": ["q"], "results": ["gravity.c"],
//!       "steps": "s1*#0 c1*#1 t1-t2", "returns": "t3 -t1" } ] }
//! ```
//!
//! Under a tolerance the text is another program than the exact one, and both stand there. A plan
//! is the same document: of each function, too, what was searched for and how it was found.

use std::collections::HashSet;
use std::ops::Not;

use serde::{Deserialize, Serialize};

use crate::fault::Fault;
use crate::identity::Base;
use crate::identity::exact::{Exact, LONGEST, Sines};
use crate::program::{Operand, Program, Step, argument};
use crate::read::whole;
use crate::work::Work;

/// The version that is read.
pub const VERSION: u32 = 2;
/// The longest document.
pub const MOST_BYTES: usize = 32 << 20;
/// The most constants, and the most operations of a function.
const MOST: usize = 1 << 17;
const MOST_FUNCTIONS: usize = 1 << 12;
/// The most results of a function: of 64 joints all h_ikm are 2¹⁸.
const MOST_RESULTS: usize = 1 << 19;
/// The most quotients times operations, and times results and quotients: what divides has a degree
/// in each divisor.
const MOST_DEGREES: usize = 1 << 26;

/// The functions of a robot, each with what is claimed of it: the exact program, its arguments and
/// results, and the scene. It has no bounds: the checker finds these itself.
///
/// ```
/// use dalembert_checker::claim::Claim;
///
/// let text = std::fs::read_to_string("tests/data/attacks/A.claim.json").unwrap();
/// let claim = Claim::read(&text)?;
/// assert_eq!(claim.functions.len(), 1);
/// assert_eq!(claim.functions[0].scene.as_deref(), Some("pick"));
/// # Ok::<(), dalembert_checker::Fault>(())
/// ```
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// The version of the document.
    pub claim: u32,
    /// The robot's name, in a plan.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub robot: String,
    /// The hash of the robot, in a plan.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub input: String,
    /// The robot by rows, as generators take it, if its joints are placed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aligned: Option<String>,
    /// The notes of the robot file, for readers: nothing is concluded from them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// The constants of all programs: `#0` is the first.
    pub constants: Vec<String>,
    /// The functions.
    pub functions: Vec<FunctionClaim>,
}

/// The claim of one function.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct FunctionClaim {
    /// The name.
    pub function: String,
    /// The names in C, of one state: in f64, and in f32.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub symbols: Vec<String>,
    /// The scene that it is for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<String>,
    /// The arguments there are, in order.
    pub arguments: Vec<String>,
    /// The links whose bodies are an argument, from one; a base that floats is zero.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<usize>,
    /// True if numbers of these bodies that are zero in the robot file stay zero.
    #[serde(skip_serializing_if = "Not::not")]
    pub keeps_zeros: bool,
    /// The results in order, each by a function that has it: `gravity.c`, `jacobian.jacobian@camera`.
    pub results: Vec<String>,
    /// The operations of the text, one a word: `s1*#0`. A product that is not rounded has `×`, and its
    /// sum is next.
    pub steps: String,
    /// The values of the results.
    pub returns: String,
    /// The exact program, if a tolerance left something out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerated: Option<ToleranceClaim>,
    /// The parameters that each column of a regressor adds up: `m2 #4*mx2`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub base: Vec<String>,
    /// The values of these parameters, constants each.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub values: String,
    /// The search, in a plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub planned: Option<SearchRecord>,
}

/// A search that a plan keeps beside its program, so that it is not repeated.
#[derive(Clone, Debug, Deserialize, Eq, Hash, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SearchRecord {
    /// The function with its parts and frames: `servo=inverse_dynamics+jacobian`.
    pub asked: String,
    /// The formulation that was asked for.
    pub formulation: String,
    /// The scalar that the program was searched for.
    pub scalar: String,
    /// The formulation that the search started from.
    pub source: String,
    /// The products, sums, quotients and sines after each pass.
    pub passes: Vec<(String, [usize; 4])>,
    /// The number of joints.
    pub joints: usize,
    /// True if six coordinates of a base that floats come before those of the joints.
    #[serde(default, skip_serializing_if = "Not::not")]
    pub floats: bool,
    /// The joints with which limbs begin, from one, where results are over limbs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limbs: Vec<usize>,
    /// The coordinates that the results are over, from one.
    pub rows: Vec<usize>,
    /// The loops of the text: the operations before each, those of a lane, and the lanes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loops: Vec<[usize; 3]>,
    /// The hash of the scene.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub scene: String,
    /// The number of entries of the load, and their hash, where parameters are arguments.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<(usize, String)>,
}

/// The claim about a function under a tolerance: the exact program, and what errors are relative to.
/// None of its numbers makes an error look smaller.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct ToleranceClaim {
    /// The operations of the exact program, if the text has others.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub steps: String,
    /// The values that it returns.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub returns: String,
    /// The meaning of T: `actuator`, the limits of the actuators, or `range`, a size that the result
    /// reaches.
    pub relative_to: String,
    /// If T is the range: a state for each result at which it is reached, q, q̇ and q̈ in a row.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub reached: Vec<Vec<f64>>,
}

impl Claim {
    /// Reads a document.
    ///
    /// # Errors
    /// A text that is no claim, with the line of the mistake.
    pub fn read(source: &str) -> Result<Claim, Fault> {
        let refuse = |why: String| Err(Fault::Claim(why));
        if source.len() > MOST_BYTES {
            return refuse(format!("more than {MOST_BYTES} bytes"));
        }
        let claim: Result<Claim, _> = serde_json::from_str(source);
        let claim = claim.or_else(|error| refuse(error.to_string()))?;
        if claim.claim != VERSION {
            let version = claim.claim;
            return refuse(format!(
                "version {version} is not known, {VERSION} is: generate the file and its claim anew"
            ));
        }
        if claim.constants.len() > MOST {
            return refuse(format!("more than {MOST} constants"));
        }
        if claim.functions.len() > MOST_FUNCTIONS {
            return refuse(format!("more than {MOST_FUNCTIONS} functions"));
        }
        let (mut keys, mut symbols) = (HashSet::new(), HashSet::new());
        for function in &claim.functions {
            let (name, scene) = (&function.function, &function.scene);
            if !keys.insert((name, scene, &function.planned)) {
                return refuse(format!("`{name}` is defined twice"));
            }
            let mut names = function.symbols.iter();
            if let Some(twice) = names.find(|symbol| !symbols.insert((*symbol, scene))) {
                return refuse(format!("`{twice:.40}` is defined twice"));
            }
            // It is printed where nothing else may stand.
            if function.planned.is_none() && !is_name(name) {
                return refuse(format!("`{name:.40}` is not the name of a function"));
            }
        }
        Ok(claim)
    }

    /// Writes the document, a line for each function.
    pub fn write(&self) -> String {
        // A struct of strings and lists has a text; no string has a bare quotation mark.
        let text = serde_json::to_string(self).unwrap_or_default();
        text.replace("{\"function\":", "\n{\"function\":") + "\n"
    }

    /// Reads the constants.
    ///
    /// # Errors
    /// The first text that is not a constant.
    pub fn constants(&self, work: &Work) -> Result<Vec<Exact>, Fault> {
        /// The most angles that constants have sines of.
        const MOST_ANGLES: usize = 1 << 10;
        /// Nanoseconds for a digit of a short constant, a factor, and the sine of an angle.
        const DIGIT: u64 = 100;
        const FACTOR: u64 = 500;
        const ANGLE: u64 = 100_000;
        let terms = |text: &String| 1 + text.matches('+').count();
        if self.constants.iter().map(terms).sum::<usize>() > MOST {
            return Err(Fault::Claim(format!("constants of more than {MOST} terms")));
        }
        for text in &self.constants {
            // Nothing is read of a longer text.
            let read = text.len().min(LONGEST);
            work.spend(read, DIGIT + read as u64 / 16)?;
        }
        let read = self.constants.iter().map(|text| {
            let why = || format!("`{text:.40}` is not a constant of at most 4000 digits");
            Exact::read(text).ok_or_else(|| Fault::Claim(why()))
        });
        let constants = read.collect::<Result<Vec<Exact>, Fault>>()?;
        let mut sines = Sines::new();
        for constant in &constants {
            let before = sines.len();
            constant.settle(&mut sines);
            work.spend(constant.factors(), FACTOR)?;
            work.spend(sines.len() - before, ANGLE)?;
            if sines.len() > MOST_ANGLES {
                let why = format!("sines of more than {MOST_ANGLES} angles");
                return Err(Fault::Claim(why));
            }
        }
        Ok(constants)
    }
}

fn is_name(name: &str) -> bool {
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    name.len() < 1 << 7
        && name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(is_plain)
}

fn constant<'c, C>(constants: &'c [C], word: &str) -> Option<&'c C> {
    constants.get(whole(word.strip_prefix('#')?)?)
}

impl FunctionClaim {
    /// Returns the program of the text.
    ///
    /// # Errors
    /// The first word that is not of one.
    pub fn program<C: Clone>(&self, constants: &[C]) -> Result<Program<C>, Fault> {
        self.read([&self.steps, &self.returns], constants)
    }

    /// Returns the exact program, if it is another one.
    ///
    /// # Errors
    /// The first word that is not of one.
    pub fn exact<C: Clone>(&self, constants: &[C]) -> Result<Option<Program<C>>, Fault> {
        let tolerance = self.tolerated.as_ref();
        let exact_claim = tolerance.filter(|claim| !claim.returns.is_empty());
        let read = |claim: &ToleranceClaim| self.read([&claim.steps, &claim.returns], constants);
        exact_claim.map(read).transpose()
    }

    fn read<C: Clone>(&self, code: [&str; 2], constants: &[C]) -> Result<Program<C>, Fault> {
        let [words, returns] = code.map(str::split_ascii_whitespace);
        let mut steps: Vec<Step<C>> = Vec::new();
        for word in words {
            let operand = |word| self.operand(word, steps.len(), constants);
            let step = || {
                let (left, right) = word.split_once(['+', '-', '*', '/', '×'])?;
                let operation = word[left.len()..].chars().next()?;
                Some((operation, [operand(left)?, operand(right)?]))
            };
            steps.push(step().ok_or_else(|| self.refused(word))?);
            if steps.len() > MOST {
                return Err(self.refused("more than 131072 operations"));
            }
        }
        let quotients = steps.iter().filter(|step| step.0 == '/').count();
        let output = |word: &str| {
            let bare = word.strip_prefix('-').unwrap_or(word);
            let operand = self.operand(bare, steps.len(), constants);
            let is_negative = bare.len() < word.len();
            Ok((is_negative, operand.ok_or_else(|| self.refused(word))?))
        };
        let outputs = returns.map(output).collect::<Result<Vec<_>, Fault>>()?;
        if outputs.len() > MOST_RESULTS {
            return Err(self.refused("more results than are looked at"));
        }
        let degrees = quotients * (4 * steps.len() + quotients * outputs.len());
        if degrees > MOST_DEGREES {
            return Err(self.refused("more quotients than are looked at"));
        }
        Ok(Program { steps, outputs })
    }

    fn refused(&self, word: &str) -> Fault {
        let name = &self.function;
        Fault::Claim(format!("`{name}`: `{word:.40}` is not valid in a program"))
    }

    fn operand<C: Clone>(&self, word: &str, count: usize, constants: &[C]) -> Option<Operand<C>> {
        if let Some(constant) = constant(constants, word) {
            return Some(Operand::Constant(constant.clone()));
        }
        let takes = |name: &str| self.arguments.iter().any(|argument| argument == name);
        if let Some(entry) = word.strip_suffix(']') {
            let (name, index) = entry.split_once('[')?;
            let place = argument(name).filter(|_| takes(name))?;
            return Some(Operand::Entry(place, whole(index)?));
        }
        let (letter, number) = word.split_at_checked(1)?;
        let place = whole(number)?.checked_sub(1)?;
        match letter {
            "t" if place < count => Some(Operand::Step(place)),
            "s" | "c" if takes("q") => Some(Operand::Sine(place, letter == "s")),
            "r" if takes("qd") => Some(Operand::Speed(place)),
            _ => None,
        }
    }

    /// Returns the base parameters of a regressor of so many links.
    ///
    /// # Errors
    /// The first word that is no parameter, or no value.
    pub fn base(&self, constants: &[Exact], links: usize, floats: bool) -> Result<Base, Fault> {
        let most = 12 * (links + usize::from(floats));
        let is_long = |text: &String| text.split_ascii_whitespace().nth(most).is_some();
        if self.base.len() > most || self.base.iter().any(is_long) {
            return Err(self.refused("more base parameters than parameters"));
        }
        let term = |word: &str| {
            let (factor, name) = match word.split_once('*') {
                Some((factor, name)) => (constant(constants, factor)?.clone(), name),
                None => (Exact::read("1")?, word),
            };
            Some((parameter(name, links, floats)?, factor))
        };
        let read = |word: &str| term(word).ok_or_else(|| self.refused(word));
        let combination = |text: &String| text.split_ascii_whitespace().map(read).collect();
        let value = |word: &str| {
            let exact = constant(constants, word).cloned();
            exact.ok_or_else(|| self.refused(word))
        };
        let combinations = self.base.iter().map(combination);
        let values = self.values.split_ascii_whitespace().map(value);
        Ok(Base {
            combinations: combinations.collect::<Result<_, _>>()?,
            values: values.collect::<Result<_, _>>()?,
        })
    }
}

/// Links are counted from one; a base that floats is zero.
fn parameter(name: &str, links: usize, floats: bool) -> Option<usize> {
    const NAMES: &str = "m mx my mz Ixx Iyy Izz Ixy Iyz Ixz";
    let digits = name.find(|c: char| c.is_ascii_digit())?;
    let number = whole(&name[digits..]).filter(|number| *number <= links)?;
    let (link, drives) = (number.checked_sub(1), 10 * (links + usize::from(floats)));
    match (&name[..digits], link) {
        ("armature", link) => Some(drives + link?),
        ("viscous", link) => Some(drives + links + link?),
        (prefix, link) => {
            let body = if floats { number } else { link? };
            Some(10 * body + NAMES.split(' ').position(|name| name == prefix)?)
        }
    }
}
