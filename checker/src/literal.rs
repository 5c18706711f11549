//! Numbers and angles of a robot file, as intervals about doubles.

use serde::Deserialize;

use crate::fault::Fault;
use crate::interval::{FARTHEST, SINE_ERROR, UNIT, sin_cos};
use crate::number::Real;

/// A number or an angle as it is written.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum Literal {
    Whole(i64),
    Decimal(f64),
    Text(String),
}

impl Default for Literal {
    fn default() -> Literal {
        Literal::Whole(0)
    }
}

/// An angle, its sine and cosine exact where it is a whole number of quarter turns.
#[derive(Clone, Copy, Debug)]
pub struct Angle {
    /// In rad; the nearest double.
    pub radians: f64,
    /// Its sine.
    pub sin: Real,
    /// Its cosine.
    pub cos: Real,
}

impl Angle {
    fn quarters(count: i64) -> Angle {
        let sine = |n: i64| [0.0, 1.0, 0.0, -1.0][n.rem_euclid(4) as usize];
        let exact = |n: i64| real(sine(n), 0.0);
        let radians = count as f64 * std::f64::consts::FRAC_PI_2;
        Angle {
            radians,
            sin: exact(count),
            cos: exact(count + 1),
        }
    }

    /// Returns an angle that is so near to a double.
    fn near(radians: f64, radius: f64) -> Option<Angle> {
        let (sin, cos) = sin_cos(radians);
        let radius = radius + SINE_ERROR;
        let (sin, cos) = (real(sin, radius), real(cos, radius));
        (radians.abs() < FARTHEST).then_some(Angle { radians, sin, cos })
    }
}

impl Literal {
    pub(crate) fn is_zero(&self) -> bool {
        matches!(self, Literal::Whole(0)) || matches!(self, Literal::Decimal(x) if *x == 0.0)
    }

    /// Returns a number in decimal, or a fraction of two whole ones: the nearest double, and an
    /// ulp for what it is off. (A decimal below the least double counts as zero.)
    fn number(&self) -> Option<(f64, f64)> {
        let value = match self {
            Literal::Whole(whole) if whole.abs() < 1 << 53 => return Some((*whole as f64, 0.0)),
            Literal::Whole(whole) => *whole as f64,
            Literal::Decimal(value) => *value,
            Literal::Text(text) => {
                let (over, under) = text.split_once('/')?;
                over.trim().parse::<i32>().ok()? as f64 / under.trim().parse::<u32>().ok()? as f64
            }
        };
        let ulp = (2.0 * UNIT * value.abs()).next_up();
        let radius = if value == 0.0 { 0.0 } else { ulp };
        (value.abs() < 1e100).then_some((value, radius))
    }

    pub(crate) fn real(&self, key: &str) -> Result<Real, Fault> {
        let read = self.number().map(|(value, radius)| real(value, radius));
        read.ok_or_else(|| Fault::robot(key, "expected a number in decimal, below 1e100"))
    }

    pub(crate) fn reals<const K: usize>(
        list: &[Literal; K],
        key: &str,
    ) -> Result<[Real; K], Fault> {
        let mut all = [Real::default(); K];
        for (one, literal) in all.iter_mut().zip(list) {
            *one = literal.real(key)?;
        }
        Ok(all)
    }

    pub(crate) fn double(&self, key: &str) -> Result<f64, Fault> {
        Ok(self.real(key)?.value)
    }

    /// Returns a number that may be missing, and then is NaN.
    pub(crate) fn optional(literal: Option<&Literal>, key: &str) -> Result<f64, Fault> {
        literal.map_or(Ok(f64::NAN), |literal| literal.double(key))
    }

    pub(crate) fn angle(&self, key: &str) -> Result<Angle, Fault> {
        let read = match self {
            Literal::Text(text) if !text.contains('/') || text.contains("pi") => turns(text.trim()),
            _ => self.number().and_then(|(value, radius)| {
                let count = (value / std::f64::consts::FRAC_PI_2).round();
                let turn = Angle::quarters(count as i64);
                // Files print π/2 as a decimal, and the project takes one within 4 ulp of
                // a quarter turn for it, up to a whole turn.
                let ulp = turn.radians.abs().next_up() - turn.radians.abs();
                let near = (turn.radians - value).abs() <= (4.0 * ulp).min(2e-15);
                let is_turn = self.is_zero() || near && (1.0..=4.0).contains(&count.abs());
                let turn = is_turn.then_some(turn);
                turn.or_else(|| Angle::near(value, radius))
            }),
        };
        let is_far = self
            .number()
            .is_some_and(|(value, _)| value.abs() >= FARTHEST);
        read.ok_or_else(|| match is_far {
            true => Fault::robot(key, "angles up to 1000 rad are checked: limit the box"),
            false => Fault::robot(key, "expected an angle: rad, \"pi/2\" or \"90deg\""),
        })
    }
}

fn real(value: f64, radius: f64) -> Real {
    Real { value, radius }
}

/// Reads `"pi/2"`, `"-3*pi/4"`, `"90deg"`.
fn turns(text: &str) -> Option<Angle> {
    let (factor, under) = match text.strip_suffix("deg") {
        Some(degrees) => (degrees.trim(), 180),
        None => {
            let (before, after) = text.split_once("pi")?;
            let under = match after.trim() {
                "" => 1,
                after => after.strip_prefix('/')?.trim().parse().ok()?,
            };
            match before.trim() {
                "" | "+" => ("1", under),
                "-" => ("-1", under),
                before => (before.strip_suffix('*')?.trim(), under),
            }
        }
    };
    if let Ok(factor) = factor.parse::<i32>()
        && (1..1 << 20).contains(&under)
        && 2 * i64::from(factor) % under == 0
    {
        return Some(Angle::quarters(2 * i64::from(factor) / under));
    }
    let radians = factor.parse::<f64>().ok()? * std::f64::consts::PI / under as f64;
    (under > 0).then(|| Angle::near(radians, 8.0 * UNIT * radians.abs()))?
}
