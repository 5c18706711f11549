//! The table of outputs, and identities of its formulas, checked exactly in the prime field.

mod frames;
mod slopes;

use crate::equations_support::random::{self, CONVENTIONS, Case, case, fields, pair, pose};
use dalembert_model::equations::chain::MomentBody;
use dalembert_model::equations::regressor::{Column, Probed, of_links};
use dalembert_model::equations::{Arm, DhVariables, Formulation, Link};
use dalembert_model::outputs::{Argument, Axis, Function, Motion, Quantity, Sizes, Written};
use dalembert_model::robot::{Convention, Inertia, JointKind};
use dalembert_model::scalar::dual::Dual;
use dalembert_model::scalar::field::{Field, Points};
use dalembert_model::scalar::{Divide, Scalar};

/// Every function with its arguments, and its results' axes for six joints and 36 base parameters.
const GOLDEN: [&str; 43] = [
    "inverse_dynamics(q, qd, qdd) -> tau[6]",
    "gravity(q) -> c[6]",
    "inertia(q) -> d[6][6]",
    "coriolis(q, qd) -> h[6]",
    "manipulator_equation(q, qd) -> d[6][6] h[6] c[6]",
    "dynamic_coefficients(q) -> d[6][6] h[6][6][6] c[6]",
    "kinetic_energy(q, qd) -> kinetic",
    "potential_energy(q) -> potential",
    "momentum(q, qd) -> p[6] ct_qd[6]",
    "coriolis_matrix(q, qd) -> c_matrix[6][6]",
    "dalembert_terms(q, qd) -> d_rot[6][6] d_tran[6][6] h_rot[6] h_tran[6] c[6]",
    "forward_kinematics(q) -> pose[3][4]",
    "link_poses(q) -> poses[6][3][4]",
    "jacobian(q) -> jacobian[6][6]",
    "jacobian_rate(q, qd) -> jacobian_rate[6]",
    "reaction_wrenches(q, qd, qdd) -> wrenches[6][6]",
    "inverse_dynamics_derivatives(q, qd, qdd) -> dtau_dq[6][6] dtau_dqd[6][6] d[6][6]",
    "passivity(q, qd, v, a) -> tau[6]",
    "forward_dynamics(q, qd, tau) -> qdd[6]",
    "inertia_inverse(q) -> d_inv[6][6]",
    "forward_dynamics_derivatives(q, qd, tau) -> dqdd_dq[6][6] dqdd_dqd[6][6] dqdd_dtau[6][6]",
    "regressor(q, qd, qdd) -> y[6][36]",
    "full_regressor(q, qd, qdd) -> y[6][60]",
    "passivity_regressor(q, qd, v, a) -> y[6][36]",
    "momentum_observer(q, qd) -> p[6] drift[6]",
    "inverse_dynamics_with_wrench(q, qd, qdd, wrench) -> tau[6]",
    "forward_dynamics_with_wrench(q, qd, tau, wrench) -> qdd[6]",
    "contact_wrench(q, tau, damping) -> contact_wrench[6]",
    "operational_inertia_inverse(q) -> operational_inertia_inverse[6][6]",
    "operational_inertia(q, damping) -> operational_inertia[6][6]",
    "consistent_inverse(q, damping) -> consistent_inverse[6][6]",
    "operational_bias(q, qd, damping) -> operational_bias[6]",
    "null_space_projector(q, damping) -> null_space[6][6]",
    "centre_of_mass(q) -> com[3]",
    "centroidal_momentum_matrix(q) -> centroidal_momentum_matrix[6][6]",
    "centroidal_bias(q, qd) -> centroidal_bias[6]",
    "joint_torques_free(q, qd, qdd) -> tau[6] base_acceleration[6]",
    "inertia_blocks(q) -> base[6][6] coupling[6][6] limbs[18]",
    "contact_jacobians(q) -> contact_jacobians[3][6]",
    "contact_bias(q, qd) -> contact_bias[3]",
    "contact_forward_dynamics(q, qd, tau, damping) -> qdd[6] forces[3]",
    "inverse_dynamics_second_derivatives(q, qd, qdd, multiplier) -> \
     d2tau_dq_dq[6][6] d2tau_dq_dqd[6][6] d2tau_dqd_dqd[6][6] d2tau_dqdd_dq[6][6]",
    "forward_dynamics_second_derivatives(q, qd, tau, multiplier) -> \
     d2qdd_dq_dq[6][6] d2qdd_dq_dqd[6][6] d2qdd_dqd_dqd[6][6] d2qdd_dtau_dq[6][6]",
];

#[test]
fn golden_list() {
    // Two limbs of three joints.
    let mut sizes = Sizes::floating(0, 6, 0b001001);
    sizes.base = 36;
    let said = |function: &Function| {
        let arguments: Vec<&str> = function.arguments().iter().map(|a| a.name()).collect();
        let result = |q: &Quantity| {
            let lengths = q.shape().lengths(sizes).map(|length| format!("[{length}]"));
            format!(" {}{}", q.field(), lengths.collect::<String>())
        };
        let results: String = function.quantities().iter().map(result).collect();
        format!("{function}({}) ->{results}", arguments.join(", "))
    };
    let signatures: Vec<String> = Function::ALL.iter().map(said).collect();
    assert_eq!(signatures, GOLDEN);
    for function in Function::ALL {
        let mut fields: Vec<_> = function.quantities().iter().map(|q| q.field()).collect();
        fields.dedup();
        let is_struct = function.structure().is_some();
        assert_eq!(fields.len(), function.quantities().len(), "{function}");
        assert_eq!(fields.len() > 1, is_struct, "{function}");
    }
    let by_default = "inverse_dynamics gravity inertia coriolis forward_kinematics jacobian \
                      forward_dynamics";
    let names = Function::by_default().into_iter().map(Function::name);
    assert!(names.eq(by_default.split(' ')), "what a controller calls");
}

fn cases() -> Vec<Case> {
    let mut points = Points::new(0x6f75);
    let mut cases = random::every_kind(3, &mut points);
    cases.extend(CONVENTIONS.map(|convention| case(convention, 6, 0b001010, &mut points)));
    for bits in [0b00, 0b01, 0b10] {
        let mut tilted = case(Convention::Standard, 3, bits, &mut points);
        for link in &mut tilted.arm.links {
            link.beta = Some(pair(&mut points));
        }
        tilted.arm.links[1].friction.coulomb = None;
        cases.push(tilted);
    }
    for at in 0..cases.len() {
        let mut placed = cases[at].clone();
        placed.arm.base = Some(pose(&mut points));
        placed.arm.tool = Some(pose(&mut points));
        cases.push(placed);
    }
    cases
}

fn written<'a>(
    formulation: Formulation,
    case: &'a Case,
    motion: &'a Motion<Field>,
    columns: &'a [Column<Field>],
) -> Written<'a, Field> {
    let (arm, at) = (&case.arm, &case.at);
    Written {
        formulation,
        arm,
        at,
        motion,
        columns,
    }
}

fn on_fixed_base(quantity: &&Quantity) -> bool {
    !quantity.facts().on_floating_base
}

#[test]
fn formulations_agree_on_every_quantity() {
    for case in cases() {
        let (mut points, n) = (Points::new(7), case.qd.len());
        let mut motion = driven(&case, &vec![true; n], &mut points);
        motion.qdd = case.qdd.clone();
        let columns = columns(&case, &mut points);
        for &quantity in Quantity::ALL.iter().filter(on_fixed_base) {
            let by =
                |formulation| quantity.written(&written(formulation, &case, &motion, &columns));
            let expected = by(Formulation::LagrangeEuler);
            let mut sizes = Sizes::whole(n);
            sizes.base = columns.len();
            assert_eq!(expected.len(), quantity.len(sizes), "{quantity:?}");
            assert!(expected.iter().any(|x| *x != Field::ZERO) || n < 6);
            for formulation in Formulation::ALL {
                assert_eq!(by(formulation), expected, "{quantity:?} {formulation:?}");
            }
        }
    }
}

fn columns(case: &Case, points: &mut Points) -> Vec<Column<Field>> {
    let n = case.arm.links.len();
    let mut columns = of_links(&case.arm);
    for (joint, place) in [(0, 3), (n - 1, 7)] {
        let body = MomentBody {
            mass: points.field(),
            first: [(); 3].map(|()| points.field()),
            second: Inertia::of([(); 6].map(|()| points.field())),
        };
        let of = Probed::Body(body);
        columns[10 * joint + place] = Column { joint, of };
    }
    (columns[4].joint, columns[4].of) = (n - 1, Probed::Armature);
    (columns[5].joint, columns[5].of) = (0, Probed::Viscous);
    columns
}

/// τ = Y π and D a + C v + c + b∘v = Y π with π of the links, in their own frames.
#[test]
fn regressors_give_the_torques() {
    let mut points = Points::new(0x7265);
    let (exact, recursion) = (Formulation::LagrangeEuler, Formulation::NewtonEulerLink);
    for (place, mut case) in cases().into_iter().enumerate() {
        if place % 2 == 0 {
            let links = case.arm.links.iter();
            case.arm.frames.links = links.map(|_| Some(pose(&mut points))).collect();
        }
        let Case { arm, at, qd, qdd } = &case;
        let columns = of_links(arm);
        let tau = exact.inverse_dynamics(arm, at, qd, qdd);
        let y = recursion.regressor(arm, at, qd, qdd, &columns);
        assert_eq!(products(arm, &y, [qd, qdd]), tau);
        let [v, a] = [(); 2].map(|()| fields(qd.len(), &mut points));
        let tau = exact.passivity(arm, at, [qd, &v, &a]);
        let y = recursion.passivity_regressor(arm, at, qd, [&v, &a], &columns);
        assert_eq!(products(arm, &y, [&v, &a]), tau);
    }
}

fn products(arm: &Arm<Field>, y: &[Vec<Field>], [qd, qdd]: [&[Field]; 2]) -> Vec<Field> {
    let pi = arm.parameters();
    let sum = |(i, row): (usize, &Vec<Field>)| {
        let drive = drive(&arm.links[i], &qd[i], &qdd[i]);
        dot(row, &pi).add(&drive)
    };
    y.iter().enumerate().map(sum).collect()
}

fn dot(a: &[Field], b: &[Field]) -> Field {
    let products = a.iter().zip(b).map(|(a, b)| a.mul(b));
    products.fold(Field::ZERO, |sum, x| sum.add(&x))
}

fn drive(link: &Link<Field>, rate: &Field, acceleration: &Field) -> Field {
    let friction = link.friction.torque(rate);
    friction.add(&link.armature.mul(acceleration))
}

fn moving(case: &Case) -> (Arm<Dual<Field>>, Vec<DhVariables<Dual<Field>>>) {
    let links = case.arm.links.iter().zip(&case.at).zip(&case.qd);
    let at = links.map(|((link, at), &rate)| {
        let (mut theta, mut d) = (at.theta.map(|x| Dual::constant(*x)), Dual::constant(at.d));
        match link.kind {
            JointKind::Revolute => theta = at.theta.clone().turning(&rate),
            JointKind::Prismatic => d.rate = rate,
        }
        DhVariables { theta, d }
    });
    (case.arm.map(|x| Dual::constant(*x)), at.collect())
}

/// Ḋ − 2C is skew, C q̇ = h, and ṗ = Ḋ q̇ + D q̈ obeys ṗ = τ + Cᵀ q̇ − c − b∘q̇.
#[test]
fn coriolis_matrix_is_the_christoffels() {
    for case in cases() {
        let Case { arm, at, qd, qdd } = &case;
        let n = arm.links.len();
        let form = Formulation::LagrangeEuler;
        let c = form.coriolis_matrix(arm, at, qd);
        let (arm_moving, at_moving) = moving(&case);
        let d = form.inertia(&arm_moving, &at_moving);
        let h = form.velocity_terms(arm, at, qd);
        let slope = form.momentum_slope(arm, at, qd);
        let tau = form.inverse_dynamics(arm, at, qd, qdd);
        let gravity = form.gravity(arm, at);
        for i in 0..n {
            let entries = d[i].iter().map(|d| (d.value, d.rate));
            let (values, rates): (Vec<Field>, Vec<Field>) = entries.unzip();
            let symmetric: Vec<Field> = (0..n).map(|k| c[i][k].add(&c[k][i])).collect();
            assert_eq!(rates, symmetric);
            assert_eq!(dot(&c[i], qd), h[i]);
            let rate = dot(&rates, qd).add(&dot(&values, qdd));
            let damping = arm.links[i].friction.torque(&qd[i]);
            let rest = tau[i].add(&slope[i]).sub(&gravity[i]).sub(&damping);
            assert_eq!(rate, rest);
        }
    }
}

/// ∂U/∂q = c, and the wrenches' parts along the joints are the torques.
#[test]
fn energy_and_wrenches_belong_to_the_torques() {
    for case in cases() {
        let Case { arm, at, qd, qdd } = &case;
        let form = Formulation::NewtonEulerLink;
        let c = form.gravity(arm, at);
        let tau = form.inverse_dynamics(arm, at, qd, qdd);
        let wrenches = form.wrenches(arm, at, [qd, qdd]);
        let poses = dalembert_model::equations::kinematics::poses(arm, at);
        let base = arm.base.as_ref().map(|base| base.axes[2]);
        let first = base.unwrap_or([Field::ZERO, Field::ZERO, Field::ONE]);
        let (arm_moving, at_moving) = moving(&case);
        let power = form.potential_energy(&arm_moving, &at_moving).rate;
        assert_eq!(power, dot(&c, qd));
        for (i, link) in arm.links.iter().enumerate() {
            let axis = match (arm.convention, i) {
                (Convention::Standard, 0) => first,
                (Convention::Standard, _) => poses[i - 1].axes[2],
                (Convention::Modified, _) => poses[i].axes[2],
            };
            let load = match link.kind {
                JointKind::Revolute => &wrenches[i].moment,
                JointKind::Prismatic => &wrenches[i].force,
            };
            let drive = drive(link, &qd[i], &qdd[i]);
            assert_eq!(dot(&axis, load).add(&drive), tau[i]);
        }
    }
}

fn driven(case: &Case, moves: &[bool], points: &mut Points) -> Motion<Field> {
    let rates = case.qd.iter().zip(moves);
    let held = rates.map(|(x, moves)| if *moves { *x } else { Field::zero() });
    let mut motion = Motion::new(Vec::new(), |argument| match argument {
        Argument::Velocity => held.clone().collect(),
        other => fields(other.length(Sizes::whole(moves.len())), points),
    });
    motion.moves = moves.to_vec();
    motion
}

/// A residual of anything else than the solution does not vanish.
#[test]
fn forward_dynamics_solves_the_equations_of_motion() {
    let mut points = Points::new(0x6664);
    for case in cases() {
        let n = case.arm.links.len();
        for bits in 1..1u32 << n.min(4) {
            let moves: Vec<bool> = (0..n).map(|i| i >= 4 || bits >> i & 1 == 1).collect();
            let motion = driven(&case, &moves, &mut points);
            let divided = Quantity::ALL.iter().filter(on_fixed_base);
            for &quantity in divided.filter(|q| q.facts().inverts_inertia) {
                let by = |formulation| written(formulation, &case, &motion, &[]);
                let recursion = by(Formulation::NewtonEulerLink);
                let found = quantity.written(&recursion);
                let expected = quantity.written(&by(Formulation::LagrangeEuler));
                assert_eq!(found, expected, "{quantity:?} {moves:?}");
                let residual = quantity.residual(&recursion, &expected);
                assert!(residual.iter().all(|x| *x == Field::zero()));
                let wrong: Vec<Field> = expected.iter().map(|x| x.add(&Field::ONE)).collect();
                let residual = quantity.residual(&recursion, &wrong);
                assert!(residual.is_empty() || residual.iter().any(|x| *x != Field::zero()));
                if quantity.shape().0[0] != Axis::Coordinates {
                    continue;
                }
                for (index, value) in expected.iter().enumerate() {
                    let row = index / (expected.len() / n);
                    assert!(moves[row] || *value == Field::zero());
                }
            }
        }
    }
}
