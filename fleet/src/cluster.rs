//! A cluster: Ballista's scheduler and executors, which know a robot's functions by name.
//!
//! Nothing of this is secured: whoever reaches the ports reads what the executors can read.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use ballista_core::extension::SessionConfigExt;
use ballista_core::registry::BallistaFunctionRegistry;
use ballista_executor::executor_process::{ExecutorProcessConfig, start_executor_process};
use ballista_scheduler::cluster::BallistaCluster;
use ballista_scheduler::config::SchedulerConfig;
use ballista_scheduler::scheduler_process::start_server;
use datafusion::execution::SessionStateBuilder;
use datafusion::prelude::SessionConfig;
use tokio::net::TcpStream;
use tokio::time::timeout;

use crate::error::Error;
use crate::functions::{Functions, evaluate_once};

/// Seconds between two signs of life of an executor.
const HEARTBEAT: u64 = 1;
/// Seconds without one after which an executor is lost, and its work done anew elsewhere.
const LOST: u64 = 6;
/// Seconds that nobody may answer.
const REACH: u64 = 10;

/// Checks that somebody answers at an address.
///
/// # Errors
/// That nobody does.
pub async fn reach(address: &str) -> Result<(), Error> {
    let connected = timeout(Duration::from_secs(REACH), TcpStream::connect(address)).await;
    let why = match connected {
        Ok(Ok(_)) => return Ok(()),
        Ok(Err(why)) => why.to_string(),
        Err(_) => format!("no answer in {REACH} s"),
    };
    Err(Error::new(format!("scheduler {address}: {why}")))
}

fn failed(why: impl std::fmt::Display) -> Error {
    Error::new(why)
}

/// Runs a scheduler until it is ended.
///
/// # Errors
/// An address that is taken, and those of Ballista.
pub async fn scheduler(address: SocketAddr, functions: Functions) -> Result<(), Error> {
    let builder = move |config: SessionConfig| {
        let mut config = config;
        evaluate_once(&mut config);
        let mut state = SessionStateBuilder::new()
            .with_default_features()
            .with_config(config);
        let scalars = state.scalar_functions().get_or_insert_default();
        scalars.extend(functions.scalars.iter().cloned());
        let aggregates = state.aggregate_functions().get_or_insert_default();
        aggregates.extend(functions.aggregates.iter().cloned());
        Ok(state.build())
    };
    let producer = || {
        let mut config = SessionConfig::new_with_ballista();
        evaluate_once(&mut config);
        config
    };
    let config = SchedulerConfig {
        bind_host: address.ip().to_string(),
        external_host: address.ip().to_string(),
        bind_port: address.port(),
        executor_timeout_seconds: LOST,
        expire_dead_executor_interval_seconds: 1,
        no_executors_grace_period_seconds: LOST,
        override_session_builder: Some(Arc::new(builder)),
        override_config_producer: Some(Arc::new(producer)),
        ..SchedulerConfig::default()
    };
    let cluster = BallistaCluster::new_from_config(&config)
        .await
        .map_err(failed)?;
    start_server(cluster, address, Arc::new(config))
        .await
        .map_err(failed)
}

/// Where an executor is, and what it may use.
#[derive(Clone, Debug)]
pub struct Executor {
    /// Where it listens, with the port of its results; that of its tasks is the next.
    pub address: SocketAddr,
    /// Host of the scheduler.
    pub scheduler_host: String,
    /// Port of the scheduler.
    pub scheduler_port: u16,
    /// Tasks at once.
    pub threads: usize,
    /// Bytes of the engine's pool.
    pub memory: u64,
    /// Folder for what stages pass on.
    pub work: PathBuf,
}

/// Runs an executor until it is ended.
///
/// # Errors
/// A scheduler that does not answer, an address that is taken, and those of Ballista.
pub async fn executor(executor: Executor, functions: Functions) -> Result<(), Error> {
    let Executor {
        scheduler_host,
        scheduler_port,
        ..
    } = executor.clone();
    reach(&format!("{scheduler_host}:{scheduler_port}")).await?;
    let mut registry = BallistaFunctionRegistry::default();
    for scalar in functions.scalars {
        registry
            .scalar_functions
            .insert(scalar.name().to_owned(), scalar);
    }
    for aggregate in functions.aggregates {
        registry
            .aggregate_functions
            .insert(aggregate.name().to_owned(), aggregate);
    }
    let producer = || {
        let mut config = SessionConfig::new_with_ballista();
        evaluate_once(&mut config);
        config
    };
    let host = executor.address.ip().to_string();
    let config = ExecutorProcessConfig {
        bind_host: host.clone(),
        external_host: Some(host),
        port: executor.address.port(),
        grpc_port: executor.address.port() + 1,
        scheduler_host,
        scheduler_port,
        vcores: executor.threads,
        work_dir: Some(executor.work.display().to_string()),
        executor_heartbeat_interval_seconds: HEARTBEAT,
        memory_pool_size: Some(executor.memory),
        override_function_registry: Some(Arc::new(registry)),
        override_config_producer: Some(Arc::new(producer)),
        ..ExecutorProcessConfig::default()
    };
    start_executor_process(Arc::new(config))
        .await
        .map_err(failed)
}
