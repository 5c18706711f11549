//! The 35 outputs: a table of what each reads and returns, and every result by the equations of
//! Newton and Euler in base axes. Slopes are those of the numbers, so that no derivative is written
//! out.

use super::arm::{Arm, Body, Joint, Placed, Pose, Screw, Vector, cross, dot, sum};
use super::exact::Point;
use super::number::Number;

/// Every function, its arguments in order, and its results: the field in a struct, what it is where
/// that is another word, and the lengths of its axes. `n` is the joints, `l` ten a link, `b` the
/// base parameters.
const TABLE: &str = "
    inverse_dynamics: q qd qdd -> tau[n]
    gravity: q -> c[n]
    inertia: q -> d[nn]
    coriolis: q qd -> h[n]
    manipulator_equation: q qd -> d[nn] h[n] c[n]
    dynamic_coefficients: q -> d[nn] h=symbols[nnn] c[n]
    kinetic_energy: q qd -> kinetic[]
    potential_energy: q -> potential[]
    momentum: q qd -> p[n] ct_qd[n]
    coriolis_matrix: q qd -> c_matrix[nn]
    dalembert_terms: q qd -> d_rot[nn] d_tran[nn] h_rot[n] h_tran[n] c[n]
    forward_kinematics: q -> pose[34]
    link_poses: q -> poses[n34]
    jacobian: q -> jacobian[6n]
    jacobian_rate: q qd -> jacobian_rate[6]
    reaction_wrenches: q qd qdd -> wrenches[n6]
    inverse_dynamics_derivatives: q qd qdd -> dtau_dq[nn] dtau_dqd[nn] d[nn]
    passivity: q qd v a -> tau=passivity[n]
    forward_dynamics: q qd tau -> qdd[n]
    inertia_inverse: q -> d_inv[nn]
    forward_dynamics_derivatives: q qd tau -> dqdd_dq[nn] dqdd_dqd[nn] dqdd_dtau=d_inv[nn]
    regressor: q qd qdd -> y=y_base[nb]
    full_regressor: q qd qdd -> y[nl]
    passivity_regressor: q qd v a -> y=y_passivity[nb]
    momentum_observer: q qd -> p[n] drift[n]
    inverse_dynamics_with_wrench: q qd qdd wrench -> tau=tau_wrench[n]
    forward_dynamics_with_wrench: q qd tau wrench -> qdd=qdd_wrench[n]
    contact_wrench: q tau damping -> contact_wrench[6]
    operational_inertia_inverse: q -> mobility[66]
    operational_inertia: q damping -> operational_inertia[66]
    consistent_inverse: q damping -> consistent_inverse[n6]
    operational_bias: q qd damping -> operational_bias[6]
    null_space_projector: q damping -> null_space[nn]
    inverse_dynamics_second_derivatives: q qd qdd multiplier ->
        d2tau_dq_dq[nn] d2tau_dq_dqd[nn] d2tau_dqd_dqd[nn] d2tau_dqdd_dq[nn]
    forward_dynamics_second_derivatives: q qd tau multiplier ->
        d2qdd_dq_dq[nn] d2qdd_dq_dqd[nn] d2qdd_dqd_dqd[nn] d2qdd_dtau_dq[nn]
";

/// The arguments, in the order in which heads have them, and their lengths.
pub const ARGUMENTS: [(&str, char); 9] = [
    ("q", 'n'),
    ("qd", 'n'),
    ("qdd", 'n'),
    ("tau", 'n'),
    ("v", 'n'),
    ("a", 'n'),
    ("wrench", '6'),
    ("damping", '1'),
    ("multiplier", 'n'),
];

/// A result of a function.
#[derive(Clone, Debug)]
pub struct Field {
    /// The name of the field of the struct.
    pub name: &'static str,
    /// The word of its formula.
    is: &'static str,
    /// The lengths of its axes, a character each.
    pub axes: &'static str,
}

/// A function that is known.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its name.
    pub name: &'static str,
    /// The places of its arguments among all.
    pub arguments: Vec<usize>,
    /// Its results, in order.
    pub fields: Vec<Field>,
}

/// Returns the place of an argument.
pub fn argument(name: &str) -> Option<usize> {
    ARGUMENTS.iter().position(|own| own.0 == name)
}

/// Returns the length of an axis.
pub fn length(axis: char, joints: usize) -> usize {
    match axis {
        'n' => joints,
        'l' => 10 * joints,
        digit => digit.to_digit(10).unwrap_or(0) as usize,
    }
}

/// Returns all functions.
pub fn functions() -> Vec<Function> {
    let field = |word: &'static str| {
        let (names, axes) = word.strip_suffix(']')?.split_once('[')?;
        let (name, is) = names.split_once('=').unwrap_or((names, names));
        Some(Field { name, is, axes })
    };
    let mut all: Vec<Function> = Vec::new();
    for word in TABLE.split_whitespace() {
        if let Some(name) = word.strip_suffix(':') {
            let (arguments, fields) = (Vec::new(), Vec::new());
            all.push(Function {
                name,
                arguments,
                fields,
            });
        } else if let Some(last) = all.last_mut() {
            last.arguments.extend(argument(word));
            last.fields.extend(field(word));
        }
    }
    all
}

/// A state: the arguments, and sine and cosine of every joint.
#[derive(Clone, Debug)]
pub struct State {
    /// The entries of each argument, in the order of [`ARGUMENTS`].
    pub given: Vec<Vec<Number>>,
    /// Sine and cosine of each joint's angle.
    pub pairs: Vec<[Number; 2]>,
}

impl State {
    /// Draws a state of so many joints at a point of a field.
    pub fn draw(point: &Point, joints: usize) -> State {
        let list = |axis: char| (0..length(axis, joints)).map(|_| point.residue()).collect();
        State {
            given: ARGUMENTS.iter().map(|own| list(own.1)).collect(),
            pairs: (0..joints).map(|_| point.pair()).collect(),
        }
    }

    /// Returns the state in which an entry of an argument has a slope of one in direction 1 or 2.
    pub fn moving(&self, argument: usize, joint: usize, direction: usize) -> State {
        let mut state = self.clone();
        let moving = |own: &mut Number, by: Number| *own = own.moving(by, direction);
        moving(&mut state.given[argument][joint], 1.into());
        if argument == 0 {
            let [sin, cos] = self.pairs[joint];
            // Where the angle moves already, so do the slopes of its sine and cosine.
            let both = [cos, -sin].map(|own| [own.slope(0), own.slope(1)]);
            for (own, [slope, bend]) in state.pairs[joint].iter_mut().zip(both) {
                *own = own.moving(slope, direction);
                if direction == 2 {
                    *own = own.moving(bend, 3);
                }
            }
        }
        state
    }
}

/// A matrix by rows.
type Matrix = Vec<Vec<Number>>;

/// An arm at a state.
struct At<'a> {
    arm: &'a Arm,
    placed: Placed,
    state: &'a State,
}

impl<'a> At<'a> {
    fn new(arm: &'a Arm, state: &'a State) -> At<'a> {
        let placed = arm.at(&state.pairs, &state.given[0]);
        At { arm, placed, state }
    }

    fn count(&self) -> usize {
        self.arm.joints.len()
    }

    fn given(&self, name: &str) -> &'a [Number] {
        argument(name).map_or(&[], |place| &self.state.given[place])
    }

    fn zeros(&self) -> Vec<Number> {
        vec![0.into(); self.count()]
    }

    /// Returns D q̈ + h, and c if gravity is asked for, without friction.
    fn loads(&self, qd: &[Number], qdd: &[Number], has_gravity: bool) -> Vec<Number> {
        let gravity = if has_gravity {
            self.arm.gravity
        } else {
            Vector::default()
        };
        let wrenches = self.placed.wrenches(qd, qdd, gravity);
        let torques = self.placed.axes.iter().zip(wrenches);
        let torques = torques.map(|(axis, wrench)| axis.power(wrench)).collect();
        self.with_drives(torques, |own| own.armature, qdd)
    }

    fn with_friction(&self, loads: Vec<Number>, rates: &[Number]) -> Vec<Number> {
        self.with_drives(loads, |own| own.viscous, rates)
    }

    /// Adds a number of each joint times its rate.
    fn with_drives(
        &self,
        loads: Vec<Number>,
        number: fn(&Joint) -> Number,
        rates: &[Number],
    ) -> Vec<Number> {
        let joints = self.arm.joints.iter().zip(rates);
        plus(loads, joints.map(|(own, rate)| number(own) * *rate))
    }

    fn torques(&self, qdd: &[Number]) -> Vec<Number> {
        let qd = self.given("qd");
        self.with_friction(self.loads(qd, qdd, true), qd)
    }

    fn gravity(&self) -> Vec<Number> {
        self.loads(&self.zeros(), &self.zeros(), true)
    }

    fn inertia(&self) -> Matrix {
        let mut d = self.placed.inertia();
        for (k, own) in self.arm.joints.iter().enumerate() {
            d[k][k] = d[k][k] + own.armature;
        }
        d
    }

    fn coriolis(&self, qd: &[Number]) -> Vec<Number> {
        self.loads(qd, &self.zeros(), false)
    }

    /// Returns C(v) w: h is quadratic, so it is half of h(v + w) − h(v) − h(w).
    fn across(&self, v: &[Number], w: &[Number]) -> Vec<Number> {
        let both = self.coriolis(&plus(v.to_vec(), w.iter().copied()));
        let twice = minus(&minus(&both, &self.coriolis(v)), &self.coriolis(w));
        twice.into_iter().map(|own| own * self.arm.half).collect()
    }

    /// Returns the columns of C(q̇).
    fn columns_of_coriolis(&self) -> Matrix {
        let column = |unit: Vec<Number>| self.across(self.given("qd"), &unit);
        units(self.count()).into_iter().map(column).collect()
    }

    /// Returns Cᵀq̇.
    fn slope(&self) -> Vec<Number> {
        times(&self.columns_of_coriolis(), self.given("qd"))
    }

    fn accelerations(&self, tau: &[Number]) -> Vec<Number> {
        let rest = minus(tau, &self.torques(&self.zeros()));
        solve(self.inertia(), &[rest]).concat()
    }

    fn hand(&self) -> Pose {
        let last = self.placed.poses.last();
        last.map_or(self.arm.hand, |last| last.then(&self.arm.hand))
    }

    /// Returns J of the hand, linear over angular.
    fn jacobian(&self) -> Matrix {
        let point = self.hand().origin;
        let column = |own: &Screw| [sum(own.1, cross(own.0, point)), own.0].concat();
        transposed(&self.placed.axes.iter().map(column).collect())
    }

    /// Returns J̇q̇: the acceleration of the hand without q̈.
    fn rate(&self) -> Vec<Number> {
        let motions = self
            .placed
            .motions(self.given("qd"), &self.zeros(), Vector::default());
        let [v, a] = motions.last().copied().unwrap_or_default();
        let point = self.hand().origin;
        let velocity = sum(v.1, cross(v.0, point));
        let linear = sum(sum(a.1, cross(a.0, point)), cross(v.0, velocity));
        [linear, a.0].concat()
    }

    /// Returns Jᵀw.
    fn of_wrench(&self) -> Vec<Number> {
        times(&transposed(&self.jacobian()), self.given("wrench"))
    }

    /// Returns M + λ² 1.
    fn damped(&self, mut matrix: Matrix) -> Matrix {
        for (k, row) in matrix.iter_mut().enumerate() {
            row[k] = row[k] + self.given("damping")[0];
        }
        matrix
    }

    /// Returns J D⁻¹ and Λ⁻¹ = J D⁻¹ Jᵀ.
    fn mobility(&self) -> [Matrix; 2] {
        let j = self.jacobian();
        let driven = solve(self.inertia(), &j);
        let mobility = driven.iter().map(|row| times(&j, row)).collect();
        [driven, mobility]
    }

    /// Returns J̄ = D⁻¹ Jᵀ Λ.
    fn consistent(&self) -> Matrix {
        let [driven, mobility] = self.mobility();
        solve(self.damped(mobility), &transposed(&driven))
    }

    /// Returns the torques of an arm that has one parameter alone, parameter by parameter of each
    /// link.
    fn columns(&self, torques: impl Fn(&At) -> Vec<Number>) -> Matrix {
        let mut bare = self.arm.with(|_, _| Body::default());
        for own in &mut bare.joints {
            (own.viscous, own.armature) = (0.into(), 0.into());
        }
        let column = |place: usize| {
            let one = |k: usize| Number::from(i64::from(k == place % 10));
            let unit = Body::new(std::array::from_fn(one));
            let mut arm = bare.clone();
            let joint = &mut arm.joints[place / 10];
            joint.body = unit.moved(&joint.link);
            torques(&At::new(&arm, self.state))
        };
        (0..10 * self.count()).map(column).collect()
    }

    /// Returns the columns of all parameters that base parameters add up: those of links, then
    /// armature and friction of the joints that have some.
    fn base_columns(
        &self,
        rates: [&[Number]; 2],
        torques: impl Fn(&At) -> Vec<Number>,
    ) -> Vec<Number> {
        let mut columns = self.columns(torques);
        let units = units(self.count());
        for (place, rates) in rates.into_iter().enumerate() {
            for (k, own) in self.arm.joints.iter().enumerate() {
                let has = [own.armature, own.viscous][place].is_nonzero();
                let rate = if has { rates[k] } else { 0.into() };
                columns.push(units[k].iter().map(|one| *one * rate).collect());
            }
        }
        transposed(&columns).concat()
    }

    /// Returns D a + C v + c + b∘v.
    fn passivity(&self) -> Vec<Number> {
        let v = self.given("v");
        let loads = self.loads(&self.zeros(), self.given("a"), true);
        let across = self.across(self.given("qd"), v);
        self.with_friction(plus(loads, across), v)
    }

    /// Returns the arm with the tensors of its links alone, or with their masses alone.
    fn with_tensors_or_masses(&self, has_tensors: bool) -> Arm {
        self.arm.with(|_, own| {
            let (mut body, centre) = own.given;
            match has_tensors {
                true => body.mass = 0.into(),
                false => body.tensor = Default::default(),
            }
            body.moved(&centre)
        })
    }

    /// Returns a result that is no slope.
    fn value(&self, is: &str) -> Vec<Number> {
        let (n, qd, zeros) = (self.count(), self.given("qd"), self.zeros());
        match is {
            "tau" => self.torques(self.given("qdd")),
            "c" => self.gravity(),
            "d" => self.inertia().concat(),
            "h" => self.coriolis(qd),
            "d_rot" | "d_tran" | "h_rot" | "h_tran" => {
                let arm = self.with_tensors_or_masses(is.ends_with("rot"));
                let own = At::new(&arm, self.state);
                match is.starts_with('d') {
                    true => own.placed.inertia().concat(),
                    false => own.coriolis(qd),
                }
            }
            "symbols" => {
                let units = units(n);
                let column = |at: usize| self.across(&units[at / n], &units[at % n]);
                transposed(&(0..n * n).map(column).collect()).concat()
            }
            "kinetic" => vec![product(qd, &self.loads(&zeros, qd, false)) * self.arm.half],
            "potential" => {
                let first = self.placed.bodies.iter().map(|own| own.first);
                vec![-dot(self.arm.gravity, first.fold(Vector::default(), sum))]
            }
            "p" => self.loads(&zeros, qd, false),
            "ct_qd" => self.slope(),
            "drift" => minus(&self.slope(), &self.with_friction(self.gravity(), qd)),
            "c_matrix" => transposed(&self.columns_of_coriolis()).concat(),
            "pose" => self.hand().rows(),
            "poses" => {
                let links = self.placed.poses.iter().zip(&self.arm.joints);
                links
                    .flat_map(|(pose, own)| pose.then(&own.shown).rows())
                    .collect()
            }
            "jacobian" => self.jacobian().concat(),
            "jacobian_rate" => self.rate(),
            "wrenches" => {
                let wrenches = self
                    .placed
                    .wrenches(qd, self.given("qdd"), self.arm.gravity);
                let about = |(k, own): (usize, Screw)| {
                    let (origin, is_moved) = self.arm.joints[k].origin;
                    let all = if is_moved {
                        &self.placed.poses
                    } else {
                        &self.placed.before
                    };
                    [own.1, sum(own.0, cross(own.1, all[k].apply(origin)))].concat()
                };
                wrenches.into_iter().enumerate().flat_map(about).collect()
            }
            "passivity" => self.passivity(),
            "qdd" => self.accelerations(self.given("tau")),
            "d_inv" => solve(self.inertia(), &units(n)).concat(),
            "tau_wrench" => minus(&self.torques(self.given("qdd")), &self.of_wrench()),
            "qdd_wrench" => {
                let tau = plus(self.of_wrench(), self.given("tau").iter().copied());
                self.accelerations(&tau)
            }
            "contact_wrench" => {
                let j = self.jacobian();
                let square = j.iter().map(|row| times(&j, row)).collect();
                solve(self.damped(square), &[times(&j, self.given("tau"))]).concat()
            }
            "mobility" => self.mobility()[1].concat(),
            "operational_inertia" => {
                let [_, mobility] = self.mobility();
                solve(self.damped(mobility), &units(6)).concat()
            }
            "consistent_inverse" => self.consistent().concat(),
            "operational_bias" => {
                let [driven, mobility] = self.mobility();
                let driven = times(&driven, &self.loads(qd, &zeros, true));
                solve(self.damped(mobility), &[minus(&driven, &self.rate())]).concat()
            }
            "null_space" => {
                let j = transposed(&self.jacobian());
                let rows = self.consistent().into_iter().zip(units(n));
                rows.flat_map(|(row, unit)| minus(&unit, &times(&j, &row)))
                    .collect()
            }
            "y" => transposed(&self.columns(|own| own.torques(own.given("qdd")))).concat(),
            "y_base" => {
                self.base_columns([self.given("qdd"), qd], |own| own.torques(own.given("qdd")))
            }
            "y_passivity" => {
                let rates = [self.given("a"), self.given("v")];
                self.base_columns(rates, |own| own.passivity())
            }
            _ => Vec::new(),
        }
    }
}

/// Returns a result of an arm at a state, flat by rows: `dtau_dq` is the slopes of `tau` by q, and
/// `d2tau_dq_dqd` those of λᵀτ by q and q̇. None of a field that has no formula.
pub fn result(arm: &Arm, state: &State, field: &Field) -> Option<Vec<Number>> {
    let n = arm.joints.len();
    let mut words = field.is.split('_');
    let first = words.next()?;
    let of = first
        .strip_prefix("d2")
        .or(first.strip_prefix('d'))
        .unwrap_or("");
    let by = words.map(|word| argument(word.strip_prefix('d')?));
    let by = by.collect::<Option<Vec<usize>>>().unwrap_or_default();
    Some(match *by.as_slice() {
        [by] => {
            let column = |joint: usize| {
                let moved = state.moving(by, joint, 1);
                let values = At::new(arm, &moved).value(of).into_iter();
                values.map(|own| own.slope(1)).collect()
            };
            transposed(&(0..n).map(column).collect()).concat()
        }
        [one, other] => {
            let bend = |at: usize| {
                let moved = state.moving(one, at / n, 1).moving(other, at % n, 2);
                let values = At::new(arm, &moved).value(of).into_iter();
                let bends: Vec<Number> = values.map(|own| own.slope(3)).collect();
                product(&bends, &state.given[argument("multiplier").unwrap_or(0)])
            };
            (0..n * n).map(bend).collect()
        }
        _ => At::new(arm, state).value(field.is),
    })
}

fn product(a: &[Number], b: &[Number]) -> Number {
    let products = a.iter().zip(b).map(|(a, b)| *a * *b);
    products.fold(0.into(), |a, b| a + b)
}

fn plus(a: Vec<Number>, b: impl IntoIterator<Item = Number>) -> Vec<Number> {
    a.into_iter().zip(b).map(|(a, b)| a + b).collect()
}

fn minus(a: &[Number], b: &[Number]) -> Vec<Number> {
    a.iter().zip(b).map(|(a, b)| *a - *b).collect()
}

/// Returns M x.
fn times(matrix: &Matrix, x: &[Number]) -> Vec<Number> {
    matrix.iter().map(|row| product(row, x)).collect()
}

fn units(n: usize) -> Matrix {
    let one = |i: usize, k: usize| i64::from(i == k).into();
    (0..n)
        .map(|i| (0..n).map(|k| one(i, k)).collect())
        .collect()
}

fn transposed(matrix: &Matrix) -> Matrix {
    let length = matrix.first().map_or(0, Vec::len);
    (0..length)
        .map(|k| matrix.iter().map(|row| row[k]).collect())
        .collect()
}

/// Returns M⁻¹ x of each x, by Gauss: M is symmetric, and no pivot is zero but by chance.
fn solve(mut m: Matrix, right: &[Vec<Number>]) -> Matrix {
    let (n, mut right) = (m.len(), right.to_vec());
    for k in 0..n {
        for i in k + 1..n {
            let factor = m[i][k] / m[k][k];
            let pivot = m[k].clone();
            let both = m[i].iter_mut().zip(&pivot).skip(k);
            both.for_each(|(own, above)| *own = *own - factor * *above);
            right.iter_mut().for_each(|x| x[i] = x[i] - factor * x[k]);
        }
    }
    for x in &mut right {
        for k in (0..n).rev() {
            let known = product(&m[k][k + 1..], &x[k + 1..]);
            x[k] = (x[k] - known) / m[k][k];
        }
    }
    right
}
