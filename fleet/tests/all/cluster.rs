//! A cluster on the loopback: what it returns is what this process returns; executors that are
//! killed change nothing, or end in an error.

use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU16, Ordering};
use std::time::{Duration, Instant};

use crate::support::{Folder, Sample, fails, robot, robot_file, succeeds, text};

/// A process that is killed at the end.
struct Process(Child);

impl Process {
    fn start(arguments: &[&str]) -> Process {
        let mut command = Command::new(env!("CARGO_BIN_EXE_dalembert-fleet"));
        let command = command.args(arguments).stdout(Stdio::null()).stderr(Stdio::null());
        Process(command.spawn().unwrap())
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

/// Two ports, one after the other, that nobody has.
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
    let start = Instant::now();
    while TcpStream::connect(("127.0.0.1", port)).is_err() {
        assert!(start.elapsed() < Duration::from_secs(120), "port {port} is not served");
        std::thread::sleep(Duration::from_millis(100));
    }
}

/// A scheduler and two executors.
struct Cluster {
    address: String,
    executors: Vec<Process>,
    _scheduler: Process,
}

impl Cluster {
    fn start(folder: &Folder) -> Cluster {
        let arm = robot_file("planar2r");
        let port = ports();
        let address = format!("127.0.0.1:{port}");
        let scheduler =
            Process::start(&["scheduler", "--robot", text(&arm), "--listen", &address]);
        wait_for(port);
        let executors = [(); 2].map(|()| {
            let port = ports();
            let own = format!("127.0.0.1:{port}");
            let executor = Process::start(&[
                "executor", "--robot", text(&arm), "--scheduler", &address, "--listen", &own,
                "--threads", "1", "--work", text(&folder.0),
            ]);
            wait_for(port);
            executor
        });
        Cluster {
            address,
            executors: executors.into(),
            _scheduler: scheduler,
        }
    }
}

/// Some logs in a folder, of so many states each.
fn logs(folder: &Folder, files: u64, states: usize) {
    let robot = robot("planar2r", true);
    for seed in 0..files {
        let path = folder.file(&format!("log{seed}.parquet"));
        Sample::new(robot.as_ref(), states, 30 + seed).write(&path);
    }
}

#[test]
fn a_cluster_returns_what_one_process_returns() {
    let folder = Folder::new();
    logs(&folder, 3, 40_000);
    let cluster = Cluster::start(&folder);
    let (all, arm) = (folder.file("*.parquet"), robot_file("planar2r"));
    for command in ["residual", "identify"] {
        let base = [command, text(&all), "--robot", text(&arm)];
        let here = succeeds(&base);
        let there = succeeds(&[&base[..], &["--scheduler", &cluster.address]].concat());
        assert_eq!(here, there);
    }
    let out = folder.file("out.parquet");
    succeeds(&[
        "residual", text(&all), "--robot", text(&arm), "--scheduler", &cluster.address,
        "-o", text(&out),
    ]);
    assert!(out.exists());
    // Another robot has other functions: there is an error, and no table of this one.
    let other = robot_file("planar3r");
    let three = folder.file("three.parquet");
    Sample::new(robot("planar3r", false).as_ref(), 100, 1).write(&three);
    let said = fails(&[
        "residual", text(&three), "--robot", text(&other), "--scheduler", &cluster.address,
    ]);
    assert!(said.contains("planar3r_"), "{said}");
}

/// Executors are killed while they work: with one left the table is the same, with none there
/// is an error soon, and no table.
#[test]
fn executors_that_are_killed_change_no_table() {
    let folder = Folder::new();
    logs(&folder, 12, 60_000);
    let mut cluster = Cluster::start(&folder);
    let (all, arm) = (folder.file("*.parquet"), robot_file("planar2r"));
    let base = ["identify", text(&all), "--robot", text(&arm)];
    let here = succeeds(&base);
    let there = [&base[..], &["--scheduler", &cluster.address]].concat();
    let start = Instant::now();
    assert_eq!(succeeds(&there), here);
    let whole = start.elapsed();

    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_dalembert-fleet"));
        let command = command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().unwrap()
    };
    let client = run(&there);
    std::thread::sleep(whole / 2);
    cluster.executors[0].kill();
    let output = client.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    assert_eq!(String::from_utf8(output.stdout).unwrap(), here);

    let client = run(&there);
    std::thread::sleep(whole / 2);
    cluster.executors[1].kill();
    let killed = Instant::now();
    let output = client.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && output.stdout.is_empty(), "{said}");
    assert!(said.contains("error: ") && !said.contains("panicked"), "{said}");
    assert!(killed.elapsed() < Duration::from_secs(30), "{:?}", killed.elapsed());
}
