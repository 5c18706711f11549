//! One aggregate over each of many logs, on this machine or on a cluster.

use std::path::Path;
use std::sync::Arc;

use datafusion::arrow::array::AsArray;
use datafusion::arrow::datatypes::DataType;
use datafusion::execution::context::SessionContext;
use datafusion::execution::memory_pool::GreedyMemoryPool;
use datafusion::execution::runtime_env::RuntimeEnvBuilder;
use datafusion::logical_expr::{AggregateUDF, Expr, cast, ident, lit};
use datafusion::prelude::{ParquetReadOptions, SessionConfig};
use futures::stream::{self, StreamExt};
use url::Url;

use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::functions::{Functions, evaluate_once, register};
use crate::logs::block::per;
use crate::logs::{Log, Source, states};
use crate::progress::Going;

#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Bytes: of what readers hold, and of the engine's pool.
    pub memory: u64,
    /// Threads that work on queries.
    pub partitions: usize,
}

/// Rows of a batch, and bytes that a partition takes beside the row group that it reads.
const BATCH: usize = 8192;
const PARTITION: u64 = 32 << 20;

pub struct Engine {
    context: SessionContext,
    functions: Functions,
    limits: Limits,
    is_cluster: bool,
}

fn config(partitions: usize) -> SessionConfig {
    let mut config = SessionConfig::new()
        .with_target_partitions(partitions.max(1))
        .with_batch_size(BATCH)
        .with_collect_statistics(false);
    evaluate_once(&mut config);
    config
}

impl Engine {
    /// Returns the engine of this machine, with a robot's functions.
    pub fn embedded(
        name: &str,
        robot: &Arc<dyn Dynamics>,
        limits: Limits,
    ) -> Result<Engine, Error> {
        let pool = Arc::new(GreedyMemoryPool::new(limits.memory as usize));
        let builder = RuntimeEnvBuilder::new().with_memory_pool(pool);
        let runtime = builder.build_arc()?;
        let context = SessionContext::new_with_config_rt(config(limits.partitions), runtime);
        Ok(Engine {
            functions: register(&context, name, robot),
            context,
            limits,
            is_cluster: false,
        })
    }

    /// Returns the engine of a cluster, whose scheduler is at `HOST:PORT`.
    #[cfg(feature = "cluster")]
    pub async fn cluster(
        scheduler: &str,
        name: &str,
        robot: &Arc<dyn Dynamics>,
        limits: Limits,
    ) -> Result<Engine, Error> {
        use ballista::prelude::{SessionConfigExt, SessionContextExt};
        use datafusion::execution::SessionStateBuilder;

        crate::cluster::reach(scheduler).await?;
        let config = config(limits.partitions).upgrade_for_ballista();
        let defaults = SessionStateBuilder::new().with_default_features();
        let state = defaults.with_config(config).build();
        let url = format!("df://{scheduler}");
        let context = SessionContext::remote_with_state(&url, state).await?;
        Ok(Engine {
            // Only now: becoming a cluster's resets the functions.
            functions: register(&context, name, robot),
            context,
            limits,
            is_cluster: true,
        })
    }

    pub fn is_cluster(&self) -> bool {
        self.is_cluster
    }

    /// Computes an aggregate of every log as bytes, in order; a log with an unusable row is bad.
    /// The error is what is no log's fault, or that the command was ended.
    pub async fn over(
        &self,
        suffix: &str,
        logs: &[Log],
        going: &Going,
        mut done: impl FnMut(&Log),
    ) -> Result<Vec<Result<Vec<u8>, Error>>, Error> {
        let mut aggregates = self.functions.aggregates.iter();
        let aggregate = aggregates
            .find(|aggregate| aggregate.name().ends_with(suffix))
            .ok_or_else(|| Error::new(format!("there is no aggregate `{suffix}`")))?;
        let with_time = suffix == "_residuals";
        // A row group of each partition is in memory: as many at once as there is room for.
        let largest = logs.iter().map(|log| log.group).max().unwrap_or(0);
        let room = self.limits.memory / (2 * largest + PARTITION);
        let at_once = match self.is_cluster {
            true => self.limits.partitions,
            false => (room as usize).clamp(1, self.limits.partitions),
        };
        let runs = stream::iter(logs).map(|log| {
            let partitions = match self.is_cluster {
                true => self.limits.partitions,
                // One large log is read in parts, many are read beside each other.
                false => at_once.div_ceil(logs.len().max(1)),
            };
            async move {
                let result = self.one(aggregate, with_time, log, partitions).await;
                (log, result)
            }
        });
        let mut queue = std::pin::pin!(runs.buffered(at_once));
        let mut results = Vec::with_capacity(logs.len());
        while let Some((log, bytes)) = going.unless_ended(async { Ok(queue.next().await) }).await? {
            done(log);
            let owned_log = log.clone();
            results.push(match bytes {
                Ok(bytes) => Ok(bytes),
                Err(why) => match going.blocking(move |_| Ok(locate(&owned_log))).await? {
                    Some(bad) => Err(bad),
                    None => return Err(why.at(log.name.display())),
                },
            });
        }
        Ok(results)
    }

    async fn one(
        &self,
        aggregate: &AggregateUDF,
        with_time: bool,
        log: &Log,
        partitions: usize,
    ) -> Result<Vec<u8>, Error> {
        let mut state = self.context.state();
        let options = state.config_mut().options_mut();
        options.execution.target_partitions = partitions;
        let context = SessionContext::new_with_state(state);
        let extension = log.path.extension().unwrap_or_default().to_string_lossy();
        let read = ParquetReadOptions::default().file_extension(&extension);
        let table = context.read_parquet(location(&log.path)?, read).await?;
        let schema = table.schema().as_arrow().clone();
        let mut arguments = Vec::new();
        if with_time {
            let name = &log.columns.time;
            let (time, factor) = match schema.field_with_name(name)?.data_type() {
                DataType::Timestamp(unit, _) => (cast(ident(name), DataType::Int64), per(*unit)),
                _ => (ident(name), log.columns.time_factor),
            };
            arguments.push(scaled(time, factor));
        }
        for (source, factors) in log.layout.iter().zip(&log.columns.factors) {
            match source {
                Some(Source::List(name)) => arguments.push(ident(name)),
                Some(Source::Columns(names)) => {
                    let columns = names.iter().zip(factors);
                    arguments.extend(columns.map(|(name, factor)| scaled(ident(name), *factor)));
                }
                Some(Source::Ragged(_)) | None => return Err(Error::new("it was not converted")),
            }
        }
        let call = aggregate.call(arguments).alias("kept");
        let batches = table.aggregate(Vec::new(), vec![call])?.collect().await?;
        let columns = batches.iter().flat_map(|batch| batch.columns().first());
        let mut values = columns.flat_map(|column| column.as_binary::<i32>().iter());
        match values.next().flatten() {
            Some(bytes) => Ok(bytes.to_vec()),
            None => Err(Error::new("every row has a null")),
        }
    }
}

/// Finds the first row of a log that cannot be used.
pub fn locate(log: &Log) -> Option<Error> {
    let blocks = states(&log.path, &log.columns);
    let checked = blocks.and_then(|mut blocks| blocks.try_for_each(|block| block?.check()));
    checked.err().map(|why| why.at(log.name.display()))
}

fn location(path: &Path) -> Result<String, Error> {
    let path = std::path::absolute(path)?;
    let lost = |()| Error::new("no address").at(path.display());
    Ok(Url::from_file_path(&path).map_err(lost)?.to_string())
}

fn scaled(of: Expr, factor: f64) -> Expr {
    match factor {
        1.0 => of,
        factor => cast(of, DataType::Float64) * lit(factor),
    }
}
