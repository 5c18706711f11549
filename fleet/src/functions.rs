//! A robot's functions in a query engine.
//!
//! Each state is evaluated once, however many of its results a query reads: the engine's
//! pushdown of leaf expressions, which would copy the call into each of them, is switched off.

mod aggregate;
mod fit;
mod residuals;
mod rms;
mod scalar;

use std::sync::Arc;

use datafusion::execution::context::SessionContext;
use datafusion::logical_expr::{AggregateUDF, ScalarUDF};
use datafusion::prelude::SessionConfig;

use crate::dynamics::Dynamics;
use aggregate::Aggregate;
pub use residuals::{Joint, Residuals};
use scalar::{Scalar, What};

/// The functions of a robot, by names that begin with the robot's.
#[derive(Clone, Debug)]
pub struct Functions {
    /// `NAME_inverse_dynamics(q, qd, qdd)` and `NAME_residual(q, qd, qdd, tau)`.
    pub scalars: Vec<Arc<ScalarUDF>>,
    /// `NAME_rms(q, qd, qdd, tau)`, `NAME_residuals(time, q, qd, qdd, tau)` and, where the
    /// robot has a model, `NAME_fit(q, qd, qdd, tau)`.
    pub aggregates: Vec<Arc<AggregateUDF>>,
}

impl Functions {
    /// Returns the functions of a robot.
    pub fn of(name: &str, robot: &Arc<dyn Dynamics>) -> Functions {
        let scalar = |what| Arc::new(ScalarUDF::from(Scalar::new(name, robot, what)));
        let aggregate = |kind| Arc::new(AggregateUDF::from(Aggregate::new(name, robot, kind)));
        let mut aggregates = vec![
            aggregate(aggregate::Kind::Rms),
            aggregate(aggregate::Kind::Residuals),
        ];
        if robot.model().is_some() {
            aggregates.push(aggregate(aggregate::Kind::Fit));
        }
        Functions {
            scalars: vec![scalar(What::Torques), scalar(What::Residual)],
            aggregates,
        }
    }
}

/// Registers a robot's functions by names that begin with `name`.
pub fn register(context: &SessionContext, name: &str, robot: &Arc<dyn Dynamics>) {
    let functions = Functions::of(name, robot);
    for scalar in &functions.scalars {
        context.register_udf(scalar.as_ref().clone());
    }
    for aggregate in &functions.aggregates {
        context.register_udaf(aggregate.as_ref().clone());
    }
    let state = context.state_ref();
    evaluate_once(state.write().config_mut());
}

/// Switches off what would evaluate a call once a result that is read of it.
pub fn evaluate_once(config: &mut SessionConfig) {
    let optimizer = &mut config.options_mut().optimizer;
    optimizer.enable_leaf_expression_pushdown = false;
}
