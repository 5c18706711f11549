//! Exact constants: sums of products of a fraction and of sines and cosines of constant angles, as
//! in `-73/500+169/1000*cos(3/10)`; their residues, and the float that is nearest.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

use num_bigint::BigInt;
use num_rational::BigRational as Rational;
use num_traits::float::FloatCore;
use num_traits::{Euclid, One, Pow, Signed, ToPrimitive, Zero};

use super::number::{Draws, Number, Prime};

/// The most digits of a number: one that went through a rotation by odd angles gains some thirty
/// for each.
const MOST_DIGITS: usize = 4000;
/// The largest power of ten.
const MOST_POWER: u64 = 400;
/// A constant of as many bytes is refused.
pub(crate) const LONGEST: usize = 1 << 15;
const MOST_FACTORS: u32 = 1 << 6;
/// Bits behind the point where sines are rounded, and where products with them are.
const BITS: u32 = 320;
const PLACES: u32 = 1400;

/// An angle: a multiple of π, a number of radians, or 2 atan of a fraction.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Angle {
    /// A multiple of π.
    Pi(Rational),
    /// Radians.
    Radians(Rational),
    /// Twice the arc tangent.
    TwiceAtan(Rational),
}

/// Reads a decimal, or a fraction of two.
pub fn number(text: &str) -> Option<Rational> {
    let (over, under) = text.split_once('/').unwrap_or((text, "1"));
    let under = decimal(under).filter(|under| under.is_positive())?;
    Some(decimal(over)? / under)
}

fn decimal(text: &str) -> Option<Rational> {
    (text.len() <= MOST_DIGITS).then_some(())?;
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, behind) = digits.split_once('.').unwrap_or((digits, ""));
    let plain = format!("{whole}{behind}").replace('_', "");
    let is_digit = |c: char| c.is_ascii_digit();
    let bare = plain.strip_prefix(['-', '+']).unwrap_or(&plain);
    (!bare.is_empty() && bare.chars().all(is_digit)).then_some(())?;
    let places = exponent.parse::<i64>().ok()? - behind.len() as i64;
    (places.unsigned_abs() < MOST_POWER).then_some(())?;
    let ten = Rational::from_integer(10.into());
    Some(Rational::from_integer(plain.parse().ok()?) * Pow::pow(ten, places as i32))
}

/// Returns a fraction in units of 2 to the power of −`bits`, rounded towards zero.
pub(crate) fn fixed(value: &Rational, bits: u32) -> BigInt {
    (value.numer() << bits) / value.denom()
}

/// Returns sine and cosine of 2 atan t: (2t, 1 − t²)/(1 + t²).
fn circle(t: Number) -> [Number; 2] {
    let one = Number::from(1);
    [(t + t) / (one + t * t), (one - t * t) / (one + t * t)]
}

/// Sums x − x³/3 + x⁵/5 − …, each power by the one before, until it is zero.
fn arctan(mut power: BigInt, next: impl Fn(BigInt) -> BigInt) -> BigInt {
    let (mut sum, mut k) = (BigInt::zero(), 1u32);
    while !power.is_zero() {
        let part = &power / k;
        sum += if k % 4 == 1 { part } else { -part };
        (power, k) = (next(power), k + 2);
    }
    sum
}

/// Returns 2 atan x in units of 2 to the power of −`bits`, to a few of them.
fn twice_atan(x: &Rational, bits: u32) -> BigInt {
    let is_steep = x.abs() > Rational::one();
    let one = BigInt::one() << bits;
    let mut x = fixed(&if is_steep { x.recip() } else { x.clone() }, bits);
    // tan(φ/2) = tan φ / (1 + √(1 + tan² φ)), four times: the series is short then.
    for _ in 0..4 {
        let root = (&one * &one + &x * &x).sqrt();
        x = &x * &one / (&one + root);
    }
    let sum = arctan(x.clone(), |power| power * &x / &one * &x / &one);
    let half_turn = Angle::Pi(x.signum().into());
    match is_steep {
        true => half_turn.scaled(bits) - sum * 32,
        false => sum * 32,
    }
}

impl Angle {
    /// Reads `0.3`, `"pi/2"`, `"-3*pi/4"`, `"90deg"`, `"2*atan(1/3)"`, or `1*pi/5` of a program. A
    /// decimal within 4 ulp of a quarter turn, up to a whole one, is that.
    pub fn read(text: &str) -> Option<Angle> {
        let text = text.trim();
        if let Some(degrees) = text.strip_suffix("deg") {
            return Some(Angle::Pi(number(degrees.trim())? / BigInt::from(180)));
        }
        if let Some((factor, tangent)) = text.split_once("atan(") {
            let tangent = number(tangent.strip_suffix(')')?.trim())?;
            let tangent = match factor.trim() {
                "2*" | "+2*" => tangent,
                "-2*" => -tangent,
                _ => return None,
            };
            let is_quarter = tangent.is_zero() || tangent.abs().is_one();
            return Some(match is_quarter {
                true => Angle::Pi(tangent / BigInt::from(2)),
                false => Angle::TwiceAtan(tangent),
            });
        }
        if let Some((factor, under)) = text.split_once("pi") {
            let factor = match factor.trim() {
                "" | "+" => Rational::one(),
                "-" => -Rational::one(),
                factor => number(factor.strip_suffix('*')?.trim())?,
            };
            let under = match under.trim() {
                "" => Rational::one(),
                under => number(under.strip_prefix('/')?.trim())?,
            };
            return (!under.is_zero()).then(|| Angle::Pi(factor / under));
        }
        let radians = number(text)?;
        let value = radians.to_f64()?;
        let quarters = (value / std::f64::consts::FRAC_PI_2).round();
        let turn = quarters * std::f64::consts::FRAC_PI_2;
        let slack = (4.0 * (turn.abs().next_up() - turn.abs())).min(2e-15);
        let is_turn = (turn - value).abs() <= slack && (1.0..=4.0).contains(&quarters.abs());
        Some(match is_turn || radians.is_zero() {
            true => Angle::Pi(Rational::new((quarters as i64).into(), 2.into())),
            false => Angle::Radians(radians),
        })
    }

    /// Returns the nearest double of its radians, to two ulps; none beyond doubles.
    pub fn radians(&self) -> Option<f64> {
        match self {
            Angle::Pi(multiple) => Some(multiple.to_f64()? * std::f64::consts::PI),
            Angle::Radians(radians) => radians.to_f64(),
            Angle::TwiceAtan(tangent) => Some(2.0 * tangent.to_f64()?.atan()),
        }
    }

    pub(super) fn scaled(&self, bits: u32) -> BigInt {
        let one = BigInt::one() << bits;
        let arc = |under: u32| arctan(&one / under, |power| power / (under * under));
        match self {
            Angle::Radians(x) => fixed(x, bits),
            Angle::Pi(x) => (fixed(x, bits) * (16 * arc(5) - 4 * arc(239))) >> bits,
            Angle::TwiceAtan(x) => twice_atan(x, bits),
        }
    }

    /// Returns sine and cosine to 2⁻³⁰⁰, in units of 2⁻³²⁰; none of angles beyond 8 rad, whose
    /// series loses more bits.
    pub(super) fn rounded(&self) -> Option<[BigInt; 2]> {
        let (one, radians) = (BigInt::one() << BITS, self.scaled(BITS));
        (radians.abs() <= BigInt::from(8) << BITS).then_some(())?;
        let (mut sums, mut term, mut k) = ([BigInt::zero(), BigInt::zero()], one.clone(), 0u32);
        while !term.is_zero() {
            sums[1 - k as usize % 2] += if k % 4 < 2 { term.clone() } else { -&term };
            k += 1;
            // Towards zero, so that it ends.
            term = &term * &radians / (&one * k);
        }
        Some(sums)
    }
}

/// Sines and cosines of angles, each rounded once.
pub type Sines = HashMap<Angle, Option<[BigInt; 2]>>;

/// A fraction, times powers of the sine and the cosine of angles.
type Term = (Rational, Vec<(Angle, [u32; 2])>);

/// A constant of a program: a sum of terms. Where it stands often it is one, and rounded once.
#[derive(Clone, Debug)]
pub struct Exact(Arc<Sum>);

#[derive(Debug)]
struct Sum {
    terms: Vec<Term>,
    rounded: OnceLock<Option<Enclosure>>,
    double: OnceLock<Option<[f64; 2]>>,
}

/// over/under, and the constant is at most slack/under from it. Nothing is reduced to lowest terms.
#[derive(Debug)]
pub struct Enclosure {
    over: BigInt,
    slack: BigInt,
    under: BigInt,
}

/// A double as m·2^e.
fn parts(value: f64) -> (BigInt, i64) {
    let (mantissa, exponent, sign) = value.integer_decode();
    (BigInt::from(mantissa) * sign, i64::from(exponent))
}

impl Enclosure {
    /// Compares (over + slack·sign)/under times two with the sum of two doubles.
    fn twice_against(&self, sign: i32, [a, b]: [f64; 2]) -> Ordering {
        let [(a, i), (b, k)] = [a, b].map(parts);
        let least = i.min(k).min(0);
        let sum = (a << (i - least)) + (b << (k - least));
        let numerator: BigInt = ((&self.over + &self.slack * sign) * 2) << -least;
        numerator.cmp(&(sum * &self.under))
    }
}

impl PartialEq for Exact {
    fn eq(&self, other: &Exact) -> bool {
        self.0.terms == other.0.terms
    }
}

impl From<Rational> for Exact {
    fn from(value: Rational) -> Exact {
        Exact::new(vec![(value, Vec::new())])
    }
}

impl Exact {
    fn new(terms: Vec<Term>) -> Exact {
        Exact(Arc::new(Sum {
            terms,
            rounded: OnceLock::new(),
            double: OnceLock::new(),
        }))
    }

    /// Reads a constant as programs write it; none of other text.
    pub fn read(text: &str) -> Option<Exact> {
        let term = |text: &str| {
            // The first factor is a fraction; `1*pi/5` stands in brackets.
            let angles = ["*sin(", "*cos("].map(|name| text.find(name));
            let end = angles.into_iter().flatten().min().unwrap_or(text.len());
            let (factor, mut rest) = text.split_at(end);
            let (mut powers, mut total) = (Vec::new(), 0);
            while let Some(part) = rest.strip_prefix('*') {
                let (name, behind) = part.split_once('(')?;
                let (angle, behind) = behind.split_once(')')?;
                let end = behind.find('*').unwrap_or(behind.len());
                let power = match behind[..end].strip_prefix('^') {
                    Some(power) => power.parse().ok().filter(|power| *power <= MOST_FACTORS)?,
                    None => 1u32,
                };
                total += power;
                let both = [("sin", [power, 0]), ("cos", [0, power])]
                    .into_iter()
                    .find(|(function, _)| *function == name)?
                    .1;
                powers.push((Angle::read(angle)?, both));
                rest = &behind[end..];
            }
            (rest.is_empty() && total <= MOST_FACTORS).then_some((number(factor)?, powers))
        };
        (text.len() < LONGEST).then_some(())?;
        let terms = text.split('+').map(term).collect::<Option<_>>();
        terms.map(Exact::new)
    }

    pub(crate) fn factors(&self) -> usize {
        let powers = self.0.terms.iter().flat_map(|term| &term.1);
        let count: u32 = powers.map(|(_, [sin, cos])| sin + cos).sum();
        self.0.terms.len() + count as usize
    }

    /// Returns a constant without angles.
    pub fn fraction(&self) -> Option<&Rational> {
        match self.0.terms.as_slice() {
            [(factor, powers)] if powers.is_empty() => Some(factor),
            _ => None,
        }
    }

    /// Rounds the constant once, by the sines that are known, to which it adds more; none if an
    /// angle is too far.
    pub fn settle(&self, known: &mut Sines) -> Option<&Enclosure> {
        let rounded = &self.0.rounded;
        rounded.get_or_init(|| self.rounded(known)).as_ref()
    }

    /// Returns a double, and how far the constant is from it at most; none if an angle is too far.
    pub fn double(&self) -> Option<[f64; 2]> {
        *self.0.double.get_or_init(|| {
            let Enclosure { over, slack, under } = self.settle(&mut Sines::new())?;
            let near = |over: BigInt, under: BigInt| Rational::new_raw(over, under).to_f64();
            let value = near(over.clone(), under.clone()).filter(|double| double.is_finite())?;
            let (m, e) = parts(value);
            let (up, down) = (e.max(0), (-e).max(0));
            let off = ((over << down) - ((m * under) << up)).abs() + (slack << down);
            let radius = match off.is_zero() {
                true => 0.0,
                false => near(off, under << down)?.next_up(),
            };
            Some([value, radius])
        })
    }

    /// Returns the nearest double; zero for an angle that is too far.
    pub fn nearest(&self) -> f64 {
        self.double().unwrap_or_default()[0]
    }

    /// Returns a number that clones of this object share, and no other object of the same value.
    pub(crate) fn address(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    fn rounded(&self, known: &mut Sines) -> Option<Enclosure> {
        if let Some(fraction) = self.fraction() {
            let (over, under) = (fraction.numer().clone(), fraction.denom().clone());
            let slack = BigInt::zero();
            return Some(Enclosure { over, slack, under });
        }
        let (mut over, mut slack) = (BigInt::zero(), BigInt::one());
        for (factor, powers) in &self.0.terms {
            let factor = fixed(factor, PLACES);
            let mut product = factor.clone();
            for (angle, powers) in powers {
                let entry = known.entry(angle.clone());
                let pair = entry.or_insert_with(|| angle.rounded());
                for (value, power) in pair.as_ref()?.iter().zip(powers) {
                    (0..*power).for_each(|_| product = (&product * value) >> BITS);
                }
            }
            // 64 factors at most, each off by 2⁻³⁰⁰, and as many products rounded.
            slack += (factor.abs() >> 280u32) + 128;
            over += product;
        }
        let under = BigInt::one() << PLACES;
        Some(Enclosure { over, slack, under })
    }

    /// Compares a literal with the nearest float; between two as near, the even one counts.
    pub fn is_nearest(&self, literal: f64, is_single: bool) -> bool {
        let Some(rounded) = self.settle(&mut Sines::new()) else {
            return false;
        };
        let is_exact = rounded.slack.is_zero();
        // Printed code has no zero with a sign. A number that is not zero does not vanish: others
        // could be as large as it is small. A sum of sines may be zero, as 2 cos² π/4 − 1 is.
        if literal == 0.0 {
            let is_zero = literal.is_sign_positive() && rounded.over.abs() <= rounded.slack;
            let point = || Point::new(&[&format!("{:?}", self.0.terms)]);
            return is_zero && (is_exact || !point().constant(self).is_nonzero());
        }
        let single = literal as f32;
        if is_single && f64::from(single) != literal {
            return false;
        }
        let (down, up, single_bits) = (single.next_down(), single.next_up(), single.to_bits());
        let (below, above, bits): (f64, f64, u64) = match is_single {
            true => (down.into(), up.into(), single_bits.into()),
            false => (literal.next_down(), literal.next_up(), literal.to_bits()),
        };
        if ![literal, below, above].iter().all(|x| x.is_finite()) {
            return false;
        }
        let is_tie = bits.is_multiple_of(2) && is_exact;
        let low = rounded.twice_against(-1, [literal, below]);
        let high = rounded.twice_against(1, [literal, above]);
        let fits = |order: Ordering, wanted| order == wanted || is_tie && order == Ordering::Equal;
        fits(low, Ordering::Greater) && fits(high, Ordering::Less)
    }
}

/// A point of a prime field: the residues of numbers, and of sines and cosines of angles.
pub struct Point {
    /// The prime of its field.
    pub prime: Prime,
    draws: RefCell<Draws>,
    angles: RefCell<HashMap<Angle, [Number; 2]>>,
    constants: RefCell<HashMap<*const Sum, (Exact, Number)>>,
}

impl Point {
    /// Returns the first point of a statement.
    pub fn new(statement: &[&str]) -> Point {
        Point::draw(&mut Draws::new(statement))
    }

    /// Draws a point, with draws of its own.
    pub fn draw(draws: &mut Draws) -> Point {
        let mut draws = draws.split();
        let prime = draws.prime();
        Point {
            prime,
            draws: draws.into(),
            angles: RefCell::default(),
            constants: RefCell::default(),
        }
    }

    /// Returns one half.
    pub fn half(&self) -> Number {
        Number::new(self.prime.value() / 2 + 1, self.prime)
    }

    /// Returns a residue that was not drawn before.
    pub fn residue(&self) -> Number {
        self.draws.borrow_mut().residue(self.prime)
    }

    /// Returns a sine and a cosine that were not drawn before.
    pub fn pair(&self) -> [Number; 2] {
        circle(self.residue())
    }

    /// Returns the residue of a fraction.
    pub fn number(&self, value: &Rational) -> Number {
        let prime = BigInt::from(self.prime.value());
        let part =
            |x: &BigInt| Number::new(x.rem_euclid(&prime).to_u128().unwrap_or(0), self.prime);
        part(value.numer()) / part(value.denom())
    }

    /// Returns sine and cosine of a twenty-fourth of a turn, a twelfth or an eighth, by √2 and √3.
    fn part_of_turn(&self, angle: &Angle) -> Option<[Number; 2]> {
        let parts = match angle {
            Angle::Pi(multiple) => multiple * BigInt::from(12),
            _ => return None,
        };
        let half = self.half();
        let [two, three] = [2, 3].map(|square| Number::new(square, self.prime).root() * half);
        match parts.is_integer().then(|| parts.to_u8())?? {
            1 => Some([three * two - two * half, three * two + two * half]),
            2 => Some([half, three]),
            3 => Some([two, two]),
            _ => None,
        }
    }

    /// Returns sine and cosine of a constant angle: a point of the circle, which one angle up to an
    /// eighth of a turn or of positive radians gives to all that follow from it. Multiples of a
    /// twenty-fourth of a turn have all their relations, other angles are drawn.
    pub fn angle(&self, angle: &Angle) -> [Number; 2] {
        let drawn = |angle: Angle| {
            let drawn_before = self.angles.borrow().get(&angle).copied();
            let known = drawn_before.or_else(|| self.part_of_turn(&angle));
            let pair = known.unwrap_or_else(|| self.pair());
            self.angles.borrow_mut().insert(angle, pair);
            pair
        };
        let multiple = match angle {
            Angle::Pi(multiple) => multiple,
            Angle::Radians(radians) => {
                let [sin, cos] = drawn(Angle::Radians(radians.abs()));
                return [if radians.is_negative() { -sin } else { sin }, cos];
            }
            Angle::TwiceAtan(tangent) => return circle(self.number(tangent)),
        };
        let half = Rational::new(1.into(), 2.into());
        let halves = multiple / &half;
        let whole = halves.floor().to_integer();
        let quarters = whole.rem_euclid(&4.into()).to_u8().unwrap_or(0);
        let rest = halves - whole;
        let [sin, cos] = if rest.is_zero() {
            [0.into(), 1.into()]
        } else if rest > half {
            let [sin, cos] = drawn(Angle::Pi((Rational::one() - rest) * half));
            [cos, sin]
        } else {
            drawn(Angle::Pi(rest * half))
        };
        match quarters {
            0 => [sin, cos],
            1 => [cos, -sin],
            2 => [-sin, -cos],
            _ => [-cos, sin],
        }
    }

    /// Returns the residue of a constant.
    pub fn constant(&self, constant: &Exact) -> Number {
        let term = |(factor, powers): &Term| {
            let mut product = self.number(factor);
            for (angle, powers) in powers {
                for (residue, power) in self.angle(angle).into_iter().zip(powers) {
                    product = (0..*power).fold(product, |product, _| product * residue);
                }
            }
            product
        };
        let mut known = self.constants.borrow_mut();
        let (_, residue) = known.entry(Arc::as_ptr(&constant.0)).or_insert_with(|| {
            let terms = constant.0.terms.iter().map(term);
            // Kept with the constant, whose place is no other's as long as it is there.
            (constant.clone(), terms.fold(0.into(), |a, b| a + b))
        });
        *residue
    }
}
