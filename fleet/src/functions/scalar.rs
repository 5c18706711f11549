//! Torques, and measured torques less these.

use std::sync::Arc;

use datafusion::arrow::datatypes::DataType;
use datafusion::error::Result;
use datafusion::logical_expr::{ColumnarValue, ScalarFunctionArgs, ScalarUDFImpl, Signature};
use datafusion::scalar::ScalarValue;

use super::Function;
use crate::arguments::{list, lists};
use crate::dynamics::{Dynamics, States};

/// What is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum What {
    Torques,
    Residual,
}

/// `NAME_inverse_dynamics` or `NAME_residual`.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(super) struct Scalar {
    function: Function,
    what: What,
}

impl Scalar {
    pub(super) fn new(name: &str, robot: &Arc<dyn Dynamics>, what: What) -> Scalar {
        let (suffix, quantities) = match what {
            What::Torques => ("inverse_dynamics", 3),
            What::Residual => ("residual", 4),
        };
        let function = Function::new(format!("{name}_{suffix}"), robot, quantities);
        Scalar { function, what }
    }
}

impl ScalarUDFImpl for Scalar {
    described!();

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        Ok(list(self.function.shape.joints))
    }

    fn invoke_with_args(&self, given: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let is_constant = given
            .args
            .iter()
            .all(|of| matches!(of, ColumnarValue::Scalar(_)));
        let Function { robot, shape, .. } = &self.function;
        let arguments = shape.read(&ColumnarValue::values_to_arrays(&given.args)?);
        let n = shape.joints;
        let mut values = vec![0.0; n * arguments.rows];
        let mut results = Vec::new();
        arguments.each(|first, piece| {
            let count = piece.count;
            match self.what {
                What::Torques => {
                    let [q, qd, qdd, _] = &piece.quantities;
                    results.resize(n * count, 0.0);
                    robot.inverse_dynamics(States { count, q, qd, qdd }, &mut results)?;
                }
                What::Residual => robot.residuals(count, &piece.quantities, &mut results)?,
            }
            let rows = values[first * n..].chunks_exact_mut(n).take(count);
            for (s, row) in rows.enumerate() {
                for (i, value) in row.iter_mut().enumerate() {
                    *value = results[i * count + s];
                }
            }
            Ok(())
        })?;
        let lists = lists(n, values, arguments.nulls)?;
        Ok(match is_constant {
            true => ColumnarValue::Scalar(ScalarValue::try_from_array(&lists, 0)?),
            false => ColumnarValue::Array(Arc::new(lists)),
        })
    }
}
