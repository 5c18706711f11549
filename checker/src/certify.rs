//! A generated file and its claim: every function is the exact program that is claimed, which is
//! the robot's, and rounding costs so much.

use std::collections::{HashMap, HashSet};

use crate::aside;
use crate::c99;
use crate::claim::{Claim, Claimed, Constants, Tolerated};
use crate::compare::compare;
use crate::cost::{cost, ranges};
use crate::fault::Fault;
use crate::file::{self, Found};
use crate::identity::exact::Exact;
use crate::identity::number::Draws;
use crate::identity::program::{ARGUMENTS, argument};
use crate::identity::program::{Operand, Program};
use crate::identity::setting::Setting;
use crate::identity::table::{Function, functions, length};
use crate::identity::{Base, Statement, aligned, check, robot};
use crate::read::{self, Argument, Head, Text, TextError, camel};
use crate::rounding::Ranges;
use crate::tolerance::Subject;

pub use crate::cost::{RATE, Shown};
pub use crate::tolerance::Bounded;

/// The most times that a function of a claim is bounded under a tolerance.
const MOST_TIMES: usize = 4;
/// The most functions, and what stands beside them, of a file.
const MOST_ITEMS: usize = 1 << 14;

/// The findings about one function, or about what stands beside functions.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its module.
    pub module: String,
    /// Its name.
    pub name: String,
    /// Its first line in the file, from one.
    pub line: usize,
    /// The cost of rounding, if it is shown; else the reason why it is not.
    pub result: Result<Shown, Fault>,
}

/// The findings about a file.
#[derive(Clone, Debug)]
pub struct Report {
    /// One a function, in the file's order, then what is not shown beside them.
    pub lines: Vec<Line>,
    /// `true` if the robot file gives rates no limit.
    pub is_unlimited: bool,
}

impl Report {
    /// Returns true if every function is shown.
    pub fn is_shown(&self) -> bool {
        !self.lines.is_empty() && self.lines.iter().all(|line| line.result.is_ok())
    }
}

/// Checks every function of a file, with its claim, against a robot or one of its scenes. A
/// `tolerance`, relative to T, takes the place of the scene's.
///
/// # Errors
/// A robot file, a claim or a file that this checker does not know; what is wrong with a function
/// is in its line.
pub fn certify(
    source: &str,
    claim: &str,
    robot: &str,
    scene: Option<&str>,
    tolerance: Option<f64>,
) -> Result<Report, Fault> {
    let document = Claim::read(claim)?;
    if document.functions.iter().any(|own| own.planned.is_some()) {
        let why = "a plan for searches, and not what is claimed of a file";
        return Err(Fault::Claim(why.into()));
    }
    let of_robot = |why: String| Fault::Robot("file".into(), why);
    let mut file = robot::read(robot).map_err(of_robot)?;
    if let Some(rows) = document.aligned.as_ref().filter(|_| file.is_placed()) {
        let of_rows = |why: String| Fault::Claim(format!("`aligned`: {why}"));
        let rows = robot::read(rows).map_err(of_rows)?;
        aligned::check(&file, &rows).map_err(of_rows)?;
        file = rows.in_scenes_of(&mut file);
    }
    let setting = file.setting(scene).map_err(of_robot)?;
    let is_c = source.starts_with(c99::HEAD);
    let items = match is_c {
        true => c99::functions(source)?,
        false => file::functions(source)?,
    };
    if items.len() > MOST_ITEMS {
        return Err(Fault::Text(1, format!("more than {MOST_ITEMS} items")));
    }
    let singles = items.iter().filter(|item| item.text.contains("[f32; "));
    let mut whole = Whole {
        seed: Draws::new(&[robot, claim, source]).text(),
        constants: document.constants()?,
        claim: &document,
        ranges: ranges(&setting).map_err(of_robot)?,
        setting: &setting,
        tolerance: match tolerance {
            Some(own) => Some((vec![own; setting.joints()], None)),
            None => (setting.tolerance().map_err(of_robot)?).map(|(own, to)| (own, Some(to))),
        },
        scene,
        is_c,
        singles: singles.map(|item| item.module).collect(),
        found: HashMap::new(),
        bounded: HashMap::new(),
    };
    // It computes no dynamics: it says where a box is.
    let is_box = |found: &Found| match is_c {
        true => found.name == format!("{}_in_box", found.module),
        false => found.name == "in_box",
    };
    let is_other = |found: &&Found| !is_beside(found) && !is_box(found);
    let mut lines = Vec::new();
    for found in items.iter().filter(is_other) {
        lines.push(Line {
            module: found.module.to_owned(),
            name: whole.name(found),
            line: found.line,
            result: whole.shown(found),
        });
    }
    let beside = whole.beside();
    for item in items.iter().filter(|item| is_beside(item)) {
        if let Err(why) = whole.follows(item, &items, &beside) {
            let head = item.text.lines().next().unwrap_or("");
            let name = head.split([':', '{', '(']).next().unwrap_or("").trim();
            lines.push(Line {
                module: item.module.to_owned(),
                name: name.to_owned(),
                line: item.line,
                result: Err(why),
            });
        }
    }
    Ok(Report {
        lines,
        is_unlimited: setting.is_unlimited(),
    })
}

/// Returns true for an item that is no function, or one that gives constants.
fn is_beside(found: &Found) -> bool {
    found.name.is_empty() || found.text.contains(" pi[")
}

/// Returns a fault of a text.
fn fault(own: TextError) -> Fault {
    Fault::Text(own.line, format!("not of the grammar: {}", own.reason))
}

/// A file that is checked.
struct Whole<'w> {
    /// The seed of all draws, from robot, claim and text.
    seed: String,
    claim: &'w Claim,
    constants: Constants,
    setting: &'w Setting<'w>,
    ranges: Ranges,
    /// The tolerance of each joint, and the scale that it is relative to, if that is given.
    tolerance: Option<(Vec<f64>, Option<&'w str>)>,
    scene: Option<&'w str>,
    is_c: bool,
    /// The modules in Rust whose scalar is f32.
    singles: HashSet<&'w str>,
    /// The finding about each function of the claim: both scalars have one program.
    found: HashMap<usize, Result<(), Fault>>,
    /// The times that each was bounded under a tolerance.
    bounded: HashMap<usize, usize>,
}

impl<'w> Whole<'w> {
    /// Returns true for a function in f32.
    fn is_single(&self, found: &Found) -> bool {
        match self.is_c {
            true => found.text.contains("const float "),
            false => self.singles.contains(found.module),
        }
    }

    /// Returns the function that a text is claimed to be, with its place.
    fn claimed(&self, found: &Found) -> Option<(usize, &'w Claimed)> {
        let is_own = |own: &&Claimed| {
            let named = match self.is_c {
                true => {
                    let place = usize::from(self.is_single(found));
                    let symbol = own.symbols.get(place).map(String::as_str);
                    symbol == Some(found.name) && c99::are_of(found, &own.function)
                }
                false => own.function == found.name,
            };
            named && own.scene.as_deref() == self.scene
        };
        let mut all = self.claim.functions.iter().enumerate();
        all.find(|(_, own)| is_own(own))
    }

    /// Returns the name of a function; of a name in C that is short also the one that it is for, and
    /// of one that is of nobody's table what it returns.
    fn name(&self, found: &Found) -> String {
        let mut name = found.name.to_owned();
        let Some((_, own)) = self.claimed(found) else {
            return name;
        };
        if !found.name.ends_with(&own.function) {
            name += &format!(" = {}", own.function);
        }
        let is_known = functions().iter().any(|known| known.name == own.function);
        if !is_known && own.function != LOAD {
            name += &format!(" = {}", own.results.join(" + "));
        }
        name
    }

    /// Shows a function.
    fn shown(&mut self, found: &Found) -> Result<Shown, Fault> {
        let Some((place, claimed)) = self.claimed(found) else {
            let scene = self
                .scene
                .map_or_else(String::new, |scene| format!(" in scene `{scene}`"));
            let why = format!("nothing is claimed of `{}`{scene}", found.name);
            return Err(Fault::Claim(why));
        };
        let refused = |why: String| Fault::Claim(format!("`{}`: {why}", claimed.function));
        let in_file = |own: Fault| match own {
            Fault::Text(line, why) => Fault::Text(found.line + line - 1, why),
            other => other,
        };
        let emitted = claimed.program(&self.constants)?;
        let other = claimed.exact(&self.constants)?;
        let exact = other.as_ref().unwrap_or(&emitted);
        let function = function(claimed).map_err(refused)?;
        let mut programs = [&emitted, exact].into_iter();
        let is_fixed = |own: &Operand<Exact>| self.setting.is_fixed(own);
        if programs.any(|own| own.reads(is_fixed)) {
            let why = "it reads a joint that is locked, or a rate that stands still";
            return Err(refused(why.into()));
        }
        let base = claimed.base(&self.constants, self.setting.links())?;
        let head = self.head(claimed, &function, &base, self.is_single(found))?;
        let read = self.read(&head, found).map_err(in_file)?;
        let why = |why: String| Fault::Text(found.line, why);
        compare(&read.program, &emitted, head.is_single).map_err(why)?;
        self.sines(&read, head.is_single).map_err(why)?;
        if !self.found.contains_key(&place) {
            let identity = self.identity(claimed, &function, exact, &base);
            self.found.insert(place, identity);
        }
        self.found.get(&place).cloned().unwrap_or(Ok(()))?;
        let results = match self.tolerated(claimed).map_err(refused)? {
            None => Vec::new(),
            Some((own, tolerance)) => {
                // A file has each in two scalars; it may not ask for the work again and again.
                let times = self.bounded.entry(place).or_default();
                *times += 1;
                if *times > MOST_TIMES {
                    return Err(Fault::Work);
                }
                let subject = Subject {
                    setting: self.setting,
                    function: &function,
                    exact,
                    emitted: &emitted,
                    read: &read,
                    is_single: head.is_single,
                    own,
                    tolerance: &tolerance,
                };
                subject.bounded()?
            }
        };
        if let Some(place) = results.iter().position(|own| !own.is_shown()) {
            let own = &results[place];
            let [bound, tolerated] = [own.bound(), own.tolerated].map(|size| size / own.unit());
            let place = place + 1;
            let why = format!("result {place} is within {bound:.3e} of T, not {tolerated:.3e}");
            return Err(refused(why));
        }
        let cost = cost(&read, &head, &self.ranges, &[&self.seed, head.name]);
        Ok(Shown { results, ..cost })
    }

    /// Returns the claim under a tolerance, and the tolerance of each joint; none of a function that
    /// needs none.
    fn tolerated(&self, own: &'w Claimed) -> Result<Option<(&'w Tolerated, Vec<f64>)>, String> {
        match (&self.tolerance, &own.tolerated) {
            (None, None) => Ok(None),
            (Some(_), None) if own.function == LOAD => Ok(None),
            (Some(_), None) => Err("its claim has no error bounds, and a tolerance is asked for".into()),
            (None, Some(_)) => Err(
                "its claim has error bounds, and no tolerance is asked for: name its scene, or give one".into(),
            ),
            (Some((each, to)), Some(own)) => match to.is_none_or(|to| to == own.relative_to) {
                true => Ok(Some((own, each.clone()))),
                false => Err("its T is not the one that the scene's errors are relative to".into()),
            },
        }
    }

    /// Returns the head that a function must have.
    fn head<'h>(
        &self,
        claimed: &'h Claimed,
        function: &'h Function,
        base: &Base,
        is_single: bool,
    ) -> Result<Head<'h>, Fault> {
        let sizes = [self.setting.joints(), self.setting.links()];
        let load = match function.fields.is_empty() {
            true => claimed.returns.split_ascii_whitespace().count(),
            false => self.load()?.map_or(0, |own| own.outputs.len()),
        };
        let arguments = function.arguments.iter().map(|&place| {
            let (name, axis) = ARGUMENTS[place];
            let length = if name == "load" {
                load
            } else {
                length(axis, sizes)
            };
            Argument {
                place,
                name,
                length,
            }
        });
        let columns = base.combinations.len();
        let fields = function.fields.iter();
        let fields = fields.map(|own| (own.name.as_str(), own.lengths(self.setting, columns)));
        let mut fields: Vec<(&str, Vec<usize>)> = fields.collect();
        if fields.is_empty() {
            fields.push((LOAD, vec![load]));
        }
        Ok(Head {
            name: &claimed.function,
            is_single,
            arguments: arguments.collect(),
            structure: None,
            fields,
            joints: sizes[0],
        })
    }

    /// Reads the text of a function.
    fn read(&self, head: &Head, found: &Found) -> Result<read::Function, Fault> {
        let structure = camel(head.name);
        let head = &Head {
            structure: (head.fields.len() > 1).then_some(structure.as_str()),
            ..head.clone()
        };
        let text = &found.text;
        let read = match self.is_c {
            true => Text::c(text).and_then(|words| {
                let symbols = c99::symbols(text, head.is_single);
                words.c_function(head, &symbols, !symbols.batch.is_empty())
            }),
            false => Text::rust(text).and_then(|words| words.rust_function(head, false)),
        };
        match read.map_err(fault)? {
            (read, true) => Ok(read),
            _ => Err(Fault::Text(1, "more than the function stands there".into())),
        }
    }

    /// Checks that sines are of joints that turn, and roots of the widths of friction.
    fn sines(&self, read: &read::Function, is_single: bool) -> Result<(), String> {
        if let Some(own) = read
            .sines
            .iter()
            .find(|own| !self.setting.turns_by(own.joint))
        {
            return Err(format!("the sine of joint {}, which slides", own.joint + 1));
        }
        for &(joint, literal) in &read.speeds {
            let square = self.setting.square_of_width(joint);
            if !square.is_some_and(|own| own.is_nearest(literal, is_single)) {
                return Err(format!("another width of friction of joint {}", joint + 1));
            }
        }
        Ok(())
    }

    /// Returns the program that computes the load of a payload, if it is claimed.
    fn load(&self) -> Result<Option<Program<Exact>>, Fault> {
        let mut all = self.claim.functions.iter();
        let own = all.find(|own| own.function == LOAD && own.scene.as_deref() == self.scene);
        own.map(|own| own.program(&self.constants)).transpose()
    }

    /// Compares a function's program with the equations of motion.
    fn identity(
        &self,
        claimed: &Claimed,
        function: &Function,
        program: &Program<Exact>,
        base: &Base,
    ) -> Result<(), Fault> {
        if function.fields.is_empty() {
            // What it computes is shown by those that take it.
            return Ok(());
        }
        let load = self.load()?;
        let statement = Statement {
            setting: self.setting,
            function,
            program,
            base,
            load: load.as_ref(),
        };
        let refused = |why| Fault::Claim(format!("`{}`: {why}", claimed.function));
        check(statement, &[&self.seed]).map_err(refused)
    }

    /// Returns what items beside functions follow from: the values of base parameters, and the
    /// structs of results in each scalar. Of a function whose claim is none, nothing follows.
    fn beside(&self) -> Beside {
        let mut all = Beside::default();
        let claims = self.claim.functions.iter();
        for own in claims.filter(|own| own.scene.as_deref() == self.scene) {
            let (Ok(base), Ok(function)) = (
                own.base(&self.constants, self.setting.links()),
                function(own),
            ) else {
                continue;
            };
            let heads = [false, true].map(|is_single| self.head(own, &function, &base, is_single));
            all.structs.extend(heads.iter().flatten().map(structure));
            let name = function.parameters();
            all.values.extend(name.map(|name| (name, base.values)));
        }
        all
    }

    /// Checks what stands beside functions.
    fn follows(&self, item: &Found, items: &[Found], beside: &Beside) -> Result<(), Fault> {
        if self.is_c {
            let mut values = beside.values.iter();
            let are =
                values.any(|(name, own)| c99::are_values(item, &name.to_ascii_lowercase(), own));
            let why = "its numbers are not the base parameters that are claimed";
            return are
                .then_some(())
                .ok_or_else(|| Fault::Text(item.line, why.into()));
        }
        let own = |other: &&Found| other.module == item.module && !other.name.is_empty();
        let functions: Vec<&Found> = items.iter().filter(own).collect();
        let known = aside::Known {
            setting: self.setting,
            ranges: &self.ranges,
            values: &beside.values,
            structs: &beside.structs,
        };
        known.follows(item, &functions)
    }
}

/// The values and structs that items beside functions follow from.
#[derive(Default)]
struct Beside {
    values: Vec<(&'static str, Vec<Exact>)>,
    structs: Vec<Vec<String>>,
}

/// The function that computes the load of a payload, and its result.
const LOAD: &str = "load";

/// Returns the function that is claimed. What computes a load means what others make of it: it has
/// no results of its own.
fn function(claimed: &Claimed) -> Result<Function, String> {
    let is_load = claimed.function == LOAD && claimed.results == [LOAD];
    if claimed.results.is_empty() {
        return Err("it has no results".into());
    }
    let results = if is_load { &[][..] } else { &claimed.results };
    let function = Function::named(&claimed.function, &claimed.arguments, results)?;
    let payload = argument("payload").unwrap_or_default();
    match is_load && function.arguments != [payload] {
        true => Err("a load is of a payload alone".into()),
        false => Ok(function),
    }
}

/// Returns the lines of the struct of a function's results in Rust; none if one number or array is
/// returned.
fn structure(head: &Head) -> Vec<String> {
    if head.fields.len() < 2 {
        return Vec::new();
    }
    let scalar = if head.is_single { "f32" } else { "f64" };
    let fields = head.fields.iter().map(|(name, shape)| {
        let lengths = shape.iter().rev();
        let of = lengths.fold(scalar.to_owned(), |of, length| format!("[{of}; {length}]"));
        format!("pub {name}: {of},")
    });
    let first = format!("pub struct {} {{", camel(head.name));
    let lines = [first].into_iter().chain(fields);
    lines.chain(["}".to_owned()]).collect()
}
