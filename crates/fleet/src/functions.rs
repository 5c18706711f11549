//! A robot's functions in a query engine.
//!
//! Each state is evaluated once, however many of its results a query reads: the engine's
//! pushdown of leaf expressions, which would copy the call into each of them, is switched off.

macro_rules! described {
    () => {
        fn name(&self) -> &str {
            &self.function.name
        }

        fn signature(&self) -> &Signature {
            &self.function.signature
        }

        fn coerce_types(&self, types: &[DataType]) -> Result<Vec<DataType>> {
            self.function.shape.coerce(&self.function.name, types)
        }
    };
}

mod aggregate;
mod residuals;
mod rms;

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use datafusion::arrow::datatypes::DataType;
use datafusion::error::Result;
use datafusion::execution::context::SessionContext;
use datafusion::logical_expr::{
    AggregateUDF, ColumnarValue, ScalarFunctionArgs, ScalarUDF, ScalarUDFImpl, Signature,
    Volatility,
};
use datafusion::prelude::SessionConfig;
use datafusion::scalar::ScalarValue;

use crate::arguments::{Shape, list, lists};
use crate::dynamics::{Dynamics, States};
use aggregate::{Aggregate, Kind};
pub use residuals::{Joint, Residuals};

/// The functions of a robot, by names that begin with the robot's.
#[derive(Clone, Debug)]
pub struct Functions {
    /// `NAME_inverse_dynamics(q, qd, qdd)` and `NAME_residual(q, qd, qdd, tau)`.
    pub scalars: Vec<Arc<ScalarUDF>>,
    /// `NAME_rms(q, qd, qdd, tau)`, `NAME_residuals(time, q, qd, qdd, tau)` and, where the
    /// robot has a model, `NAME_fit(q, qd, qdd, tau)`.
    pub aggregates: Vec<Arc<AggregateUDF>>,
}

/// Two functions of one name are the same if they are of the same robot.
#[derive(Debug)]
struct Function {
    name: String,
    robot: Arc<dyn Dynamics>,
    shape: Shape,
    signature: Signature,
}

impl Function {
    fn new(name: String, robot: &Arc<dyn Dynamics>, quantities: usize) -> Function {
        Function {
            name,
            robot: robot.clone(),
            shape: Shape {
                joints: robot.joints(),
                time: false,
                quantities,
            },
            signature: Signature::user_defined(Volatility::Immutable),
        }
    }
}

impl PartialEq for Function {
    fn eq(&self, other: &Function) -> bool {
        self.name == other.name && Arc::ptr_eq(&self.robot, &other.robot)
    }
}

impl Eq for Function {}

impl Hash for Function {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

/// Torques, or measured torques less these.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Scalar {
    function: Function,
}

impl ScalarUDFImpl for Scalar {
    described!();

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        Ok(list(self.function.shape.joints))
    }

    fn invoke_with_args(&self, args: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let mut kinds = args.args.iter();
        let is_constant = kinds.all(|of| matches!(of, ColumnarValue::Scalar(_)));
        let Function { robot, shape, .. } = &self.function;
        let arguments = shape.read(&ColumnarValue::values_to_arrays(&args.args)?);
        let n = shape.joints;
        let mut values = vec![0.0; n * arguments.rows];
        let mut results = Vec::new();
        arguments.each(|first, piece| {
            let (count, [q, qd, qdd, _]) = (piece.count, &piece.quantities);
            if shape.quantities == 3 {
                results.resize(n * count, 0.0);
                robot.inverse_dynamics(States { count, q, qd, qdd }, &mut results)?;
            } else {
                robot.residuals(count, &piece.quantities, &mut results)?;
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

impl Functions {
    pub fn of(name: &str, robot: &Arc<dyn Dynamics>) -> Functions {
        let scalar = |suffix: &str, quantities| {
            let function = Function::new(format!("{name}_{suffix}"), robot, quantities);
            Arc::new(ScalarUDF::from(Scalar { function }))
        };
        let aggregate = |kind| Arc::new(AggregateUDF::from(Aggregate::new(name, robot, kind)));
        let mut aggregates = vec![aggregate(Kind::Rms), aggregate(Kind::Residuals)];
        if robot.model().is_some() {
            aggregates.push(aggregate(Kind::Fit));
        }
        Functions {
            scalars: vec![scalar("inverse_dynamics", 3), scalar("residual", 4)],
            aggregates,
        }
    }
}

/// Registers a robot's functions by names that begin with `name`; returns them.
pub fn register(context: &SessionContext, name: &str, robot: &Arc<dyn Dynamics>) -> Functions {
    let functions = Functions::of(name, robot);
    for scalar in &functions.scalars {
        context.register_udf(scalar.as_ref().clone());
    }
    for aggregate in &functions.aggregates {
        context.register_udaf(aggregate.as_ref().clone());
    }
    let state = context.state_ref();
    evaluate_once(state.write().config_mut());
    functions
}

/// Switches off what would evaluate a call once a result that is read of it.
pub fn evaluate_once(config: &mut SessionConfig) {
    let optimizer = &mut config.options_mut().optimizer;
    optimizer.enable_leaf_expression_pushdown = false;
}
