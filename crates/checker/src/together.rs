//! The functions of a header that give sines, which must be these: of several angles, or of one
//! where they are called at many states. Their operations are those of the crate
//! `dalembert-sines`, where each result is proved to be within an ulp; what is further away than
//! `MOST` is the C library's.

use crate::file::between;
use crate::read::whole;

/// The function of several; `@` is what their names begin with. Literals of f32 end with F for
/// `~`, and functions of the library with f for `^`.
const SEVERAL: &str = "#if defined(__clang__)
__attribute__((noinline))
#endif
static inline void @_sines_COUNT(const REAL angle[ARM_RESTRICT COUNT], REAL sine[ARM_RESTRICT COUNT], REAL cosine[ARM_RESTRICT COUNT])
{
ARM_UNFUSED
int i;
for (i = 0; i < COUNT; ++i) {
const REAL x0 = angle[i];
STEPS
const REAL whole = ((x3 * 0.25~) + SHIFT~) - SHIFT~;
const REAL turns = x3 - (whole * 4.0~);
const REAL square = turns * turns;
const REAL one = (square == 1.0~) ? COSINE : SINE;
const REAL other = (square == 1.0~) ? SINE : COSINE;
sine[i] = (turns >= square) ? one : -one;
cosine[i] = (-turns >= square) ? other : -other;
}
for (i = 0; i < COUNT; ++i) {
if (!(fabs^(angle[i]) <= MOST~)) {
sine[i] = sin^(angle[i]);
cosine[i] = cos^(angle[i]);
}
}
}";

/// The operations, x1 and on: a quarter turn in three parts is taken off, and polynomials follow.
const DOUBLE: &str = "x0*0.6366197723675814 x1+6755399441055744.0 x2-6755399441055744.0
    x3*1.5707963267941523 x0-x4 x3*7.443547480480255e-13 x5-x6 x3*6.36831716351095e-25
    x5-x7 x9-x6 x8-x10 x7*x7 x12*x12 x12*-0.00833333333332184 x14+0.1666666666666663
    x12*-2.755731353849849e-6 x16+0.0001984126982935851 x12*-1.5895432974606856e-10
    x18+2.5050734385279406e-8 x13*x19 x17+x20 x13*x21 x15+x22 x12*-0.0013888888888874474
    x24+0.0416666666666666 x12*-2.755731440101526e-7 x26+2.4801587289671513e-5
    x12*-1.1359934021914191e-11 x28+2.0875729278007775e-9 x13*x29 x27+x30 x13*x31 x25+x32
    x12*0.5 1.0-x34 x11*x35 x7*x12 x37*x23 x36+x38 x7-x39 1.0-x35 x41-x34 x13*x33 x7*x11
    x43+x44 x42+x45 x35+x46";
const SINGLE: &str = "x0*0.63661975 x1+12582912.0 x2-12582912.0 x3*1.5707855 x0-x4
    x3*1.0804331e-5 x5-x6 x3*2.563344e-12 x5-x7 x9-x6 x8-x10 x7*x7 x12*x12
    x12*0.00019518287 x14+-0.008332189 x15*x12 x16+0.16666655 x12*2.443067e-5
    x18+-0.0013887301 x19*x12 x20+0.041666646 x12*0.5 1.0-x22 x11*x23 x7*x12 x25*x17
    x24+x26 x7-x27 1.0-x23 x29-x22 x13*x21 x7*x11 x31+x32 x30+x33 x23+x34";

const ONE: &str = "typedef struct {
REAL sin;
REAL cos;
} @_sincos_t;
static inline @_sincos_t @_sincos(const int far, const REAL angle)
{
ARM_UNFUSED
const REAL x0 = (fabs^(angle) <= MOST~) ? angle : 0.0~;
STEPS
const unsigned int turns = (unsigned int)(int)x3;
const REAL one = ((turns & 1U) == 0U) ? SINE : COSINE;
const REAL other = ((turns & 1U) == 0U) ? COSINE : SINE;
@_sincos_t pair;
pair.sin = ((turns & 2U) == 0U) ? one : -one;
pair.cos = (((turns + 1U) & 2U) == 0U) ? other : -other;
if ((far != 0) && !(fabs^(angle) <= MOST~)) {
pair.sin = sin^(angle);
pair.cos = cos^(angle);
}
return pair;
}";

/// Returns the lines of the functions that give sines, if this is the fourth of them: the head of
/// what is called once, or the name of a struct.
pub(crate) fn lines(header: &str, fourth: &str) -> Option<String> {
    let several = fourth
        .strip_prefix("static inline void ")
        .and_then(|head| head.split_once('(')?.0.split_once("_sines_"));
    let one = || Some((between(fourth, "} ", "_sincos_t;")?, "1"));
    let (base, count) = several.or_else(one)?;
    let module = base.to_ascii_uppercase();
    let is_single = module == format!("{header}_F32");
    (whole(count).is_some() && (is_single || module == header)).then_some(())?;
    let (real, operations, [sine, cosine], most, ends) = match is_single {
        true => ("float", SINGLE, ["x28", "x35"], "100.0", ["F", "f"]),
        false => ("double", DOUBLE, ["x40", "x47"], "8192.0", ["", ""]),
    };
    let step = |(index, operation): (usize, &str)| {
        let (left, right) = operation.split_at(operation.find(['*', '+', '-']).unwrap_or(0));
        let (sign, right) = right.split_at(1);
        let [left, right] = [left, right].map(|word| match word.starts_with('x') {
            true => word.to_owned(),
            false => format!("{word}~"),
        });
        format!("const REAL x{} = {left} {sign} {right};", index + 1)
    };
    let steps = operations.split_whitespace().enumerate().map(step);
    let shift = operations.split(['+', ' ']).nth(2)?;
    let steps = steps.collect::<Vec<String>>().join("\n");
    let mut text = several.map_or(ONE, |_| SEVERAL).replace("STEPS", &steps);
    for (word, meant) in [
        ("SHIFT", shift),
        ("COSINE", cosine),
        ("SINE", sine),
        ("MOST", most),
        ("REAL", real),
        ("COUNT", count),
        ("~", ends[0]),
        ("^", ends[1]),
        ("ARM", header),
        ("@", base),
    ] {
        text = text.replace(word, meant);
    }
    Some(text)
}
