//! Torques, and measured torques less these.

use std::sync::Arc;

use datafusion::arrow::datatypes::DataType;
use datafusion::error::Result;
use datafusion::logical_expr::{ColumnarValue, ScalarFunctionArgs, ScalarUDFImpl, Signature};
use datafusion::scalar::ScalarValue;

use super::Function;
use crate::arguments::{list, lists};
use crate::dynamics::States;

#[derive(Debug, PartialEq, Eq, Hash)]
pub(super) struct Scalar {
    pub(super) function: Function,
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
            match shape.quantities {
                3 => {
                    let [q, qd, qdd, _] = &piece.quantities;
                    results.resize(n * count, 0.0);
                    robot.inverse_dynamics(States { count, q, qd, qdd }, &mut results)?;
                }
                _ => robot.residuals(count, &piece.quantities, &mut results)?,
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
