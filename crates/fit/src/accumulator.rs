//! The triangles of all joints: states go in, states of parts merge, bytes come out.
//!
//! A joint's row of Y π = τ is reduced with its torque as the last column,
//!
//! ```text
//! [Y_i τ_i] = Q_i [R_i z_i; 0 ρ_i]
//! ```
//!
//! over the columns alone that are not zero in it. For any π the sum of squared residuals is
//! ‖R_i π_i − z_i‖² + ρ_i²: weights by the joints' noise, cross-validation and comparisons of
//! two robots need no second look at the states. The memory does not grow with them.

use crate::error::{Error, check};
use crate::model::{Column, Model};
use crate::triangle::Triangle;

const MAGIC: &[u8; 6] = b"DLBFIT";
const VERSION: u16 = 1;

/// The sums over any number of states.
#[derive(Clone, Debug, PartialEq)]
pub struct Accumulator {
    fingerprint: [u8; 32],
    /// The columns of each row, without the torque.
    rows: Vec<Vec<usize>>,
    triangles: Vec<Triangle>,
    states: u64,
}

pub(crate) struct Row<'a> {
    pub(crate) columns: &'a [usize],
    /// [R_i z_i; 0 ρ_i], whole rows.
    pub(crate) factor: Vec<f64>,
}

impl Row<'_> {
    /// Returns ρ_i²: the residual that a fit of this joint alone leaves, columns independent.
    pub(crate) fn rest(&self) -> f64 {
        let last = self.factor.last().copied().unwrap_or(0.0);
        last * last
    }
}

impl Accumulator {
    /// Returns the accumulator of no states.
    pub fn new(model: &Model) -> Accumulator {
        let rows = model.rows.clone();
        Accumulator {
            fingerprint: *model.fingerprint(),
            triangles: rows.iter().map(|of| Triangle::new(of.len() + 1)).collect(),
            rows,
            states: 0,
        }
    }

    /// Returns the number of states.
    pub fn states(&self) -> u64 {
        self.states
    }

    /// Adds a state: positions, velocities, accelerations and measured torques. Where the base floats, as
    /// of [`Model::lengths`]: torques begin with the force and the moment on the base.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::Value`] and [`Error::OtherModel`]; then nothing is added.
    pub fn add(
        &mut self,
        model: &Model,
        [q, qd, qdd]: [&[f64]; 3],
        tau: &[f64],
    ) -> Result<(), Error> {
        self.matches(model)?;
        check("tau", tau, self.rows.len())?;
        let y = model.regressor(q, qd, qdd)?;
        self.add_rows(model, &y, tau)
    }

    /// Adds a state by its regressor, as [`Model::regressor`] returns it.
    pub fn add_rows(&mut self, model: &Model, y: &[f64], tau: &[f64]) -> Result<(), Error> {
        self.matches(model)?;
        let width = model.columns().len();
        check("tau", tau, self.rows.len())?;
        check("y", y, self.rows.len() * width)?;
        for (i, (row, triangle)) in self.rows.iter().zip(&mut self.triangles).enumerate() {
            let entries = row.iter().map(|k| y[i * width + k]);
            triangle.push(entries.chain([tau[i]]));
        }
        self.states += 1;
        Ok(())
    }

    /// Adds states by what a generated `regressor` returns for many of them, column by column:
    /// entry (i, k) of state s at `(i * base + k) * states + s`, velocities and torques of
    /// joint i at `i * states + s`. Columns of friction and offsets come from the velocities.
    ///
    /// It was generated from [`Model::generator_robot`], so that the columns are the same.
    ///
    /// # Errors
    /// As [`Accumulator::add`]; an index is that of the array.
    pub fn add_columns(
        &mut self,
        model: &Model,
        y: &[f64],
        qd: &[f64],
        tau: &[f64],
        states: usize,
    ) -> Result<(), Error> {
        self.matches(model)?;
        let (n, base) = (self.rows.len(), model.base());
        check("qd", qd, n * states)?;
        check("tau", tau, n * states)?;
        check("y", y, n * base * states)?;
        let of_base = model.robot().base_coordinates();
        let ones = vec![1.0; states];
        let column = |of: &[f64], i: usize| i * states..of.len().min((i + 1) * states);
        for (i, (row, triangle)) in self.rows.iter().zip(&mut self.triangles).enumerate() {
            let rates = &qd[column(qd, i)];
            let coulomb: Vec<f64> = match i.checked_sub(of_base) {
                Some(joint) => rates.iter().map(|qd| model.coulomb(joint, qd)).collect(),
                None => Vec::new(),
            };
            let entries: Vec<&[f64]> = row
                .iter()
                .map(|k| match model.columns()[*k] {
                    Column::Base(k) => &y[column(y, i * base + k)],
                    Column::Coulomb(_) => &coulomb[..],
                    Column::Offset(_) => &ones[..],
                })
                .chain([&tau[column(tau, i)]])
                .collect();
            triangle.push_columns(&entries);
        }
        self.states += states as u64;
        Ok(())
    }

    /// Adds all states of another accumulator.
    ///
    /// # Errors
    /// [`Error::OtherModel`].
    pub fn merge(&mut self, other: &Accumulator) -> Result<(), Error> {
        if self.fingerprint != other.fingerprint || self.rows != other.rows {
            return Err(Error::OtherModel);
        }
        for (triangle, other) in self.triangles.iter_mut().zip(&other.triangles) {
            triangle.merge(other);
        }
        self.states += other.states;
        Ok(())
    }

    /// Computes the root mean square of each joint's residual τ − Y π.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::OtherModel`] and, of no states, [`Error::TooFew`].
    pub fn residual(&self, model: &Model, parameters: &[f64]) -> Result<Vec<f64>, Error> {
        self.matches(model)?;
        check("parameters", parameters, model.columns().len())?;
        if self.states == 0 {
            return Err(Error::TooFew {
                joint: 0,
                states: 0,
                needed: 0,
            });
        }
        let residuals = self.factors().into_iter().map(|row| {
            let width = row.columns.len() + 1;
            let mut total = row.rest();
            for r in row.factor.chunks(width).take(width - 1) {
                let pairs = row.columns.iter().zip(r);
                let sum: f64 = pairs.map(|(k, r)| r * parameters[*k]).sum();
                total += (sum - r[width - 1]).powi(2);
            }
            libm::sqrt(total / self.states as f64)
        });
        Ok(residuals.collect())
    }

    pub(crate) fn matches(&self, model: &Model) -> Result<(), Error> {
        let is_same = self.fingerprint == *model.fingerprint();
        is_same.then_some(()).ok_or(Error::OtherModel)
    }

    pub(crate) fn factors(&self) -> Vec<Row<'_>> {
        let reduced = self.triangles.iter().map(|of| of.clone().reduced());
        let rows = self.rows.iter().zip(reduced);
        rows.map(|(columns, factor)| Row { columns, factor })
            .collect()
    }

    /// Writes the accumulator: a version, the model's fingerprint and the triangles.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(self.fingerprint);
        bytes.extend(self.states.to_le_bytes());
        for row in self.factors() {
            let width = row.columns.len() + 1;
            for (i, r) in row.factor.chunks(width).enumerate() {
                r[i..].iter().for_each(|x| bytes.extend(x.to_le_bytes()));
            }
        }
        bytes
    }

    /// Reads what [`Accumulator::to_bytes`] wrote.
    ///
    /// # Errors
    /// [`Error::Bytes`] and, of another robot or other options, [`Error::OtherModel`].
    pub fn from_bytes(model: &Model, bytes: &[u8]) -> Result<Accumulator, Error> {
        let mut read = Accumulator::new(model);
        let rest = bytes
            .strip_prefix(MAGIC.as_slice())
            .ok_or(Error::Bytes("they do not begin with DLBFIT"))?;
        let short = Error::Bytes("they end too early");
        let (version, rest) = rest.split_first_chunk().ok_or(short.clone())?;
        if u16::from_le_bytes(*version) != VERSION {
            return Err(Error::Bytes("their version is not 1"));
        }
        let (fingerprint, rest) = rest.split_first_chunk::<32>().ok_or(short.clone())?;
        if fingerprint != model.fingerprint() {
            return Err(Error::OtherModel);
        }
        let (states, rest) = rest.split_first_chunk().ok_or(short.clone())?;
        read.states = u64::from_le_bytes(*states);
        let (numbers, surplus) = rest.as_chunks::<8>();
        let mut numbers = numbers.iter().map(|x| f64::from_le_bytes(*x));
        for triangle in &mut read.triangles {
            let width = triangle.columns();
            let mut r = vec![0.0; width * width];
            for i in 0..width {
                for x in &mut r[i * width + i..(i + 1) * width] {
                    *x = numbers.next().ok_or(short.clone())?;
                    if !x.is_finite() {
                        return Err(Error::Bytes("a number is not finite"));
                    }
                }
            }
            *triangle = Triangle::of(width, r);
        }
        if numbers.next().is_some() || !surplus.is_empty() {
            return Err(Error::Bytes("there are more than the robot's columns need"));
        }
        Ok(read)
    }
}
