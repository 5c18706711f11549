//! A generated file without a certificate: how far each of its functions can be from the
//! dynamics of the robot.

use crate::aside;
use crate::c99;
use crate::certificate::Claim;
use crate::fault::Fault;
use crate::file::{self, Found};
use crate::identity::number::first_bits;
use crate::interval::UNIT;
use crate::number::Work;
use crate::quantity::Function;
use crate::scene::{self, Setting};
use crate::sines::Scalar;
use crate::tried;
use crate::verdict::{self, measure};

/// The largest rates where the robot file has no limit, per second and per second
/// squared.
pub const RATE: f64 = 10.0;
/// The most that rounding may cost an exact program, in half ulps of the largest entry; and in half
/// ulps of a double, what the checker's own numbers, which are doubles, leave open.
const MOST_UNITS: f64 = 65_536.0;
/// The most that text and equations may differ by in real numbers, in half ulps of the entry itself:
/// rounding of constants explains so much. (Tens in most functions; 146 in the Panda's smallest h_ikm,
/// 141 with sines by polynomials.)
const MOST_EDITS: f64 = 256.0;
/// An entry below this share of its result's largest counts as zero.
const ZERO: f64 = 1e-12;
/// The most that may be left over in an equation that is tried, in the same units of its terms.
const MOST_LEFT: f64 = 4096.0;

/// The findings about one function.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its module.
    pub module: String,
    /// Its name.
    pub name: String,
    /// Its text, and the line of the file where that begins, from one.
    pub text: (String, usize),
    /// The bounds that were shown, or the reason why none was.
    pub result: Result<Distance, Fault>,
}

/// How far a function can be from the dynamics, each number relative to the largest value seen of
/// the entry, of a matrix of its row or its column.
#[derive(Clone, Copy, Debug, Default)]
pub struct Distance {
    /// In real numbers, with constants as they are printed.
    pub edits: f64,
    /// By rounding and library sines.
    pub rounding: f64,
    /// The largest error seen at states.
    pub seen: f64,
    /// Half an ulp, relative.
    pub unit: f64,
    /// The number of states at which the equation that it solves was tried, where nothing is
    /// bounded; else zero.
    pub tried: usize,
    /// `true` if every entry is bounded as an exact program's is.
    pub is_within: bool,
    /// `true` if sines are polynomials, which err more than rounding.
    pub has_polynomials: bool,
}

impl Distance {
    /// Returns the bound of both, in units of half an ulp; of what was only tried, what was seen.
    pub fn units(&self) -> f64 {
        match self.tried {
            0 => (self.edits + self.rounding) / self.unit,
            _ => self.seen / self.unit,
        }
    }

    /// Returns whether that is no more than an exact program's rounding.
    pub fn is_shown(&self) -> bool {
        self.is_within || self.tried > 0 && self.units() <= MOST_LEFT
    }
}

/// The findings about a file.
#[derive(Clone, Debug)]
pub struct Report {
    /// One a function, in the file's order.
    pub lines: Vec<Line>,
    /// `true` if the robot file gives rates no limit.
    pub is_unlimited: bool,
}

impl Report {
    /// Returns whether every function is shown.
    pub fn is_shown(&self) -> bool {
        let shown = |line: &Line| line.result.as_ref().is_ok_and(Distance::is_shown);
        !self.lines.is_empty() && self.lines.iter().all(shown)
    }
}

/// Checks every function of a file against a robot, or one of its scenes.
///
/// # Errors
/// A robot file or a file that this checker does not know; what is wrong with a function
/// is in its line.
pub fn check(source: &str, robot: &str, scene: Option<&str>) -> Result<Report, Fault> {
    let mut setting = scene::read(robot, scene)?;
    let mut is_unlimited = false;
    for range in setting.ranges.iter_mut().flatten() {
        if range.iter().any(|end| end.is_nan()) {
            (*range, is_unlimited) = ([-RATE, RATE], true);
        }
    }
    let line = |found: &Found| Line {
        module: found.module.to_owned(),
        name: found.name.to_owned(),
        text: (found.text.clone(), found.line),
        result: distance(found, &setting, robot),
    };
    let items = match source.starts_with(c99::HEAD) {
        true => c99::functions(source)?,
        false => file::functions(source)?,
    };
    // These compute no dynamics: one says where a box is, one which angles there are.
    let is_other = |found: &&Found| !["in_box", "angles", ""].contains(&found.name);
    let mut lines: Vec<Line> = items.iter().filter(is_other).map(line).collect();
    lines.extend(
        items
            .iter()
            .filter_map(|item| beside(item, &items, &setting)),
    );
    Ok(Report {
        lines,
        is_unlimited,
    })
}

/// Returns the reason why an item that is no function is not shown, if there is one.
fn beside(item: &Found, items: &[Found], setting: &Setting) -> Option<Line> {
    let own = |other: &&Found| other.module == item.module && !other.name.is_empty();
    let functions: Vec<&Found> = items.iter().filter(own).collect();
    let fault = item
        .name
        .is_empty()
        .then(|| aside::follows(item, &functions, setting));
    let head = item.text.lines().next().unwrap_or("");
    Some(Line {
        module: item.module.to_owned(),
        name: head.split([':', '{', '(']).next()?.trim().to_owned(),
        text: (item.text.clone(), item.line),
        result: Err(fault?.err()?),
    })
}

fn distance(found: &Found, setting: &Setting, robot: &str) -> Result<Distance, Fault> {
    let of_singles = ["[f32; ", "const float "];
    let is_single = of_singles.iter().any(|word| found.text.contains(word));
    let claim = Claim::exact(found, is_single, setting);
    let why = |fault: Fault| fault.to_string().replace("certificate: ", "");
    let unknown = |fault| Fault::Text(found.line, why(fault));
    claim.function().map_err(unknown)?;
    let in_file = |fault| match fault {
        Fault::Text(line, why) => Fault::Text(found.line + line - 1, why),
        other => other,
    };
    let mut distance = Distance {
        unit: Scalar::of(&claim.scalar).unit,
        has_polynomials: ["let x1 = ", " x1_1 = "]
            .iter()
            .any(|word| found.text.contains(word)),
        ..Distance::default()
    };
    if claim.function()?.is_tried() {
        distance.tried = tried::STATES;
        let hash = hmac_sha256::Hash::hash([&found.text, robot].concat().as_bytes());
        for own in tried::worst(&claim, setting, first_bits(&hash)).map_err(in_file)? {
            let off = if own.off == 0.0 {
                0.0
            } else {
                own.off / own.size
            };
            if off > distance.seen || off.is_nan() {
                distance.seen = off;
            }
        }
        return Ok(distance);
    }
    let all = measure(&claim, setting, |_| f64::INFINITY, &mut Work::default()).map_err(in_file)?;
    let (sizes, largest) = sizes(&claim.function()?, claim.rows.len(), &all);
    let worse = |before: f64, x: f64| if x > before || x.is_nan() { x } else { before };
    distance.is_within = true;
    for ((found, own), whole) in all.iter().zip(sizes).zip(largest) {
        let of = |x: f64| if x == 0.0 { 0.0 } else { x / own };
        distance.edits = worse(distance.edits, of(found.edits));
        distance.rounding = worse(distance.rounding, of(found.rounding));
        distance.seen = worse(distance.seen, of(found.seen.off));
        let explained = MOST_EDITS * distance.unit * own + MOST_UNITS * UNIT * whole;
        let is_small = found.rounding <= MOST_UNITS * distance.unit * whole;
        distance.is_within &= found.edits <= explained && is_small;
    }
    Ok(distance)
}

/// Returns of each output the size that it is measured by, and the largest of the result that it
/// is in. The first is its own largest value, of a matrix the smallest of the largest in its row and in
/// its column; where that is zero, the result's.
fn sizes(function: &Function, rows: usize, all: &[verdict::Found]) -> (Vec<f64>, Vec<f64>) {
    let (mut own, mut largest, mut left) = (Vec::new(), Vec::new(), all);
    for (_, quantity) in &function.fields {
        let shape = quantity.shape(rows);
        let (each, behind) = left.split_at(shape.iter().product());
        left = behind;
        let most = |list: &mut dyn Iterator<Item = &verdict::Found>| {
            list.map(|found| found.seen.size).fold(0.0, f64::max)
        };
        let whole = most(&mut each.iter());
        for index in 0..each.len() {
            let mut size = whole;
            let mut stride = each.len();
            for length in &shape {
                stride /= length;
                let digit = |index: usize| index / stride % length;
                let same = |(other, _): &(usize, _)| digit(*other) == digit(index);
                let mut slice = each.iter().enumerate().filter(same).map(|(_, found)| found);
                let most = most(&mut slice);
                if most > ZERO * whole {
                    size = size.min(most);
                }
            }
            own.push(size);
        }
        largest.extend(each.iter().map(|_| whole));
    }
    (own, largest)
}
