//! Names, arguments and states as bytes, which the aggregates share, and the triangles of fits.

use std::fmt;
use std::sync::Arc;

use dalembert_fit::Accumulator as Triangles;
use datafusion::arrow::array::{ArrayRef, AsArray};
use datafusion::arrow::datatypes::{DataType, Field, FieldRef};
use datafusion::error::Result;
use datafusion::logical_expr::function::{AccumulatorArgs, StateFieldsArgs};
use datafusion::logical_expr::utils::format_state_name;
use datafusion::logical_expr::{Accumulator, AggregateUDFImpl, Signature};
use datafusion::scalar::ScalarValue;

use super::Function;
use super::residuals::Residuals;
use super::rms::Rms;
use crate::arguments::{Piece, Shape, list};
use crate::dynamics::{Dynamics, States, no_model};
use crate::error::Error;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    Rms,
    Residuals,
    Fit,
}

pub(super) trait Kept: fmt::Debug + Send + Sync {
    fn add(&mut self, robot: &dyn Dynamics, piece: &Piece) -> Result<(), Error>;
    fn to_bytes(&self) -> Vec<u8>;
    fn merge(&mut self, robot: &dyn Dynamics, bytes: &[u8]) -> Result<(), Error>;
    /// Null of no states.
    fn value(&self) -> Result<ScalarValue>;
    fn size(&self) -> usize;
}

#[derive(Debug, PartialEq, Eq, Hash)]
pub(super) struct Aggregate {
    function: Function,
    kind: Kind,
}

impl Aggregate {
    pub(super) fn new(name: &str, robot: &Arc<dyn Dynamics>, kind: Kind) -> Aggregate {
        let suffix = match kind {
            Kind::Rms => "rms",
            Kind::Residuals => "residuals",
            Kind::Fit => "fit",
        };
        let mut function = Function::new(format!("{name}_{suffix}"), robot, 4);
        function.shape.time = kind == Kind::Residuals;
        Aggregate { function, kind }
    }
}

impl AggregateUDFImpl for Aggregate {
    described!();

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        Ok(match self.kind {
            Kind::Rms => list(self.function.shape.joints),
            Kind::Residuals | Kind::Fit => DataType::Binary,
        })
    }

    fn state_fields(&self, args: StateFieldsArgs) -> Result<Vec<FieldRef>> {
        let name = format_state_name(args.name, "kept");
        Ok(vec![Arc::new(Field::new(name, DataType::Binary, true))])
    }

    fn accumulator(&self, _: AccumulatorArgs) -> Result<Box<dyn Accumulator>> {
        let Function { robot, shape, .. } = &self.function;
        let kept: Box<dyn Kept> = match self.kind {
            Kind::Rms => Box::new(Rms::new(shape.joints)),
            Kind::Residuals => Box::new(Residuals::new(shape.joints)),
            Kind::Fit => Box::new(Parameters::new(robot.as_ref())?),
        };
        Ok(Box::new(Keeping {
            robot: robot.clone(),
            shape: *shape,
            kept,
        }))
    }
}

#[derive(Debug)]
struct Keeping {
    robot: Arc<dyn Dynamics>,
    shape: Shape,
    kept: Box<dyn Kept>,
}

impl Accumulator for Keeping {
    fn update_batch(&mut self, values: &[ArrayRef]) -> Result<()> {
        let arguments = self.shape.read(values).valid()?;
        arguments.each(|_, piece| Ok(self.kept.add(self.robot.as_ref(), piece)?))
    }

    fn evaluate(&mut self) -> Result<ScalarValue> {
        self.kept.value()
    }

    fn size(&self) -> usize {
        size_of_val(self) + self.kept.size()
    }

    fn state(&mut self) -> Result<Vec<ScalarValue>> {
        Ok(vec![ScalarValue::Binary(Some(self.kept.to_bytes()))])
    }

    fn merge_batch(&mut self, states: &[ArrayRef]) -> Result<()> {
        let entries = states.iter().flat_map(|array| array.as_binary::<i32>());
        for bytes in entries.flatten() {
            self.kept.merge(self.robot.as_ref(), bytes)?;
        }
        Ok(())
    }
}

pub(super) struct Reader<'a>(pub(super) &'a [u8]);

impl Reader<'_> {
    fn next(&mut self) -> Result<[u8; 8], Error> {
        let damaged = || Error::new("what an executor sent is damaged, or of another version");
        let (first, rest) = self.0.split_first_chunk().ok_or_else(damaged)?;
        self.0 = rest;
        Ok(*first)
    }

    pub(super) fn float(&mut self) -> Result<f64, Error> {
        Ok(f64::from_le_bytes(self.next()?))
    }

    pub(super) fn count(&mut self) -> Result<u64, Error> {
        Ok(u64::from_le_bytes(self.next()?))
    }
}

/// Fewer states than in other pieces: of each there is a whole regressor.
const FEW: usize = 128;

/// The triangles of all joints, which identification keeps, read by [`Triangles::from_bytes`].
#[derive(Debug)]
struct Parameters {
    kept: Triangles,
    parts: [Vec<f64>; 4],
    room: Vec<f64>,
}

impl Parameters {
    fn new(robot: &dyn Dynamics) -> Result<Parameters> {
        Ok(Parameters {
            kept: Triangles::new(robot.model().ok_or_else(no_model)?),
            parts: Default::default(),
            room: Vec::new(),
        })
    }
}

impl Kept for Parameters {
    fn add(&mut self, robot: &dyn Dynamics, piece: &Piece) -> Result<(), Error> {
        let Parameters { kept, parts, room } = self;
        for first in (0..piece.count).step_by(FEW) {
            let last = piece.count.min(first + FEW);
            for (part, quantity) in parts.iter_mut().zip(&piece.quantities) {
                part.clear();
                for column in quantity.chunks_exact(piece.count) {
                    part.extend_from_slice(&column[first..last]);
                }
            }
            let [q, qd, qdd, tau] = &*parts;
            let count = last - first;
            robot.accumulate(States { count, q, qd, qdd }, tau, room, kept)?;
        }
        Ok(())
    }

    fn to_bytes(&self) -> Vec<u8> {
        self.kept.to_bytes()
    }

    fn merge(&mut self, robot: &dyn Dynamics, bytes: &[u8]) -> Result<(), Error> {
        let model = robot.model().ok_or_else(no_model)?;
        Ok(self.kept.merge(&Triangles::from_bytes(model, bytes)?)?)
    }

    fn value(&self) -> Result<ScalarValue> {
        let bytes = (self.kept.states() > 0).then(|| self.kept.to_bytes());
        Ok(ScalarValue::Binary(bytes))
    }

    fn size(&self) -> usize {
        // The triangles, and 64 rows that each of them waits with.
        4 * self.kept.to_bytes().len() + 8 * self.room.capacity()
    }
}
