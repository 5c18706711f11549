//! Taking whole turns off an angle, without branches.
//!
//! k = (q·ι + M) − M with ι ≈ 1/2π and M = 1.5·2^(p−1): next to M the floats
//! are the integers, so k is one. Then r = (q − k·A) − k·B, where A is 2π in
//! few bits, so that k·A is exact, and B the rest of it.

use dalembert_model::number::{Angle, Rational, Rounded};
use num_traits::float::FloatCore;

use crate::dag::{Id, Node};
use crate::program::kernel::{Kernel, KernelWriter};
use crate::program::scalar_type::underflow;
use crate::program::{Literal, Operation, ScalarType};
use crate::sincos::interval::Interval;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rest {
    pub range: Interval,
    /// Its distance from the angle less whole turns.
    pub error: f64,
}

fn digits(scalar: ScalarType) -> i32 {
    scalar.of(f64::MANTISSA_DIGITS, f32::MANTISSA_DIGITS) as i32
}

fn magic(scalar: ScalarType) -> f64 {
    1.5 * libm::exp2(f64::from(digits(scalar) - 1))
}

fn turn() -> Rational {
    Angle::right_angles(4).radians()
}

/// Returns ι, A and B.
pub(crate) fn constants(scalar: ScalarType) -> [f64; 3] {
    let round = |x: &Rational| scalar.round_rational(x);
    // Turns up to 2^21 in f64 and 2^8 in f32 are subtracted exactly.
    let kept = scalar.of(32, 16);
    let (whole, grid) = (turn(), libm::exp2(f64::from(kept - 3)));
    let coarse = libm::floor(f64::nearest_rational(&whole) * grid) / grid;
    let exact = Rational::from_float(coarse).unwrap_or_default();
    [round(&whole.recip()), coarse, round(&(whole - exact))]
}

pub(crate) fn write(
    kernel: &mut KernelWriter,
    [inverse, much, little]: [f64; 3],
    scalar: ScalarType,
) -> Id {
    let (angle, inverse) = (kernel.angle(), kernel.literal(inverse));
    let turns = kernel.mul(angle, inverse);
    let magic = kernel.literal(magic(scalar));
    let shifted = kernel.apply(Operation::Add, [turns, magic]);
    let k = kernel.apply(Operation::Sub, [shifted, magic]);
    [much, little].into_iter().fold(angle, |rest, part| {
        let part = kernel.literal(part);
        let part = kernel.mul(k, part);
        kernel.apply(Operation::Sub, [rest, part])
    })
}

pub(crate) fn split(kernel: &Kernel, scalar: ScalarType) -> Option<([f64; 3], Kernel)> {
    let dag = &kernel.dag;
    let literal = |place: usize| match dag.node(dag.operations().nth(place)?.2[1]) {
        Node::Constant(Literal(value)) => Some(*value),
        _ => None,
    };
    let constants = [literal(0)?, literal(3)?, literal(5)?];
    let mut expected = KernelWriter::default();
    let rest = write(&mut expected, constants, scalar);
    let expected = expected.finish(Vec::new());
    if dag.nodes.get(..expected.nodes.len()) != Some(&expected.nodes) {
        return None;
    }
    // Nothing else may read what came before, but for its literals.
    let is_left = |id: Id| match dag.node(id) {
        Node::Constant(_) => true,
        Node::Apply(..) => id >= rest,
        Node::Input(_) => false,
    };
    let operations = dag.nodes.iter().skip(expected.nodes.len());
    let mut reads = operations
        .filter_map(Node::operands)
        .flatten()
        .chain(dag.outputs.iter().map(|edge| edge.node));
    if !dag.is_straight() || !reads.all(is_left) {
        return None;
    }
    let mut dag = dag.clone();
    dag.nodes[rest as usize] = Node::Input(crate::program::kernel::Angle);
    let left = Kernel {
        need: kernel.need,
        dag: dag.map(|literal| *literal, |angle| *angle),
    };
    Some((constants, left))
}

pub(crate) fn rest(
    [inverse, much, little]: [f64; 3],
    scalar: ScalarType,
    range: Interval,
) -> Option<Rest> {
    let u = Interval::point(scalar.unit_roundoff());
    let eta = Interval::point(underflow(scalar));
    let point = Interval::point;
    let reach = point(range.magnitude());
    let most = libm::exp2(f64::from(digits(scalar) - 2));
    let whole = turn();
    let exact = |x: f64| Rational::from_float(x);
    let off = |x: &Rational| point(Interval::rational(x).magnitude());
    let wrong = off(&(exact(inverse)? - whole.recip()));
    let scaled = reach * point(inverse.abs());
    let counted = reach * wrong + u * scaled + eta;
    if scaled.high() + 1.0 > most {
        return None;
    }
    // k is an integer within a half of q·ι as computed.
    let half = counted + point(0.5);
    let most_turns = reach * Interval::rational(&whole.recip()) + half;
    let turns = point(libm::floor(most_turns.high()));
    let left = Interval::rational(&whole) * half;
    // k·A, q − k·A, k·B and the last difference are each rounded once.
    let big = turns * point(much.abs());
    let first = match is_exact(much, turns.high(), scalar) {
        true => Interval::ZERO,
        false => u * big + eta,
    };
    let away = turns * off(&(&whole - exact(much)?));
    let second = u * (left + away + first);
    let third = u * turns * point(little.abs()) + eta;
    let missing = turns * off(&(&whole - exact(much)? - exact(little)?));
    let before = missing + first + second + third;
    let error = before + u * (left + before);
    let most = left + error;
    Some(Rest {
        range: Interval::symmetric(most.high()),
        error: error.high(),
    })
}

fn is_exact(x: f64, turns: f64, scalar: ScalarType) -> bool {
    let (mantissa, exponent, _) = FloatCore::integer_decode(x);
    let bits = 64 - (mantissa >> mantissa.trailing_zeros().min(63)).leading_zeros() as i32;
    let spare = digits(scalar) - bits;
    // Far from the ends of the exponents: neither overflow nor subnormals.
    let plain = (-100..100).contains(&(i32::from(exponent) + 53));
    plain && spare >= 0 && turns <= libm::exp2(f64::from(spare))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sincos::tests::alone;

    fn reduced(scalar: ScalarType) -> Kernel {
        let mut kernel = KernelWriter::default();
        let rest = write(&mut kernel, constants(scalar), scalar);
        alone(kernel, rest)
    }

    #[test]
    fn the_rest_is_as_near_as_proved() {
        let mut random = crate::random::Random::new(5);
        for (scalar, reach) in [(ScalarType::F64, 1e6), (ScalarType::F32, 1e3)] {
            let kernel = reduced(scalar);
            let (constants, left) = split(&kernel, scalar).unwrap();
            assert!(matches!(left.dag.nodes[..], [Node::Input(_)]));
            let rest = rest(constants, scalar, Interval::symmetric(reach)).unwrap();
            let u = scalar.unit_roundoff();
            let most = std::f64::consts::PI * 1.0001;
            assert!(rest.error < 8.0 * u && rest.range.high() < most);
            for _ in 0..2000 {
                let q = reach * (2.0 * random.unit() - 1.0);
                let (q, r) = match scalar {
                    ScalarType::F64 => (q, kernel.run(q).0),
                    ScalarType::F32 => (f64::from(q as f32), kernel.run(q as f32).0.into()),
                };
                assert!(rest.range.contains(r), "{q} {r}");
                let exact = |x| Rational::from_float(x).unwrap();
                let turns = ((exact(q) - exact(r)) / turn()).round();
                let off = exact(q) - turns * turn() - exact(r);
                assert!(f64::nearest_rational(&off).abs() <= rest.error, "{q}");
            }
        }
    }

    #[test]
    fn what_is_no_reduction_is_none() {
        let kernel = reduced(ScalarType::F64);
        assert!(split(&kernel, ScalarType::F32).is_none());
        let mut other = kernel.clone();
        other.dag.nodes[3] = Node::Constant(Literal(1.0));
        assert!(split(&other, ScalarType::F64).is_none());
        // A reader of the whole angle has not taken the turns off.
        let mut writer = KernelWriter::default();
        let left = write(&mut writer, constants(ScalarType::F64), ScalarType::F64);
        let angle = writer.angle();
        let product = writer.mul(left, angle);
        assert!(split(&alone(writer, product), ScalarType::F64).is_none());
        let (mut constants, _) = split(&kernel, ScalarType::F64).unwrap();
        let range = Interval::symmetric(100.0);
        assert!(rest(constants, ScalarType::F64, Interval::symmetric(1e17)).is_none());
        constants[2] *= 1.5;
        assert!(rest(constants, ScalarType::F64, range).unwrap().error > 1e-9);
    }
}
