//! The kernels to choose from.
//!
//! About a multiple of π/2 a sine is odd or even, so every other coefficient vanishes; about the
//! middle of a narrow range, of few terms, the whole polynomial may be shorter. Halving the angle h
//! times shrinks the range: with s_h = λ_h·sin(x/2^h), c_h = λ_h·cos(x/2^h), λ_0 = 1 and λ_h =
//! √(2·λ_(h−1)),
//!
//! s_(h−1) = s_h·c_h, c_(h−1) = λ_(h−1) − s_h²,
//!
//! so that doubling takes two multiplications and a subtraction: the factors
//! of sin 2x = 2 sin x cos x and cos 2x = 1 − 2 sin² x are in the fits.

use std::fmt;

use dalembert_model::number::{Angle, Rational};
use num_bigint::BigInt;
use num_traits::One;

use super::reduction;
use super::series::{MinimaxFit, Wave};
use crate::dag::{Edge, Node};
use crate::program::kernel::{Kernel, KernelWriter, SinCosUse};
use crate::program::{Literal, Operation, ScalarType};

/// The angle at which a polynomial's variable is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Centre {
    /// At this multiple of π/2.
    Quarter(i32),
    /// Anywhere.
    At(f64),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Form {
    /// True if whole turns are taken off first.
    pub reduced: bool,
    pub centre: Centre,
    pub halvings: u32,
    /// The degrees of the fits to sine and cosine.
    pub degrees: [usize; 2],
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.reduced {
            f.write_str("less whole turns, ")?;
        }
        match self.centre {
            Centre::Quarter(0) => {}
            Centre::Quarter(k) => write!(f, "about {}, ", Angle::right_angles(k.into()))?,
            Centre::At(x) => write!(f, "about {x:?}, ")?,
        }
        match self.halvings {
            0 => {}
            1 => f.write_str("half the angle, ")?,
            h => write!(f, "the angle over {}, ", 1u64 << h)?,
        }
        write!(f, "degrees {} and {}", self.degrees[0], self.degrees[1])
    }
}

impl Form {
    /// Returns its kernel; `fit` is of the form's centre and halvings. Without a fit
    /// every coefficient is one: the kernel has the right number of operations.
    pub fn kernel(&self, fit: Option<&MinimaxFit>, need: SinCosUse, scalar: ScalarType) -> Kernel {
        let mut kernel = KernelWriter::default();
        let rest = match self.reduced {
            true => reduction::write(&mut kernel, reduction::constants(scalar), scalar),
            false => kernel.angle(),
        };
        let x = match self.centre {
            Centre::Quarter(0) => rest,
            Centre::Quarter(k) => {
                let angle = Angle::right_angles(k.into()).radians();
                kernel.add_literal(rest, -scalar.round_rational(&angle))
            }
            Centre::At(x) => kernel.add_literal(rest, -x),
        };
        let lambdas = factors(self.halvings);
        let coefficients = |wave: Wave, degree: usize| match fit {
            Some(fit) => fit.coefficients(wave, degree, &lambdas[self.halvings as usize], scalar),
            None => vec![1.0; degree + 1],
        };
        let sine = coefficients(Wave::Sin, self.degrees[0]);
        let cosine = coefficients(Wave::Cos, self.degrees[1]);
        let (mut s, mut c) = match self.centre {
            Centre::At(_) => (kernel.horner(x, &sine), kernel.horner(x, &cosine)),
            Centre::Quarter(_) => {
                let square = kernel.mul(x, x);
                let odd: Vec<f64> = sine.into_iter().skip(1).step_by(2).collect();
                let even: Vec<f64> = cosine.into_iter().step_by(2).collect();
                let (p, c) = (kernel.horner(square, &odd), kernel.horner(square, &even));
                (kernel.mul(x, p), c)
            }
        };
        for level in (0..self.halvings as usize).rev() {
            let squared = kernel.mul(s, s);
            let product = kernel.mul(s, c);
            let lambda = kernel.literal(scalar.round_rational(&lambdas[level]));
            (s, c) = (product, kernel.apply(Operation::Sub, [lambda, squared]));
        }
        // Over narrow ranges a result may be a constant, whose sign is a literal's: as
        // such it is read back.
        let mut value = |negative, node| match *kernel.node(node) {
            Node::Constant(Literal(x)) if negative => Edge::from(kernel.literal(-x)),
            _ => Edge { node, negative },
        };
        let quarter = |k: i32| k.rem_euclid(4);
        let results = match self.centre {
            Centre::Quarter(k) if quarter(k) == 1 => [value(false, c), value(true, s)],
            Centre::Quarter(k) if quarter(k) == 2 => [value(true, s), value(true, c)],
            Centre::Quarter(k) if quarter(k) == 3 => [value(true, c), value(false, s)],
            _ => [value(false, s), value(false, c)],
        };
        kernel.kernel(need, results)
    }

    /// Estimates the error of the form: the fits' errors through the doublings.
    pub fn estimate(&self, fit: &MinimaxFit, need: SinCosUse) -> f64 {
        let mut s = fit.tail(Wave::Sin, self.degrees[0]);
        let mut c = fit.tail(Wave::Cos, self.degrees[1]);
        for _ in 0..self.halvings {
            (s, c) = (2.0 * s.max(c), 4.0 * s);
        }
        let swaps = matches!(self.centre, Centre::Quarter(k) if k % 2 != 0);
        let (sin, cos) = if swaps { (c, s) } else { (s, c) };
        let wanted = |needed, error| if needed { error } else { 0.0 };
        f64::max(wanted(need.sin, sin), wanted(need.cos, cos))
    }
}

/// Returns λ_0 … λ_h to 40 digits, which is enough: the proof is of the literals.
fn factors(halvings: u32) -> Vec<Rational> {
    const BITS: u32 = 140;
    let mut factors = vec![Rational::one()];
    for _ in 0..halvings {
        let last = &factors[factors.len() - 1];
        let square: BigInt =
            (last * Rational::from_integer(BigInt::one() << (2 * BITS + 1))).to_integer();
        factors.push(Rational::new(square.sqrt(), BigInt::one() << BITS));
    }
    factors
}
