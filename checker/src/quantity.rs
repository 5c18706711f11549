//! The results of functions, each by the recursion.
//!
//! Derivatives are slopes of the recursion on numbers that have one. Half the slope of h(v) along
//! a velocity w is C(v) w, which gives the Coriolis matrix and the Christoffel symbols.

use Quantity::*;

use crate::dynamics::{State, torques};
use crate::fault::Fault;
use crate::kinematics::Arm;
use crate::number::{Dual, Number, Work};
use crate::scene::Setting;

/// A part of what a function returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// τ = D q̈ + h + c + b∘q̇
    Torque,
    /// c
    Gravity,
    /// D, row by row
    Inertia,
    /// h
    Coriolis,
    /// h_ikm, symmetric in k and m
    Christoffel,
    /// C_ik = Σ_m h_ikm q̇_m
    CoriolisMatrix,
    /// p = D q̇
    Momentum,
    /// Cᵀq̇
    MomentumSlope,
    /// ½ q̇ᵀ D q̇
    KineticEnergy,
    /// U
    PotentialEnergy,
    /// Cᵀq̇ − c − b∘q̇
    MomentumDrift,
    /// ∂τ/∂q, row by row
    TorqueByPosition,
    /// ∂τ/∂q̇, row by row
    TorqueByVelocity,
    /// [R | p] of the hand
    Pose,
    /// [R | p] of each link
    LinkPoses,
    /// J, linear over angular
    Jacobian,
    /// J̇ q̇
    JacobianRate,
    /// q̈, from torques
    Acceleration,
    /// D⁻¹
    InertiaInverse,
    /// ∂q̈/∂q, from torques
    AccelerationByPosition,
    /// ∂q̈/∂q̇
    AccelerationByVelocity,
    /// D a + C v + c + b∘v
    Passivity,
    /// τ beside a wrench on the hand
    ContactTorque,
    /// q̈ under a wrench on the hand
    ContactAcceleration,
}

impl Quantity {
    /// Returns the lengths of the axes of its array, over so many rows.
    pub fn shape(self, rows: usize) -> Vec<usize> {
        match self {
            KineticEnergy | PotentialEnergy => vec![],
            Inertia | CoriolisMatrix | TorqueByPosition | TorqueByVelocity => vec![rows; 2],
            InertiaInverse | AccelerationByPosition | AccelerationByVelocity => vec![rows; 2],
            Christoffel => vec![rows; 3],
            Pose => vec![3, 4],
            LinkPoses => vec![rows, 3, 4],
            Jacobian => vec![6, rows],
            JacobianRate => vec![6],
            _ => vec![rows],
        }
    }

    /// Returns the number of its entries over so many rows.
    pub(crate) fn length(self, rows: usize) -> usize {
        self.shape(rows).iter().product()
    }

    /// Returns whether its axes are over joints, all of them.
    fn is_over_joints(self) -> bool {
        !matches!(self, Pose | LinkPoses | Jacobian | JacobianRate)
    }

    /// Returns whether it is only tried at states: it divides, or reads more than q, q̇ and q̈.
    pub(crate) fn is_tried(self) -> bool {
        self as usize >= Acceleration as usize
    }

    /// Returns the number of arguments among q, q̇ and q̈, in this order.
    fn arguments(self) -> usize {
        match self {
            Gravity | Inertia | Christoffel | PotentialEnergy => 1,
            Pose | LinkPoses | Jacobian => 1,
            Torque | TorqueByPosition | TorqueByVelocity => 3,
            _ => 2,
        }
    }
}

/// The name of a result, and what it is.
pub type Field = (&'static str, Quantity);

/// The size of a result of a struct, as its text tells.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Extent {
    /// The number of axes of its array.
    Axes(usize),
    /// The number of its entries.
    Entries(usize),
}

/// A generated function, or a bundle of what such return.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Function {
    /// Its results; of several there is a struct.
    pub fields: Vec<Field>,
}

/// The functions that are checked, those that are only tried behind the others.
pub const FUNCTIONS: [(&str, &[Field]); 22] = [
    ("inverse_dynamics", &[("tau", Torque)]),
    ("gravity", &[("c", Gravity)]),
    ("inertia", &[("d", Inertia)]),
    ("coriolis", &[("h", Coriolis)]),
    (
        "manipulator_equation",
        &[("d", Inertia), ("h", Coriolis), ("c", Gravity)],
    ),
    (
        "dynamic_coefficients",
        &[("d", Inertia), ("h", Christoffel), ("c", Gravity)],
    ),
    ("kinetic_energy", &[("kinetic", KineticEnergy)]),
    ("momentum", &[("p", Momentum), ("ct_qd", MomentumSlope)]),
    ("coriolis_matrix", &[("c_matrix", CoriolisMatrix)]),
    ("potential_energy", &[("potential", PotentialEnergy)]),
    (
        "momentum_observer",
        &[("p", Momentum), ("drift", MomentumDrift)],
    ),
    (
        "inverse_dynamics_derivatives",
        &[
            ("dtau_dq", TorqueByPosition),
            ("dtau_dqd", TorqueByVelocity),
            ("d", Inertia),
        ],
    ),
    ("forward_kinematics", &[("pose", Pose)]),
    ("link_poses", &[("poses", LinkPoses)]),
    ("jacobian", &[("jacobian", Jacobian)]),
    ("jacobian_rate", &[("jacobian_rate", JacobianRate)]),
    ("forward_dynamics", &[("qdd", Acceleration)]),
    ("inertia_inverse", &[("d_inv", InertiaInverse)]),
    (
        "forward_dynamics_derivatives",
        &[
            ("dqdd_dq", AccelerationByPosition),
            ("dqdd_dqd", AccelerationByVelocity),
            ("dqdd_dtau", InertiaInverse),
        ],
    ),
    ("passivity", &[("tau", Passivity)]),
    ("inverse_dynamics_with_wrench", &[("tau", ContactTorque)]),
    (
        "forward_dynamics_with_wrench",
        &[("qdd", ContactAcceleration)],
    ),
];

/// The arguments of functions, in the order in which they stand.
pub(crate) const ARGUMENTS: [&str; 7] = ["q", "qd", "qdd", "tau", "v", "a", "wrench"];

/// Returns the number of entries of an argument.
pub(crate) fn entries(argument: &str, joints: usize) -> usize {
    if argument == "wrench" { 6 } else { joints }
}

impl Function {
    /// Returns the function of a name.
    pub fn named(name: &str) -> Option<Function> {
        let known = FUNCTIONS.iter().find(|(own, _)| *own == name);
        known.map(|(_, fields)| Function {
            fields: fields.to_vec(),
        })
    }

    /// Returns the bundle of results that have these names and extents, over so many rows; or
    /// the name that no function's result has.
    pub(crate) fn bundle<'t>(
        results: &[(&'t str, Extent)],
        rows: usize,
    ) -> Result<Function, &'t str> {
        let known = |&(name, extent): &(&'t str, Extent)| {
            let mut all = FUNCTIONS.iter().flat_map(|(_, fields)| fields.iter());
            let is_own = |field: &&Field| {
                let shape = field.1.shape(rows);
                let has_extent = match extent {
                    Extent::Axes(count) => shape.len() == count,
                    Extent::Entries(count) => shape.iter().product::<usize>() == count,
                };
                field.0 == name && has_extent && !field.1.is_tried()
            };
            all.find(is_own).copied().ok_or(name)
        };
        let fields = results.iter().map(known).collect::<Result<_, _>>()?;
        Ok(Function { fields })
    }

    /// Returns the number of arguments among q, q̇ and q̈, in this order.
    pub fn arguments(&self) -> usize {
        let each = self.fields.iter().map(|(_, field)| field.arguments());
        each.max().unwrap_or(0)
    }

    /// Returns whether it is only tried at states.
    pub(crate) fn is_tried(&self) -> bool {
        self.fields.iter().any(|(_, field)| field.is_tried())
    }

    /// Of each output its quantity and the places of its joints among so many rows.
    pub fn places(&self, rows: usize) -> Vec<(Quantity, Vec<usize>)> {
        let mut places = Vec::new();
        for &(_, quantity) in &self.fields {
            let axes = quantity.shape(rows).len() as u32;
            let axes = if quantity.is_over_joints() { axes } else { 0 };
            let digit = |index: usize, axis: u32| index / rows.pow(axes - 1 - axis) % rows;
            let place = |index: usize| (0..axes).map(|axis| digit(index, axis)).collect();
            places.extend((0..quantity.length(rows)).map(|index| (quantity, place(index))));
        }
        places
    }

    /// Returns its outputs at a state, over these rows, from zero.
    ///
    /// # Errors
    /// As of [`torques`]; a function that is only tried has none.
    pub fn outputs<N: Number>(
        &self,
        setting: &Setting,
        states: &[State<N>],
        rows: &[usize],
        work: &mut Work,
    ) -> Result<Vec<N>, Fault> {
        let mut at = At {
            setting,
            states,
            rows,
            work,
        };
        let each = self.fields.iter().map(|field| at.quantity(field.1));
        Ok(each.collect::<Result<Vec<Vec<N>>, Fault>>()?.concat())
    }
}

/// The state of each joint, and its slope.
type Slopes<N> = Vec<State<Dual<N>>>;

/// A state, and what is asked of it.
pub(crate) struct At<'a, N> {
    pub(crate) setting: &'a Setting,
    pub(crate) states: &'a [State<N>],
    pub(crate) rows: &'a [usize],
    pub(crate) work: &'a mut Work,
}

impl<'a, N: Number> At<'a, N> {
    /// Returns the states with other rates.
    fn rated(&self, qd: &[N], qdd: &[N]) -> Vec<State<N>> {
        let states = self.states.iter().zip(qd).zip(qdd);
        let states = states.map(|((state, qd), qdd)| State {
            velocity: qd.clone(),
            acceleration: qdd.clone(),
            ..state.clone()
        });
        states.collect()
    }

    /// Returns the loads of all joints at other rates, with gravity and friction or without.
    pub(crate) fn loads(&mut self, qd: &[N], qdd: &[N], with: [bool; 2]) -> Result<Vec<N>, Fault> {
        torques(self.setting, &self.rated(qd, qdd), with, self.work)
    }

    /// Returns states with their slopes where positions and velocities have these.
    fn moved(&mut self, states: &[State<N>], slopes: [&[N]; 2]) -> Result<Slopes<N>, Fault> {
        let mut all = Vec::new();
        let [dq, dqd] = slopes.map(<[N]>::iter);
        for ((state, dq), dqd) in states.iter().zip(dq).zip(dqd) {
            let dual = |value: &N, slope: N| Dual {
                value: value.clone(),
                slope,
            };
            all.push(State {
                sin: dual(&state.sin, state.cos.times(dq, self.work)?),
                cos: dual(&state.cos, state.sin.times(dq, self.work)?.negated()),
                position: dual(&state.position, dq.clone()),
                velocity: dual(&state.velocity, dqd.clone()),
                acceleration: dual(&state.acceleration, N::default()),
            });
        }
        Ok(all)
    }

    /// Returns the slopes of all loads of the state by positions and velocities.
    fn slope(&mut self, by: [&[N]; 2]) -> Result<Vec<N>, Fault> {
        let states = self.moved(self.states, by)?;
        let loads = torques(self.setting, &states, [true; 2], self.work)?;
        Ok(loads.into_iter().map(|load| load.slope).collect())
    }

    pub(crate) fn zeros(&self) -> Vec<N> {
        vec![N::default(); self.states.len()]
    }

    /// Returns one for a joint, zero for all others.
    fn unit(&self, joint: usize) -> Vec<N> {
        let mut unit = self.zeros();
        unit[joint] = N::one();
        unit
    }

    pub(crate) fn velocities(&self) -> Vec<N> {
        self.states.iter().map(|s| s.velocity.clone()).collect()
    }

    pub(crate) fn accelerations(&self) -> Vec<N> {
        let each = self.states.iter().map(|s| s.acceleration.clone());
        each.collect()
    }

    fn arm(&mut self) -> Result<Arm<'a, N>, Fault> {
        Arm::new(self.setting, self.states, self.work)
    }

    /// Returns C(v) w: h is quadratic, so its slope along w is twice that.
    pub(crate) fn across(&mut self, v: &[N], w: &[N]) -> Result<Vec<N>, Fault> {
        let zeros = self.zeros();
        let states = self.moved(&self.rated(v, &zeros), [&zeros, w])?;
        let half = N::constant(0.5.into());
        let loads = torques(self.setting, &states, [false; 2], self.work)?;
        let halves = loads.iter().map(|load| load.slope.times(&half, self.work));
        halves.collect()
    }

    /// Returns C(v), by columns over the rows.
    fn columns(&mut self, v: &[N]) -> Result<Vec<Vec<N>>, Fault> {
        let rows = self.rows;
        rows.iter()
            .map(|&k| self.across(v, &self.unit(k)))
            .collect()
    }

    fn dot(&mut self, a: &[N], b: &[N]) -> Result<N, Fault> {
        let mut sum = N::default();
        for (a, b) in a.iter().zip(b) {
            sum = sum.plus(&a.times(b, self.work)?);
        }
        Ok(sum)
    }

    /// Returns the entries over the rows of columns of all joints, row by row.
    fn matrix(&self, columns: &[Vec<N>]) -> Vec<N> {
        let row = |&row: &usize| columns.iter().map(move |column| column[row].clone());
        self.rows.iter().flat_map(row).collect()
    }

    pub(crate) fn quantity(&mut self, quantity: Quantity) -> Result<Vec<N>, Fault> {
        let (rows, zeros, v) = (self.rows, self.zeros(), self.velocities());
        let select = |all: Vec<N>| rows.iter().map(|&row| all[row].clone()).collect();
        Ok(match quantity {
            Quantity::Torque => {
                let qdd: Vec<N> = self.accelerations();
                select(self.loads(&v, &qdd, [true; 2])?)
            }
            Quantity::Gravity => select(self.loads(&zeros, &zeros, [true, false])?),
            Quantity::Coriolis => select(self.loads(&v, &zeros, [false; 2])?),
            Quantity::Inertia => {
                let column = |&row| self.loads(&zeros, &self.unit(row), [false; 2]);
                let columns: Result<Vec<Vec<N>>, Fault> = rows.iter().map(column).collect();
                self.matrix(&columns?)
            }
            Quantity::Christoffel => self.christoffel()?,
            Quantity::CoriolisMatrix => {
                let columns = self.columns(&v)?;
                self.matrix(&columns)
            }
            Quantity::Momentum => select(self.loads(&zeros, &v, [false; 2])?),
            Quantity::MomentumSlope => {
                let columns = self.columns(&v)?;
                let slopes = columns.iter().map(|column| self.dot(&v, column));
                slopes.collect::<Result<_, Fault>>()?
            }
            Quantity::MomentumDrift => {
                let slopes = self.quantity(MomentumSlope)?;
                let minus = |v: &N| v.negated();
                let opposite: Vec<N> = v.iter().map(minus).collect();
                // Friction opposes q̇, and D of no acceleration is nothing.
                let loads = self.loads(&zeros, &zeros, [true, false])?;
                let mut drift: Vec<N> = Vec::new();
                for (slope, &row) in slopes.iter().zip(rows) {
                    let viscous = N::constant(self.setting.joints[row].viscous);
                    let rubbing = viscous.times(&opposite[row], self.work)?;
                    drift.push(slope.plus(&loads[row].negated()).plus(&rubbing));
                }
                drift
            }
            Quantity::PotentialEnergy => {
                vec![Arm::new(self.setting, self.states, self.work)?.potential_energy(self.work)?]
            }
            Quantity::TorqueByPosition | Quantity::TorqueByVelocity => {
                let columns = rows.iter().map(|&row| match (quantity, self.unit(row)) {
                    (Quantity::TorqueByPosition, unit) => self.slope([&unit, &zeros]),
                    (_, unit) => self.slope([&zeros, &unit]),
                });
                let columns: Result<Vec<Vec<N>>, Fault> = columns.collect();
                self.matrix(&columns?)
            }
            Quantity::Pose => self.arm()?.hand(self.work)?.rows(),
            Quantity::LinkPoses => {
                let (arm, mut all) = (self.arm()?, Vec::new());
                for &row in rows {
                    all.extend(arm.link(row, self.work)?.rows());
                }
                all
            }
            Quantity::Jacobian => {
                let columns = self.arm()?.jacobian(self.work)?;
                let row = |r: usize| rows.iter().map(move |&k| (r, k));
                let entry = |(r, k): (usize, usize)| columns[k][r].clone();
                (0..6).flat_map(row).map(entry).collect()
            }
            Quantity::JacobianRate => {
                let states = self.moved(self.states, [&v, &zeros])?;
                let columns = Arm::new(self.setting, &states, self.work)?.jacobian(self.work)?;
                let row = |r: usize| columns.iter().map(move |column| column[r].slope.clone());
                let each = (0..6).map(|r| self.dot(&row(r).collect::<Vec<N>>(), &v));
                each.collect::<Result<_, Fault>>()?
            }
            Quantity::KineticEnergy => {
                let p = self.loads(&zeros, &v, [false; 2])?;
                let half = N::constant(0.5.into());
                vec![self.dot(&v, &p)?.times(&half, self.work)?]
            }
            _ => return Err(Fault::certificate("a function that divides is only tried")),
        })
    }

    fn christoffel(&mut self) -> Result<Vec<N>, Fault> {
        let (rows, count) = (self.rows, self.rows.len());
        let mut symbols = vec![N::default(); count.pow(3)];
        for k in 0..count {
            for m in 0..=k {
                let loads = self.across(&self.unit(rows[k]), &self.unit(rows[m]))?;
                for (i, &row) in rows.iter().enumerate() {
                    symbols[(i * count + k) * count + m] = loads[row].clone();
                    symbols[(i * count + m) * count + k] = loads[row].clone();
                }
            }
        }
        Ok(symbols)
    }
}
