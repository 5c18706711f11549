//! Every result by the equations of Newton and Euler in base axes, D by the links that move as one.
//! Slopes are those of the numbers, so that no derivative is written out.

use super::arm::{Arm, HAND, Joint};
use super::matrix::{Matrix, minus, plus, product, solve, times, transposed, units};
use super::number::Number;
use super::screw::{Body, Pose, Screw, Vector, cross, dot, opposite, sum};
use super::state::State;
use super::table::{Field, View};
use crate::program::argument;

/// An arm at a state, and the frame that is its hand.
#[derive(Clone)]
pub(super) struct At<'a> {
    arm: &'a Arm,
    state: &'a State,
    pub(super) view: &'a View,
    axes: Vec<Screw>,
    pub(super) base: Option<Body>,
    pub(super) bodies: Vec<Body>,
    /// The motion of the base, and then of each link.
    poses: Vec<Pose>,
}

impl<'a> At<'a> {
    fn new(arm: &'a Arm, state: &'a State, view: &'a View) -> At<'a> {
        let mut poses = vec![Pose::shift(Vector::default())];
        let carrier = |joint: &Joint| joint.parent.map_or(0, |parent| parent + 1);
        for joint in &arm.joints {
            poses.push(poses[carrier(joint)].then(&joint.motion(state)));
        }
        let axis = |joint: &Joint| poses[carrier(joint)].screw(joint.axis);
        let bodies = arm.joints.iter().zip(&poses[1..]);
        At {
            arm,
            state,
            view,
            axes: arm.joints.iter().map(axis).collect(),
            base: arm.base,
            bodies: bodies.map(|(joint, pose)| joint.body.moved(pose)).collect(),
            poses,
        }
    }

    /// Returns it with another frame for a hand.
    pub(super) fn seen_as<'v>(&'v self, view: &'v View) -> At<'v> {
        At {
            view,
            ..self.clone()
        }
    }

    fn moved<'b>(&'b self, state: &'b State, by: &[usize]) -> At<'b> {
        match by.contains(&0) {
            true => At::new(self.arm, state, self.view),
            false => At {
                state,
                ..self.clone()
            },
        }
    }

    fn count(&self) -> usize {
        self.first() + self.arm.movers.len()
    }

    /// Returns how many coordinates come before those of the joints.
    pub(super) fn first(&self) -> usize {
        self.arm.base_coordinates()
    }

    fn of_base(&self, rates: &[Number]) -> Screw {
        match self.base {
            Some(_) => screw(rates),
            None => Screw::default(),
        }
    }

    pub(super) fn given(&self, name: &str) -> &'a [Number] {
        argument(name).map_or(&[], |place| &self.state.arguments[place])
    }

    pub(super) fn zeros(&self) -> Vec<Number> {
        vec![0.into(); self.count()]
    }

    /// Returns the wrench on the base, and the one that each joint passes on, by the equations of
    /// Newton and Euler. Rates of components in axes that turn are those of a motion as such.
    pub(super) fn wrenches(
        &self,
        qd: &[Number],
        qdd: &[Number],
        gravity: Vector,
    ) -> (Screw, Vec<Screw>) {
        // A base that is accelerated upward feels what one in gravity does.
        let lifted = Screw(Vector::default(), opposite(gravity));
        let base = (self.of_base(qd), self.of_base(qdd).plus(lifted));
        let [qd, qdd] = [qd, qdd].map(|rates| self.arm.spread(rates));
        let exerted = |body: &Body, (v, a): (Screw, Screw)| {
            let turned = v.across_momentum(body.momentum(v));
            body.momentum(a).plus(turned)
        };
        let root = self.base;
        let mut on_base = root.map_or_else(Screw::default, |body| exerted(&body, base));
        let mut motions: Vec<(Screw, Screw)> = Vec::new();
        let mut wrenches: Vec<Screw> = Vec::new();
        for (k, joint) in self.arm.joints.iter().enumerate() {
            let (v, a) = joint.parent.map_or(base, |carrier| motions[carrier]);
            let (axis, body) = (self.axes[k], &self.bodies[k]);
            let motion = axis.times(qd[k]);
            let a = a.plus(axis.times(qdd[k])).plus(v.across(motion));
            let v = v.plus(motion);
            motions.push((v, a));
            wrenches.push(exerted(body, (v, a)));
        }
        for k in (0..wrenches.len()).rev() {
            let wrench = wrenches[k];
            let carrier = self.arm.joints[k].parent;
            let carrier = carrier.map_or(&mut on_base, |carrier| &mut wrenches[carrier]);
            *carrier = carrier.plus(wrench);
        }
        (on_base, wrenches)
    }

    /// Returns D q̈ + h, and c if there is gravity, without friction.
    fn loads(&self, qd: &[Number], qdd: &[Number], gravity: Vector) -> Vec<Number> {
        let (on_base, wrenches) = self.wrenches(qd, qdd, gravity);
        let torque = |(axis, wrench): (&Screw, Screw)| axis.power(wrench);
        let torques = self.axes.iter().zip(wrenches).map(torque);
        let mut loads = self.arm.gathered(torques);
        let units = base_units().into_iter().take(self.first());
        for (load, unit) in loads.iter_mut().zip(units) {
            *load = unit.power(on_base);
        }
        let drives = self.drives(|joint| joint.armature, qdd);
        plus(&loads, &drives)
    }

    fn with_friction(&self, loads: &[Number], rates: &[Number]) -> Vec<Number> {
        // A joint that follows another has no Coulomb friction.
        let speed = |joint: &Joint| self.state.speeds[self.first() + joint.leader.0];
        let drag = self.drives(|joint| joint.viscous + joint.coulomb * speed(joint), rates);
        plus(loads, &drag)
    }

    fn drives(&self, number: impl Fn(&Joint) -> Number, rates: &[Number]) -> Vec<Number> {
        let rows = self.arm.joints.iter().zip(self.arm.spread(rates));
        let drives = rows.map(|(joint, rate)| number(joint) * rate);
        self.arm.gathered(drives)
    }

    pub(super) fn torques(&self, qdd: &[Number]) -> Vec<Number> {
        let qd = self.given("qd");
        self.with_friction(&self.loads(qd, qdd, self.arm.gravity), qd)
    }

    fn gravity(&self) -> Vec<Number> {
        self.loads(&self.zeros(), &self.zeros(), self.arm.gravity)
    }

    /// Returns D: if one joint alone moves, all links behind it move as one body.
    pub(super) fn inertia(&self) -> Matrix {
        let mut d = vec![self.zeros(); self.count()];
        let (mut behind, first) = (self.bodies.clone(), self.first());
        let mut whole = self.base.unwrap_or_default();
        let units = || base_units().into_iter().take(first).enumerate();
        for (k, joint) in self.arm.joints.iter().enumerate().rev() {
            let body = behind[k];
            let parent = joint.parent;
            let carrier = parent.map_or(&mut whole, |carrier| &mut behind[carrier]);
            *carrier = carrier.plus(&body);
            let momentum = body.momentum(self.axes[k]);
            let (leader, factor) = joint.leader;
            let row = first + leader;
            d[row][row] = d[row][row] + joint.armature * factor * factor;
            for (column, unit) in units() {
                let entry = unit.power(momentum) * factor;
                d[row][column] = d[row][column] + entry;
                d[column][row] = d[column][row] + entry;
            }
            for i in self.arm.way(Some(k)) {
                let (leader, other) = self.arm.joints[i].leader;
                let column = first + leader;
                let entry = self.axes[i].power(momentum) * factor * other;
                d[row][column] = d[row][column] + entry;
                if i < k {
                    d[column][row] = d[column][row] + entry;
                }
            }
        }
        for (row, unit) in units() {
            for (column, other) in units() {
                d[row][column] = other.power(whole.momentum(unit));
            }
        }
        d
    }

    pub(super) fn moving(&self, mut rows: Matrix) -> Matrix {
        for &joint in &self.arm.locked {
            rows.iter_mut().for_each(|row| row[joint] = 0.into());
        }
        rows
    }

    /// Returns D⁻¹ x of each x; what is locked stands still.
    pub(super) fn driven(&self, right: Matrix) -> Matrix {
        let mut d = self.moving(transposed(&self.moving(self.inertia())));
        for &joint in &self.arm.locked {
            // Any number of the field but zero.
            d[joint][joint] = self.arm.half;
        }
        solve(d, self.moving(right))
    }

    fn coriolis(&self, qd: &[Number]) -> Vec<Number> {
        self.loads(qd, &self.zeros(), Vector::default())
    }

    fn momentum(&self) -> Vec<Number> {
        self.loads(&self.zeros(), self.given("qd"), Vector::default())
    }

    /// Returns C(v) w: h is quadratic, so it is half of h(v + w) − h(v) − h(w). For a base that floats
    /// half of D [v, w] comes in: how far motions that are constant in its axes do not commute.
    fn across(&self, v: &[Number], w: &[Number]) -> Vec<Number> {
        let both = self.coriolis(&plus(v, w));
        let mut twice = minus(&minus(&both, &self.coriolis(v)), &self.coriolis(w));
        if self.base.is_some() {
            let mut bracket = self.zeros();
            let Screw(turn, shift) = screw(v).across(screw(w));
            bracket[..3].copy_from_slice(&shift);
            bracket[3..6].copy_from_slice(&turn);
            let momentum = self.loads(&self.zeros(), &bracket, Vector::default());
            twice = plus(&twice, &momentum);
        }
        let half = |entry: Number| entry * self.arm.half;
        twice.into_iter().map(half).collect()
    }

    fn columns_of_coriolis(&self) -> Matrix {
        let column = |unit: Vec<Number>| self.across(self.given("qd"), &unit);
        units(self.count()).into_iter().map(column).collect()
    }

    fn slope(&self) -> Vec<Number> {
        times(&self.columns_of_coriolis(), self.given("qd"))
    }

    pub(super) fn accelerations(&self, tau: &[Number]) -> Vec<Number> {
        let rest = minus(tau, &self.torques(&self.zeros()));
        self.driven(vec![rest]).concat()
    }

    pub(super) fn hand(&self) -> Option<(Option<usize>, Pose)> {
        let name = match self.view.frame.as_str() {
            "" => HAND,
            name => name,
        };
        let frame = self.arm.frames.iter().find(|frame| frame.name == name)?;
        let pose = self.poses.get(frame.row.map_or(0, |row| row + 1))?;
        Some((frame.row, pose.then(&frame.pose)))
    }

    /// Linear components stand over angular ones.
    fn seen(&self, motion: Screw, hand: &Pose) -> Vec<Number> {
        let linear = sum(motion.1, cross(motion.0, hand.origin));
        let six = match self.view.axes.as_str() {
            "world" => [motion.1, motion.0],
            "local" => [linear, motion.0].map(|vector| hand.back(vector)),
            _ => [linear, motion.0],
        };
        let six = six.concat();
        match self.view.rows.as_slice() {
            [] => six,
            rows => rows.iter().map(|&row| six[row]).collect(),
        }
    }

    pub(super) fn jacobian(&self) -> Matrix {
        let Some((last, hand)) = self.hand() else {
            return Vec::new();
        };
        let way: Vec<usize> = self.arm.way(last).collect();
        let column = |(row, axis): (usize, &Screw)| {
            let is_on_way = way.contains(&row);
            let motion = if is_on_way { *axis } else { Screw::default() };
            self.seen(motion, &hand)
        };
        let columns = self.axes.iter().enumerate().map(column).collect();
        let base = base_units().map(|unit| self.seen(unit, &hand));
        let base = transposed(&base[..self.first()].to_vec());
        let with_base = |(k, row): (usize, Vec<Number>)| {
            let mut row = self.arm.gathered(row);
            if let Some(entries) = base.get(k) {
                row[..entries.len()].copy_from_slice(entries);
            }
            row
        };
        let rows = transposed(&columns).into_iter().enumerate();
        rows.map(with_base).collect()
    }

    fn slopes(&self, by: usize, of: impl Fn(&At) -> Vec<Number>) -> Matrix {
        let before = if by == 0 { self.first() } else { 0 };
        let column = |coordinate: usize| {
            let numbers = match coordinate.checked_sub(before) {
                Some(index) => {
                    let moved = self.state.moving(by, index, 1);
                    of(&self.moved(&moved, &[by]))
                }
                None => {
                    let arm = self.arm.with_base_turned(coordinate);
                    of(&At {
                        arm: &arm,
                        ..self.clone()
                    })
                }
            };
            parts(numbers, 1)
        };
        transposed(&(0..self.count()).map(column).collect())
    }

    /// Returns J̇q̇: the slope of J q̇ along q̇, in axes that do not turn.
    pub(super) fn rate(&self) -> Vec<Number> {
        let qd = self.given("qd");
        let rate = times(&self.slopes(0, |at| times(&at.jacobian(), qd)), qd);
        let (Some(_), Some((last, hand))) = (self.base, self.hand()) else {
            return rate;
        };
        // Components in the base's axes, which turn; in the hand's they are what they are.
        let base = screw(qd);
        let (links, rates) = (self.arm.way(last), self.arm.spread(qd));
        let motion = links.fold(base, |motion, k| motion.plus(self.axes[k].times(rates[k])));
        let turned = match self.view.axes.as_str() {
            "local" => return rate,
            "world" => base.across(motion),
            _ => {
                let linear = sum(motion.1, cross(motion.0, hand.origin));
                let linear = cross(base.0, linear);
                // Seen at the hand, the linear part is that of its point.
                let angular = cross(base.0, motion.0);
                Screw(angular, sum(linear, cross(hand.origin, angular)))
            }
        };
        plus(&rate, &self.seen(turned, &hand))
    }

    /// Ten columns a link, then armature and viscous friction of the rows that have some.
    fn columns(&self, torques: impl Fn(&At) -> Vec<Number>) -> Matrix {
        let (rows, step) = (self.arm.joints.len(), Number::step(1));
        let bodies = rows + usize::from(self.base.is_some());
        let column = |place: usize| {
            let mut at = self.clone();
            if place < 10 * bodies {
                let entry = |k: usize| if k == place % 10 { step } else { 0.into() };
                let body = Body::new(std::array::from_fn(entry));
                match ((place / 10 + rows).checked_sub(bodies), &mut at.base) {
                    (Some(link), _) => {
                        let body = body.moved(&self.arm.joints[link].shown);
                        at.bodies[link] = at.bodies[link].plus(&body.moved(&self.poses[link + 1]));
                    }
                    (None, Some(base)) => *base = base.plus(&body),
                    (None, None) => {}
                }
                return parts(torques(&at), 1);
            }
            let place = place - 10 * bodies;
            let mut arm = self.arm.clone();
            let joint = &mut arm.joints[place % rows];
            let one = match place < rows {
                true => &mut joint.armature,
                false => &mut joint.viscous,
            };
            *one = if one.is_nonzero() { *one + step } else { *one };
            parts(torques(&At { arm: &arm, ..at }), 1)
        };
        (0..10 * bodies + 2 * rows).map(column).collect()
    }

    /// Returns D a + C v + c + b∘v.
    fn passivity(&self) -> Vec<Number> {
        let v = self.given("v");
        let loads = self.loads(&self.zeros(), self.given("a"), self.arm.gravity);
        let across = self.across(self.given("qd"), v);
        self.with_friction(&plus(&loads, &across), v)
    }

    fn with_tensors_or_masses(&self, has_tensors: bool) -> Arm {
        let mut arm = self.arm.clone();
        for joint in &mut arm.joints {
            let (mut body, centre) = joint.centred;
            match has_tensors {
                true => body.mass = 0.into(),
                false => body.tensor = Default::default(),
            }
            joint.body = body.moved(&centre);
            joint.armature = 0.into();
        }
        arm
    }

    fn value(&self, name: &str) -> Vec<Number> {
        let (n, qd) = (self.count(), self.given("qd"));
        match name {
            "tau" => self.torques(self.given("qdd")),
            "c" => self.gravity(),
            "d" | "d_limbs" => self.inertia().concat(),
            "h" => self.coriolis(qd),
            "d_rot" | "d_tran" | "h_rot" | "h_tran" => {
                let arm = self.with_tensors_or_masses(name.ends_with("rot"));
                let at = At::new(&arm, self.state, self.view);
                match name.starts_with('d') {
                    true => at.inertia().concat(),
                    false => at.coriolis(qd),
                }
            }
            "symbols" => {
                let units = units(n);
                let column = |at: usize| self.across(&units[at / n], &units[at % n]);
                transposed(&(0..n * n).map(column).collect()).concat()
            }
            "kinetic" => vec![product(qd, &self.momentum()) * self.arm.half],
            "potential" => {
                let bodies = self.base.iter().chain(&self.bodies);
                let first = bodies.map(|body| body.first);
                vec![-dot(self.arm.gravity, first.fold(Vector::default(), sum))]
            }
            "p" => self.momentum(),
            "ct_qd" => self.slope(),
            "drift" => minus(&self.slope(), &self.with_friction(&self.gravity(), qd)),
            "c_matrix" => transposed(&self.columns_of_coriolis()).concat(),
            "pose" => self.hand().map_or_else(Vec::new, |(_, hand)| hand.rows()),
            "poses" => {
                let links = self.poses[1..].iter().zip(&self.arm.joints);
                let rows = links.flat_map(|(pose, joint)| pose.then(&joint.shown).rows());
                rows.collect()
            }
            "jacobian" => self.jacobian().concat(),
            "jacobian_rate" => self.rate(),
            "wrenches" => {
                let (_, wrenches) = self.wrenches(qd, self.given("qdd"), self.arm.gravity);
                let about = |(k, wrench): (usize, Screw)| {
                    let (origin, is_moved) = self.arm.joints[k].origin;
                    let origin = self.poses[k + usize::from(is_moved)].apply(origin);
                    [wrench.1, sum(wrench.0, cross(wrench.1, origin))].concat()
                };
                wrenches.into_iter().enumerate().flat_map(about).collect()
            }
            "com" => self.centre().to_vec(),
            "centroidal_momentum_matrix" => {
                let rest = self.zeros();
                let units = units(n).into_iter();
                let columns = units.map(|unit| self.about_centre(&rest, &unit));
                transposed(&columns.collect()).concat()
            }
            "centroidal_bias" => self.about_centre(qd, &self.zeros()),
            "tau_free" => {
                let mut torques = self.torques(&self.in_flight());
                torques[..self.first()].fill(0.into());
                torques
            }
            "base_acceleration" => self.in_flight()[..self.first()].to_vec(),
            "d_base" | "d_coupling" => {
                let (base, d) = (self.first(), self.inertia());
                let columns = if name == "d_base" { 0..base } else { base..n };
                let part = |row: &Vec<Number>| row[columns.clone()].to_vec();
                d[..base].iter().flat_map(part).collect()
            }
            "contact_jacobians" => self.contact_jacobians().concat(),
            "contact_bias" => self.contact_bias(),
            "qdd_held" => self.held()[0].clone(),
            "forces" => self.held()[1].clone(),
            "passivity" => self.passivity(),
            "qdd" => self.accelerations(self.given("tau")),
            "d_inv" => self.driven(units(n)).concat(),
            "tau_wrench" => minus(&self.torques(self.given("qdd")), &self.of_wrench()),
            "qdd_wrench" => self.accelerations(&plus(&self.of_wrench(), self.given("tau"))),
            "contact_wrench" => {
                let j = self.moving_jacobian();
                let square = j.iter().map(|row| times(&j, row)).collect();
                solve(self.damped(square), vec![times(&j, self.given("tau"))]).concat()
            }
            "mobility" => self.mobility()[1].concat(),
            "operational_inertia" => {
                let [_, mobility] = self.mobility();
                let units = units(mobility.len());
                solve(self.damped(mobility), units).concat()
            }
            "consistent_inverse" => self.consistent().concat(),
            "operational_bias" => {
                let [driven, mobility] = self.mobility();
                let driven = times(&driven, &self.loads(qd, &self.zeros(), self.arm.gravity));
                solve(self.damped(mobility), vec![minus(&driven, &self.rate())]).concat()
            }
            "null_space" => {
                let j = transposed(&self.moving_jacobian());
                // A locked coordinate is in no space.
                let units = self.moving(units(n)).into_iter();
                let both = units.zip(self.consistent());
                let row = |(unit, inverse): (Vec<Number>, Vec<Number>)| {
                    minus(&unit, &times(&j, &inverse))
                };
                both.flat_map(row).collect()
            }
            "y" | "y_base" => {
                let mut columns = self.columns(|at| at.torques(at.given("qdd")));
                if name == "y" {
                    let drives = 2 * self.arm.joints.len();
                    columns.truncate(columns.len() - drives);
                }
                transposed(&columns).concat()
            }
            "y_passivity" => transposed(&self.columns(|at| at.passivity())).concat(),
            _ => Vec::new(),
        }
    }
}

/// Returns the motion of which these are the components, linear over angular.
fn screw(six: &[Number]) -> Screw {
    let part = |from: usize| std::array::from_fn(|k| six[from + k]);
    Screw(part(3), part(0))
}

/// Returns unit motions of a base that floats: along x, y and z, then about these.
fn base_units() -> [Screw; 6] {
    let unit = |k: usize| std::array::from_fn(|i| Number::from(i64::from(i == k)));
    std::array::from_fn(|k| match k.checked_sub(3) {
        None => Screw(Vector::default(), unit(k)),
        Some(axis) => Screw(unit(axis), Vector::default()),
    })
}

fn parts(values: Vec<Number>, part: usize) -> Vec<Number> {
    values.into_iter().map(|value| value.slope(part)).collect()
}

/// Returns a result of an arm at a state, flat by rows: `dtau_dq` is the slopes of `tau` by q, and
/// `d2tau_dq_dqd` those of λᵀτ by q and q̇. None of a field that has no formula.
pub fn result(arm: &Arm, state: &State, field: &Field) -> Option<Vec<Number>> {
    let arm_at_state = At::new(arm, state, &field.view);
    if field.is_of_base(arm.base.is_none()) {
        return None;
    }
    // A frame that is not there has no results, of which others would be short.
    if field.is_of_frame() {
        arm_at_state.of_points(|_| Matrix::new())?;
    }
    let n = arm.movers.len();
    let mut words = field.quantity.split('_');
    let first = words.next()?;
    let of = first.trim_start_matches('d').trim_start_matches('2');
    let by: Option<Vec<usize>> = words.map(|key| argument(key.strip_prefix('d')?)).collect();
    Some(match *by.unwrap_or_default().as_slice() {
        [by] => arm_at_state.slopes(by, |at| at.value(of)).concat(),
        [one, other] => {
            let bend = |at: usize, known: &[Number]| {
                if one == other && at % n < at / n {
                    return known[at % n * n + at / n];
                }
                // A locked coordinate has none of a motion that is solved for.
                let is_held = |joint: &usize| arm.locked.contains(joint);
                if of == "qdd" && [at / n, at % n].iter().any(is_held) {
                    return 0.into();
                }
                let moved = state.moving(one, at / n, 1).moving(other, at % n, 2);
                let bends = parts(arm_at_state.moved(&moved, &[one, other]).value(of), 3);
                product(&bends, arm_at_state.given("multiplier"))
            };
            (0..n * n).fold(Vec::new(), |mut entries, at| {
                entries.push(bend(at, &entries));
                entries
            })
        }
        _ => arm_at_state.value(field.quantity),
    })
}
