//! A cluster: Ballista's scheduler and executors, which know a robot's functions by name.
//!
//! Nothing of this is secured: whoever reaches the ports reads what the executors can read.

use std::net::SocketAddr;
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
pub async fn reach(address: &str) -> Result<(), Error> {
    let connected = timeout(Duration::from_secs(REACH), TcpStream::connect(address)).await;
    let why = match connected {
        Ok(Ok(_)) => return Ok(()),
        Ok(Err(why)) => why.to_string(),
        Err(_) => format!("no answer in {REACH} s"),
    };
    Err(Error::new(format!("scheduler {address}: {why}")))
}

fn session() -> SessionConfig {
    let mut config = SessionConfig::new_with_ballista();
    evaluate_once(&mut config);
    config
}

/// Runs a scheduler until it is ended.
pub async fn scheduler(address: SocketAddr, functions: Functions) -> Result<(), Error> {
    let builder = move |mut config: SessionConfig| {
        evaluate_once(&mut config);
        let defaults = SessionStateBuilder::new().with_default_features();
        let mut state = defaults.with_config(config);
        let scalars = state.scalar_functions().get_or_insert_default();
        scalars.extend(functions.scalars.iter().cloned());
        let aggregates = state.aggregate_functions().get_or_insert_default();
        aggregates.extend(functions.aggregates.iter().cloned());
        Ok(state.build())
    };
    let host = address.ip().to_string();
    let config = SchedulerConfig {
        bind_host: host.clone(),
        external_host: host,
        bind_port: address.port(),
        executor_timeout_seconds: LOST,
        expire_dead_executor_interval_seconds: 1,
        no_executors_grace_period_seconds: LOST,
        override_session_builder: Some(Arc::new(builder)),
        override_config_producer: Some(Arc::new(session)),
        ..SchedulerConfig::default()
    };
    let cluster = BallistaCluster::new_from_config(&config).await;
    let served = start_server(cluster.map_err(Error::new)?, address, Arc::new(config));
    served.await.map_err(Error::new)
}

/// Runs an executor until it is ended: `config` says where it is, with the port of its results
/// (that of its tasks is the next), and what it may use.
pub async fn executor(config: ExecutorProcessConfig, functions: Functions) -> Result<(), Error> {
    let scheduler = format!("{}:{}", config.scheduler_host, config.scheduler_port);
    reach(&scheduler).await?;
    let mut registry = BallistaFunctionRegistry::default();
    for function in functions.scalars {
        let name = function.name().to_owned();
        registry.scalar_functions.insert(name, function);
    }
    for function in functions.aggregates {
        let name = function.name().to_owned();
        registry.aggregate_functions.insert(name, function);
    }
    let config = ExecutorProcessConfig {
        grpc_port: config.port + 1,
        executor_heartbeat_interval_seconds: HEARTBEAT,
        override_function_registry: Some(Arc::new(registry)),
        override_config_producer: Some(Arc::new(session)),
        ..config
    };
    let served = start_executor_process(Arc::new(config));
    served.await.map_err(Error::new)
}
