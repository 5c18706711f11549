//! Kernels against libm, and their proofs against samples.

use super::choose::{Candidates, KernelChoice};
use super::proof::prove;
use super::*;
use crate::dag::{Edge, Id, Node};
use crate::program::Literal;
use crate::program::kernel::{Kernel, KernelWriter, SinCosUse};
use crate::random::Random;

const BOTH: SinCosUse = SinCosUse::BOTH;

pub(super) fn alone(kernel: KernelWriter, node: Id) -> Kernel {
    let need = SinCosUse {
        sin: true,
        cos: false,
    };
    kernel.kernel(need, [Edge::from(node); 2])
}

fn largest_errors(kernel: &Kernel, scalar: ScalarType, range: Interval) -> Errors {
    let mut random = Random::new(11);
    let mut worst = Errors::default();
    for i in 0..4000 {
        let t = if i < 2 { f64::from(i) } else { random.unit() };
        let q = (range.low() + range.width() * t).clamp(range.low(), range.high());
        let (q, (s, c)) = match scalar {
            ScalarType::F64 => (q, kernel.run(q)),
            ScalarType::F32 => {
                let q = q as f32;
                let (s, c) = kernel.run(q);
                (f64::from(q), (f64::from(s), f64::from(c)))
            }
        };
        if !range.contains(q) {
            continue;
        }
        let (sin, cos) = libm::sincos(q);
        worst.sin = worst.sin.max((s - sin).abs());
        worst.cos = worst.cos.max((c - cos).abs());
    }
    worst
}

fn range(low: f64, high: f64) -> Interval {
    Interval::new(low, high).unwrap()
}

fn cheapest(need: SinCosUse, scalar: ScalarType, over: Interval, error: f64) -> KernelChoice {
    let choice = Candidates::new(need, scalar, over).cheapest(error);
    choice.filter(|c| c.errors.worst() <= error).unwrap()
}

const PI: f64 = std::f64::consts::PI;

/// Ranges of every kind: symmetric, one-sided, narrow, two turns, many.
const CASES: [(ScalarType, f64, f64, f64); 10] = [
    (ScalarType::F64, -PI, PI, 1e-3),
    (ScalarType::F64, -PI, PI, 1e-8),
    (ScalarType::F64, -PI, PI, 1e-13),
    (ScalarType::F64, 0.1, 2.6, 1e-9),
    (ScalarType::F64, 0.9, 1.3, 1e-6),
    (ScalarType::F64, -2.0 * PI, 2.0 * PI, 1e-7),
    (ScalarType::F64, -1e6, 1e6, 1e-9),
    (ScalarType::F32, -PI, PI, 1e-5),
    (ScalarType::F32, -3.0, -0.5, 1e-6),
    (ScalarType::F32, -1e3, 1e3, 1e-5),
];

/// A proved error is at most four times what is seen: loose bounds would cost operations.
#[test]
fn errors_are_as_proved_and_not_far_below() {
    for (scalar, low, high, error) in CASES {
        let over = range(low, high);
        let choice = cheapest(BOTH, scalar, over, error);
        let sample_errors = largest_errors(&choice.kernel, scalar, over);
        let proved = choice.errors;
        // libm's own errors, of which the samples are not free.
        let libm_error = 2.0 * f64::EPSILON;
        let is_within = |sample: f64, bound: f64| sample <= bound + libm_error;
        assert!(is_within(sample_errors.sin, proved.sin));
        assert!(is_within(sample_errors.cos, proved.cos));
        let is_near = proved.worst() <= 4.0 * sample_errors.worst() + libm_error;
        assert!(is_near, "{}: {proved:?} {sample_errors:?}", choice.form);
    }
}

#[test]
fn a_changed_literal_shows() {
    for (scalar, low, high, error) in [CASES[1], CASES[3], CASES[7], CASES[9]] {
        let over = range(low, high);
        let honest = cheapest(BOTH, scalar, over, error);
        for index in 0..honest.kernel.dag.nodes.len() {
            let mut kernel = honest.kernel.clone();
            let Node::Constant(Literal(value)) = &mut kernel.dag.nodes[index] else {
                continue;
            };
            *value = scalar.nearest(*value * 1.01);
            let wrong = largest_errors(&kernel, scalar, over);
            if let Some(bound) = prove(&kernel, scalar, over, f64::INFINITY) {
                let is_bound = wrong.sin <= bound.sin && wrong.cos <= bound.cos;
                let is_seen = bound.worst() > honest.errors.worst();
                assert!(is_bound && is_seen, "node {index}");
            }
        }
    }
}

#[test]
fn operations_follow_from_error_and_range() {
    let cost = |need, low, high, error| {
        let choice = cheapest(need, ScalarType::F64, range(low, high), error);
        choice.kernel.operations()
    };
    assert!(cost(BOTH, -PI, PI, 1e-8) <= 22);
    assert!(cost(BOTH, -PI, PI, 1e-4) <= 16);
    assert!(cost(BOTH, 0.1, 2.6, 1e-8) <= 20);
    assert!(cost(BOTH, -0.3, 0.3, 1e-8) <= 12);
    let only = |sin| SinCosUse { sin, cos: !sin };
    assert!(cost(only(true), -PI, PI, 1e-8) < cost(BOTH, -PI, PI, 1e-8));
    assert!(cost(only(false), -1.0, 1.0, 1e-8) < cost(BOTH, -1.0, 1.0, 1e-8));
    let reduced = cost(BOTH, -100.0, 100.0, 1e-8) - cost(BOTH, -PI, PI, 1e-8);
    assert!((1..=8).contains(&reduced), "{reduced}");
}

#[test]
fn what_cannot_be_reached_is_said() {
    let sines = |half: f64, error| {
        let trig = Pair {
            joint: 1,
            need: BOTH,
            kernel: None,
        };
        one(&trig, ScalarType::F32, range(-half, half), error)
    };
    let miss = sines(PI, 1e-9).unwrap_err();
    let (said, error) = (miss.to_string(), miss.reachable().unwrap());
    assert!(said.starts_with("f32 polynomials reach "), "{said}");
    assert!(said.ends_with("e-7 for q2 in [-π, π], not 1e-9"), "{said}");
    let help = format!("use `sincos_error: {error:e}`, `scalar: f64` or `sincos: libm`");
    assert_eq!(miss.help(), help);
    assert!(sines(PI, error).is_ok() && sines(PI, 0.9 * error).is_err());
    let wide = sines(2.0 * PI, 1e-6).unwrap_err();
    assert!(wide.help().ends_with(", or limit q2 to ±π"));
    assert!(sines(PI, 1e-6).is_ok());
    let help = sines(1.5, 1e-30).unwrap_err().help();
    assert!(help.ends_with("` or `sincos: libm`") && !help.contains("f64"));
    for bad in [0.0, -1.0, f64::NAN] {
        assert!(sines(PI, bad).is_err());
    }
}

#[test]
fn nothing_unbounded_is_proved() {
    let mut kernel = KernelWriter::default();
    let mut node = kernel.literal(1.5);
    for _ in 0..100 {
        node = kernel.mul(node, node);
    }
    let mut wild = KernelWriter::default();
    let infinite = wild.literal(f64::INFINITY);
    for kernel in [alone(kernel, node), alone(wild, infinite)] {
        let bound = prove(&kernel, ScalarType::F64, range(0.0, 1.0), f64::INFINITY);
        assert_eq!(bound, None);
    }
}
