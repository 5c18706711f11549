//! The inputs of a program.

use core::fmt;

use dalembert_model::equations::SinCosPair;
use dalembert_model::scalar::Scalar;

use crate::function::Argument;

/// A sum of joint angles with signs, such as q₂ + q₃ or q₄ − q₅.
///
/// One bit a joint: a robot has at most 64.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct AngleSum {
    plus: u64,
    minus: u64,
}

impl AngleSum {
    /// Returns the angle of one joint (zero-based, below 64).
    pub fn joint(joint: usize) -> Self {
        debug_assert!(joint < 64);
        AngleSum {
            plus: 1u64.wrapping_shl(joint as u32),
            minus: 0,
        }
    }

    /// Returns the sum with one more joint; `None` if the joint is in it already.
    pub fn with(self, joint: usize, negative: bool) -> Option<Self> {
        let bit = 1u64.checked_shl(joint as u32)?;
        let mut sum = self;
        let side = if negative {
            &mut sum.minus
        } else {
            &mut sum.plus
        };
        *side |= bit;
        ((self.plus | self.minus) & bit == 0).then_some(sum)
    }

    /// Returns the joints (zero-based, ascending) and whether each is subtracted.
    pub fn terms(self) -> impl Iterator<Item = (usize, bool)> {
        (0..64)
            .filter(move |joint| (self.plus | self.minus) >> joint & 1 == 1)
            .map(move |joint| (joint, self.minus >> joint & 1 == 1))
    }

    /// Returns the sine and cosine of the sum from those of the joints' angles.
    pub fn pair<S: Scalar>(self, mut of: impl FnMut(usize) -> SinCosPair<S>) -> SinCosPair<S> {
        let mut sum = SinCosPair {
            sin: S::zero(),
            cos: S::one(),
        };
        for (joint, negative) in self.terms() {
            let mut pair = of(joint);
            if negative {
                pair.sin = pair.sin.neg();
            }
            sum = sum.compose(&pair);
        }
        sum
    }

    /// Returns the additions that forming the angle takes.
    pub fn additions(self) -> usize {
        (self.plus | self.minus).count_ones() as usize - 1
    }
}

impl fmt::Display for AngleSum {
    /// Writes one-based joint numbers: `2p3` for q₂ + q₃, `4m5` for q₄ − q₅.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (joint, negative)) in self.terms().enumerate() {
            match (index, negative) {
                (0, false) => {}
                (_, false) => f.write_str("p")?,
                (_, true) => f.write_str("m")?,
            }
            write!(f, "{}", joint + 1)?;
        }
        Ok(())
    }
}

impl core::str::FromStr for AngleSum {
    type Err = ();

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, ()> {
        let mut sum: Option<AngleSum> = None;
        let mut rest = text;
        while !rest.is_empty() {
            let (negative, digits) = match (&sum, rest.as_bytes()[0]) {
                (None, _) => (false, rest),
                (Some(_), b'p') => (false, &rest[1..]),
                (Some(_), b'm') => (true, &rest[1..]),
                _ => return Err(()),
            };
            let end = digits.find(['p', 'm']).unwrap_or(digits.len());
            let joint: usize = digits[..end].parse().map_err(|_| ())?;
            let joint = joint.checked_sub(1).filter(|&joint| joint < 64).ok_or(())?;
            sum = Some(match sum {
                None => AngleSum::joint(joint),
                Some(sum) => sum.with(joint, negative).ok_or(())?,
            });
            rest = &digits[end..];
        }
        sum.ok_or(())
    }
}

/// An input of a program. Joints are zero-based.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Input {
    /// The sine of an angle.
    Sin(AngleSum),
    /// The cosine of an angle.
    Cos(AngleSum),
    /// 1/√(q̇² + w²) of a joint with Coulomb friction, w being its width.
    PerSpeed(usize),
    /// An entry of an argument, of most a joint's; of q that of a prismatic joint.
    Entry(Argument, usize),
}

impl Input {
    /// Returns the argument that it is made from.
    pub fn argument(self) -> Argument {
        match self {
            Input::Sin(_) | Input::Cos(_) => Argument::Position,
            Input::PerSpeed(_) => Argument::Velocity,
            Input::Entry(argument, _) => argument,
        }
    }

    /// Returns the angle, if it is the sine or cosine of one.
    pub fn angle(self) -> Option<AngleSum> {
        match self {
            Input::Sin(angle) | Input::Cos(angle) => Some(angle),
            _ => None,
        }
    }
}
