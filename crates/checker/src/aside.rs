//! Items beside the functions of a file. Each is compared with the one that follows from the
//! functions and from the robot, so that the number of joints, and the test whether a state is
//! inside the box, are what was checked, and nothing hides.

use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

use crate::compare::is_literal;
use crate::fault::Fault;
use crate::file::{Item, between};
use crate::identity::exact::Exact;
use crate::identity::setting::Setting;
use crate::payload;
use crate::program::ARGUMENTS;
use crate::read::{number, whole};
use crate::rounding::Ranges;
use crate::sines::Scalar;
use crate::tolerance::BOX_SLACK;

const SCALARS: [&str; 2] = ["f64", "f32"];
const STATE: [&str; 3] = [ARGUMENTS[0].0, ARGUMENTS[1].0, ARGUMENTS[2].0];
const BOX: &str = "pub const BOX: StateBox = StateBox {";

/// The ranges of q, q̇ and q̈ joint by joint; `None` where one is open or not bounded.
type Ends = [Option<Vec<Option<[f64; 2]>>>; 3];

#[derive(Clone, Debug, Default)]
pub(crate) struct BoxFacts {
    pub polynomials: HashSet<usize>,
    /// For q, q̇ and q̈: true if functions under a tolerance bound it.
    pub bounded: [bool; 3],
}

pub(crate) struct FileFacts<'k> {
    setting: &'k Setting<'k>,
    ranges: &'k Ranges,
    /// The values of base parameters of functions that are shown, each with the name of its constant.
    pub values: Vec<(&'static str, Vec<Exact>)>,
    /// The items whose text is known, those of one module behind its name.
    pub items: HashSet<String>,
    pub held: HashMap<&'k str, BoxFacts>,
}

impl<'k> FileFacts<'k> {
    pub(crate) fn new(setting: &'k Setting<'k>, ranges: &'k Ranges, load: usize) -> FileFacts<'k> {
        let (joints, rows) = (setting.joints(), &setting.rows);
        let count = rows.len();
        let over = match setting.base() {
            0 => "JOINTS",
            _ => "COORDINATES",
        };
        let mut items = HashSet::from([
            format!("pub const N: usize = {joints};"),
            format!("pub const {over}: [usize; {count}] = {rows:?};"),
        ]);
        if let Some(places) = setting.places() {
            let [_, coordinates] = places.counts;
            let constants = places.velocities.iter().chain(&places.positions);
            let line = |name: &str, place: usize| format!("pub const {name}: usize = {place};");
            items.extend(constants.map(|(name, place)| line(name, *place)));
            items.extend([line("NV", coordinates), untabbed(&places.array())]);
            items.extend(places.limbs());
        }
        for (name, public, count) in [
            ("Gravity", "pub ", 3),
            ("Payload", "", 10),
            ("Body", "", 10),
            ("Bodies", "", 10 * setting.bodies.len()),
            ("Load", "", load),
        ] {
            for scalar in SCALARS {
                let array = format!("[{scalar}; {count}]");
                items.insert(format!("pub struct {name}({public}{array});"));
                items.insert(format!(
                    "impl ::core::ops::Deref for {name} {{\ntype Target = {array};\n\
                     fn deref(&self) -> &{array} {{\n&self.0\n}}\n}}"
                ));
            }
        }
        for kind in ["Payload", "Body"] {
            items.extend([false, true].map(|is_single| payload::rust(is_single, kind)));
        }
        items.insert(payload::rust_bodies(setting.bodies.len(), &setting.zeros));
        FileFacts {
            setting,
            ranges,
            values: Vec::new(),
            items,
            held: HashMap::new(),
        }
    }

    pub(crate) fn add_box(&mut self, item: &'k Item, is_single: bool) {
        let lines = trimmed(item);
        let Some((&BOX, behind)) = lines.split_first() else {
            return;
        };
        let ends = ends(behind, is_single);
        let Some(ends) = ends.filter(|ends| self.has(item.module, ends, is_single)) else {
            return;
        };
        self.add(item.module, lines.join("\n"));
        for scalar in SCALARS {
            let (mut structure, mut checks) = ("pub struct StateBox {".to_owned(), String::new());
            let mut arguments = Vec::new();
            for (name, ends) in STATE.iter().zip(&ends) {
                let Some(ends) = ends else { continue };
                let count = ends.len();
                structure += &format!("\npub {name}: [[{scalar}; 2]; {count}],");
                arguments.push(format!("{name}: &[{scalar}; {count}]"));
                for joint in (0..count).filter(|joint| ends[*joint].is_some()) {
                    let entry = format!("{name}[{joint}]");
                    checks += &format!("\nlet inside = inside & (BOX.{entry}[0] <= {entry})");
                    checks += &format!(" & ({entry} <= BOX.{entry}[1]);");
                }
            }
            let arguments = arguments.join(", ");
            self.add(item.module, structure + "\n}");
            let head = format!("pub fn in_box({arguments}) -> bool {{");
            let test = format!("{head}\nlet inside = true;{checks}\ninside\n}}");
            self.add(item.module, test);
        }
    }

    fn add(&mut self, module: &str, item: String) {
        self.items.insert(format!("mod {module}\n{item}"));
    }

    pub(crate) fn follows(&self, item: &Item) -> Result<(), Fault> {
        let lines = trimmed(item);
        let mut values = self.values.iter();
        let text = lines.join("\n");
        let is_known = self.items.contains(&text)
            || self.items.contains(&format!("mod {}\n{text}", item.module))
            || values.any(|(name, constants)| is_array(&lines, name, constants));
        let head = lines.first().unwrap_or(&"");
        let why = || format!("it does not follow from the functions and the robot: `{head}`");
        let fault = || Fault::Text(item.line, why());
        is_known.then_some(()).ok_or_else(fault)
    }

    pub(crate) fn is_box(&self, item: &Item) -> bool {
        let (lines, macros) = (trimmed(item), &item.symbols.macros);
        let head = lines.first().unwrap_or(&"");
        let is_single = head.contains("const float ");
        let float = if is_single { "float" } else { "double" };
        let suffix = if is_single { "F" } else { "" };
        let (mut ends, mut arguments) = (Ends::default(), Vec::new());
        for (place, (name, ends)) in STATE.iter().zip(&mut ends).enumerate() {
            let count = self.setting.entries(place);
            let parameter = format!("const {float} {name}[{macros}_RESTRICT {count}]");
            if head.contains(&parameter) {
                *ends = Some(vec![None; count]);
                arguments.push(parameter);
            }
        }
        let (module, arguments) = (item.module, arguments.join(", "));
        let mut text =
            format!("static inline int {module}_in_box({arguments})\n{{\nint inside = 1;");
        for line in &lines {
            let Some(range) = between(line, "if (!((", "))) {") else {
                continue;
            };
            let mut read = || {
                let (low, rest) = range.split_once(" <= ")?;
                let (entry, high) = rest.split_once(") && (")?;
                let high = high.strip_prefix(entry)?.strip_prefix(" <= ")?;
                let (name, joint) = entry.strip_suffix(']')?.split_once('[')?;
                let place = STATE.iter().position(|argument| *argument == name)?;
                let end = |text: &str| number(text.strip_suffix(suffix)?, is_single);
                let ends = ends[place].as_mut()?.get_mut(whole(joint)?)?;
                *ends = Some([end(low)?, end(high)?]);
                Some(())
            };
            if read().is_none() {
                return false;
            }
            text += &format!("\n{line}\ninside = 0;\n}}");
        }
        text += "\nreturn inside;\n}";
        text == lines.join("\n") && self.has(module, &ends, is_single)
    }

    /// Returns true if a box is the robot file's, and open only where the functions of its module
    /// hold everywhere.
    fn has(&self, module: &str, ends: &Ends, is_single: bool) -> bool {
        // A box of no functions is another module's.
        let Some(held) = self.held.get(module) else {
            return false;
        };
        let setting = self.setting;
        (0..3).all(|place| {
            let joint_ends = ends[place].as_deref();
            let is_locked = |index: usize| match place {
                0 => setting.is_locked(index),
                _ => setting.is_held(index),
            };
            let is_free =
                |joint| place == 0 && setting.turns_by(joint) && !setting.is_limited(joint);
            let count = setting.entries(place);
            let is_known = |joint: usize| match joint_ends.and_then(|pairs| pairs[joint]) {
                None if is_locked(joint) => true,
                None if place == 0 => {
                    let is_bounded = held.bounded[0] && setting.is_limited(joint);
                    !is_bounded && !held.polynomials.contains(&joint)
                }
                None => !held.bounded[place],
                // Polynomials that take off whole turns are good far beyond one.
                Some([low, high]) if is_free(joint) => {
                    let far = Scalar::new(is_single).far;
                    let is_far = high <= far * (1.0 + BOX_SLACK) && low >= -far * (1.0 + BOX_SLACK);
                    is_far && low <= -PI && PI <= high
                }
                Some([low, high]) => {
                    let [own_low, own_high] = self.ranges[place][joint];
                    // Ends are floats inside the range.
                    let ulp = f64::from(f32::EPSILON);
                    let digits = if is_single { ulp } else { BOX_SLACK };
                    let near = |end: f64, other: f64, size: f64| (end - other).abs() <= size;
                    let slack = (digits + BOX_SLACK) * (own_low.abs() + own_high.abs());
                    low <= high && near(low, own_low, slack) && near(high, own_high, slack)
                }
            };
            joint_ends.is_none_or(|pairs| pairs.len() == count) && (0..count).all(is_known)
        })
    }
}

pub(crate) fn is_body(item: &Item, setting: &Setting) -> bool {
    let (prefix, macros) = (&item.symbols.prefix, &item.symbols.macros);
    let is_single = item.text.contains("float ");
    let text = |kind| payload::c(is_single, "static inline", [prefix, macros], kind);
    let item = trimmed(item).join("\n");
    let bodies = (setting.bodies.len(), setting.zeros.as_slice());
    let of_all = || payload::c_bodies(is_single, "static inline", [prefix, macros], bodies);
    let mut kinds = ["payload", "body"].into_iter();
    kinds.any(|kind| text(kind) == item) || bodies.0 > 0 && of_all() == item
}

fn trimmed<'t>(item: &'t Item) -> Vec<&'t str> {
    let lines = item.text.lines().map(str::trim);
    lines.filter(|line| !line.is_empty()).collect()
}

pub(crate) fn untabbed(text: &str) -> String {
    text.lines().map(str::trim).collect::<Vec<_>>().join("\n")
}

fn ends(lines: &[&str], is_single: bool) -> Option<Ends> {
    let (mut ends, mut place) = (Ends::default(), None);
    for line in lines {
        if let Some(name) = line.strip_suffix(": [") {
            place = STATE.iter().position(|argument| *argument == name);
            ends[place?] = Some(Vec::new());
        } else if let Some(pair) = between(line, "[", "],") {
            let (low, high) = pair.split_once(", ")?;
            let open = |scalar: &str| format!("{scalar}::NEG_INFINITY, {scalar}::INFINITY");
            let range = match SCALARS.iter().any(|scalar| pair == open(scalar)) {
                true => None,
                false => Some([number(low, is_single)?, number(high, is_single)?]),
            };
            ends[place?].as_mut()?.push(range);
        } else {
            ["],", "};"].contains(line).then_some(())?;
        }
    }
    Some(ends)
}

fn is_array(lines: &[&str], name: &str, values: &[Exact]) -> bool {
    let [head, lines @ .., "];"] = lines else {
        return false;
    };
    let is_single = head.contains(": [f32; ");
    let scalar = if is_single { "f32" } else { "f64" };
    let expected = format!("pub const {name}: [{scalar}; {}] = [", values.len());
    let mut pairs = lines.iter().zip(values);
    *head == expected
        && lines.len() == values.len()
        && pairs.all(|(line, value)| {
            let literal = line.strip_suffix(',');
            literal.is_some_and(|word| is_literal(word, value, is_single))
        })
}
