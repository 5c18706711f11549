//! The items of generated code that make a payload of numbers that a body has, line by line.
//!
//! Of a body ½ tr(I) 1 − I is ∫ r rᵀ dm, about the centre of mass: none of its principal minors is
//! negative. ½ is a little more here, since moments that are rounded, as those of a thin plate, are
//! a body's as well.

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

/// Returns the methods of the type in Rust.
pub fn rust(is_single: bool) -> String {
    let (real, half) = match is_single {
        true => ("f32", "0.5005"),
        false => ("f64", "0.5000005"),
    };
    let tested = TESTED.replace("TEST", TEST).replace("HALF", half);
    let (tested, numbers) = (tested.replace('~', ""), NUMBERS.join(", "));
    format!(
        "impl Payload {{\npub const NONE: Payload = Payload([0.0; 10]);\n\
         pub const fn new(mass: {real}, com: [{real}; 3], inertia: [{real}; 6]) -> Option<Payload> {{\n\
         let ([x, y, z], [xx, yy, zz, xy, yz, xz]) = (com, inertia);\n\
         {tested}\nSome(Payload([{numbers}]))\n}} else {{\nNone\n}}\n}}\n}}"
    )
}

/// Returns the type and the function in C, which begins with `function`: their names begin with
/// `own`, and macros with `macros`.
pub fn c(is_single: bool, function: &str, own: &str, macros: &str) -> String {
    let (real, half, suffix) = match is_single {
        true => ("float", "0.5005", "F"),
        false => ("double", "0.5000005", ""),
    };
    let tested = TESTED.replace("TEST", &format!("({TEST})"));
    let each = |line: fn((usize, &&str)) -> String| -> String {
        NUMBERS.iter().enumerate().map(line).collect()
    };
    let lines = each(|(place, own)| format!("let {own} = numbers[{place}];\n")) + &tested;
    let lines = lines.replace("let", &format!("const {real}"));
    let lines = lines.replace("HALF", half).replace('~', suffix);
    let kept = each(|(place, own)| format!("payload->payload[{place}] = {own};\n"));
    format!(
        "typedef struct {{\n{real} payload[10];\n}} {own}_payload_t;\n\
         {function} int {own}_payload(const {real} numbers[{macros}_RESTRICT 10], \
         {own}_payload_t payload[{macros}_RESTRICT 1])\n{{\n{macros}_UNFUSED\nint is_body = 0;\n\
         {lines}\n{kept}is_body = 1;\n}}\nreturn is_body;\n}}"
    )
}
