//! Exact constants: sums of products of a fraction and of sines and cosines of constant angles, as
//! in `-73/500+169/1000*cos(3/10)`; their residues, and the float that is nearest.

use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

use num_bigint::BigInt;
use num_rational::BigRational as Rational;
use num_traits::{One, Pow, Signed, ToPrimitive, Zero};

use super::number::{Draws, Number};

/// The longest number that is read.
const MOST_DIGITS: usize = 1 << 12;
/// The longest constant.
const MOST_BYTES: usize = 1 << 15;
/// The most sines and cosines of a product.
const MOST_FACTORS: u32 = 1 << 6;
/// Bits behind the point where sines are rounded, and where products with them are.
const BITS: u32 = 320;
const PLACES: u32 = 1400;

/// An angle: a multiple of π, or a number of radians.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Angle {
    /// A multiple of π.
    Pi(Rational),
    /// Radians.
    Radians(Rational),
}

/// Reads a decimal, or a fraction of two.
pub fn number(text: &str) -> Option<Rational> {
    match text.split_once('/') {
        Some((over, under)) => {
            let under = decimal(under).filter(|under| under.is_positive())?;
            Some(decimal(over)? / under)
        }
        None => decimal(text),
    }
}

fn decimal(text: &str) -> Option<Rational> {
    if text.len() > MOST_DIGITS {
        return None;
    }
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, behind) = digits.split_once('.').unwrap_or((digits, ""));
    let plain = format!("{whole}{behind}").replace('_', "");
    let is_digit = |c: char| c.is_ascii_digit();
    let bare = plain.strip_prefix(['-', '+']).unwrap_or(&plain);
    (!bare.is_empty() && bare.chars().all(is_digit)).then_some(())?;
    let places = exponent.parse::<i64>().ok()? - behind.len() as i64;
    (places.abs() < 1000).then_some(())?;
    let ten = Rational::from_integer(10.into());
    Some(Rational::from_integer(plain.parse().ok()?) * Pow::pow(ten, places as i32))
}

impl Angle {
    /// Reads `0.3`, `"pi/2"`, `"-3*pi/4"`, `"90deg"`, or `1*pi/5` of a program. A decimal within 4
    /// ulp of a quarter turn, up to a whole one, is that.
    pub fn read(text: &str) -> Option<Angle> {
        let text = text.trim();
        if let Some(degrees) = text.strip_suffix("deg") {
            return Some(Angle::Pi(
                number(degrees.trim())? / Rational::from_integer(180.into()),
            ));
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
        let is_turn =
            (turn - value).abs() <= (4.0 * (turn.abs().next_up() - turn.abs())).min(2e-15);
        Some(
            match radians.is_zero() || is_turn && (1.0..=4.0).contains(&quarters.abs()) {
                true => Angle::Pi(Rational::new((quarters as i64).into(), 2.into())),
                false => Angle::Radians(radians),
            },
        )
    }

    /// Returns the nearest double of its radians, to two ulps; none beyond doubles.
    pub fn radians(&self) -> Option<f64> {
        match self {
            Angle::Pi(multiple) => Some(multiple.to_f64()? * std::f64::consts::PI),
            Angle::Radians(radians) => radians.to_f64(),
        }
    }

    /// Returns sine and cosine, by those of an angle up to an eighth of a turn or of positive
    /// radians, so that angles share theirs.
    fn pair(&self, drawn: impl FnOnce(&Angle) -> [Number; 2]) -> [Number; 2] {
        let half = Rational::new(1.into(), 2.into());
        let (quarters, [sin, cos]) = match self {
            Angle::Radians(radians) if radians.is_negative() => {
                let [sin, cos] = drawn(&Angle::Radians(-radians));
                (0, [-sin, cos])
            }
            Angle::Radians(_) => (0, drawn(self)),
            Angle::Pi(multiple) => {
                let halves = multiple / &half;
                let whole = halves.floor().to_integer();
                let quarters: BigInt = (&whole % 4 + 4) % 4;
                let quarters = quarters.to_u8().unwrap_or(0);
                let rest = &halves - Rational::from_integer(whole);
                let pair = if rest.is_zero() {
                    [0.into(), 1.into()]
                } else if rest > half || rest == half && quarters % 2 == 1 {
                    let [sin, cos] = drawn(&Angle::Pi((Rational::one() - rest) * &half));
                    [cos, sin]
                } else {
                    drawn(&Angle::Pi(rest * &half))
                };
                (quarters, pair)
            }
        };
        match quarters {
            0 => [sin, cos],
            1 => [cos, -sin],
            2 => [-sin, -cos],
            _ => [-cos, sin],
        }
    }

    /// Returns the radians, in units of 2 to the power of −`bits`.
    pub(super) fn scaled(&self, bits: u32) -> BigInt {
        let one = BigInt::one() << bits;
        let scaled = |x: &Rational| (x * Rational::from_integer(one.clone())).to_integer();
        let arc = |under: u32| {
            // arctan 1/n
            let (mut power, mut sum, mut k) = (&one / under, BigInt::zero(), 1u32);
            while !power.is_zero() {
                let part = &power / k;
                sum = if k % 4 == 1 { sum + part } else { sum - part };
                (power, k) = (power / (under * under), k + 2);
            }
            sum
        };
        match self {
            Angle::Radians(x) => scaled(x),
            Angle::Pi(x) => (scaled(x) * (16 * arc(5) - 4 * arc(239))) >> bits,
        }
    }

    /// Returns sine and cosine to 2⁻³⁰⁰, in units of 2⁻³²⁰; none of angles beyond 8 rad, whose series loses more bits.
    pub(super) fn rounded(&self) -> Option<[BigInt; 2]> {
        let (one, radians) = (BigInt::one() << BITS, self.scaled(BITS));
        if radians.abs() > BigInt::from(8) << BITS {
            return None;
        }
        let (mut sums, mut term, mut k) = ([BigInt::zero(), BigInt::zero()], one.clone(), 0u32);
        while !term.is_zero() {
            let sum = &mut sums[1 - k as usize % 2];
            *sum = if k % 4 < 2 {
                &*sum + &term
            } else {
                &*sum - &term
            };
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
    rounded: OnceLock<Option<[Rational; 2]>>,
    double: OnceLock<Option<[f64; 2]>>,
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
                let both = [("sin", [power, 0]), ("cos", [0, power])];
                let both = both.into_iter().find(|(own, _)| *own == name)?.1;
                powers.push((Angle::read(angle)?, both));
                rest = &behind[end..];
            }
            (rest.is_empty() && total <= MOST_FACTORS).then_some((number(factor)?, powers))
        };
        (text.len() < MOST_BYTES).then_some(())?;
        let terms = text.split('+').map(term).collect::<Option<_>>();
        terms.map(Exact::new)
    }

    /// Returns a constant without angles as text.
    pub fn text(&self) -> Option<String> {
        match self.0.terms.as_slice() {
            [(factor, powers)] if powers.is_empty() => Some(factor.to_string()),
            _ => None,
        }
    }

    /// Rounds the constant with the sines that are known, to which it adds its own.
    pub fn settle(&self, known: &mut Sines) {
        self.0.rounded.get_or_init(|| self.rounded(known));
    }

    /// Returns a double, and how far the constant is from it at most; none if an angle is too far.
    pub fn double(&self) -> Option<[f64; 2]> {
        *self.0.double.get_or_init(|| self.nearest())
    }

    fn nearest(&self) -> Option<[f64; 2]> {
        let own = || self.rounded(&mut Sines::new());
        let [sum, slack] = self.0.rounded.get_or_init(own).as_ref()?;
        let value = sum.to_f64().filter(|value| value.is_finite())?;
        let off = (sum - Rational::from_float(value)?).abs() + slack;
        let radius = if off.is_zero() {
            0.0
        } else {
            off.to_f64()?.next_up()
        };
        Some([value, radius])
    }

    /// Returns a fraction, and how far it is off at most; none if an angle is too far.
    fn rounded(&self, known: &mut Sines) -> Option<[Rational; 2]> {
        if let [(factor, powers)] = self.0.terms.as_slice()
            && powers.is_empty()
        {
            return Some([factor.clone(), Rational::zero()]);
        }
        let one = BigInt::one() << PLACES;
        let (mut sum, mut slack) = (BigInt::zero(), BigInt::one());
        for (factor, powers) in &self.0.terms {
            let factor = factor.numer() * &one / factor.denom();
            let mut product = factor.clone();
            for (angle, powers) in powers {
                let own = known
                    .entry(angle.clone())
                    .or_insert_with(|| angle.rounded());
                for (value, power) in own.as_ref()?.iter().zip(powers) {
                    (0..*power).for_each(|_| product = (&product * value) >> BITS);
                }
            }
            // 64 factors at most, each off by 2⁻³⁰⁰, and as many products rounded.
            slack += (factor.abs() >> 280u32) + 128;
            sum += product;
        }
        let own = |scaled| Rational::new(scaled, one.clone());
        Some([own(sum), own(slack)])
    }

    /// Compares a literal with the nearest float; between two as near, the even one counts.
    pub fn is_nearest(&self, literal: f64, is_single: bool) -> bool {
        // Printed code has no zero with a sign.
        if literal == 0.0 && literal.is_sign_negative() {
            return false;
        }
        let own = || self.rounded(&mut Sines::new());
        let Some([sum, slack]) = self.0.rounded.get_or_init(own) else {
            return false;
        };
        // A number that is not zero does not vanish: others could be as large as it is small.
        if literal == 0.0 && !(sum.is_zero() && slack.is_zero()) {
            return false;
        }
        let float = |x: f64| Rational::from_float(x);
        let own = literal as f32;
        if is_single && f64::from(own) != literal {
            return false;
        }
        let (below, above, bits): (f64, f64, u64) = match is_single {
            true => (
                own.next_down().into(),
                own.next_up().into(),
                own.to_bits().into(),
            ),
            false => (literal.next_down(), literal.next_up(), literal.to_bits()),
        };
        let (Some(own), Some(below), Some(above)) = (float(literal), float(below), float(above))
        else {
            return false;
        };
        let twice = |x: &Rational| x + x;
        let low = twice(&(sum - slack)) - (&own + below);
        let high = (own + above) - twice(&(sum + slack));
        let is_tie = bits.is_multiple_of(2) && slack.is_zero();
        let fits = |room: Rational| room.is_positive() || is_tie && room.is_zero();
        fits(low) && fits(high)
    }
}

/// A point of a prime field: the residues of numbers, and of sines and cosines of angles.
pub struct Point {
    /// The prime of its field.
    pub prime: u64,
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
        Number::new(self.prime / 2 + 1, self.prime)
    }

    /// Returns a residue that was not drawn before.
    pub fn residue(&self) -> Number {
        self.draws.borrow_mut().residue(self.prime)
    }

    /// Returns a sine and a cosine that were not drawn before.
    pub fn pair(&self) -> [Number; 2] {
        self.draws.borrow_mut().pair(self.prime)
    }

    /// Returns the residue of a fraction.
    pub fn number(&self, value: &Rational) -> Number {
        let prime = BigInt::from(self.prime);
        let part = |x: &BigInt| {
            let value = ((x % &prime + &prime) % &prime).to_u64().unwrap_or(0);
            Number::new(value, self.prime)
        };
        part(value.numer()) / part(value.denom())
    }

    /// Returns sine and cosine of a constant angle: a point of the circle, drawn once.
    pub fn angle(&self, angle: &Angle) -> [Number; 2] {
        let drawn = |key: &Angle| {
            let mut angles = self.angles.borrow_mut();
            *angles.entry(key.clone()).or_insert_with(|| self.pair())
        };
        angle.pair(drawn)
    }

    /// Returns the residue of a constant.
    pub fn constant(&self, constant: &Exact) -> Number {
        let key = Arc::as_ptr(&constant.0);
        if let Some((_, known)) = self.constants.borrow().get(&key) {
            return *known;
        }
        let term = |(factor, powers): &Term| {
            let mut product = self.number(factor);
            for (angle, powers) in powers {
                for (own, power) in self.angle(angle).into_iter().zip(powers) {
                    product = (0..*power).fold(product, |all, _| all * own);
                }
            }
            product
        };
        let own = constant.0.terms.iter().map(term);
        let own = own.fold(0.into(), |a, b| a + b);
        // Kept with the constant, whose place is no other's as long as it is there.
        let mut known = self.constants.borrow_mut();
        known.insert(key, (constant.clone(), own));
        own
    }
}
