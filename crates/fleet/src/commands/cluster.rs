//! `scheduler` and `executor`: a cluster for the commands over logs.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;

use ballista_executor::executor_process::ExecutorProcessConfig;
use clap::Args;

use crate::cluster;
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::functions::Functions;
use crate::job::{RobotArgs, bytes, threads};
use crate::output::Scratch;
use crate::progress::Going;

#[derive(Args, Debug)]
pub(super) struct SchedulerArgs {
    #[command(flatten)]
    robot: RobotArgs,
    /// The address to listen on; not secured: use it only on a trusted network
    #[arg(long, value_name = "HOST:PORT", default_value = "127.0.0.1:50050")]
    listen: SocketAddr,
}

#[derive(Args, Debug)]
pub(super) struct ExecutorArgs {
    #[command(flatten)]
    robot: RobotArgs,
    /// The scheduler
    #[arg(long, value_name = "HOST:PORT", default_value = "127.0.0.1:50050")]
    scheduler: String,
    /// The address to listen on, with the port after it as well; not secured
    #[arg(long, value_name = "HOST:PORT", default_value = "127.0.0.1:50051")]
    listen: SocketAddr,
    /// Tasks at once [default: the machine's threads]
    #[arg(long, value_name = "COUNT")]
    threads: Option<usize>,
    /// The most memory that queries take, as 512M or 4G
    #[arg(long, value_name = "SIZE", default_value = "1G", value_parser = bytes)]
    memory: u64,
    /// Folder for the temporary data that stages exchange
    /// [default: the system's for temporary files]
    #[arg(long, value_name = "FOLDER")]
    work: Option<PathBuf>,
}

async fn functions(robot: &RobotArgs, going: &Going) -> Result<Functions, Error> {
    let loaded = robot.load(true, going).await?;
    let name = robot.function_name(&loaded);
    let loaded: Arc<dyn Dynamics> = loaded;
    Ok(Functions::of(&name, &loaded))
}

pub(super) async fn scheduler(args: SchedulerArgs, going: &Going) -> Result<String, Error> {
    let functions = functions(&args.robot, going).await?;
    eprintln!("scheduler at {}, not secured", args.listen);
    let served = going.unless_ended(cluster::scheduler(args.listen, functions));
    served.await.map(|()| String::new())
}

pub(super) async fn executor(args: ExecutorArgs, going: &Going) -> Result<String, Error> {
    let functions = functions(&args.robot, going).await?;
    let address = || Error::new(format!("`{}`: HOST:PORT was expected", args.scheduler));
    let (host, port) = args.scheduler.rsplit_once(':').ok_or_else(address)?;
    let port = port.parse().map_err(|_| address())?;
    let parent = args.work.clone().unwrap_or_else(std::env::temp_dir);
    let scratch = Scratch::within(&parent)?;
    let listen_host = args.listen.ip().to_string();
    let config = ExecutorProcessConfig {
        bind_host: listen_host.clone(),
        external_host: Some(listen_host),
        port: args.listen.port(),
        scheduler_host: host.to_owned(),
        scheduler_port: port,
        vcores: threads(args.threads),
        memory_pool_size: Some(args.memory),
        work_dir: Some(scratch.file("stages").display().to_string()),
        ..ExecutorProcessConfig::default()
    };
    eprintln!("executor at {}, not secured", args.listen);
    let served = going.unless_ended(cluster::executor(config, functions));
    served.await.map(|()| String::new())
}
