//! A binary float of 448 bits, 134 decimal digits: the reference of tests and
//! reports.

use alloc::format;
use alloc::string::String;
use core::str::FromStr;

use dashu_float::round::mode::{HalfAway, HalfEven};
use dashu_float::{Context, FBig};
use dashu_int::IBig;
use num_bigint::{BigInt, Sign};
use num_rational::BigRational;

use super::{Divide, Scalar};

type Float = FBig<HalfEven, 2>;

/// A number rounded to nearest at [`Big::PRECISION`] bits; its exponent has no
/// practical bound.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub struct Big(Float);

impl Big {
    /// Bits of the significand.
    pub const PRECISION: usize = 448;

    /// Returns the value of a float, exactly; `None` for NaN and the infinities.
    pub fn from_f64(x: f64) -> Option<Self> {
        if !x.is_finite() {
            return None;
        }
        Float::try_from(x).ok().map(rounded)
    }

    /// Returns the value of an integer, rounded.
    pub fn from_int(x: &BigInt) -> Self {
        rounded(
            Context::new(Self::PRECISION)
                .convert_int(integer(x))
                .value(),
        )
    }

    /// Returns the value of a rational, rounded once.
    pub fn from_rational(x: &BigRational) -> Self {
        Big(quotient(x, Self::PRECISION))
    }

    /// Returns the value of a decimal literal such as `-1.25e-3`, rounded.
    pub fn from_decimal(text: &str) -> Option<Self> {
        let decimal = FBig::<HalfAway, 10>::from_str(text).ok()?;
        let exact = decimal.with_rounding::<HalfEven>();
        let binary = exact.with_base_and_precision::<2>(Self::PRECISION + GUARD);
        Some(rounded(binary.value()))
    }

    /// Returns sin and cos of a float of radians, correctly rounded at every size.
    ///
    /// The reduction of the argument raises its working precision with the
    /// exponent, so that 1e8 loses nothing.
    pub fn sin_cos(&self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_cos();
        (Big(sin), Big(cos))
    }

    /// Returns sin and cos of a rational number of radians.
    pub fn sin_cos_of(radians: &BigRational) -> (Self, Self) {
        // An error of the argument passes to the result undiminished, so the
        // argument gets the bits of its whole part on top.
        let whole = radians.to_integer().bits() as usize;
        let (sin, cos) = quotient(radians, Self::PRECISION + GUARD + whole).sin_cos();
        (rounded(sin), rounded(cos))
    }

    /// Returns sin and cos of a rational multiple of π, exact at multiples of π/2.
    pub fn sin_cos_pi(multiple: &BigRational) -> (Self, Self) {
        // The period goes first, exactly.
        let two = BigRational::from_integer(2.into());
        let turns = (multiple / &two).floor();
        let within = multiple - turns * two;
        let (sin, cos) = quotient(&within, Self::PRECISION + GUARD).sin_cos_pi();
        (rounded(sin), rounded(cos))
    }

    /// Returns the nearest f64.
    pub fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    /// Returns the nearest f32.
    pub fn to_f32(&self) -> f32 {
        self.0.to_f32().value()
    }

    /// Returns the number with `digits` significant decimal digits, as `1.25e-3`.
    pub fn to_decimal(&self, digits: usize) -> String {
        let decimal = self.0.clone().with_rounding::<HalfAway>();
        let decimal = decimal.with_base_and_precision::<10>(digits.max(1)).value();
        format!("{decimal:e}")
    }

    /// Returns `self / other`, rounded; `None` when `other` is zero.
    pub fn div(&self, other: &Self) -> Option<Self> {
        let zero = *other == Self::zero();
        (!zero).then(|| Big(&self.0 / &other.0))
    }

    /// Returns the square root, rounded; zero of what is below zero.
    pub fn sqrt(&self) -> Self {
        match *self > Self::zero() {
            true => Big(self.0.sqrt()),
            false => Self::zero(),
        }
    }

    /// |self|
    pub fn abs(&self) -> Self {
        if *self < Self::zero() {
            self.neg()
        } else {
            self.clone()
        }
    }
}

/// Bits beyond the precision for intermediate values.
const GUARD: usize = 64;

/// Returns it rounded to the precision, which every [`Big`] carries: an operation takes the
/// larger precision of its operands.
fn rounded(x: Float) -> Big {
    Big(x.with_precision(Big::PRECISION).value())
}

/// Returns a rational at a precision, rounded once.
fn quotient(x: &BigRational, precision: usize) -> Float {
    // Both integers are taken whole: the only rounding is the division's.
    let [numer, denom] = [x.numer(), x.denom()].map(|part| {
        let bits = (part.bits() as usize).max(1);
        let part = Context::<HalfEven>::new(bits.max(precision)).convert_int::<2>(integer(part));
        part.value().into_repr()
    });
    match Context::<HalfEven>::new(precision).div(&numer, &denom) {
        Ok(quotient) => quotient.value(),
        // The denominator of a rational is not zero, and exponents are small.
        Err(_) => Float::ZERO,
    }
}

fn integer(x: &BigInt) -> IBig {
    let (sign, bytes) = x.to_bytes_le();
    let size = IBig::from(dashu_int::UBig::from_le_bytes(&bytes));
    if sign == Sign::Minus { -size } else { size }
}

impl Scalar for Big {
    fn zero() -> Self {
        rounded(Float::ZERO)
    }
    fn one() -> Self {
        rounded(Float::ONE)
    }
    fn add(&self, other: &Self) -> Self {
        Big(&self.0 + &other.0)
    }
    fn sub(&self, other: &Self) -> Self {
        Big(&self.0 - &other.0)
    }
    fn mul(&self, other: &Self) -> Self {
        Big(&self.0 * &other.0)
    }
    fn neg(&self) -> Self {
        Big(-self.0.clone())
    }
    fn half(&self) -> Self {
        Big(self.0.clone() >> 1)
    }
}

impl Divide for Big {
    /// Divides; by zero: zero, for want of an infinity. Who divides by what may vanish asks first
    /// ([`Big::div`]).
    fn div(&self, other: &Self) -> Self {
        Big::div(self, other).unwrap_or_else(Self::zero)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn big(text: &str) -> Big {
        Big::from_decimal(text).unwrap()
    }

    /// |a − b| ≤ 1e-digits.
    fn close(a: &Big, b: &str, digits: i32) {
        let error = a.sub(&big(b)).abs();
        assert!(
            error <= big(&format!("1e-{digits}")),
            "{}",
            a.to_decimal(120)
        );
    }

    // 120 digits each, by another library.
    const SIN_1E8: &str = "0.931639027109726008027516653612042970472901838527536434308283895137708520197435239068405256467504292266158598305482026364";
    const COS_1E8: &str = "-0.363385089355690553872375352547100110924259160874345033861427300160457342655124720232878368077296095481031029038863008871";
    const SIN_HALF_PI: &str = "0.999999999999999999999999999999998125300271672678006691905443142903006960036541718383451457204339887439863414533197331654";
    const COS_HALF_PI: &str = "0.0000000000000000612323399573676588613032966137500146464037779883628305209605498277248630839770963795134091635848062649240640801323296266";
    const SIN_THIRD: &str = "-0.897248065324785778662195500222454740984497119953170012629037423122444982105901495332496669324876368644120162063215508706";
    const COS_THIRD: &str = "0.441526793378305584348821930243176157739973890708120253259424023626762732996429423725786863940970197243971129753636392534";
    const SIN_PI_7: &str = "0.433883739117558120475768332848358754609990727787459876444547303532203251653198421520784021774456102088744102930045535819";

    #[test]
    fn sine_and_cosine_are_good_to_a_hundred_digits() {
        let (sin, cos) = Big::from_f64(1e8).unwrap().sin_cos();
        close(&sin, SIN_1E8, 110);
        close(&cos, COS_1E8, 110);
        // cos is 6e-17 here: its own digits count.
        let (sin, cos) = Big::from_f64(core::f64::consts::FRAC_PI_2)
            .unwrap()
            .sin_cos();
        close(&sin, SIN_HALF_PI, 110);
        close(&cos, COS_HALF_PI, 126);
        let third = BigRational::new(100_000_001.into(), 3.into());
        let (sin, cos) = Big::sin_cos_of(&third);
        close(&sin, SIN_THIRD, 110);
        close(&cos, COS_THIRD, 110);
        let (sin, cos) = Big::sin_cos_of(&-third);
        close(&sin.neg(), SIN_THIRD, 110);
        close(&cos, COS_THIRD, 110);
    }

    #[test]
    fn multiples_of_pi_are_exact_where_they_can_be() {
        let pi_times = |n: i64, d: i64| Big::sin_cos_pi(&BigRational::new(n.into(), d.into()));
        close(&pi_times(1, 7).0, SIN_PI_7, 110);
        close(
            &pi_times(1, 7).0.neg(),
            pi_times(-1, 7).0.to_decimal(130).as_str(),
            128,
        );
        close(&pi_times(14_000_001, 7).0, SIN_PI_7, 110);
        assert_eq!(pi_times(1, 2), (Big::one(), Big::zero()));
        assert_eq!(pi_times(-1, 2), (Big::one().neg(), Big::zero()));
        assert_eq!(pi_times(5, 1), (Big::zero(), Big::one().neg()));
    }

    #[test]
    fn conversions_round_once() {
        let third = BigRational::new((-1).into(), 3.into());
        let x = Big::from_rational(&third);
        assert_eq!(x.to_f64(), -1.0 / 3.0);
        assert_eq!(x.to_f32(), -1.0 / 3.0);
        assert_eq!(x.to_decimal(5), "-3.3333e-1");
        let error = x.mul(&Big::from_int(&3.into())).add(&Big::one()).abs();
        assert!(error <= big("1e-133"), "{}", error.to_decimal(5));
        let power = BigInt::from(1) << 2000;
        let nearly = BigRational::new(&power + 1, power);
        assert_eq!(Big::from_rational(&nearly), Big::one());
        assert_eq!(big("0.1").to_f64(), 0.1);
        assert_eq!(Big::from_f64(5e-324).unwrap().to_f64(), 5e-324);
        assert_eq!(Big::from_f64(f64::NAN), None);
        assert_eq!(big("3").half().double(), big("3"));
        assert_eq!(Big::zero().div(&Big::zero()), None);
        let root = big("2").sqrt();
        assert!(root.mul(&root).sub(&big("2")).abs() < big("1e-133"));
        assert_eq!(big("-2").sqrt(), Big::zero());
    }
}
