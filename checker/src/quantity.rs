//! The results of functions, each by the recursion.
//!
//! The recursion is quadratic in q̇: h(v + w) − h(v) − h(w) is twice the load that two
//! velocities give together, C(v) w. So the Christoffel symbols, the Coriolis matrix and
//! what follows from them are loads at sums of velocities.

use Quantity::*;

use crate::dynamics::{State, torques};
use crate::fault::Fault;
use crate::number::{Number, Work};
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
}

impl Quantity {
    /// Returns the number of axes of its array, each over the rows.
    pub fn axes(self) -> usize {
        match self {
            Quantity::KineticEnergy => 0,
            Quantity::Torque | Quantity::Gravity | Quantity::Coriolis => 1,
            Quantity::Momentum | Quantity::MomentumSlope => 1,
            Quantity::Inertia | Quantity::CoriolisMatrix => 2,
            Quantity::Christoffel => 3,
        }
    }

    /// Returns the number of its entries over so many rows.
    pub(crate) fn length(self, rows: usize) -> usize {
        rows.pow(self.axes() as u32)
    }

    /// Returns the number of arguments among q, q̇ and q̈, in this order.
    fn arguments(self) -> usize {
        match self {
            Quantity::Gravity | Quantity::Inertia | Quantity::Christoffel => 1,
            Quantity::Torque => 3,
            _ => 2,
        }
    }
}

/// The name of a result, and what it is.
pub type Field = (&'static str, Quantity);

/// A generated function, or a bundle of what such return.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Function {
    /// Its results; of several there is a struct.
    pub fields: Vec<Field>,
}

/// The functions that are checked.
pub const FUNCTIONS: [(&str, &[Field]); 9] = [
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
];

impl Function {
    /// Returns the function of a name.
    pub fn named(name: &str) -> Option<Function> {
        let known = FUNCTIONS.iter().find(|(own, _)| *own == name);
        known.map(|(_, fields)| Function {
            fields: fields.to_vec(),
        })
    }

    /// The bundle of results that have these names and numbers of entries, over so many rows; or
    /// the name that no function's result has.
    pub(crate) fn bundle<'t>(
        results: &[(&'t str, usize)],
        rows: usize,
    ) -> Result<Function, &'t str> {
        let known = |&(name, length): &(&'t str, usize)| {
            let mut all = FUNCTIONS.iter().flat_map(|(_, fields)| fields.iter());
            let is_own = |field: &&Field| field.0 == name && field.1.length(rows) == length;
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

    /// Of each output its quantity and the places of its joints among so many rows.
    pub fn places(&self, rows: usize) -> Vec<(Quantity, Vec<usize>)> {
        let mut places = Vec::new();
        for &(_, quantity) in &self.fields {
            let axes = quantity.axes() as u32;
            let digit = |index: usize, axis: u32| index / rows.pow(axes - 1 - axis) % rows;
            let place = |index: usize| (0..axes).map(|axis| digit(index, axis)).collect();
            places.extend((0..quantity.length(rows)).map(|index| (quantity, place(index))));
        }
        places
    }

    /// Returns its outputs at a state, over these rows, from zero.
    ///
    /// # Errors
    /// As of [`torques`].
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

/// A state, and what is asked of it.
struct At<'a, N> {
    setting: &'a Setting,
    states: &'a [State<N>],
    rows: &'a [usize],
    work: &'a mut Work,
}

impl<N: Number> At<'_, N> {
    /// Returns the loads of all joints at other rates.
    fn loads(&mut self, qd: &[N], qdd: &[N], with: (bool, bool)) -> Result<Vec<N>, Fault> {
        let states = self.states.iter().zip(qd).zip(qdd);
        let states = states.map(|((state, qd), qdd)| State {
            velocity: qd.clone(),
            acceleration: qdd.clone(),
            ..state.clone()
        });
        let states: Vec<State<N>> = states.collect();
        torques(self.setting, &states, with, self.work)
    }

    fn zeros(&self) -> Vec<N> {
        vec![N::default(); self.states.len()]
    }

    /// Returns one for a joint, zero for all others.
    fn unit(&self, joint: usize) -> Vec<N> {
        let mut unit = self.zeros();
        unit[joint] = N::one();
        unit
    }

    fn velocities(&self) -> Vec<N> {
        self.states.iter().map(|s| s.velocity.clone()).collect()
    }

    fn coriolis(&mut self, qd: &[N]) -> Result<Vec<N>, Fault> {
        let zeros = self.zeros();
        self.loads(qd, &zeros, (false, false))
    }

    /// Returns C(v) e_k, the load that a velocity and a joint's give together.
    fn together(&mut self, v: &[N], own: &[N], joint: usize) -> Result<Vec<N>, Fault> {
        let unit = self.unit(joint);
        let sum: Vec<N> = v.iter().zip(&unit).map(|(a, b)| a.plus(b)).collect();
        let (both, alone) = (self.coriolis(&sum)?, self.coriolis(&unit)?);
        let half = N::constant(0.5.into());
        let each = both.iter().zip(own).zip(&alone);
        let rests =
            each.map(|((both, own), alone)| both.plus(&own.negated()).plus(&alone.negated()));
        rests.map(|rest| rest.times(&half, self.work)).collect()
    }

    /// Returns C(v), by columns over the rows.
    fn columns(&mut self, v: &[N]) -> Result<Vec<Vec<N>>, Fault> {
        let (rows, own) = (self.rows, self.coriolis(v)?);
        rows.iter().map(|&k| self.together(v, &own, k)).collect()
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

    fn quantity(&mut self, quantity: Quantity) -> Result<Vec<N>, Fault> {
        let (rows, zeros, v) = (self.rows, self.zeros(), self.velocities());
        let select = |all: Vec<N>| rows.iter().map(|&row| all[row].clone()).collect();
        Ok(match quantity {
            Quantity::Torque => {
                let qdd = self.states.iter().map(|s| s.acceleration.clone());
                let qdd: Vec<N> = qdd.collect();
                select(self.loads(&v, &qdd, (true, true))?)
            }
            Quantity::Gravity => select(self.loads(&zeros, &zeros, (true, false))?),
            Quantity::Coriolis => select(self.coriolis(&v)?),
            Quantity::Inertia => {
                let column = |&row| self.loads(&zeros, &self.unit(row), (false, false));
                let columns: Result<Vec<Vec<N>>, Fault> = rows.iter().map(column).collect();
                self.matrix(&columns?)
            }
            Quantity::Christoffel => self.christoffel()?,
            Quantity::CoriolisMatrix => {
                let columns = self.columns(&v)?;
                self.matrix(&columns)
            }
            Quantity::Momentum => select(self.loads(&zeros, &v, (false, false))?),
            Quantity::MomentumSlope => {
                let columns = self.columns(&v)?;
                let slopes = columns.iter().map(|column| self.dot(&v, column));
                slopes.collect::<Result<_, Fault>>()?
            }
            Quantity::KineticEnergy => {
                let p = self.loads(&zeros, &v, (false, false))?;
                let half = N::constant(0.5.into());
                vec![self.dot(&v, &p)?.times(&half, self.work)?]
            }
        })
    }

    fn christoffel(&mut self) -> Result<Vec<N>, Fault> {
        let (rows, count) = (self.rows, self.rows.len());
        let mut symbols = vec![N::default(); count.pow(3)];
        for k in 0..count {
            let unit = self.unit(rows[k]);
            let own = self.coriolis(&unit)?;
            for m in 0..=k {
                let loads = match k == m {
                    true => own.clone(),
                    false => self.together(&unit, &own, rows[m])?,
                };
                for (i, &row) in rows.iter().enumerate() {
                    symbols[(i * count + k) * count + m] = loads[row].clone();
                    symbols[(i * count + m) * count + k] = loads[row].clone();
                }
            }
        }
        Ok(symbols)
    }
}
