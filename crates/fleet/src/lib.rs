//! A fleet's logs: residuals of an arm's model and identification of its parameters, as
//! functions of a query engine.
//!
//! ```no_run
//! use std::sync::Arc;
//!
//! use dalembert_fleet::{Dynamics, Loaded, register};
//! use datafusion::prelude::{ParquetReadOptions, SessionContext};
//!
//! # async fn run() -> Result<(), Box<dyn std::error::Error>> {
//! let arm: Arc<dyn Dynamics> = Arc::new(Loaded::open("arm.urdf".as_ref(), &Default::default(), true)?);
//! let context = SessionContext::new();
//! register(&context, "arm", &arm);
//! context.register_parquet("logs", "logs/", ParquetReadOptions::default()).await?;
//! context.sql("SELECT robot, arm_rms(q, qd, qdd, tau) FROM logs GROUP BY robot").await?.show().await?;
//! # Ok(())
//! # }
//! ```
//!
//! In the order in which they use each other:
//! - [`dynamics`]: what the functions ask of a robot: any at run time, or a generated type
//! - `arguments`: n columns or one list; [`functions`]: scalars and aggregates
//! - [`logs`]: columns and units, states in order, files that are bad, conversion
//! - `output`: whole or not at all; [`progress`]: how far, and whether to go on
//! - [`engine`]: an aggregate over each of many logs, here or on a cluster
//! - [`job`]: what the commands share; `picture`: residuals as SVG; [`commands`]: the commands
#![forbid(unsafe_code)]

mod arguments;
#[cfg(feature = "cluster")]
pub mod cluster;
pub mod commands;
pub mod dynamics;
pub mod engine;
mod error;
pub mod functions;
pub mod job;
pub mod logs;
mod output;
mod picture;
pub mod progress;

pub use dynamics::{Dynamics, Generated, Loaded, States};
pub use error::Error;
pub use functions::{Functions, Residuals, register};
