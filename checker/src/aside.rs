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
    pub values: Vec<(&'static str, Vec<Exact>)>,
    /// The lines of the struct of each function's results.
    pub structs: Vec<Vec<String>>,
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
        let is_known = structs.any(|own| *own == lines);
        if is_known || self.values.iter().any(|(name, own)| are(&lines, name, own)) {
            return Ok(());
        }
        let (joints, rows) = (self.setting.joints(), &self.setting.rows);
        let (head, behind) = lines.split_first().unwrap_or((&"", &[]));
        let other = match *head {
            "pub struct StateBox {" => {
                let scalars = ["f64", "f32"].into_iter();
                let fields = scalars.flat_map(|own| {
                    ["q", "qd", "qdd"].map(|name| format!("pub {name}: [[{own}; 2]; {joints}],"))
                });
                let fields: Vec<String> = fields.collect();
                // A compiler compares these with the box.
                let is_own = |line: &str| line == "}" || fields.iter().any(|own| own == line);
                behind.iter().find(|line| !is_own(line))
            }
            "pub const BOX: StateBox = StateBox {" => {
                let is_box = self.within(behind, functions).is_some();
                (!is_box).then_some(head)
            }
            _ => {
                let count = rows.len();
                let known = [
                    format!("pub const N: usize = {joints};"),
                    format!("pub const JOINTS: [usize; {count}] = {rows:?};"),
                ];
                let is_known = behind.is_empty() && known.iter().any(|own| own == head);
                (!is_known).then_some(head)
            }
        };
        let Some(other) = other else {
            return Ok(());
        };
        let why = format!("it does not follow from the functions and the robot: `{other}`");
        Err(Fault::Text(item.line, why))
    }

    /// Compares the box of states that these lines are behind their head: none unless it is within
    /// the robot file's, and open only where sines are no polynomials, or none of the joint's is
    /// read.
    fn within(&self, lines: &[&str], functions: &[&Found]) -> Option<()> {
        let is_open = !functions.iter().any(|own| own.text.contains("let x1 = "));
        let (mut ranges, mut is_position) = (None, false);
        for line in lines {
            if let Some(name) = line.strip_suffix(": [") {
                let place = ["q", "qd", "qdd"].iter().position(|own| *own == name)?;
                (ranges, is_position) = (Some(self.ranges[place].iter().enumerate()), place == 0);
            } else if let Some(pair) = between(line, "[", "],") {
                let (joint, [own_low, own_high]) = ranges.as_mut()?.next()?;
                let (low, high) = pair.split_once(", ")?;
                let is_good = if low.ends_with("::NEG_INFINITY") && high.ends_with("::INFINITY") {
                    is_open || !is_position || self.setting.is_locked(joint)
                } else {
                    let (low, high): (f64, f64) = (low.parse().ok()?, high.parse().ok()?);
                    let slack = BOX_SLACK * (own_low.abs() + own_high.abs());
                    own_low - slack <= low && high <= own_high + slack
                };
                is_good.then_some(())?;
            } else {
                ["],", "};"].contains(line).then_some(())?;
            }
        }
        Some(())
    }
}

/// Returns whether lines are a constant of a name with these values, each the nearest float.
fn are(lines: &[&str], name: &str, values: &[Exact]) -> bool {
    let [head, lines @ .., "];"] = lines else {
        return false;
    };
    let is_single = head.contains(": [f32; ");
    let scalar = if is_single { "f32" } else { "f64" };
    let expected = format!("pub const {name}: [{scalar}; {}] = [", values.len());
    let mut all = lines.iter().zip(values);
    *head == expected
        && lines.len() == values.len()
        && all.all(|(line, value)| {
            let literal = line.strip_suffix(',');
            literal.is_some_and(|own| is_literal(own, value, is_single))
        })
}
