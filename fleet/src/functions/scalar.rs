//! Torques, and measured torques less these.

use std::sync::Arc;

use datafusion::arrow::array::{Array, ArrayRef, FixedSizeListArray, Float64Array};
use datafusion::arrow::datatypes::{DataType, Field};
use datafusion::error::Result;
use datafusion::logical_expr::{ColumnarValue, ScalarFunctionArgs, ScalarUDFImpl, Signature};

use super::Function;
use crate::arguments::list;
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
        let arrays = match is_constant {
            true => ColumnarValue::values_to_arrays(&given.args)?,
            false => {
                let each = given.args.iter();
                let each = each.map(|of| of.to_array(given.number_rows));
                each.collect::<Result<Vec<ArrayRef>>>()?
            }
        };
        let Function { robot, shape, .. } = &self.function;
        let arguments = shape.read(&arrays);
        let n = shape.joints;
        let mut values = vec![0.0; n * arguments.rows];
        let mut tau = Vec::new();
        arguments.each(|first, piece| {
            let [q, qd, qdd, measured] = &piece.quantities;
            let count = piece.count;
            tau.resize(n * count, 0.0);
            let states = States { count, q, qd, qdd };
            robot.inverse_dynamics(states, &mut tau)?;
            let rows = values[first * n..].chunks_exact_mut(n).take(count);
            for (s, row) in rows.enumerate() {
                for (i, value) in row.iter_mut().enumerate() {
                    let place = i * count + s;
                    *value = match self.what {
                        What::Torques => tau[place],
                        What::Residual => measured[place] - tau[place],
                    };
                }
            }
            Ok(())
        })?;
        let item = Arc::new(Field::new_list_field(DataType::Float64, true));
        let values = Arc::new(Float64Array::from(values));
        let lists = FixedSizeListArray::try_new(item, n as i32, values, arguments.nulls.clone())?;
        match is_constant && lists.len() == 1 {
            true => Ok(ColumnarValue::Scalar(
                datafusion::scalar::ScalarValue::try_from_array(&lists, 0)?,
            )),
            false => Ok(ColumnarValue::Array(Arc::new(lists))),
        }
    }
}
