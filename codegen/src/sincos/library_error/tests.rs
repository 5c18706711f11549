//! What is proved of the called sines, against what the crate computes.

use super::*;
use crate::program::{Library, Operand};
use crate::random::Random;
use dalembert_model::number::Wide;
use dalembert_model::scalar::Scalar;
use dalembert_sines::text::{Fused, alone};

/// Below what is said in certificates, and not far above what was measured
/// (`sines/tests/accuracy.rs`): 0.8166 and 0.7999 u.
#[test]
fn less_than_stated_is_proved_in_both_scalars() {
    let stated = 0.9;
    assert!(
        Library::Together
            .assumption()
            .contains(&format!("within {stated} u"))
    );
    for scalar in ScalarType::ALL {
        let u = scalar.unit_roundoff();
        let called = Called::of(scalar).unwrap();
        let worst = called.error(1.0) / u;
        println!("{scalar}: {worst} u, cosine {} u", called.cosine / u);
        assert!(worst > 0.79 && worst <= stated, "{scalar}: {worst}");
        // Small ones err less, and relative to their size by less than is assumed of
        // libm's, for which an ulp is up to 2 u of it.
        let relative = |k: i32| {
            let size = 0.5 * 0.96f64.powi(k);
            called.error(size) / (u * size)
        };
        let worst = (0..200).map(relative).fold(0.0, f64::max);
        println!("{scalar}: {worst} u of small sines");
        assert!(worst < 2.0, "{scalar}: {worst}");
    }
}

/// Fused products err no more than rounded ones, so certificates for those hold for these.
#[test]
fn fused_products_err_no_more() {
    for scalar in ScalarType::ALL {
        let u = scalar.unit_roundoff();
        let called = Called::of(scalar).unwrap();
        let fused = Called::prove_of(&trace::trace::<Fused>(scalar), scalar).unwrap();
        let (own, other) = (fused.error(1.0) / u, called.error(1.0) / u);
        println!(
            "{scalar}: {own} u fused, cosine {} u; {other} u",
            fused.cosine / u
        );
        assert!(own > 0.7 && own <= FUSED_ERROR, "{scalar}: {own}");
        assert!(fused.cosine <= called.cosine && fused.beyond <= called.beyond);
        for ((to, error), (wider, other)) in fused.sines.iter().zip(&called.sines) {
            assert!(
                to <= wider && error <= other,
                "{to}: {} u, {} u",
                error / u,
                other / u
            );
        }
    }
}

/// What was recorded is the crate's, to the last bit: the kernel runs as it does where
/// no quarter turn is taken off.
#[test]
fn the_recorded_text_is_the_routine() {
    let mut random = Random::new(3);
    let kernels = ScalarType::ALL.map(|scalar| {
        let rounded = trace::trace::<Rounded>(scalar);
        (scalar, rounded, trace::trace::<Fused>(scalar))
    });
    for _ in 0..1000 {
        let x = 1.5 * (random.unit() - 0.5);
        for (scalar, rounded, fused) in &kernels {
            match scalar {
                ScalarType::F64 => {
                    let ([sin], [cos]) = dalembert_sines::sincos(&[x]);
                    assert_eq!(rounded.run(x), (sin, cos));
                    assert_eq!(fused.run(x), alone::<f64, Fused>(x));
                }
                ScalarType::F32 => {
                    let x = x as f32;
                    let ([sin], [cos]) = dalembert_sines::sincosf(&[x]);
                    assert_eq!(rounded.run(x), (sin, cos));
                    assert_eq!(fused.run(x), alone::<f32, Fused>(x));
                }
            }
        }
    }
}

/// Nothing that is computed is further off than is proved, large and small alike; fused or not.
#[test]
fn no_sine_is_further_off() {
    let mut random = Random::new(4);
    let called = ScalarType::ALL.map(|scalar| Called::of(scalar).unwrap());
    let fused = ScalarType::ALL.map(|scalar| {
        let kernel = trace::trace::<Fused>(scalar);
        Called::prove_of(&kernel, scalar).unwrap()
    });
    for index in 0..600 {
        let reach = [8192.0, 3.2, 0.3, 1e-3][index % 4];
        let turns = core::f64::consts::PI * (index % 3) as f64;
        let x = (turns + reach * (2.0 * random.unit() - 1.0)).clamp(-8192.0, 8192.0);
        let single = (x as f32).clamp(-100.0, 100.0);
        let wide = |(sin, cos): (f32, f32)| [f64::from(sin), cos.into()];
        let (rounded, roundedf) = (alone::<f64, Rounded>(x), alone::<f32, Rounded>(single));
        let (once, oncef) = (alone::<f64, Fused>(x), alone::<f32, Fused>(single));
        let runs = [
            (called[0], x, rounded.into()),
            (called[1], single.into(), wide(roundedf)),
            (&fused[0], x, once.into()),
            (&fused[1], single.into(), wide(oncef)),
        ];
        for (called, x, found) in runs {
            let exact = Wide::sincos_of(x).unwrap();
            for (found, exact) in found.into_iter().zip([exact.sin, exact.cos]) {
                let error = Wide::from_f64(found).unwrap().sub(&exact).magnitude();
                let size = exact.magnitude();
                assert!(error <= called.error(size), "{x:e}: {error:e} of {size:e}");
            }
        }
    }
}

/// Another literal or another operation shows in the bound, or ends it.
#[test]
fn another_text_has_another_bound() {
    let scalar = ScalarType::F64;
    let kernel = trace::trace::<Rounded>(scalar);
    let (parts, _) = reduction::split(&kernel, scalar).unwrap();
    let largest = Called::largest(scalar);
    assert!(reduction::bound(&parts, scalar, largest).is_some());
    // Beyond, a count times a part of π/2 is no float any more.
    assert!(reduction::bound(&parts, scalar, 64.0 * largest).is_none());
    for step in 0..11 {
        let mut other = kernel.clone();
        other.steps[step].left = crate::program::kernel::literal(1.0);
        assert!(reduction::split(&other, scalar).is_none(), "{step}");
    }
    assert!(reduction::split(&kernel, ScalarType::F32).is_none());
    let proved = Called::prove_of(&kernel, scalar).unwrap();
    for index in 11..kernel.steps.len() {
        let mut other = kernel.clone();
        let step = &mut other.steps[index];
        let mut changed = false;
        for operand in [&mut step.left, &mut step.right] {
            // What one is taken from is put back by the difference that follows.
            if let Operand::Constant(literal) = operand
                && literal.0 != 1.0
            {
                literal.0 *= 1.0 + 1e-3;
                changed = true;
            }
        }
        if changed {
            let worse = Called::prove_of(&other, scalar);
            let shows = worse.is_none_or(|worse| worse.error(1.0) > proved.error(1.0));
            assert!(shows, "{index}");
        }
    }
}
