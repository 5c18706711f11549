//! Arms whose parameters are known, and what is taken for them at first.

use dalembert_fit::random::{Random, normal, within};
use dalembert_fit::simulate::Log;
use dalembert_fit::{Accumulator, Differentiator, Effort, Fit, Model, differentiate, fit};
use dalembert_model::number::Rational;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::read::parse;
use dalembert_model::robot::{Inertia, Robot};

pub const ARMS: [&str; 3] = ["puma560", "ur10", "panda"];
pub const TREES: [&str; 2] = ["two_arms", "g1_hand"];

pub fn file(name: &str) -> Robot {
    let folder = match name {
        "g1_hand" => "../../gallery/robots",
        "puma560_placed" | "two_arms" => "../model/tests/data",
        _ => "../../generated/robots",
    };
    let path = format!("{}/{folder}/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    parse(&text).unwrap().robot
}

pub fn number(value: f64) -> Rational {
    parse_decimal(&format!("{value:.12e}")).unwrap()
}

pub fn truth(name: &str) -> Robot {
    let mut robot = file(name);
    for (i, joint) in robot.joints.iter_mut().enumerate() {
        let size = 1.0 / (1.0 + i as f64);
        if joint.mass == number(0.0) {
            joint.mass = number(2.0);
        }
        let mut added = number(1e-3);
        // Off the border: a body that barely exists would not survive rounding.
        joint.inertia = raised(&joint.inertia, &number(1e-4));
        while joint.inertia.defect(&joint.mass).is_some() {
            joint.inertia = raised(&joint.inertia, &added);
            added = &added + &added;
        }
        joint.armature = number(0.3 * size);
        joint.viscous = number(1.5 * size);
        joint.coulomb = number(4.0 * size);
        joint.coulomb_width = number(0.02);
    }
    robot
}

fn raised(tensor: &Inertia<Rational>, by: &Rational) -> Inertia<Rational> {
    Inertia {
        xx: &tensor.xx + by,
        yy: &tensor.yy + by,
        zz: &tensor.zz + by,
        ..tensor.clone()
    }
}

/// Returns the arm as a data sheet has it: masses and centres a fifth wrong, no friction.
pub fn guess(truth: &Robot) -> Robot {
    let mut robot = truth.clone();
    let mut random = Random::new(11);
    for joint in &mut robot.joints {
        joint.mass = &joint.mass * &number(1.0 + within(&mut random, 0.2));
        for com in &mut joint.com {
            *com = &*com * &number(1.0 + within(&mut random, 0.2));
        }
        for of in [&mut joint.armature, &mut joint.viscous, &mut joint.coulomb] {
            *of = number(0.0);
        }
    }
    robot
}

pub fn model(robot: &Robot) -> Model {
    Model::new(robot).unwrap()
}

pub fn arm(name: &str) -> (Model, Vec<f64>) {
    let truth = truth(name);
    (model(&guess(&truth)), true_parameters(&truth))
}

pub struct State {
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
    pub y: Vec<f64>,
}

pub fn states(model: &Model, count: usize, seed: u64) -> Vec<State> {
    let mut random = Random::new(seed);
    let mut draw = |largest: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let draws = (0..model.joints()).map(|i| within(&mut random, largest(i)));
        draws.collect()
    };
    let states = (0..count).map(|_| {
        let q = draw(&|_| 2.5);
        let qd = draw(&|i| model.limits()[i].velocity);
        let qdd = draw(&|i| model.limits()[i].acceleration);
        let y = model.regressor(&q, &qd, &qdd).unwrap();
        State { q, qd, qdd, y }
    });
    states.collect()
}

pub fn true_parameters(truth: &Robot) -> Vec<f64> {
    model(truth).parameters().to_vec()
}

pub fn torques(y: &[f64], parameters: &[f64]) -> Vec<f64> {
    let row = |row: &[f64]| row.iter().zip(parameters).map(|(y, p)| y * p).sum();
    y.chunks(parameters.len()).map(row).collect()
}

pub fn noise(joint: usize) -> f64 {
    0.5 / (1.0 + joint as f64)
}

/// Asserts that numbers differ by less than a part of their size, or of one.
#[track_caller]
pub fn near(found: f64, wanted: f64, part: f64, what: &str) {
    let most = part * (1.0 + wanted.abs());
    assert!((found - wanted).abs() < most, "{what}: {found} {wanted}");
}

pub fn short_effort() -> Effort {
    Effort {
        starts: 8,
        descents: 1,
        steps: 10,
        ..Effort::default()
    }
}

/// Returns q, q̇ and q̈ of a log's positions; the first state is that at `filter.half()`.
pub fn differentiated(filter: &Differentiator, log: &Log) -> Vec<[Vec<f64>; 3]> {
    let joint = |i: usize| {
        let q: Vec<f64> = log.q.iter().map(|q| q[i]).collect();
        differentiate(filter, &q).unwrap()
    };
    let joints: Vec<[Vec<f64>; 3]> = (0..log.q[0].len()).map(joint).collect();
    let state = |k: usize| -> [Vec<f64>; 3] {
        [0, 1, 2].map(|of| joints.iter().map(|joint| joint[of][k]).collect())
    };
    (0..joints[0][0].len()).map(state).collect()
}

/// Returns the data of so many states with noise of a seed, and their fit.
pub fn fitted(model: &Model, right: &[f64], count: usize, seeds: [u64; 2]) -> (Accumulator, Fit) {
    let states = states(model, count, seeds[0]);
    let data = accumulated(model, &states, right, Some(seeds[1]));
    let fit = fit(model, &data).unwrap();
    (data, fit)
}

pub fn accumulated(
    model: &Model,
    states: &[State],
    parameters: &[f64],
    seed: Option<u64>,
) -> Accumulator {
    let mut random = seed.map(Random::new);
    let mut data = Accumulator::new(model);
    for state in states {
        let mut tau = torques(&state.y, parameters);
        if let Some(random) = &mut random {
            for (i, tau) in tau.iter_mut().enumerate() {
                *tau += noise(i) * normal(random);
            }
        }
        data.add_rows(model, &state.y, &tau).unwrap();
    }
    data
}
