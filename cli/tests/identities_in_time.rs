//! What must hold along a motion: Ḋ − 2C is skew-symmetric, and a passive arm
//! keeps its energy.

use dalembert_codegen::workspace::{Emitted, JointState, seeded};
use dalembert_codegen::{Function, Request, ScalarType, generate};
use dalembert_model::equations::matrix::Columns;
use dalembert_model::equations::{Arm, Formulation, JointPosition, SinCosPair};
use dalembert_model::number::{Rounded, Wide};
use dalembert_model::read;
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::dual::Dual;

fn robot(name: &str) -> Robot {
    let folder = env!("CARGO_MANIFEST_DIR");
    let file = format!("{folder}/../generated/robots/{name}.toml");
    let source = std::fs::read_to_string(file).unwrap();
    read::parse(&source, &read::Options::default())
        .unwrap()
        .robot
}

type Matrix = Vec<Vec<f64>>;

/// The symbols h_ikm of a robot by emitted code.
struct Symbols(Emitted);

impl Symbols {
    fn new(robot: &Robot) -> Symbols {
        let request = Request {
            scalars: vec![ScalarType::F64],
            ..Request::of(&[Function::DynamicCoefficients])
        };
        Symbols(generate(robot, &request).unwrap().emitted.remove(0))
    }

    /// Returns C_ik = Σ_m h_ikm q̇_m
    fn matrix(&self, state: &JointState) -> Matrix {
        let n = state.q.len();
        let results = self.0.run(state);
        let h = &results[n * n..n * n + n * n * n];
        let row = |row: &[f64]| row.iter().zip(&state.qd).map(|(h, v)| h * v).sum();
        h.chunks(n * n)
            .map(|h| h.chunks(n).map(row).collect())
            .collect()
    }
}

/// Returns Ḋ by dual numbers through a formula for D. Over the wide float: in doubles
/// the formulas as written cancel up to 90 u of Ḋ themselves.
fn inertia_rate(robot: &Robot, formula: Formulation, state: &JointState) -> Matrix {
    let arm = Arm::from_robot(robot, &mut |x| Dual::constant(Wide::from_exact(x)));
    let joints = robot.joints.iter().zip(state.q.iter().zip(&state.qd));
    let position: Vec<_> = joints
        .map(|(joint, (&q, &qd))| {
            let [value, rate] = [q, qd].map(|x| Wide::from_f64(x).unwrap());
            match joint.kind {
                JointKind::Revolute => {
                    JointPosition::Revolute(Wide::sincos_of(q).unwrap().turning(&rate))
                }
                JointKind::Prismatic => JointPosition::Prismatic(Dual { value, rate }),
            }
        })
        .collect();
    let d = formula.inertia(&arm, &arm.at(&position));
    let rates = |row: &Vec<Dual<Wide>>| row.iter().map(|d| d.rate.to_f64()).collect();
    d.iter().map(rates).collect()
}

/// Returns Ḋ − 2C and its size before the subtraction.
fn difference(rate: &Matrix, c: &Matrix) -> (Matrix, f64) {
    let mut size = 0.0f64;
    let entry = |(rate, c): (&f64, &f64)| {
        size = size.max(rate.abs()).max((2.0 * c).abs());
        rate - 2.0 * c
    };
    let mut entry = entry;
    let rows = rate.iter().zip(c);
    let s = rows
        .map(|(a, b)| a.iter().zip(b).map(&mut entry).collect())
        .collect();
    (s, size)
}

/// Returns max |S + Sᵀ|
fn asymmetry(s: &Matrix) -> f64 {
    let n = s.len();
    let pairs = (0..n * n).map(|i| (i / n, i % n));
    pairs.fold(0.0, |most, (i, k)| most.max((s[i][k] + s[k][i]).abs()))
}

/// |q̇ᵀ S q̇| / |q̇|²
fn power(s: &Matrix, qd: &[f64]) -> f64 {
    let row = |row: &Vec<f64>| row.iter().zip(qd).map(|(s, v)| s * v).sum::<f64>();
    let total: f64 = s.iter().zip(qd).map(|(s, v)| row(s) * v).sum();
    total.abs() / qd.iter().map(|v| v * v).sum::<f64>()
}

const U: f64 = f64::EPSILON / 2.0;

#[test]
fn inertia_rate_less_twice_coriolis_is_skew() {
    for name in [
        "puma560", "stanford", "ur10", "panda", "planar2r", "planar3r",
    ] {
        let robot = robot(name);
        let symbols = Symbols::new(&robot);
        let mut worst = 0.0f64;
        for state in seeded(&robot, 100, 0x5e) {
            let c = symbols.matrix(&state);
            let rate = inertia_rate(&robot, Formulation::Dalembert, &state);
            let (s, size) = difference(&rate, &c);
            worst = worst.max(asymmetry(&s) / size / U);
        }
        println!("{name}: Ḋ − 2C is skew but for {worst:.1} u");
        assert!(worst <= 50.0, "{name}: {worst} u");
    }
}

/// A C with the right C q̇, and so the right h, that is no C: q̇ᵀ(Ḋ − 2C)q̇ = 0
/// does not notice, the full matrix does.
#[test]
fn a_wrong_coriolis_matrix_is_noticed() {
    let robot = robot("puma560");
    let symbols = Symbols::new(&robot);
    for state in seeded(&robot, 20, 0x5f) {
        let mut c = symbols.matrix(&state);
        // A row more, perpendicular to q̇.
        let qd = &state.qd;
        c[2][0] += qd[1];
        c[2][1] -= qd[0];
        let (s, size) = difference(&inertia_rate(&robot, Formulation::Dalembert, &state), &c);
        assert!(power(&s, qd) <= 50.0 * U * size);
        assert!(asymmetry(&s) > 1e-3 * size, "{}", asymmetry(&s) / size);
    }
}

macro_rules! passive {
    ($name:ident, $t:ty, $module:ident) => {
        /// Energies along 10 s of passive motion, RK4 at 1 ms, at every
        /// millisecond: (kinetic + potential, potential).
        fn $name(q: [$t; 6]) -> Vec<(f64, f64)> {
            use dalembert_generated::$module::manipulator_equation;
            let rates = |q: &[$t; 6], qd: &[$t; 6]| {
                let m = manipulator_equation(q, qd);
                let load: [$t; 6] = std::array::from_fn(|i| -(m.h[i] + m.c[i]));
                solve(m.d, load)
            };
            let robot = robot("puma560");
            let arm = Arm::from_robot(&robot, &mut f64::nearest);
            let step = |x: &[$t; 6], v: &[$t; 6], by: $t| -> [$t; 6] {
                std::array::from_fn(|i| x[i] + by * v[i])
            };
            let dt: $t = 1e-3;
            let (mut q, mut qd) = (q, [0.0; 6]);
            let mut energies = Vec::new();
            for _ in 0..10_000 {
                let d = manipulator_equation(&q, &qd).d;
                let wide = |x: &[$t; 6]| x.map(f64::from);
                let potential = potential(&arm, &wide(&q));
                energies.push((
                    kinetic(&d.map(|row| wide(&row)), &wide(&qd)) + potential,
                    potential,
                ));
                let (v1, a1) = (qd, rates(&q, &qd));
                let v2 = step(&qd, &a1, dt / 2.0);
                let a2 = rates(&step(&q, &v1, dt / 2.0), &v2);
                let v3 = step(&qd, &a2, dt / 2.0);
                let a3 = rates(&step(&q, &v2, dt / 2.0), &v3);
                let v4 = step(&qd, &a3, dt);
                let a4 = rates(&step(&q, &v3, dt), &v4);
                for i in 0..6 {
                    q[i] += dt / 6.0 * (v1[i] + 2.0 * (v2[i] + v3[i]) + v4[i]);
                    qd[i] += dt / 6.0 * (a1[i] + 2.0 * (a2[i] + a3[i]) + a4[i]);
                }
            }
            return energies;

            /// Returns D x = b, by elimination: D is positive definite.
            fn solve(mut d: [[$t; 6]; 6], mut b: [$t; 6]) -> [$t; 6] {
                for i in 0..6 {
                    let (row, value) = (d[i], b[i]);
                    for k in i + 1..6 {
                        let factor = d[k][i] / row[i];
                        for (entry, above) in d[k].iter_mut().zip(row) {
                            *entry -= factor * above;
                        }
                        b[k] -= factor * value;
                    }
                }
                for i in (0..6).rev() {
                    let known: $t = (i + 1..6).map(|k| d[i][k] * b[k]).sum();
                    b[i] = (b[i] - known) / d[i][i];
                }
                b
            }
        }
    };
}
passive!(passive_f64, f64, puma560);
passive!(passive_f32, f32, puma560_f32);

fn kinetic(d: &[[f64; 6]; 6], qd: &[f64; 6]) -> f64 {
    let row = |row: &[f64; 6]| row.iter().zip(qd).map(|(d, v)| d * v).sum::<f64>();
    0.5 * d.iter().zip(qd).map(|(d, v)| row(d) * v).sum::<f64>()
}

/// Returns −Σ m g·r, from the poses.
fn potential(arm: &Arm<f64>, q: &[f64; 6]) -> f64 {
    let pair = |q: &f64| {
        let (sin, cos) = libm::sincos(*q);
        JointPosition::Revolute(SinCosPair { sin, cos })
    };
    let position: Vec<_> = q.iter().map(pair).collect();
    let mut pose = Columns::identity();
    let mut sum = 0.0;
    for (link, at) in arm.links.iter().zip(arm.at(&position)) {
        pose = link.append(arm.convention, &at, &pose);
        let centre = pose.apply(&link.com, &1.0);
        let depth: f64 = arm.gravity.iter().zip(centre).map(|(g, r)| g * r).sum();
        sum -= link.mass * depth;
    }
    sum
}

/// Returns the largest drift of the energy over the span of the potential.
fn drift(energies: &[(f64, f64)]) -> f64 {
    let first = energies[0].0;
    let drift = energies
        .iter()
        .map(|(e, _)| (e - first).abs())
        .fold(0.0, f64::max);
    let potentials = || energies.iter().map(|(_, v)| *v);
    let span = potentials().fold(f64::MIN, f64::max) - potentials().fold(f64::MAX, f64::min);
    drift / span
}

#[test]
fn a_passive_arm_keeps_its_energy() {
    let q = [0.3, -0.5, 0.4, 0.2, -0.6, 0.1];
    let wide = drift(&passive_f64(q));
    let single = drift(&passive_f32(q.map(|x| x as f32)));
    println!("energy drift over the potential's span: f64 {wide:.1e}, f32 {single:.1e}");
    assert!(wide <= 1e-8, "{wide:e}");
}
