//! A cluster on the loopback: what it returns is what this process returns; executors that are
//! killed change nothing, or end in an error.

use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicU16, Ordering};
use std::time::{Duration, Instant};

use dalembert_fleet::engine::{Engine, Limits};
use dalembert_fleet::job::RobotArgs;
use dalembert_fleet::logs::{Columns, Log, inspect};
use dalembert_fleet::progress::Going;
use dalembert_fleet::{Dynamics, Residuals};

use crate::support::{
    Folder, Sample, fails, fitted, fleet, over, robot, robot_file, says, started, succeeds, text,
    wait_until,
};

struct Process(Child);

impl Process {
    fn start(arguments: &[&str]) -> Process {
        Process(started(arguments, Stdio::null))
    }

    fn kill(&mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

static NEXT: AtomicU16 = AtomicU16::new(0);

/// Returns two ports, one after the other, that nobody has.
fn ports() -> u16 {
    let first = 42_000 + (std::process::id() % 5_000) as u16;
    loop {
        let port = first + 2 * NEXT.fetch_add(1, Ordering::Relaxed);
        let is_free = |port: u16| TcpListener::bind(("127.0.0.1", port)).is_ok();
        if is_free(port) && is_free(port + 1) {
            return port;
        }
    }
}

fn wait_for(port: u16) {
    let is_served = || TcpStream::connect(("127.0.0.1", port)).is_ok();
    wait_until(&format!("port {port} is served"), is_served);
}

struct Cluster {
    address: String,
    executors: Vec<(Process, PathBuf)>,
    _scheduler: Process,
}

impl Cluster {
    fn start(folder: &Folder) -> Cluster {
        let arm = robot_file("planar2r");
        let port = ports();
        let address = format!("127.0.0.1:{port}");
        let scheduler = Process::start(&["scheduler", "--robot", text(&arm), "--listen", &address]);
        wait_for(port);
        let executors = ["first", "second"].map(|name| {
            let port = ports();
            let work = folder.file(name);
            std::fs::create_dir(&work).unwrap();
            let own_address = format!("127.0.0.1:{port}");
            let base = ["executor", "--robot", text(&arm), "--threads", "1"];
            let at = ["--scheduler", &address, "--listen", &own_address];
            let work_in = ["--work", text(&work)];
            let executor = Process::start(&[&base[..], &at, &work_in].concat());
            wait_for(port);
            (executor, work)
        });
        Cluster {
            address,
            executors: executors.into(),
            _scheduler: scheduler,
        }
    }
}

fn files(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let counts = entries.map(|entry| match entry.path() {
        path if path.is_dir() => files(&path),
        _ => 1,
    });
    counts.sum()
}

fn has_worked(work: &Path, before: usize, client: &mut Child) {
    wait_until("it gets work", || {
        let has_ended = client.try_wait().unwrap().is_some();
        let has_worked = files(work) > before;
        assert!(has_worked || !has_ended, "all was done without it");
        has_worked
    });
}

fn logs(folder: &Folder, files: u64, states: usize) {
    let robot = robot("planar2r", true);
    for seed in 0..files {
        let path = folder.file(&format!("log{seed}.parquet"));
        Sample::new(robot.as_ref(), states, 30 + seed).write(&path);
    }
}

/// Results have equal bits where sums are of integers, and agree to 1e-12 where they are not.
#[test]
fn a_cluster_returns_what_one_process_returns() {
    let folder = Folder::new();
    logs(&folder, 3, 40_000);
    let cluster = Cluster::start(&folder);
    let (pattern, arm) = (folder.file("*.parquet"), robot_file("planar2r"));
    let loaded = robot("planar2r", true);
    let args = RobotArgs {
        robot: arm.clone(),
        chain: Default::default(),
        without_rotors: false,
    };
    let name = args.function_name(&loaded);
    let dynamics: Arc<dyn Dynamics> = loaded.clone();
    let (memory, partitions) = (1 << 30, 4);
    let limits = Limits { memory, partitions };
    let columns = Columns::canonical(2);
    let (_end, going) = Going::new();
    let logs: [Log; 3] = ["log0.parquet", "log1.parquet", "log2.parquet"]
        .map(|name| inspect(&folder.file(name), &columns, &going).unwrap());
    let runtime = tokio::runtime::Runtime::new().unwrap();
    let [here, there] = runtime.block_on(async {
        let here = Engine::embedded(&name, &dynamics, limits).unwrap();
        let there = Engine::cluster(&cluster.address, &name, &dynamics, limits).await;
        let mut results = Vec::new();
        for engine in [here, there.unwrap()] {
            let residuals = engine.over("_residuals", &logs, &going, |_| ()).await;
            let fits = engine.over("_fit", &logs, &going, |_| ()).await;
            results.push((residuals.unwrap(), fits.unwrap()));
        }
        <[_; 2]>::try_from(results).unwrap()
    });
    let near = |x: f64, y: f64| (x - y).abs() <= 1e-12 * y.abs();
    for (here, there) in here.0.iter().zip(&there.0) {
        let read = |bytes: &Result<Vec<u8>, _>| Residuals::from_bytes(bytes.as_ref().unwrap());
        let [here, there] = [here, there].map(|bytes| read(bytes).unwrap());
        assert_eq!(here.states(), 40_000);
        for i in 0..2 {
            let (here_rms, there_rms) = (here.rms(i), there.rms(i));
            assert!(near(there_rms, here_rms), "{there_rms} {here_rms}");
            assert_eq!(there.quantile(i, 0.99), here.quantile(i, 0.99));
            assert_eq!(there.joints()[i].worst, here.joints()[i].worst);
            assert_eq!(there.joints()[i].time, here.joints()[i].time);
        }
    }
    let model = loaded.model().unwrap();
    for (here, there) in here.1.iter().zip(&there.1) {
        let parameters =
            |bytes: &Result<Vec<u8>, _>| fitted(model, bytes.as_ref().unwrap()).parameters;
        let [here, there] = [here, there].map(parameters);
        let parts = here.iter().zip(&there);
        let apart = parts.map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
        let size = here.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!(apart <= 1e-12 * size, "{apart} of {size}");
    }
    for command in ["residual", "identify"] {
        let base = over(command, &pattern, &arm, &[]);
        let here = succeeds(&base);
        let there = succeeds(&[&base[..], &["--scheduler", &cluster.address]].concat());
        assert_eq!(here, there);
    }
    let out = folder.file("out.parquet");
    let more = ["--scheduler", cluster.address.as_str(), "-o", text(&out)];
    let local = fleet(&over("residual", &pattern, &arm, &more));
    let said = String::from_utf8_lossy(&local.stderr);
    says(&said, &["computed by this machine"]);
    assert!(out.exists());
    // Another robot has other functions: there is an error, and no table of this one.
    let other = robot_file("planar3r");
    let three = folder.file("three.parquet");
    Sample::new(robot("planar3r", false).as_ref(), 100, 1).write(&three);
    let said = fails(&over("residual", &three, &other, &more[..2]));
    says(&said, &["planar3r_"]);
}

#[test]
fn executors_that_are_killed_change_no_table() {
    let folder = Folder::new();
    logs(&folder, 24, 40_000);
    let mut cluster = Cluster::start(&folder);
    let (pattern, arm) = (folder.file("*.parquet"), robot_file("planar2r"));
    let base = over("identify", &pattern, &arm, &[]);
    let here = succeeds(&base);
    let there = [&base[..], &["--scheduler", &cluster.address]].concat();
    let mut client = started(&there, Stdio::piped);
    let (executor, work) = &mut cluster.executors[0];
    has_worked(work, 0, &mut client);
    executor.kill();
    let output = client.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert_eq!(String::from_utf8(output.stdout).unwrap(), here);

    let (executor, work) = &mut cluster.executors[1];
    let before = files(work);
    let mut client = started(&there, Stdio::piped);
    has_worked(work, before, &mut client);
    executor.kill();
    let killed = Instant::now();
    let output = client.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success(), "{said}");
    assert!(output.stdout.is_empty(), "{said}");
    says(&said, &["error: "]);
    assert!(!said.contains("panicked"), "{said}");
    let after = killed.elapsed();
    println!("{after:.1?} after the last executor: {said}");
    assert!(after < Duration::from_secs(30), "{after:?}");
}
