//! Constants beside the functions of a file in Rust. Each line is compared with the one that
//! follows from the functions and from the robot, so that whoever asks for the number of joints gets
//! what was checked.

use crate::compare::is_literal;
use crate::fault::Fault;
use crate::file::{Found, between};
use crate::identity::exact::Exact;
use crate::identity::setting::Setting;
use crate::rounding::Ranges;
use crate::tolerance::BOX_SLACK;

/// The facts that items beside functions follow from.
pub(crate) struct Known<'k> {
    /// The robot in its scene.
    pub setting: &'k Setting<'k>,
    /// The box of states.
    pub ranges: &'k Ranges,
    /// The values of base parameters, each with the name of its constant.
    pub values: &'k [(&'static str, Vec<Exact>)],
    /// The lines of the struct of each function's results.
    pub structs: &'k [Vec<String>],
}

impl Known<'_> {
    /// Checks an item of a module that has these functions.
    ///
    /// # Errors
    /// Its first line that does not follow.
    pub(crate) fn follows(&self, item: &Found, functions: &[&Found]) -> Result<(), Fault> {
        let lines = item.text.lines().map(str::trim);
        let lines: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
        let mut structs = self.structs.iter();
        let is_known = structs.any(|own| !own.is_empty() && *own == lines);
        if is_known || self.values.iter().any(|(name, own)| are(&lines, name, own)) {
            return Ok(());
        }
        let expected = expected(&lines, functions, self.setting, self.ranges);
        let mut pairs = lines.iter().enumerate();
        let other =
            pairs.find(|(index, own)| expected.get(*index).map(String::as_str) != Some(**own));
        if other.is_none() && lines.len() == expected.len() {
            return Ok(());
        }
        let own = other.map_or("", |(_, own)| own);
        let why = format!("it does not follow from the functions and the robot: `{own}`");
        Err(Fault::Text(item.line, why))
    }
}

/// Returns whether lines are a constant of a name with these values, each the nearest float.
fn are(lines: &[&str], name: &str, values: &[Exact]) -> bool {
    let head = lines.first().copied().unwrap_or("");
    let is_single = head.contains(": [f32; ");
    let scalar = if is_single { "f32" } else { "f64" };
    let expected = format!("pub const {name}: [{scalar}; {}] = [", values.len());
    let is_whole = lines.len() == values.len() + 2 && head == expected;
    let mut all = lines.iter().skip(1).zip(values);
    is_whole
        && lines.last() == Some(&"];")
        && all.all(|(line, value)| {
            let literal = line.strip_suffix(',');
            literal.is_some_and(|own| is_literal(own, value, is_single))
        })
}

/// Returns the lines that an item must have that begins with the first of these; none if nothing is
/// known of it.
fn expected(
    lines: &[&str],
    functions: &[&Found],
    setting: &Setting,
    ranges: &Ranges,
) -> Vec<String> {
    let head = lines.first().copied().unwrap_or("");
    let joints = setting.joints();
    let known = if head.starts_with("pub const N:") {
        Some(vec![format!("pub const N: usize = {joints};")])
    } else if head.starts_with("pub const JOINTS:") {
        let rows = &setting.rows;
        Some(vec![format!(
            "pub const JOINTS: [usize; {}] = {rows:?};",
            rows.len()
        )])
    } else if head.starts_with("pub const BOX:") {
        within(lines, functions, setting, ranges)
    } else if head == "pub struct StateBox {" {
        let field = |name: &str, scalar: &str| format!("pub {name}: [[{scalar}; 2]; {joints}],");
        let scalars = ["f64", "f32"].into_iter();
        let fields = scalars.flat_map(|own| ["q", "qd", "qdd"].map(|name| field(name, own)));
        let fields: Vec<String> = fields.collect();
        // A compiler compares these with the box.
        let is_own = |line: &&&str| **line == "}" || fields.iter().any(|own| own == **line);
        let own = lines.iter().skip(1).filter(is_own);
        let own = own.map(|line| line.to_string());
        Some([head.to_owned()].into_iter().chain(own).collect())
    } else {
        None
    };
    known.unwrap_or_default()
}

/// Returns the lines of the box of states if it is within the robot file's, and open only
/// where sines are no polynomials, or none of the joint's is read.
fn within(
    lines: &[&str],
    functions: &[&Found],
    setting: &Setting,
    ranges: &Ranges,
) -> Option<Vec<String>> {
    let is_open = !functions.iter().any(|own| own.text.contains("let x1 = "));
    let (mut own, mut is_position) = (None, false);
    for line in lines.get(1..)? {
        if let Some(name) = line.strip_suffix(": [") {
            let place = ["q", "qd", "qdd"].iter().position(|own| *own == name)?;
            (own, is_position) = (Some(ranges[place].iter().enumerate()), place == 0);
        } else if let Some(pair) = between(line, "[", "],") {
            let (joint, [own_low, own_high]) = own.as_mut()?.next()?;
            let (low, high) = pair.split_once(", ")?;
            if low.ends_with("::NEG_INFINITY") && high.ends_with("::INFINITY") {
                (is_open || !is_position || setting.is_locked(joint)).then_some(())?;
                continue;
            }
            let (low, high): (f64, f64) = (low.parse().ok()?, high.parse().ok()?);
            let slack = BOX_SLACK * (own_low.abs() + own_high.abs());
            (own_low - slack <= low && high <= own_high + slack).then_some(())?;
        } else {
            ["],", "};"].contains(line).then_some(())?;
        }
    }
    let lines = lines.iter().skip(1).map(|line| line.to_string());
    let head = "pub const BOX: StateBox = StateBox {".to_owned();
    Some([head].into_iter().chain(lines).collect())
}
