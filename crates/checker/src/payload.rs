//! The bodies that a payload may be, and the items of generated code that make bodies of numbers that a
//! body has, line by line.
//!
//! A body's ½ tr(I) 1 − I is ∫ r rᵀ dm, about the centre of mass: none of its principal minors is
//! negative. ½ is a little more here, since moments that are rounded, as those of a thin plate, are
//! a body's as well.

use std::fmt;

use crate::interval::up;

/// The points of which a body is made: fewer have no inertia about some axis.
const POINTS: usize = 5;

/// The bodies that a payload may be: all of the mass is within a radius of the origin of its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyRange {
    /// The range of the mass, kg.
    pub mass: [f64; 2],
    /// The radius, m.
    pub radius: f64,
}

impl Default for BodyRange {
    fn default() -> BodyRange {
        let (mass, radius) = ([0.0, 5.0], 0.3);
        BodyRange { mass, radius }
    }
}

impl BodyRange {
    /// Returns bodies beyond what decimals lose in doubles, and numbers in f32.
    pub(crate) fn outward(self, is_single: bool) -> BodyRange {
        let up = |x: f64| match is_single {
            true if x != 0.0 => f64::from((x as f32).next_up()),
            _ => up(x),
        };
        let [low, high] = self.mass;
        BodyRange {
            mass: [(2.0 * low - up(low)).max(0.0), up(high)],
            radius: up(self.radius),
        }
    }

    /// Returns the ranges of the ten numbers, in the order of [`BodyRange::draw`].
    pub(crate) fn ranges(self) -> Vec<[f64; 2]> {
        let BodyRange { mass, radius } = self;
        let most = up(up(mass[1] * radius) * radius);
        let symmetric = |most: f64| [-most, most];
        [
            vec![mass],
            vec![symmetric(radius); 3],
            vec![[0.0, most]; 3],
            // |∫ x y dm| ≤ ½ ∫ (x² + y²) dm
            vec![symmetric(0.5 * most); 3],
        ]
        .concat()
    }

    /// Draws one as points of mass, from numbers of zero to one: mass, centre of mass, and inertia about
    /// that as xx, yy, zz, xy, yz, xz.
    pub fn draw(self, share: &mut impl FnMut() -> f64) -> Vec<f64> {
        let BodyRange { mass, radius } = self;
        let mass = mass[0] + (mass[1] - mass[0]) * share();
        let mut points = [([0.0; 3], 0.0); POINTS];
        let mut sum = 0.0;
        for (at, weight) in &mut points {
            // In the cube inside the ball, not beyond it.
            let side = radius / 3f64.sqrt();
            *at = [(); 3].map(|()| side * (2.0 * share() - 1.0));
            *weight = share() + 1e-3;
            sum += *weight;
        }
        let mean = |f: &dyn Fn([f64; 3]) -> f64| -> f64 {
            let parts = points.iter().map(|(at, weight)| f(*at) * weight / sum);
            parts.sum()
        };
        let com = [0, 1, 2].map(|k| mean(&|at| at[k]));
        let moment = |i: usize, k: usize| mass * mean(&|at| (at[i] - com[i]) * (at[k] - com[k]));
        let about = |i: usize, k: usize| moment(i, i) + moment(k, k);
        let [x, y, z] = com;
        let inertia = [about(1, 2), about(2, 0), about(0, 1)];
        let products = [-moment(0, 1), -moment(1, 2), -moment(0, 2)];
        [vec![mass, x, y, z], inertia.to_vec(), products.to_vec()].concat()
    }
}

impl fmt::Display for BodyRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([low, high], radius) = (self.mass, self.radius);
        let place = "of the origin of its frame";
        write!(f, "{low} to {high} kg, all of it within {radius} m {place}")
    }
}

const NUMBERS: [&str; 10] = ["mass", "x", "y", "z", "xx", "yy", "zz", "xy", "yz", "xz"];

/// The test, from its lines on; no number is infinite or NaN, and nothing without mass has moments.
/// `~` stands for the suffix of literals.
const TESTED: &str = "let most = HALF~ * (xx + yy + zz);
let a = most - xx;
let b = most - yy;
let c = most - zz;
let ab = (a * b) - (xy * xy);
let bc = (b * c) - (yz * yz);
let ac = (a * c) - (xz * xz);
let abc = (a * bc) - (b * (xz * xz)) - (c * (xy * xy)) - (2.0~ * (xy * (yz * xz)));
let sum = mass + x + y + z;
if TEST {";
const TEST: &str = "(mass >= 0.0~) && (a >= 0.0~) && (b >= 0.0~) && (c >= 0.0~) && (ab >= 0.0~) && \
    (bc >= 0.0~) && (ac >= 0.0~) && (abc >= 0.0~) && ((sum - sum) == 0.0~) && \
    !((mass <= 0.0~) && (most > 0.0~))";

/// Returns the methods of a type in Rust, `Payload` or `Body`.
pub fn rust(is_single: bool, kind: &str) -> String {
    let (real, half) = match is_single {
        true => ("f32", "0.5005"),
        false => ("f64", "0.5000005"),
    };
    let tested = TESTED.replace("TEST", TEST).replace("HALF", half);
    let (tested, numbers) = (tested.replace('~', ""), NUMBERS.join(", "));
    format!(
        "impl {kind} {{\npub const NONE: {kind} = {kind}([0.0; 10]);\n\
         pub const fn new(mass: {real}, com: [{real}; 3], inertia: [{real}; 6]) -> Option<{kind}> {{\n\
         let ([x, y, z], [xx, yy, zz, xy, yz, xz]) = (com, inertia);\n\
         {tested}\nSome({kind}([{numbers}]))\n}} else {{\nNone\n}}\n}}\n}}"
    )
}

/// Returns the methods of so many bodies in Rust; where some numbers stay zero, they are tested.
pub fn rust_bodies(count: usize, zeros: &[bool]) -> String {
    let (length, digits) = (zeros.len(), digits(zeros));
    let (list, test) = match length {
        0 => (String::new(), ""),
        _ => (
            format!("const ZEROS: [u8; {length}] = [{digits}];\n"),
            "assert!(!((ZEROS[10 * place + number] == 1) && !(body.0[number] == 0.0)));\n",
        ),
    };
    format!(
        "impl Bodies {{\npub const fn with(mut self, place: usize, body: Body) -> Bodies {{\n\
         {list}assert!(place < {count});\nlet mut number = 0;\nwhile number < 10 {{\n{test}\
         self.0[10 * place + number] = body.0[number];\nnumber += 1;\n}}\nself\n}}\n}}"
    )
}

fn digits(zeros: &[bool]) -> String {
    let numbers = zeros.iter().map(|is_zero| if *is_zero { "1" } else { "0" });
    numbers.collect::<Vec<_>>().join(", ")
}

/// Returns a type and its function in C, `payload` or `body`; the text begins with `function`, names
/// with `prefix`, and macros with `macros`.
pub fn c(is_single: bool, function: &str, [prefix, macros]: [&str; 2], kind: &str) -> String {
    let (real, half, suffix) = match is_single {
        true => ("float", "0.5005", "F"),
        false => ("double", "0.5000005", ""),
    };
    let (mut lines, mut kept) = (String::new(), String::new());
    for (place, name) in NUMBERS.iter().enumerate() {
        lines += &format!("const {real} {name} = numbers[{place}];\n");
        kept += &format!("{kind}->{kind}[{place}] = {name};\n");
    }
    let tested = TESTED.replace("TEST", &format!("({TEST})"));
    let constants = tested.replace("let", &format!("const {real}"));
    lines += &constants.replace("HALF", half).replace('~', suffix);
    format!(
        "typedef struct {{\n{real} {kind}[10];\n}} {prefix}_{kind}_t;\n\
         {function} int {prefix}_{kind}(const {real} numbers[{macros}_RESTRICT 10], \
         {prefix}_{kind}_t {kind}[{macros}_RESTRICT 1])\n{{\n{macros}_UNFUSED\nint is_body = 0;\n\
         {lines}\n{kept}is_body = 1;\n}}\nreturn is_body;\n}}"
    )
}

/// Returns the type of so many bodies in C, and the function that puts one in its place; where some
/// numbers stay zero, they are tested.
pub fn c_bodies(
    is_single: bool,
    function: &str,
    [prefix, macros]: [&str; 2],
    (count, zeros): (usize, &[bool]),
) -> String {
    let real = if is_single { "float" } else { "double" };
    let (numbers, digits) = (10 * count, digits(zeros));
    let (list, test) = match zeros {
        [] => (String::new(), ""),
        _ => (
            format!("static const unsigned char zeros[{numbers}] = {{{digits}}};\n"),
            "while (number < 10) {\n\
             if ((zeros[10 * place + number] == 1) && !(body->body[number] == 0)) {\nreturn 0;\n}\n\
             number += 1;\n}\nnumber = 0;\n",
        ),
    };
    format!(
        "typedef struct {{\n{real} bodies[{numbers}];\n}} {prefix}_bodies_t;\n\
         {function} int {prefix}_with_body({prefix}_bodies_t into[{macros}_RESTRICT 1], int place, \
         const {prefix}_body_t body[{macros}_RESTRICT 1])\n{{\n{list}int number = 0;\n\
         if (!((place >= 0) && (place < {count}))) {{\nreturn 0;\n}}\n{test}while (number < 10) {{\n\
         into->bodies[10 * place + number] = body->body[number];\nnumber += 1;\n}}\nreturn 1;\n}}"
    )
}
