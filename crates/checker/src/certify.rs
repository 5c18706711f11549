//! A generated file and its claim: every function is the exact program that is claimed, which is
//! the robot's, and rounding costs so much.

use std::collections::{HashMap, HashSet};

use crate::aside::{FileFacts, is_body};
use crate::c99;
use crate::claim::{Claim, FunctionClaim, ToleranceClaim};
use crate::compare::{Literals, compare};
use crate::cost::{self, bodies_of, ranges};
use crate::defaults::{Default, is_default};
use crate::fault::Fault;
use crate::file::{self, Item};
use crate::identity::exact::Exact;
use crate::identity::given::DEFAULTS;
use crate::identity::number::Draws;
use crate::identity::setting::Setting;
use crate::identity::table::{Field, Function, functions, length};
use crate::identity::{Base, Points, Statement, aligned, check, robot};
use crate::program::{ARGUMENTS, LOAD, Operand, Program};
use crate::read::{self, Argument, Head, Source, Text};
use crate::rounding::Ranges;
use crate::sines;
use crate::tolerance;
use crate::work::Work;

pub use crate::cost::{Cost, Findings, RATE};
pub use crate::payload::BodyRange;
pub use crate::tolerance::{Bound, ResultBound};

/// The most times that a function of a claim stands in a file: once for each scalar is usual.
const MOST_TIMES: usize = 4;
const MOST_ITEMS: usize = 1 << 14;
/// Nanoseconds for an operation, at all points of the identity.
const IDENTITY: u64 = 400;

/// The findings about one function, or about what stands beside functions.
#[derive(Clone, Debug)]
pub struct FunctionReport {
    /// Its module.
    pub module: String,
    /// Its name.
    pub name: String,
    /// Its first line in the file, from one.
    pub line: usize,
    /// The cost of rounding, if it is shown; else the reason why it is not.
    pub result: Result<Findings, Fault>,
}

/// The findings about a file.
#[derive(Clone, Debug)]
pub struct Report {
    /// One a function, in the file's order, then what is not shown beside them.
    pub lines: Vec<FunctionReport>,
    /// `true` if the robot file gives rates no limit.
    pub is_unlimited: bool,
    /// The payloads, where a function takes one, and whether they are the default.
    pub payloads: Option<(BodyRange, bool)>,
    /// The links whose bodies are arguments, from one, a base that floats zero, with those of each.
    pub bodies: Vec<(usize, BodyRange)>,
}

impl Report {
    /// Returns true if every function is shown; if the user is not strict, or measured.
    pub fn passes(&self, is_strict: bool) -> bool {
        let passes = |line: &FunctionReport| {
            let result = line.result.as_ref();
            result.is_ok_and(|findings| findings.is_bounded() || !is_strict)
        };
        !self.lines.is_empty() && self.lines.iter().all(passes)
    }
}

/// The user's demands on a file.
#[derive(Clone, Copy, Debug, Default)]
pub struct Demand<'d> {
    /// The scene that the file is for.
    pub scene: Option<&'d str>,
    /// The largest error relative to T, in place of the scene's tolerance.
    pub tolerance: Option<f64>,
    /// The largest cost of rounding relative to the largest value, where it is larger than what is
    /// shown otherwise: 1/64 in f32 and of polynomials for sines, 2⁻²⁹ in f64.
    pub worst: Option<f64>,
}

/// Checks every function of a file, with its claim, against a robot or one of its scenes.
///
/// ```
/// use dalembert_checker::certify::{Demand, certify};
///
/// // This text returns other torques than those of the robot, and its claim says otherwise.
/// let read = |name: &str| std::fs::read_to_string(format!("tests/data/attacks/{name}")).unwrap();
/// let (text, claim, robot) = (read("A.rs.txt"), read("A.claim.json"), read("r2.toml"));
/// let demand = Demand { scene: Some("pick"), ..Demand::default() };
/// let report = certify(&text, &claim, &robot, &demand)?;
/// assert!(!report.passes(false));
/// # Ok::<(), dalembert_checker::Fault>(())
/// ```
///
/// # Errors
/// A robot file, a claim or a file that this checker does not know; what is wrong with a function
/// is in its line.
pub fn certify(source: &str, claim: &str, robot: &str, demand: &Demand) -> Result<Report, Fault> {
    let (scene, tolerance) = (demand.scene, demand.tolerance);
    let mut document = Claim::read(claim)?;
    let is_plan = |function: &FunctionClaim| function.planned.is_some();
    if document.functions.iter().any(is_plan) {
        let why = "this is a search plan, not the claim of a file";
        return Err(Fault::Claim(why.into()));
    }
    let of_robot = |why: String| Fault::Robot("file".into(), why);
    let mut file = robot::read(robot).map_err(of_robot)?;
    let in_scene = |function: &FunctionClaim| function.scene.as_deref() == scene;
    document.functions.retain(in_scene);
    let is_load = |function: &&FunctionClaim| function.function == LOAD;
    let load = document.functions.iter().find(is_load);
    let links = load.map_or(&[][..], |load_claim| &load_claim.bodies);
    let mut defaults: Vec<Default> = Vec::new();
    for name in DEFAULTS {
        defaults.push((name, file.defaults(name, links).map_err(of_robot)?));
    }
    if let Some(rows) = document.aligned.as_ref().filter(|_| file.is_placed()) {
        let of_rows = |why: String| Fault::Claim(format!("`aligned`: {why}"));
        let rows = robot::read(rows).map_err(of_rows)?;
        aligned::check(&file, &rows, scene).map_err(of_rows)?;
        file = rows.in_scenes_of(file, scene);
    }
    let mut setting = file.setting(scene).map_err(of_robot)?;
    if let Some(load_claim) = load {
        let (arguments, keeps_zeros) = (&load_claim.arguments, load_claim.keeps_zeros);
        let taken = setting.take(arguments, links, &defaults[0].1, keeps_zeros);
        taken.map_err(Fault::Claim)?;
    }
    let is_c = source.starts_with(c99::HEAD);
    let items = match is_c {
        true => c99::functions(source, setting.places().as_ref())?,
        false => file::functions(source)?,
    };
    if items.len() > MOST_ITEMS {
        return Err(Fault::Text(1, format!("more than {MOST_ITEMS} items")));
    }
    let work = Work::default();
    let constants = document.constants(&work)?;
    let real = if is_c { "float " } else { "[f32; " };
    let singles = items.iter().filter(|item| item.text.contains(real));
    let payload = setting.body().map_err(of_robot)?;
    let bodies = setting.bodies_given().map_err(of_robot)?;
    let program = |function: &FunctionClaim| function.program(&constants);
    let whole = Whole {
        seed: Draws::new(&[robot, claim, source]).text(),
        load: load.map(program).transpose(),
        constants,
        claim: &document,
        ranges: ranges(&setting, &bodies).map_err(of_robot)?,
        bodies,
        defaults,
        worst: demand.worst.unwrap_or(0.0),
        work,
        literals: Literals::default(),
        setting: &setting,
        tolerance: match tolerance {
            Some(bound) => Some((vec![bound; setting.sizes().coordinates], None)),
            None => (setting.tolerance().map_err(of_robot)?)
                .map(|(tolerances, to)| (tolerances, Some(to))),
        },
        scene,
        is_c,
        singles: singles.map(|item| item.module).collect(),
    };
    let line = |item: &Item, name: String, result| FunctionReport {
        module: item.module.to_owned(),
        name,
        line: item.line,
        result,
    };
    let mut state = ReportState {
        identities: HashMap::new(),
        points: Points::new(&setting, &[&whole.seed]),
        known: FileFacts::new(&setting, &whole.ranges, whole.load_length().unwrap_or(0)),
    };
    let mut heads = HashSet::new();
    let mut is_twice = |item: &Item| -> Result<(), Fault> {
        let head = item.text.lines().next().unwrap_or("");
        let name = match item.name {
            "" => head,
            name => name,
        };
        let twice = || Fault::Text(item.line, format!("`{name}` is defined twice"));
        let is_first = heads.insert((item.module.to_owned(), name.to_owned()));
        is_first.then_some(()).ok_or_else(twice)
    };
    let mut lines = Vec::new();
    let modules = |is_such: fn(&FunctionClaim) -> bool| -> HashSet<&str> {
        let is_own = |item: &&Item| whole.claimed(item).is_some_and(is_such);
        let functions = items.iter().filter(is_own);
        functions.map(|item| item.module).collect()
    };
    let takers = modules(|function| function.arguments.iter().any(|name| name == LOAD));
    let loads = modules(|function| function.function == LOAD);
    let has_load = |item: &Item| {
        let why = "a load without functions that take it, or without the function `load`";
        let has_both = takers.contains(item.module) == loads.contains(item.module);
        has_both.then_some(()).ok_or(Fault::Claim(why.into()))
    };
    for item in items.iter().filter(|item| !is_beside(item)) {
        state.known.held.entry(item.module).or_default();
        let result = is_twice(item)
            .and_then(|()| has_load(item))
            .and_then(|()| whole.shown(item, &mut state));
        lines.push(line(item, whole.name(item), result));
    }
    for item in &items {
        state.known.add_box(item, whole.is_single(item));
    }
    for item in items.iter().filter(|item| is_beside(item)) {
        let follows = is_twice(item).and_then(|()| whole.follows(item, &state.known));
        if let Err(why) = follows {
            let head = item.text.lines().next().unwrap_or("");
            let name = head.split([':', '{', '(']).next().unwrap_or("").trim();
            lines.push(line(item, name.to_owned(), Err(why)));
        }
    }
    let takes_payload = !bodies_of(&whole.bodies, "payload").is_empty();
    let of_links = bodies_of(&whole.bodies, "bodies").iter().copied();
    Ok(Report {
        lines,
        is_unlimited: setting.is_unlimited(),
        bodies: setting.bodies.iter().copied().zip(of_links).collect(),
        payloads: takes_payload.then(|| (payload.unwrap_or_default(), payload.is_none())),
    })
}

/// Constants, payloads and boxes compute no dynamics.
fn is_beside(item: &Item) -> bool {
    let name = item.name.strip_prefix(item.module);
    let is_box = item.name == "in_box" || name == Some("_in_box");
    let is_written = |mark: &&str| item.text.contains(mark);
    is_box || item.name.is_empty() || c99::WRITTEN.iter().any(is_written)
}

/// The finding that a program is the robot's, once it is asked for; how often its function came.
type Identity = (Option<Result<(), Fault>>, usize);

struct ReportState<'w> {
    /// The finding about each function of the claim, since both scalars have one program.
    identities: HashMap<&'w str, Identity>,
    points: Points<'w>,
    known: FileFacts<'w>,
}

struct Whole<'w> {
    seed: String,
    claim: &'w Claim,
    constants: Vec<Exact>,
    load: Result<Option<Program<Exact>>, Fault>,
    setting: &'w Setting<'w>,
    ranges: Ranges,
    bodies: Vec<(usize, Vec<BodyRange>)>,
    /// The robot's numbers in the place of arguments of `load`.
    defaults: Vec<Default>,
    worst: f64,
    work: Work,
    literals: Literals,
    /// The tolerance of each joint, and the scale that it is relative to, if that is given.
    tolerance: Option<(Vec<f64>, Option<&'w str>)>,
    scene: Option<&'w str>,
    is_c: bool,
    singles: HashSet<&'w str>,
}

impl<'w> Whole<'w> {
    fn is_single(&self, item: &Item) -> bool {
        match self.is_c {
            true => item.text.contains("float "),
            false => self.singles.contains(item.module),
        }
    }

    fn claimed(&self, item: &Item) -> Option<&'w FunctionClaim> {
        let is_own = |claim: &&FunctionClaim| match self.is_c {
            true => {
                let symbol = claim.symbols.get(usize::from(self.is_single(item)));
                symbol.is_some_and(|name| name == item.name)
                    && c99::are_of(item, &claim.function, &self.claim.functions)
            }
            false => claim.function == item.name,
        };
        self.claim.functions.iter().find(is_own)
    }

    fn name(&self, item: &Item) -> String {
        let mut name = item.name.to_owned();
        let Some(claim) = self.claimed(item) else {
            return name;
        };
        if !item.name.ends_with(&claim.function) {
            name += &format!(" = {}", claim.function);
        }
        let is_known = functions().iter().any(|known| known.name == claim.function);
        if !is_known && claim.function != LOAD {
            name += &format!(" = {}", claim.results.join(" + "));
        }
        name
    }

    fn shown(&self, item: &'w Item, state: &mut ReportState<'w>) -> Result<Findings, Fault> {
        let Some(claimed) = self.claimed(item) else {
            let scene = self.scene.map(|scene| format!(" in scene `{scene}`"));
            let (name, scene) = (item.name, scene.unwrap_or_default());
            let why = format!("nothing is claimed of `{name}`{scene}");
            return Err(Fault::Claim(why));
        };
        let refused = |why: String| Fault::Claim(format!("`{}`: {why}", claimed.function));
        // A file may not ask for the same work again and again.
        let entry = state.identities.entry(&claimed.function).or_default();
        entry.1 += 1;
        if entry.1 > MOST_TIMES {
            return Err(Fault::Work);
        }
        let function = function(claimed).map_err(refused)?;
        let emitted = claimed.program(&self.constants)?;
        let other = claimed.exact(&self.constants)?;
        let exact = other.as_ref().unwrap_or(&emitted);
        if exact.outputs.len() != emitted.outputs.len() {
            return Err(refused("its two programs have different results".into()));
        }
        let mut programs = [&emitted, exact].into_iter();
        let is_fixed = |operand: &Operand<Exact>| self.setting.is_fixed(operand);
        if programs.any(|program| program.reads(is_fixed)) {
            let why = "it reads a joint that is locked, or a rate that stands still";
            return Err(refused(why.into()));
        }
        let divides = |program: &Program<Exact>| program.steps.iter().any(|step| step.0 == '/');
        let may_divide = function.fields.iter().any(Field::divides);
        if !may_divide && [&emitted, exact].into_iter().any(divides) {
            let why = "it divides, and no result of it asks for that";
            return Err(refused(why.into()));
        }
        let (links, floats) = (self.setting.links(), self.setting.base() > 0);
        let base = claimed.base(&self.constants, links, floats)?;
        let head = self.head(claimed, &function, &base, self.is_single(item))?;
        let read = self.read(&head, item)?;
        state.known.items.extend(structure(&head));
        let why = |why: String| Fault::Text(item.line, why);
        let literals = (&self.literals, &self.work);
        compare(&read.program, &emitted, head.is_single, literals).map_err(why)?;
        self.sines(&read, head.is_single).map_err(why)?;
        for sine in &read.sines {
            if let Source::Polynomial(program) = &sine.source {
                // Twice each, where a tolerance asks for it as well.
                self.work.spend(4, sines::work(program))?;
            }
        }
        let identity = || -> Result<(), Fault> {
            if function.fields.is_empty() {
                // The functions that take it show what it computes.
                return Ok(());
            }
            let statement = Statement {
                function: &function,
                program: exact,
                base: &base,
                load: self.load()?,
            };
            let quotients = exact.steps.iter().filter(|step| step.0 == '/').count();
            let degrees = exact.steps.len() * quotients / 50;
            let operations = exact.steps.len() + degrees + 500 * exact.outputs.len();
            self.work.spend(operations, IDENTITY)?;
            check(statement, &mut state.points).map_err(refused)
        };
        entry.0.get_or_insert_with(identity).clone()?;
        let has_load = head.arguments.iter().any(|argument| argument.name == LOAD);
        let results = match self.tolerated(claimed).map_err(refused)? {
            None => Vec::new(),
            Some((claim, tolerance)) => {
                let subject = tolerance::VariantSubject {
                    setting: self.setting,
                    function: &function,
                    exact,
                    emitted: &emitted,
                    read: &read,
                    load: self.load()?.filter(|_| has_load),
                    is_single: head.is_single,
                    claim,
                    tolerance,
                    work: &self.work,
                };
                subject.bounded()?
            }
        };
        let mut pairs = results.iter().zip(1..);
        if let Some((result, place)) = pairs.find(|(result, _)| !result.is_shown()) {
            let (relative_bound, most) = (result.relative(), result.tolerated / result.unit());
            let of = ["rounding", "approximation"]
                [usize::from(relative_bound.real > relative_bound.rounding)];
            let bound = relative_bound.total();
            let why = format!("result {place} has a bound of {bound:.1e} T, over {most:.1e}: {of}");
            return Err(refused(why));
        }
        let subject = cost::Subject {
            setting: self.setting,
            function: &function,
            program: &emitted,
            load: self.load()?.filter(|_| has_load),
            read: &read,
            head: &head,
            ranges: &self.ranges,
            bodies: &self.bodies,
            texts: &[self.seed.as_str(), head.name],
            worst: self.worst,
            work: &self.work,
        };
        // Under a tolerance, rounding is bounded together with the rest.
        let costs = match results.is_empty() {
            true => subject.costs(&mut state.points)?,
            false => Vec::new(),
        };
        let held = state.known.held.entry(item.module).or_default();
        held.polynomials.extend(cost::polynomials(&read));
        if !results.is_empty() {
            (0..3).for_each(|place| held.bounded[place] |= function.arguments.contains(&place));
        }
        if let Some(name) = function.parameters().filter(|_| !base.values.is_empty()) {
            let mut others = state.known.values.iter();
            if others.any(|(constant, values)| *constant == name && *values != base.values) {
                return Err(refused(format!("its {name} are not another function's")));
            }
            state.known.values.push((name, base.values));
        }
        Ok(Findings {
            costs,
            has_polynomials: cost::polynomials(&read).next().is_some(),
            results,
        })
    }

    fn tolerated(
        &self,
        function: &'w FunctionClaim,
    ) -> Result<Option<(&'w ToleranceClaim, &[f64])>, String> {
        let why = match (&self.tolerance, &function.tolerated) {
            (None, None) => return Ok(None),
            (Some(_), None) if function.function == LOAD => return Ok(None),
            (Some(_), None) => "its claim has no exact program, and a tolerance is asked for",
            (None, Some(_)) => {
                "it was generated under a tolerance, and none is asked for: name its scene, or \
                 give one"
            }
            (Some((_, Some(to))), Some(claim)) if *to != claim.relative_to => {
                "its T is not the one that the scene's errors are relative to"
            }
            (Some((tolerances, _)), Some(claim)) => {
                return Ok(Some((claim, tolerances.as_slice())));
            }
        };
        Err(why.into())
    }

    fn head<'h>(
        &self,
        claimed: &'h FunctionClaim,
        function: &'h Function,
        base: &Base,
        is_single: bool,
    ) -> Result<Head<'h>, Fault> {
        let sizes = self.setting.sizes();
        let load = self.load_length()?;
        let arguments = function.arguments.iter().map(|&place| {
            let (name, axis) = ARGUMENTS[place];
            Argument {
                place,
                name,
                length: match name {
                    LOAD => load,
                    _ => length(axis, sizes),
                },
            }
        });
        let columns = base.combinations.len();
        let shape = |field: &'h Field| (field.name.as_str(), field.lengths(self.setting, columns));
        let mut fields: Vec<_> = function.fields.iter().map(shape).collect();
        if fields.is_empty() {
            fields.push((LOAD, vec![load]));
        }
        Ok(Head {
            name: &claimed.function,
            is_single,
            arguments: arguments.collect(),
            fields,
            joints: sizes.joints,
        })
    }

    fn read(&self, head: &Head, item: &Item) -> Result<read::ReadFunction, Fault> {
        let text = &item.text;
        let read = match self.is_c {
            true => Text::c(text).and_then(|words| {
                let symbols = &item.symbols;
                words.function(head, Some(symbols), !symbols.batch.is_empty())
            }),
            false => Text::rust(text).and_then(|words| words.function(head, None, false)),
        };
        let (line, why) = match read {
            Ok((read, true)) => return Ok(read),
            Ok(_) => (1, "text after the end of the function".into()),
            Err(Fault::Text(line, reason)) => (line, format!("not of the grammar: {reason}")),
            Err(fault) => return Err(fault),
        };
        Err(Fault::Text(item.line + line - 1, why))
    }

    /// Checks that sines are of joints that turn, and roots of the widths of friction.
    fn sines(&self, read: &read::ReadFunction, is_single: bool) -> Result<(), String> {
        let mut joints = read.sines.iter().map(|sine| sine.joint);
        if let Some(joint) = joints.find(|joint| !self.setting.turns_by(*joint)) {
            return Err(format!("the sine of joint {}, which slides", joint + 1));
        }
        for &(coordinate, literal) in &read.speeds {
            let square = self.setting.square_of_width(coordinate);
            if !square.is_some_and(|exact| exact.is_nearest(literal, is_single)) {
                let joint = (coordinate + 1).saturating_sub(self.setting.base());
                return Err(format!("wrong friction width of joint {joint}"));
            }
        }
        Ok(())
    }

    fn load(&self) -> Result<Option<&Program<Exact>>, Fault> {
        self.load.as_ref().map(Option::as_ref).map_err(Fault::clone)
    }

    fn load_length(&self) -> Result<usize, Fault> {
        Ok(self.load()?.map_or(0, |program| program.outputs.len()))
    }

    fn follows(&self, item: &Item, known: &FileFacts) -> Result<(), Fault> {
        let is_single = self.singles.contains(item.module);
        if is_default(item, self.is_c, is_single, &self.defaults) {
            return Ok(());
        }
        if !self.is_c {
            return known.follows(item);
        }
        let mut values = known.values.iter();
        let are = values
            .any(|(name, constants)| c99::are_values(item, &name.to_ascii_lowercase(), constants));
        let why = match item.text.contains(" pi[") {
            true => "its numbers are not the base parameters that are claimed",
            false if item.text.contains(" numbers[") => "it does not make a body",
            false if item.text.contains(" into[") => "its numbers are not those of the robot file",
            false => "it does not say where the functions hold",
        };
        let is_known = are || known.is_box(item) || is_body(item, self.setting);
        let fault = || Fault::Text(item.line, why.into());
        is_known.then_some(()).ok_or_else(fault)
    }
}

/// A load has no results of its own: the functions that take it give it its meaning.
fn function(claimed: &FunctionClaim) -> Result<Function, String> {
    let is_load = claimed.function == LOAD;
    let results: &[String] = match claimed.results.as_slice() {
        [] => return Err("it has no results".into()),
        [one] if is_load && one == LOAD => &[],
        _ if is_load => return Err("it has other results".into()),
        results => results,
    };
    let function = Function::named(&claimed.function, &claimed.arguments, results)?;
    match is_load && function.arguments.is_empty() {
        true => Err("a load is of bodies or drives".into()),
        false => Ok(function),
    }
}

fn structure(head: &Head) -> Option<String> {
    let mut text = format!("pub struct {} {{\n", head.structure()?);
    for (name, shape) in &head.fields {
        text += &format!("pub {name}: {},\n", head.kind(shape));
    }
    Some(text + "}")
}
