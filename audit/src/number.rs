//! Numbers that the equations are evaluated in, and numbers of a robot file.

use crate::fault::Fault;
use crate::interval::{SINE_ERROR, UNIT, sin_cos};
use crate::polynomial::{Polynomial, Work};

/// A number known to be at most `radius` from `value`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ball {
    /// The double.
    pub value: f64,
    /// How far off it is at most.
    pub radius: f64,
}

impl Ball {
    /// A double itself.
    pub fn exact(value: f64) -> Ball {
        Ball { value, radius: 0.0 }
    }

    /// Reads a decimal literal; a whole number below 2⁵³ is exact, any other is within
    /// an ulp of the double next to it.
    pub fn parse(literal: &str) -> Option<Ball> {
        let plain = literal.trim().replace('_', "");
        let value: f64 = plain.parse().ok()?;
        let digits = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
        if !plain.chars().all(digits) || value.abs() > 1e100 {
            return None;
        }
        let (whole, part) = plain.split_once('.').unwrap_or((&plain, ""));
        let is_whole = part.chars().all(|c| c == '0') && !whole.contains(['e', 'E']);
        let radius = match is_whole && value.abs() < 2f64.powi(53) {
            true => 0.0,
            false => (value.abs() * 2.0 * UNIT).next_up(),
        };
        Some(Ball { value, radius })
    }

    /// Reads a number or a fraction of two whole ones.
    pub fn parse_fraction(text: &str) -> Option<Ball> {
        let Some((over, under)) = text.split_once('/') else {
            return Ball::parse(text);
        };
        let (over, under) = (Ball::parse(over)?, Ball::parse(under)?);
        let whole = over.radius == 0.0 && under.radius == 0.0 && under.value != 0.0;
        let value = over.value / under.value;
        let radius = (value.abs() * 2.0 * UNIT).next_up();
        whole.then_some(Ball { value, radius })
    }
}

/// An angle: how many quarter turns if that is a whole number, and its value in rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angle {
    /// A whole number of quarter turns.
    pub quarters: Option<i64>,
    /// In rad.
    pub radians: Ball,
}

impl Angle {
    /// A number of quarter turns.
    fn quarters(count: Ball) -> Angle {
        let half_pi = std::f64::consts::FRAC_PI_2;
        let value = count.value * half_pi;
        let radius = (4.0 * UNIT * value.abs() + 2.0 * count.radius).next_up();
        let whole = count.radius == 0.0 && count.value.fract() == 0.0;
        Angle {
            quarters: whole.then_some(count.value as i64),
            radians: Ball { value, radius },
        }
    }

    /// Radians as a number. One within 4 ulp of one to four quarter turns, and within
    /// 2e-15, is these: files print π/2 so, and the project reads it so.
    pub fn number(radians: Ball) -> Option<Angle> {
        let count = (radians.value / std::f64::consts::FRAC_PI_2).round();
        let turn = Angle::quarters(Ball::exact(count));
        let ulp = turn.radians.value.abs().next_up() - turn.radians.value.abs();
        let near = (turn.radians.value - radians.value).abs() <= (4.0 * ulp).min(2e-15);
        let is_turn = near && (radians == Ball::default() || (1.0..=4.0).contains(&count.abs()));
        match is_turn {
            true => Some(turn),
            false => (radians.value.abs() < 1000.0).then_some(Angle { quarters: None, radians }),
        }
    }

    /// Reads `"pi/2"`, `"-3*pi/4"`, `"90deg"` or a fraction of radians.
    pub fn parse(text: &str) -> Option<Angle> {
        let text = text.trim();
        let in_quarters = |over: Ball, under: Ball| {
            let value = over.value / under.value;
            let exact = value.fract() == 0.0 && value * under.value == over.value;
            let radius = match exact && over.radius == 0.0 {
                true => 0.0,
                false => (value.abs() * 4.0 * UNIT + over.radius / under.value.abs()).next_up(),
            };
            (under.radius == 0.0 && value.abs() < 600.0)
                .then_some(Angle::quarters(Ball { value, radius }))
        };
        if let Some(degrees) = text.strip_suffix("deg") {
            return in_quarters(Ball::parse(degrees)?, Ball::exact(90.0));
        }
        let Some((before, after)) = text.split_once("pi") else {
            return Angle::number(Ball::parse_fraction(text).filter(|_| text.contains('/'))?);
        };
        let factor = match before.trim() {
            "" | "+" => Ball::exact(1.0),
            "-" => Ball::exact(-1.0),
            factor => Ball::parse(factor.strip_suffix('*')?)?,
        };
        let under = match after.trim() {
            "" => Ball::exact(1.0),
            under => Ball::parse(under.strip_prefix('/')?)?,
        };
        // Twice as many quarters as half turns; doubling is exact.
        let twice = Ball { value: 2.0 * factor.value, radius: 2.0 * factor.radius };
        in_quarters(twice, under)
    }

    /// Its sine and cosine.
    pub fn sin_cos(self) -> (Ball, Ball) {
        if let Some(quarters) = self.quarters {
            let sine = |n: i64| Ball::exact([0.0, 1.0, 0.0, -1.0][n.rem_euclid(4) as usize]);
            return (sine(quarters), sine(quarters + 1));
        }
        let (sin, cos) = sin_cos(self.radians.value);
        let radius = (self.radians.radius + SINE_ERROR).next_up();
        (Ball { value: sin, radius }, Ball { value: cos, radius })
    }
}

/// What the recursion computes with: polynomials for the proof, doubles for states.
pub trait Number: Clone {
    /// A constant.
    fn constant(value: Ball) -> Self;
    /// The sum.
    fn plus(&self, other: &Self) -> Self;
    /// The opposite.
    fn negated(&self) -> Self;
    /// The product.
    ///
    /// # Errors
    /// As of [`Polynomial::times`].
    fn times(&self, other: &Self, work: &mut Work) -> Result<Self, Fault>;
}

impl Number for f64 {
    fn constant(value: Ball) -> f64 {
        value.value
    }
    fn plus(&self, other: &f64) -> f64 {
        self + other
    }
    fn negated(&self) -> f64 {
        -self
    }
    fn times(&self, other: &f64, _: &mut Work) -> Result<f64, Fault> {
        Ok(self * other)
    }
}

impl Number for Polynomial {
    fn constant(value: Ball) -> Polynomial {
        Polynomial::constant(value.value, value.radius)
    }
    fn plus(&self, other: &Polynomial) -> Polynomial {
        Polynomial::plus(self, other)
    }
    fn negated(&self) -> Polynomial {
        self.clone().negated()
    }
    fn times(&self, other: &Polynomial, work: &mut Work) -> Result<Polynomial, Fault> {
        Polynomial::times(self, other, work)
    }
}
