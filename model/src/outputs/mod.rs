//! What can be asked about an arm: outputs are rows of a table and a formula each.
//!
//! - `table`: [`Function`] and [`Quantity`], a row each
//! - `textbook`: the formulas of quantities by the textbook, and the equations that they solve
//! - `regrouped`: their formulas by the chain with regrouped parameters
//! - `function`: what a generated function is: its name, arguments and results
//! - `bundle`: several of them as one
//! - `at`: one of them at a frame of the robot
//! - `quantity`: what a result is: its [`Shape`], names and error scale; `unit`: its unit
//! - `shape`: the axes of a result, and what their lengths follow from
//! - `select`: entries over some rows of an arm from those over others
//! - `argument`: what functions read; `motion`: its values
//! - `runtime`: parameters of the arm that are arguments on request
//!
//! Readers of robot files and macros, scenes, traces, proofs, printing, reading
//! back and the checks in floating point all ask here; none of them knows an
//! output by name. To add one: write its rows and its formulas.

mod argument;
mod at;
mod bundle;
mod function;
mod motion;
mod quantity;
mod regrouped;
mod runtime;
mod select;
mod shape;
mod table;
mod textbook;
mod unit;

pub use argument::Argument;
pub use at::{FunctionAt, QuantityAt};
pub use bundle::{Bundle, BundleError};
pub use function::Columns;
pub use motion::Motion;
pub use quantity::ErrorScale;
pub use regrouped::{Regrouped, Shared};
pub use runtime::{PayloadDependence, RuntimeParameter};
pub use shape::{Axis, Shape, Sizes};
pub use table::{Function, Quantity};
pub use textbook::Written;
