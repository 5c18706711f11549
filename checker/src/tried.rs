//! Functions that divide, or read more than q, q̇ and q̈, at states of the box: what is left over in
//! the equation that each solves. That is no bound, and the report says so.

use crate::certificate::Claim;
use crate::dynamics::State;
use crate::fault::Fault;
use crate::kinematics::Arm;
use crate::number::Work;
use crate::quantity::{ARGUMENTS, At, Quantity, entries};
use crate::sample::{Random, Seen, rounded, run, states};
use crate::scene::Setting;
use crate::text;

/// At how many states a function is tried.
pub const STATES: usize = 10_000;
/// The largest torque where the robot file has no limit, and wrench, N or N·m.
const TORQUE: f64 = 100.0;

/// Returns what is left over at most of each equation at [`STATES`] states that a seed gives, and the largest of the
/// sums of its terms' magnitudes.
///
/// # Errors
/// A text that is not of the grammar; results over fewer joints than move.
pub fn worst(claim: &Claim, setting: &Setting, seed: u64) -> Result<Vec<Seen>, Fault> {
    let (program, function) = (text::read(claim, setting)?, claim.function()?);
    let moving = (0..setting.joints.len()).filter(|&joint| setting.locks[joint].is_none());
    let (rows, is_single) = (moving.collect::<Vec<usize>>(), claim.scalar == "f32");
    let why = "its results are not over all joints that move";
    Fault::unless(rows == claim.rows(), why)?;
    let (mut random, mut worst) = (Random(seed), Vec::new());
    for _ in 0..STATES {
        let at = drawn(setting, is_single, &mut random);
        let computed = run(&program, &at, is_single);
        let states: Vec<State<f64>> = states(setting, &at[..3]);
        let work = &mut Work::default();
        let (setting, rows, states) = (setting, rows.as_slice(), states.as_slice());
        let mut own = Equations {
            at: At {
                setting,
                states,
                rows,
                work,
            },
            inertia: Vec::new(),
            given: &at,
            computed: &computed,
            left: Vec::new(),
        };
        let mut first = 0;
        for &(_, quantity) in &function.fields {
            own.add(quantity, first)?;
            first += quantity.length(rows.len());
        }
        worst.resize(own.left.len(), Seen::default());
        for (worst, own) in worst.iter_mut().zip(own.left) {
            // So that a result that is no number counts.
            if own.off > worst.off || own.off.is_nan() {
                worst.off = own.off;
            }
            worst.size = worst.size.max(own.size);
        }
    }
    Ok(worst)
}

/// Returns the arguments at a state of the box.
fn drawn(setting: &Setting, is_single: bool, random: &mut Random) -> Vec<Vec<f64>> {
    let [q, qd, qdd] = &setting.ranges;
    let limit = |limit: &f64| if limit.is_nan() { TORQUE } else { *limit };
    let torques = setting.torques.iter().map(|own| [-limit(own), limit(own)]);
    let (torques, any) = (torques.collect(), vec![[-TORQUE, TORQUE]; 6]);
    let lists = [q, qd, qdd, &torques, qd, qdd, &any];
    let mut one = |range: &[f64; 2]| rounded(random.within(*range, false), is_single);
    let each = lists.iter().zip(ARGUMENTS);
    each.map(|(list, argument)| {
        let count = entries(argument, setting.joints.len());
        list.iter().take(count).map(&mut one).collect()
    })
    .collect()
}

/// The equations of a function at a state, and the rest that each leaves.
struct Equations<'a> {
    at: At<'a, f64>,
    /// D over the rows, row by row, once it is asked for.
    inertia: Vec<f64>,
    given: &'a [Vec<f64>],
    computed: &'a [f64],
    left: Vec<Seen>,
}

impl Equations<'_> {
    /// Adds the equations of a result that begins at a place.
    fn add(&mut self, quantity: Quantity, first: usize) -> Result<(), Fault> {
        let (rows, count) = (self.at.rows, self.at.rows.len());
        let result = &self.computed[first..first + quantity.length(count)];
        let (v, zeros) = (self.at.velocities(), self.at.zeros());
        let [tau, wished, a] = [3, 4, 5].map(|place: usize| self.given[place].clone());
        let over = |list: &[f64]| rows.iter().map(|&row| list[row]).collect::<Vec<f64>>();
        let opposite = |list: &[f64]| list.iter().map(|x| -x).collect::<Vec<f64>>();
        let column = |of: &[f64], k: usize| (0..count).map(|i| of[i * count + k]).collect();
        let tau = opposite(&over(&tau));
        let bias = over(&self.at.loads(&v, &zeros, [true; 2])?);
        match quantity {
            Quantity::Acceleration => self.solves(result, &[&bias, &tau])?,
            Quantity::ContactAcceleration => {
                let by_wrench = self.of_wrench()?;
                self.solves(result, &[&bias, &tau, &by_wrench])?;
            }
            Quantity::InertiaInverse => {
                for k in 0..count {
                    let mut unit = vec![0.0; count];
                    unit[k] = -1.0;
                    let column: Vec<f64> = column(result, k);
                    self.solves(&column, &[&unit])?;
                }
            }
            Quantity::AccelerationByPosition | Quantity::AccelerationByVelocity => {
                let rest: Vec<f64> = bias.iter().zip(&tau).map(|(a, b)| -a - b).collect();
                let slopes = self.slopes(quantity, rest)?;
                for k in 0..count {
                    let [result, slopes]: [Vec<f64>; 2] = [result, &slopes].map(|of| column(of, k));
                    self.solves(&result, &[&slopes])?;
                }
            }
            Quantity::Passivity => {
                let loads = self.at.loads(&zeros, &a, [true, false])?;
                let across = self.at.across(&v, &wished)?;
                for (&row, result) in rows.iter().zip(result) {
                    let viscous = self.at.setting.joints[row].viscous.value * wished[row];
                    self.push(&[loads[row], across[row], viscous, -result]);
                }
            }
            Quantity::ContactTorque => {
                let own = over(&self.at.loads(&v, &self.at.accelerations(), [true; 2])?);
                let by_wrench = self.of_wrench()?;
                for ((own, by), result) in own.iter().zip(&by_wrench).zip(result) {
                    self.push(&[*own, *by, -result]);
                }
            }
            _ => {
                return Err(Fault::certificate(
                    "the checker knows no equation for a result of this function",
                ));
            }
        }
        Ok(())
    }

    /// Returns −Jᵀw over the rows.
    fn of_wrench(&mut self) -> Result<Vec<f64>, Fault> {
        let columns = Arm::new(self.at.setting, self.at.states, self.at.work)?;
        let columns = columns.jacobian(self.at.work)?;
        let wrench = &self.given[6];
        let torque = |row: &usize| columns[*row].iter().zip(wrench).map(|(j, w)| -j * w).sum();
        Ok(self.at.rows.iter().map(torque).collect())
    }

    /// Returns ∂τ/∂q, or ∂τ/∂q̇, at the accelerations that the rest of the torques gives.
    fn slopes(&mut self, quantity: Quantity, mut rest: Vec<f64>) -> Result<Vec<f64>, Fault> {
        let (count, mut d) = (rest.len(), self.inertia()?.to_vec());
        // Gauss: D is positive definite, so its pivots are.
        for k in 0..count {
            for i in k + 1..count {
                let factor = d[i * count + k] / d[k * count + k];
                (k..count).for_each(|j| d[i * count + j] -= factor * d[k * count + j]);
                rest[i] -= factor * rest[k];
            }
        }
        for k in (0..count).rev() {
            let known: f64 = (k + 1..count).map(|j| d[k * count + j] * rest[j]).sum();
            rest[k] = (rest[k] - known) / d[k * count + k];
        }
        let mut states = self.at.states.to_vec();
        for (&row, acceleration) in self.at.rows.iter().zip(rest) {
            states[row].acceleration = acceleration;
        }
        let torques = match quantity {
            Quantity::AccelerationByPosition => Quantity::TorqueByPosition,
            _ => Quantity::TorqueByVelocity,
        };
        let (setting, rows, work) = (self.at.setting, self.at.rows, &mut Work::default());
        let states = &states;
        At {
            setting,
            states,
            rows,
            work,
        }
        .quantity(torques)
    }

    /// Adds the equations D x + Σ terms = 0.
    fn solves(&mut self, x: &[f64], terms: &[&[f64]]) -> Result<(), Fault> {
        self.inertia()?;
        for i in 0..x.len() {
            let row = &self.inertia[i * x.len()..];
            let products = row.iter().zip(x).map(|(d, x)| d * x);
            let all = products.chain(terms.iter().map(|term| term[i]));
            self.push(&all.collect::<Vec<f64>>());
        }
        Ok(())
    }

    fn inertia(&mut self) -> Result<&[f64], Fault> {
        if self.inertia.is_empty() {
            self.inertia = self.at.quantity(Quantity::Inertia)?;
        }
        Ok(&self.inertia)
    }

    /// Adds an equation: the sum of some terms is zero.
    fn push(&mut self, terms: &[f64]) {
        let off = terms.iter().sum::<f64>().abs();
        let size = terms.iter().map(|term| term.abs()).sum();
        self.left.push(Seen { off, size });
    }
}
