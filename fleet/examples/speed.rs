//! What residuals and fits cost, against the engine's own scan of the same columns: processor
//! time of one partition, one after the other in turn, the best of five.
//!
//! ```sh
//! dalembert-fleet simulate --robot generated/robots/ur10.toml --exact --files 1 --seconds 2000 -o logs
//! cargo run --release --example speed -- generated/robots/ur10.toml logs/log0000.parquet
//! ```

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use dalembert_fleet::{Dynamics, Loaded, register};
use datafusion::prelude::{ParquetReadOptions, SessionConfig, SessionContext};

const RUNS: usize = 5;
/// Queries of a run: Linux tells hundredths of a second.
const QUERIES: usize = 4;

/// Returns the processor time of this process so far, in seconds, by Linux's hundredths.
fn processor() -> Result<f64, Box<dyn Error>> {
    let stat = std::fs::read_to_string("/proc/self/stat")?;
    let (_, rest) = stat.rsplit_once(')').ok_or("no times")?;
    let words: Vec<&str> = rest.split_whitespace().collect();
    Ok((words[11].parse::<f64>()? + words[12].parse::<f64>()?) / 100.0)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let usage = "usage: speed ROBOT LOG.parquet";
    let robot = arguments.next().ok_or(usage)?;
    let log = arguments.next().ok_or(usage)?;
    let arm: Arc<dyn Dynamics> =
        Arc::new(Loaded::open(Path::new(&robot), &Default::default(), true)?);
    let n = arm.joints();
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(1)
        .build()?;
    runtime.block_on(async {
        let config = SessionConfig::new().with_target_partitions(1);
        let context = SessionContext::new_with_config(config);
        register(&context, "arm", &arm);
        let read = ParquetReadOptions::default();
        context.register_parquet("log", &log, read).await?;
        let rows = context.sql("SELECT time FROM log").await?.count().await? as f64;
        let columns: Vec<String> = ["q", "qd", "qdd", "tau"]
            .iter()
            .flat_map(|name| (1..=n).map(move |i| format!("{name}{i}")))
            .collect();
        let sums: Vec<String> = columns.iter().map(|name| format!("sum({name})")).collect();
        let all = columns.join(", ");
        let queries = [
            (
                "scan, a sum a column",
                format!("SELECT sum(time), {} FROM log", sums.join(", ")),
            ),
            (
                "residuals",
                format!("SELECT arm_residuals(time, {all}) FROM log"),
            ),
            ("rms", format!("SELECT arm_rms({all}) FROM log")),
            ("fit", format!("SELECT arm_fit({all}) FROM log")),
        ];
        let mut best = [f64::INFINITY; 4];
        for _ in 0..RUNS {
            for ((_, query), best) in queries.iter().zip(&mut best) {
                let before = processor()?;
                for _ in 0..QUERIES {
                    context.sql(query).await?.collect().await?;
                }
                *best = best.min((processor()? - before) / QUERIES as f64);
            }
        }
        println!("{rows} states of {n} joints; processor time, the best of {RUNS}");
        for ((name, _), own) in queries.iter().zip(best) {
            let rate = 1e-6 * rows / own;
            println!(
                "{name:22} {own:7.3} s {rate:7.3} M states/s, {:.2} of the scan's",
                best[0] / own
            );
        }
        Ok(())
    })
}
