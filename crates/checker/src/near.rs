//! The text of what divides against the exact program, at a few random states.
//!
//! Near to where a divisor vanishes, rounding has no bound, and over the box there may be none at
//! all. So a text could add numbers beside which the robot's vanish, and take them away again. It is
//! computed in its scalar, and the exact program to so many digits that doubles hide none of them.

use num_bigint::BigInt;
use num_rational::BigRational as Rational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::cost::drawn;
use crate::identity::exact::{Exact, Sines, fixed};
use crate::identity::number::Draws;
use crate::identity::setting::Setting;
use crate::interval::sin_cos;
use crate::program::{Operand, Program};
use crate::read::{Function, Head};
use crate::rounding::Ranges;

const STATES: usize = 8;
/// Errors are at most 1/SHARE of a field's largest entry, at more than half of the states.
const SHARE: u32 = 8;
const BITS: u32 = 1280;
const MOST_BITS: u64 = 1 << 13;

/// A number in units of 2⁻¹²⁸⁰; none where something is divided by zero, or is too large.
type Long = Option<BigInt>;

/// A state: what is given, sine and cosine of each joint, and 1/√(q̇² + w²) of those with friction.
struct At {
    given: Ranges,
    sines: Vec<[BigInt; 2]>,
    speeds: Vec<Long>,
}

fn double(own: &BigInt) -> Option<f64> {
    Rational::new_raw(own.clone(), BigInt::one() << BITS).to_f64()
}

fn long(own: f64) -> Long {
    Some(fixed(&Rational::from_float(own)?, BITS))
}

fn over(a: &BigInt, b: &BigInt) -> Long {
    (!b.is_zero()).then(|| (a << BITS) / b)
}

impl At {
    /// Returns the state that is given: sines and cosines are those of a point of the circle.
    fn new(given: Ranges, setting: &Setting) -> Option<At> {
        let one = BigInt::one() << BITS;
        let pair = |[angle, _]: &[f64; 2]| {
            let (sin, cos) = sin_cos(0.5 * angle);
            let half = long(sin / cos)?;
            let square = (&half * &half) >> BITS;
            let sum = &one + &square;
            Some([over(&(half * 2), &sum)?, over(&(&one - square), &sum)?])
        };
        let speed = |joint: usize| {
            let width = setting.square_of_width(joint)?;
            let rate = long(given[1].get(joint)?[0])?;
            let [width, _] = width.settle(&mut Sines::new())?;
            let square = ((&rate * &rate) >> BITS) + fixed(width, BITS);
            over(&one, &(square << BITS).sqrt())
        };
        Some(At {
            sines: given[0].iter().map(pair).collect::<Option<_>>()?,
            speeds: (0..setting.joints()).map(speed).collect(),
            given,
        })
    }

    fn leaf<C>(&self, own: &Operand<C>) -> Long {
        match own {
            Operand::Entry(place, index) => long(self.given.get(*place)?.get(*index)?[0]),
            Operand::Sine(joint, is_sine) => {
                let [sin, cos] = self.sines.get(*joint)?;
                Some(if *is_sine { sin } else { cos }.clone())
            }
            Operand::Speed(joint) => self.speeds.get(*joint)?.clone(),
            Operand::Constant(_) | Operand::Step(_) => None,
        }
    }

    fn exact(&self, program: &Program<Exact>) -> Option<Vec<Long>> {
        let leaf = |own: &Operand<Exact>| match own {
            Operand::Constant(own) => {
                let [value, _] = own.settle(&mut Sines::new())?;
                Some(Some(fixed(value, BITS)))
            }
            own => Some(self.leaf(own)),
        };
        let apply = |operation: char, a: Long, b: Long| {
            let (a, b) = (a?, b?);
            let value = match operation {
                '+' => a + b,
                '-' => a - b,
                '/' => over(&a, &b)?,
                _ => (a * b) >> BITS,
            };
            Some(value).filter(|own| own.bits() < MOST_BITS)
        };
        program.run(leaf, apply, |own: Long| own.map(|own| -own))
    }

    fn found(&self, program: &Program<f64>, is_single: bool) -> Option<Vec<f64>> {
        let round = |own: f64| {
            if is_single {
                f64::from(own as f32)
            } else {
                own
            }
        };
        let leaf = |own: &Operand<f64>| match own {
            Operand::Constant(literal) => Some(*literal),
            own => double(&self.leaf(own)?).map(round),
        };
        let apply = |operation: char, a: f64, b: f64| match operation {
            '+' => round(a + b),
            '-' => round(a - b),
            '/' => round(a / b),
            '*' => round(a * b),
            // Its sum is next, and rounds.
            _ => a * b,
        };
        program.run(leaf, apply, |own: f64| -own)
    }
}

/// Asks for agreement at most of the states, which are drawn from these texts.
pub(crate) fn is_near(
    read: &Function,
    exact: &Program<Exact>,
    head: &Head,
    ranges: &Ranges,
    setting: &Setting,
    texts: &[&str],
) -> bool {
    let mut draws = Draws::new(texts);
    let mut is_near = || {
        let at = At::new(drawn(ranges, &mut draws, head.is_single), setting)?;
        let mut found = at.found(&read.program, head.is_single)?.into_iter();
        let mut exact = at.exact(exact)?.into_iter();
        for (_, shape) in &head.fields {
            let (mut size, mut off) = (BigInt::zero(), BigInt::zero());
            for _ in 0..shape.iter().product() {
                let exact = exact.next()??;
                off = off.max((long(found.next()?)? - &exact).abs());
                size = size.max(exact.abs());
            }
            (off * SHARE <= size).then_some(())?;
        }
        Some(())
    };
    let near = (0..STATES).filter(|_| is_near().is_some()).count();
    2 * near > STATES
}
