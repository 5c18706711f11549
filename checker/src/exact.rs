//! A generated file without a certificate: how far each of its functions can be from the
//! dynamics of the robot.

use crate::c99;
use crate::certificate::Claim;
use crate::fault::Fault;
use crate::file::{self, Found};
use crate::scene::{self, Setting};
use crate::sines::Scalar;
use crate::tried;
use crate::verdict::measure;

/// The largest rates where the robot file has no limit, per second and per second
/// squared.
pub const RATE: f64 = 10.0;
/// What an exact program may be off, in units of half an ulp of the largest output: above
/// this something was left out, or rounding can cost that much.
const MOST_UNITS: f64 = 65_536.0;
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

/// How far a function can be from the dynamics, each number relative to the largest
/// entry, of all that are seen, of what it is an entry of.
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
        self.units()
            <= if self.tried > 0 {
                MOST_LEFT
            } else {
                MOST_UNITS
            }
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
        result: distance(found, &setting),
    };
    // These compute no dynamics: one says where a box is, one which angles there are.
    let is_other = |found: &&Found| !["in_box", "angles"].contains(&found.name);
    let functions = match source.starts_with(c99::HEAD) {
        true => c99::functions(source)?,
        false => file::functions(source)?,
    };
    Ok(Report {
        lines: functions.iter().filter(is_other).map(line).collect(),
        is_unlimited,
    })
}

fn distance(found: &Found, setting: &Setting) -> Result<Distance, Fault> {
    let of_singles = ["[f32; ", "const float "];
    let is_single = of_singles.iter().any(|word| found.text.contains(word));
    let claim = Claim::exact(found, is_single, setting);
    let why = |fault: Fault| fault.to_string().replace("certificate: ", "");
    let unknown = |fault| Fault::Text(found.line, why(fault));
    let places = claim.function().map_err(unknown)?.places(claim.rows.len());
    let in_file = |fault| match fault {
        Fault::Text(line, why) => Fault::Text(found.line + line - 1, why),
        other => other,
    };
    let mut distance = Distance {
        unit: Scalar::of(&claim.scalar).unit,
        ..Distance::default()
    };
    if claim.function()?.is_tried() {
        distance.tried = tried::STATES;
        for own in tried::worst(&claim, setting).map_err(in_file)? {
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
    let all = measure(&claim, setting, |_| f64::INFINITY).map_err(in_file)?;
    let pairs = || places.iter().map(|(quantity, _)| quantity).zip(&all);
    for (own, found) in pairs() {
        let same = pairs().filter(|(other, _)| *other == own);
        let size = same.map(|(_, found)| found.seen.size).fold(0.0, f64::max);
        let of = |x: f64| if x == 0.0 { 0.0 } else { x / size };
        let worse = |before: f64, x: f64| if x > before || x.is_nan() { x } else { before };
        distance.edits = worse(distance.edits, of(found.edits));
        distance.rounding = worse(distance.rounding, of(found.rounding));
        distance.seen = worse(distance.seen, of(found.seen.off));
    }
    Ok(distance)
}
