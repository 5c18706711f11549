//! Intervals and polynomials against exact numbers.

use dalembert_checker::domain::Domain;
use dalembert_checker::identity::exact::Exact;
use dalembert_checker::identity::number::Draws;
use dalembert_checker::interval::{Interval, SINE_ERROR, sin_cos};
use dalembert_checker::polynomial::{Polynomial, Powers, Variable, exponent};
use dalembert_checker::program::{Operand, Program, Step, argument};
use dalembert_checker::work::Work;
use num_rational::BigRational;

fn exact(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap()
}

/// Numbers of many sizes, the same on every machine.
fn numbers(count: usize) -> Vec<f64> {
    let mut draws = Draws::new(&["numbers"]);
    let number = |_| {
        let size = [1e-9, 1e-3, 1.0, 1e3, 1e9][(5.0 * draws.share()) as usize];
        (draws.share() - 0.5) * size
    };
    (0..count).map(number).collect()
}

fn has(interval: Interval, value: &BigRational) -> bool {
    exact(interval.low) <= *value && *value <= exact(interval.high)
}

#[test]
fn operations_of_intervals_have_the_exact_results() {
    let numbers = numbers(400);
    for four in numbers.windows(4) {
        let [a, b, c, d] = [four[0], four[1], four[2], four[3]];
        let [x, y] = [[a, b], [c, d]].map(|[p, q]| Interval::new(p.min(q), p.max(q)));
        for p in [a, b] {
            for q in [c, d] {
                assert!(has(x + y, &(exact(p) + exact(q))));
                assert!(has(x + -y, &(exact(p) - exact(q))));
                assert!(has(x * y, &(exact(p) * exact(q))));
            }
        }
        let around = Interval::around(d, (a - d).abs().next_up());
        assert!(has(around, &exact(a)));
    }
}

#[test]
fn what_is_no_interval_is_everything() {
    for interval in [Interval::new(1.0, 0.0), Interval::new(f64::NAN, 0.0)] {
        assert_eq!(interval.magnitude(), f64::INFINITY);
        assert_eq!((interval * Interval::point(0.0)).magnitude(), f64::INFINITY);
    }
}

#[test]
fn sines_are_within_their_error() {
    for x in numbers(4000).into_iter().map(|x| x % 1000.0) {
        let (sin, cos) = sin_cos(x);
        // libm is within an ulp.
        assert!((sin - x.sin()).abs() < SINE_ERROR, "{x}");
        assert!((cos - x.cos()).abs() < SINE_ERROR, "{x}");
    }
}

#[test]
fn products_of_polynomials_are_within_their_rest() {
    let numbers = numbers(240);
    for six in numbers.chunks(6) {
        let cos = Polynomial::variable(Variable::Cos, 0, six[0]);
        let rate = Polynomial::variable(Variable::Velocity, 1, six[1]);
        let one = cos.plus(&Polynomial::constant(six[2], 0.0)).plus(&rate);
        let other = rate.plus(&Polynomial::variable(Variable::Cos, 0, six[3]));
        let product = one.times(&other, &Work::default()).unwrap();
        let (c, v) = (exact(six[4] % 1.0), exact(six[5] % 1.0));
        let at = |p: &Polynomial| {
            let term = |&(key, coefficient): &(Powers, f64)| {
                let power = |variable, joint| exponent(key, variable, joint) as usize;
                let c = num_traits::pow(c.clone(), power(Variable::Cos, 0));
                let v = num_traits::pow(v.clone(), power(Variable::Velocity, 1));
                exact(coefficient) * c * v
            };
            p.terms.iter().map(term).fold(exact(0.0), |a, b| a + b)
        };
        let off = at(&product) - at(&one) * at(&other);
        let rest = exact(product.rest);
        assert!(-rest.clone() <= off && off <= rest, "{six:?}");
    }
}

#[test]
fn the_square_of_a_sine_is_one_less_that_of_the_cosine() {
    let [sin, cos] = [Variable::Sin, Variable::Cos].map(|v| Polynomial::variable(v, 3, 1.0));
    let work = &Work::default();
    let [one, other] = [sin, cos].map(|polynomial| polynomial.times(&polynomial, work).unwrap());
    assert_eq!(one.plus(&other), Polynomial::constant(1.0, 0.0));
}

#[test]
fn powers_that_there_is_no_room_for_are_refused() {
    let mut power = Polynomial::variable(Variable::Cos, 21, 1.0);
    let cos = power.clone();
    let mut steps = 1;
    while let Ok(next) = power.times(&cos, &Work::default()) {
        (power, steps) = (next, steps + 1);
    }
    assert_eq!(steps, 7);
}

#[test]
fn products_of_two_accelerations_loads_or_errors_count_with_their_magnitudes() {
    use Variable::{Acceleration, EvenError, Load, OddError};
    let work = &Work::default();
    let ones = [Acceleration, EvenError, OddError, Load];
    let variable = |kind, index| Polynomial::variable(kind, index, 0.5);
    for factor in ones {
        for other in ones {
            let are_errors = [factor, other].map(|kind| format!("{kind:?}").ends_with("Error"));
            let is_left_out = factor == other || are_errors == [true; 2];
            let product = variable(factor, 21).times(&variable(other, 3), work);
            let Polynomial { terms, rest } = product.unwrap();
            let are_left_out = [terms.is_empty(), rest >= 0.25];
            assert_eq!(are_left_out, [is_left_out; 2], "{factor:?} {other:?}");
            for (key, _) in &terms {
                let powers = [exponent(*key, factor, 21), exponent(*key, other, 3)];
                assert_eq!(powers, [1, 1], "{factor:?} {other:?}");
                assert_eq!(exponent(*key, factor, 20) + exponent(*key, other, 2), 0);
            }
        }
    }
}

const FLOATING: &str = r#"
name = "hopper"
gravity = [0, 0, -9.81]
[[joint]]
name = "trunk"
kind = "floating"
mass = 9
com = [0, 0, 0]
inertia = [0.2, 0.15, 0.09, 0, 0, 0]
[[joint]]
kind = "revolute"
placement = { xyz = [0, 0, -0.1] }
axis = [0, 1, 0]
mass = 1
com = [0, 0, -0.1]
inertia = [0.02, 0.02, 0.003, 0, 0, 0]
"#;

/// Gravity in the axes of a base has any direction and any length up to the file's: turned, it is no
/// longer; and what vanishes for its whole length alone, in a program that was edited, is not small.
#[test]
fn gravity_is_a_ball() {
    let domain = Domain::read(FLOATING, None, &["q", "g"], None).unwrap();
    let gravity = argument("g").unwrap();
    let entry = |index: usize| Operand::Entry(gravity, index);
    let shown = |steps: Vec<Step<Exact>>, most: f64| {
        let outputs = vec![(false, Operand::Step(steps.len() - 1))];
        let written = domain.write(&Program { steps, outputs }, None).unwrap();
        domain.decide(&written[0], most).0.is_shown
    };
    let turned = vec![
        ('*', [Operand::Sine(0, true), entry(0)]),
        ('*', [Operand::Sine(0, false), entry(2)]),
        ('+', [Operand::Step(0), Operand::Step(1)]),
    ];
    assert!(shown(turned.clone(), 9.9) && !shown(turned, 9.8));
    let square = Exact::read("96.2361").unwrap();
    let squared = |index| ('*', [entry(index), entry(index)]);
    let mut steps: Vec<Step<Exact>> = (0..3).map(squared).collect();
    steps.push(('+', [Operand::Step(0), Operand::Step(1)]));
    steps.push(('+', [Operand::Step(2), Operand::Step(3)]));
    steps.push(('-', [Operand::Step(4), Operand::Constant(square)]));
    assert!(!shown(steps, 1.0));
}
