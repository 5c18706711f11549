//! Items beside the functions of a file in Rust. Each is compared with the one that follows from
//! the functions and from the robot, so that whoever asks for the number of joints gets what was
//! checked, and that nothing hides.

use crate::compare::is_literal;
use crate::fault::Fault;
use crate::file::{Found, between};
use crate::identity::exact::Exact;
use crate::identity::setting::Setting;
use crate::rounding::Ranges;
use crate::tolerance::BOX_SLACK;

/// The type of an argument that is no list of joints, and what a payload has besides.
const TYPES: [&str; 3] = [
    "pub struct NAME(pub [REAL; COUNT]);",
    "impl ::core::ops::Deref for NAME {
type Target = [REAL; COUNT];
fn deref(&self) -> &[REAL; COUNT] {
&self.0
}
}",
    "impl Payload {
pub const NONE: Payload = Payload([0.0; 10]);
pub const fn new(mass: REAL, com: [REAL; 3], inertia: [REAL; 6]) -> Payload {
let ([x, y, z], [xx, yy, zz, xy, yz, xz]) = (com, inertia);
Payload([mass, x, y, z, xx, yy, zz, xy, yz, xz])
}
}",
];
const SCALARS: [&str; 2] = ["f64", "f32"];
/// The arguments that a box is of.
const STATE: [&str; 3] = ["q", "qd", "qdd"];

/// The facts that items beside functions follow from.
pub(crate) struct Known<'k> {
    /// The robot in its scene.
    setting: &'k Setting<'k>,
    /// The box of states.
    ranges: &'k Ranges,
    /// The values of base parameters, each with the name of its constant.
    pub values: Vec<(&'static str, Vec<Exact>)>,
    /// The items whose text is known.
    pub items: Vec<String>,
}

impl<'k> Known<'k> {
    /// Returns what follows from a robot, a load being so many numbers.
    pub(crate) fn new(setting: &'k Setting<'k>, ranges: &'k Ranges, load: usize) -> Known<'k> {
        let (joints, rows) = (setting.joints(), &setting.rows);
        let count = rows.len();
        let mut items = vec![
            format!("pub const N: usize = {joints};"),
            format!("pub const JOINTS: [usize; {count}] = {rows:?};"),
        ];
        for (name, count) in [("Gravity", 3), ("Payload", 10), ("Load", load)] {
            for own in SCALARS {
                items.extend(TYPES.map(|text| {
                    let text = text.replace("NAME", name).replace("REAL", own);
                    text.replace("COUNT", &count.to_string())
                }));
            }
        }
        Known {
            setting,
            ranges,
            values: Vec::new(),
            items,
        }
    }

    /// Checks an item of a module that has these functions.
    ///
    /// # Errors
    /// It does not follow.
    pub(crate) fn follows(&self, item: &Found, functions: &[&Found]) -> Result<(), Fault> {
        let lines = item.text.lines().map(str::trim);
        let lines: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
        let (head, behind) = lines.split_first().unwrap_or((&"", &[]));
        let mut values = self.values.iter();
        let is_known = self.items.contains(&lines.join("\n"))
            || values.any(|(name, own)| are(&lines, name, own))
            || match *head {
                "pub const BOX: StateBox = StateBox {" => self.within(behind, functions).is_some(),
                _ => self.is_of_box(head, behind),
            };
        let why = || format!("it does not follow from the functions and the robot: `{head}`");
        is_known
            .then_some(())
            .ok_or_else(|| Fault::Text(item.line, why()))
    }

    /// Returns true for the type of a box of states, and for the function that asks whether one is
    /// inside. A compiler compares their lines with the box, and sees where they are mixed up.
    fn is_of_box(&self, head: &str, lines: &[&str]) -> bool {
        let joints = self.setting.joints();
        let mut known = Vec::from(["let inside = true;", "inside", "}"].map(str::to_owned));
        for name in STATE {
            for own in SCALARS {
                known.push(format!("{name}: &[{own}; {joints}]"));
                known.push(format!("pub {name}: [[{own}; 2]; {joints}],"));
            }
            known.extend((0..joints).map(|joint| {
                let (own, ends) = (format!("{name}[{joint}]"), format!("BOX.{name}[{joint}]"));
                format!("let inside = inside & ({ends}[0] <= {own}) & ({own} <= {ends}[1]);")
            }));
        }
        let is_known = |line: &str| known.iter().any(|own| own == line);
        let list = between(head, "pub fn in_box(", ") -> bool {");
        let is_head = match list {
            Some(list) => list.split(", ").all(is_known),
            None => head == "pub struct StateBox {",
        };
        is_head && lines.iter().all(|line| is_known(line))
    }

    /// Compares the box of states that these lines are behind their head: none unless it is within
    /// the robot file's, and open only where sines are no polynomials, or none of the joint's is
    /// read.
    fn within(&self, lines: &[&str], functions: &[&Found]) -> Option<()> {
        let is_open = !functions.iter().any(|own| own.text.contains("let x1 = "));
        let (mut ranges, mut is_position) = (None, false);
        for line in lines {
            if let Some(name) = line.strip_suffix(": [") {
                let place = STATE.iter().position(|own| *own == name)?;
                (ranges, is_position) = (Some(self.ranges[place].iter().enumerate()), place == 0);
            } else if let Some(pair) = between(line, "[", "],") {
                let (joint, [own_low, own_high]) = ranges.as_mut()?.next()?;
                let (low, high) = pair.split_once(", ")?;
                let ends = |own: &&str| {
                    [low, high] == [format!("{own}::NEG_INFINITY"), format!("{own}::INFINITY")]
                };
                let is_good = if SCALARS.iter().any(ends) {
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
