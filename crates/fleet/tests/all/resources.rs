//! The progress that a command shows, and the memory that it takes.

use std::time::Duration;

use dalembert_fleet::progress::Progress;

use crate::support::{Folder, fleet, over, robot_file, says, simulated};

#[test]
fn progress_is_told_where_it_is_asked_for() {
    let folder = Folder::new();
    simulated(&folder, "--files 2 --seconds 20");
    let (logs, arm) = (folder.file("logs/*.parquet"), robot_file("planar2r"));
    let base = over("residual", &logs, &arm, &[]);
    let said = |more: &[&str]| {
        let output = fleet(&[&base[..], more].concat());
        String::from_utf8(output.stderr).unwrap()
    };
    assert!(!said(&[]).contains("states"));
    says(&said(&["--progress"]), &["0.04 of 0.04 M states, "]);
    let progress = Progress::default();
    progress.expect(4_000_000);
    std::thread::sleep(Duration::from_millis(20));
    progress.add(1_000_000);
    let told = progress.to_string();
    assert!(told.starts_with("1.00 of 4.00 M states, "), "{told}");
    says(&told, &[" M/s, "]);
    assert!(told.ends_with(" s left"), "{told}");
}

#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_states() {
    let folder = Folder::new();
    simulated(&folder, "--files 1 --exact --seconds 200");
    let log = folder.file("logs/log0000.parquet");
    for k in 1..8 {
        std::fs::hard_link(&log, folder.file(&format!("logs/log000{k}.parquet"))).unwrap();
    }
    let arm = robot_file("planar2r");
    for command in ["residual", "identify"] {
        let [one, eight] = ["logs/log0000.parquet", "logs/*.parquet"].map(|logs| {
            let logs = folder.file(logs);
            peak(&over(command, &logs, &arm, &["--memory", "64M"]))
        });
        println!("{command}: {one} KiB, of eight times as many states {eight} KiB");
        assert!(eight < one + (24 << 10), "{command}: {one} {eight}");
    }
}

/// KiB, as often as one can look.
#[cfg(target_os = "linux")]
fn peak(arguments: &[&str]) -> u64 {
    let mut child = crate::support::started(arguments, std::process::Stdio::null);
    let path = format!("/proc/{}/status", child.id());
    let mut peak = 0;
    loop {
        let status = std::fs::read_to_string(&path).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let size = line.and_then(|line| line.split_whitespace().next()?.parse().ok());
        peak = size.unwrap_or(0).max(peak);
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success());
            return peak;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}
