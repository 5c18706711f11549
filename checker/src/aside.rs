//! Constants beside the functions of a file in Rust. Each line is compared with the one that
//! follows from the functions and from the robot, so that whoever asks for the number of joints gets
//! what was checked.

use crate::fault::Fault;
use crate::file::{Found, between};
use crate::scene::Setting;
use crate::verdict::BOX_SLACK;

/// Checks an item of a module that has these functions.
///
/// # Errors
/// Its first line that does not follow.
pub(crate) fn follows(item: &Found, functions: &[&Found], setting: &Setting) -> Result<(), Fault> {
    let lines = item.text.lines().map(str::trim);
    let lines: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
    let expected = expected(&lines, functions, setting);
    let mut pairs = lines.iter().enumerate();
    let other = pairs.find(|(index, own)| expected.get(*index).map(String::as_str) != Some(**own));
    if other.is_none() && lines.len() == expected.len() {
        return Ok(());
    }
    let own = other.map_or("", |(_, own)| own);
    let why = format!("it does not follow from the functions and the robot: `{own}`");
    Err(Fault::Text(item.line, why))
}

/// Returns the lines that an item must have that begins with the first of these; none if nothing is
/// known of it.
fn expected(lines: &[&str], functions: &[&Found], setting: &Setting) -> Vec<String> {
    let head = lines.first().copied().unwrap_or("");
    let joints = setting.joints.len();
    let known = if head.starts_with("pub const N:") {
        Some(vec![format!("pub const N: usize = {joints};")])
    } else if head.starts_with("pub const JOINTS:") {
        let rows = &setting.rows;
        Some(vec![format!(
            "pub const JOINTS: [usize; {}] = {rows:?};",
            rows.len()
        )])
    } else if head.starts_with("pub const BOX:") {
        within(lines, functions, setting)
    } else if between(head, "pub struct ", " {").is_some() {
        // A compiler compares its fields with those that functions return.
        Some(lines.iter().map(|line| line.to_string()).collect())
    } else {
        None
    };
    known.unwrap_or_default()
}

/// Returns the lines of the box of states if it is within the robot file's, and open only
/// where sines are no polynomials.
fn within(lines: &[&str], functions: &[&Found], setting: &Setting) -> Option<Vec<String>> {
    let is_open = !functions.iter().any(|own| own.text.contains("let x1 = "));
    let (mut ranges, mut is_position) = (None, false);
    for line in lines.get(1..)? {
        if let Some(name) = line.strip_suffix(": [") {
            let place = ["q", "qd", "qdd"].iter().position(|own| *own == name)?;
            (ranges, is_position) = (Some(setting.ranges[place].iter()), place == 0);
        } else if let Some(pair) = between(line, "[", "],") {
            let [own_low, own_high] = *ranges.as_mut()?.next()?;
            let (low, high) = pair.split_once(", ")?;
            if low.ends_with("::NEG_INFINITY") && high.ends_with("::INFINITY") {
                (is_open || !is_position).then_some(())?;
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
