//! Every result by the equations of Newton and Euler in base axes. Slopes are those of the numbers,
//! so that no derivative is written out.

use super::arm::{Arm, Joint, Placed};
use super::matrix::{Matrix, minus, plus, product, solve, times, transposed, units};
use super::number::Number;
use super::program::argument;
use super::screw::{Body, Pose, Screw, Vector, cross, dot, sum};
use super::setting::Setting;
use super::state::State;
use super::table::{Field, View};

/// An arm at a state, and the frame that is its hand.
struct At<'a> {
    arm: &'a Arm,
    placed: Placed,
    state: &'a State,
    view: &'a View,
}

impl<'a> At<'a> {
    fn new(arm: &'a Arm, state: &'a State, view: &'a View) -> At<'a> {
        let placed = arm.at(state);
        At {
            arm,
            placed,
            state,
            view,
        }
    }

    /// Returns another arm at the same state.
    fn with<'b>(&'b self, arm: &'b Arm) -> At<'b> {
        At::new(arm, self.state, self.view)
    }

    /// Returns the number of joints that move by themselves.
    fn count(&self) -> usize {
        self.arm.movers.len()
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
        let rates = [qd, qdd].map(|rates| self.arm.spread(rates));
        let wrenches = self.placed.wrenches(&rates[0], &rates[1], gravity);
        let torques = self.placed.axes.iter().zip(wrenches);
        let torques = torques.map(|(axis, wrench)| axis.power(wrench));
        let torques = self.arm.gathered(torques);
        self.with_drives(torques, |own| own.armature, qdd)
    }

    fn with_friction(&self, loads: Vec<Number>, rates: &[Number]) -> Vec<Number> {
        let loads = self.with_drives(loads, |own| own.viscous, rates);
        let joints = self.arm.movers.iter().zip(&self.state.speeds).zip(rates);
        let dry = joints.map(|((row, speed), rate)| self.arm.joints[*row].coulomb * *speed * *rate);
        plus(loads, dry)
    }

    /// Adds a number of each joint times its rate.
    fn with_drives(
        &self,
        loads: Vec<Number>,
        number: fn(&Joint) -> Number,
        rates: &[Number],
    ) -> Vec<Number> {
        let rates = self.arm.spread(rates).into_iter();
        let rows = self.arm.joints.iter().zip(rates);
        let drives = rows.map(|(own, rate)| number(own) * rate);
        plus(loads, self.arm.gathered(drives))
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
        self.square(d)
    }

    /// Returns Sᵀ M S: what is of rows, over joints.
    fn square(&self, rows: Matrix) -> Matrix {
        let half = rows.into_iter().map(|row| self.arm.gathered(row)).collect();
        let columns = transposed(&half).into_iter();
        columns.map(|column| self.arm.gathered(column)).collect()
    }

    /// Returns D⁻¹ x of each x; what is locked stands still.
    fn driven(&self, right: &[Vec<Number>]) -> Matrix {
        let (free, d) = (&self.arm.free, self.inertia());
        let pick = |row: &Vec<Number>| free.iter().map(|&k| row[k]).collect::<Vec<Number>>();
        let own: Matrix = free.iter().map(|&i| pick(&d[i])).collect();
        let right: Matrix = right.iter().map(pick).collect();
        let spread = |own: Vec<Number>| {
            let mut all = self.zeros();
            free.iter().zip(own).for_each(|(&k, own)| all[k] = own);
            all
        };
        solve(own, &right).into_iter().map(spread).collect()
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
        self.driven(&[rest]).concat()
    }

    /// Returns the row of the link that has the hand, or the frame in its place, and its pose; of a
    /// frame that is not there nothing.
    fn hand(&self) -> Option<(usize, Pose)> {
        let is_hand = self.view.frame.is_empty() || self.view.frame == self.arm.hand.name;
        let mut frames = self.arm.frames.iter();
        let own = match is_hand {
            true => Some(&self.arm.hand),
            false => frames.find(|own| own.name == self.view.frame),
        }?;
        let pose = self.placed.poses.get(own.row)?;
        Some((own.row, pose.then(&own.pose)))
    }

    /// Returns the components that are asked for of a motion of the hand's link, linear over
    /// angular.
    fn seen(&self, motion: Screw, hand: &Pose) -> Vec<Number> {
        let linear = sum(motion.1, cross(motion.0, hand.origin));
        let six = match self.view.axes.as_str() {
            "world" => [motion.1, motion.0],
            "local" => [linear, motion.0].map(|own| hand.back(own)),
            _ => [linear, motion.0],
        };
        self.picked(six.concat())
    }

    /// Returns the components that are asked for, of six.
    fn picked(&self, six: Vec<Number>) -> Vec<Number> {
        match self.view.rows.as_slice() {
            [] => six,
            rows => rows.iter().map(|&row| six[row]).collect(),
        }
    }

    /// Returns J of the hand.
    fn jacobian(&self) -> Matrix {
        let Some((last, hand)) = self.hand() else {
            return Vec::new();
        };
        let column = |(row, own): (usize, &Screw)| {
            let own = if row <= last { *own } else { Screw::default() };
            self.seen(own, &hand)
        };
        let columns = self.placed.axes.iter().enumerate().map(column).collect();
        let rows = transposed(&columns).into_iter();
        rows.map(|row| self.arm.gathered(row)).collect()
    }

    /// Returns J of what moves.
    fn moving_jacobian(&self) -> Matrix {
        let mut j = self.jacobian();
        for row in &mut j {
            for (k, own) in row.iter_mut().enumerate() {
                if !self.arm.free.contains(&k) {
                    *own = 0.into();
                }
            }
        }
        j
    }

    /// Returns J̇q̇: the acceleration of the hand without q̈.
    fn rate(&self) -> Vec<Number> {
        let rates = [self.given("qd"), &self.zeros()].map(|rates| self.arm.spread(rates));
        let motions = self.placed.motions(&rates[0], &rates[1], Vector::default());
        let Some((last, hand)) = self.hand() else {
            return Vec::new();
        };
        let [v, a] = motions.get(last).copied().unwrap_or_default();
        let velocity = sum(v.1, cross(v.0, hand.origin));
        let mixed = sum(sum(a.1, cross(a.0, hand.origin)), cross(v.0, velocity));
        let six = match self.view.axes.as_str() {
            "world" => [a.1, a.0],
            // The frame's axes turn as well.
            "local" => [sum(mixed, cross(velocity, v.0)), a.0].map(|own| hand.back(own)),
            _ => [mixed, a.0],
        };
        self.picked(six.concat())
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
        let j = self.moving_jacobian();
        let driven = self.driven(&j);
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
            (own.viscous, own.armature, own.coulomb) = (0.into(), 0.into(), 0.into());
        }
        let column = |place: usize| {
            let one = |k: usize| Number::from(i64::from(k == place % 10));
            let unit = Body::new(std::array::from_fn(one));
            let mut arm = bare.clone();
            let joint = &mut arm.joints[place / 10];
            joint.body = unit.moved(&joint.link);
            torques(&self.with(&arm))
        };
        (0..10 * self.arm.joints.len()).map(column).collect()
    }

    /// Returns the columns of all parameters that base parameters add up: those of links, then
    /// armature and friction of the joints that have some.
    fn base_columns(
        &self,
        rates: [&[Number]; 2],
        torques: impl Fn(&At) -> Vec<Number>,
    ) -> Vec<Number> {
        let mut columns = self.columns(torques);
        let units = units(self.arm.joints.len());
        for (place, rates) in rates.into_iter().enumerate() {
            let rates = self.arm.spread(rates);
            for (k, own) in self.arm.joints.iter().enumerate() {
                let has = [own.armature, own.viscous][place].is_nonzero();
                let rate = if has { rates[k] } else { 0.into() };
                let column = units[k].iter().map(|one| *one * rate);
                columns.push(self.arm.gathered(column));
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
                let own = self.with(&arm);
                match is.starts_with('d') {
                    true => own.square(own.placed.inertia()).concat(),
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
            "pose" => self.hand().map_or_else(Vec::new, |(_, hand)| hand.rows()),
            "poses" => {
                let links = self.placed.poses.iter().zip(&self.arm.joints);
                links
                    .flat_map(|(pose, own)| pose.then(&own.shown).rows())
                    .collect()
            }
            "jacobian" => self.jacobian().concat(),
            "jacobian_rate" => self.rate(),
            "wrenches" => {
                let rates = [qd, self.given("qdd")].map(|rates| self.arm.spread(rates));
                let [qd, qdd] = &rates;
                let wrenches = self.placed.wrenches(qd, qdd, self.arm.gravity);
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
            "d_inv" => self.driven(&units(n)).concat(),
            "tau_wrench" => minus(&self.torques(self.given("qdd")), &self.of_wrench()),
            "qdd_wrench" => {
                let tau = plus(self.of_wrench(), self.given("tau").iter().copied());
                self.accelerations(&tau)
            }
            "contact_wrench" => {
                let j = self.moving_jacobian();
                let square = j.iter().map(|row| times(&j, row)).collect();
                solve(self.damped(square), &[times(&j, self.given("tau"))]).concat()
            }
            "mobility" => self.mobility()[1].concat(),
            "operational_inertia" => {
                let [_, mobility] = self.mobility();
                let units = units(mobility.len());
                solve(self.damped(mobility), &units).concat()
            }
            "consistent_inverse" => self.consistent().concat(),
            "operational_bias" => {
                let [driven, mobility] = self.mobility();
                let driven = times(&driven, &self.loads(qd, &zeros, true));
                solve(self.damped(mobility), &[minus(&driven, &self.rate())]).concat()
            }
            "null_space" => {
                let j = transposed(&self.moving_jacobian());
                // What is locked is in no space.
                let unit = |k: usize, mut unit: Vec<Number>| {
                    unit[k] = if self.arm.free.contains(&k) { 1 } else { 0 }.into();
                    unit
                };
                let units = units(n).into_iter().enumerate();
                let rows = self.consistent().into_iter().zip(units);
                rows.flat_map(|(row, (k, own))| minus(&unit(k, own), &times(&j, &row)))
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
    let n = arm.movers.len();
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
                let values = At::new(arm, &moved, &field.view).value(of).into_iter();
                values.map(|own| own.slope(1)).collect()
            };
            transposed(&(0..n).map(column).collect()).concat()
        }
        [one, other] => {
            let bend = |at: usize| {
                // Of a motion that is solved for, what is locked has none.
                let is_held = |joint: usize| !arm.free.contains(&joint);
                if of == "qdd" && (is_held(at / n) || is_held(at % n)) {
                    return 0.into();
                }
                let moved = state.moving(one, at / n, 1).moving(other, at % n, 2);
                let values = At::new(arm, &moved, &field.view).value(of).into_iter();
                let bends: Vec<Number> = values.map(|own| own.slope(3)).collect();
                product(&bends, &state.given[argument("multiplier").unwrap_or(0)])
            };
            (0..n * n).map(bend).collect()
        }
        _ => At::new(arm, state, &field.view).value(field.is),
    })
}

/// Returns those entries of a result that are over the joints that a scene asks for.
pub fn selected(field: &Field, setting: &Setting, values: Vec<Number>) -> Vec<Number> {
    let lengths = field.lengths(setting, 0).into_iter();
    let mut parts = vec![values];
    for (axis, length) in field.axes.chars().zip(lengths) {
        // Behind these nothing is over joints.
        if ['l', 'b'].contains(&axis) {
            break;
        }
        let all: Vec<usize> = (0..length).collect();
        let (count, rows) = match axis {
            'n' => (setting.joints(), &setting.rows),
            _ => (length, &all),
        };
        let split = parts.iter().flat_map(|part| {
            let length = part.len() / count.max(1);
            let pick = move |row: &usize| part[row * length..(row + 1) * length].to_vec();
            rows.iter().map(pick)
        });
        parts = split.collect();
    }
    parts.concat()
}
