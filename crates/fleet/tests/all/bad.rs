//! Files that cannot be used, outputs that cannot be written, and commands that are ended.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use dalembert_fleet::logs::Table;

use crate::support::{
    Folder, Sample, fails, fleet, over, robot, robot_file, says, simulated, started, succeeds,
    text, wait_until,
};

fn log(folder: &Folder, name: &str, change: impl FnOnce(&mut Sample)) {
    let mut sample = Sample::new(robot("planar2r", false).as_ref(), 20_000, 20);
    change(&mut sample);
    sample.write(&folder.file(name));
}

#[test]
fn bad_files_are_named_and_skipped_only_if_asked() {
    let folder = Folder::new();
    log(&folder, "good.parquet", |_| {});
    log(&folder, "back.parquet", |of| of.time[12_344] = 1.0);
    log(&folder, "double.parquet", |of| {
        of.time[9_000] = of.time[8_999]
    });
    log(&folder, "clock.parquet", |of| of.time[17] = f64::NAN);
    let bytes = fs::read(folder.file("good.parquet")).unwrap();
    fs::write(folder.file("short.parquet"), &bytes[..bytes.len() / 2]).unwrap();
    fs::write(folder.file("text.parquet"), "time,q1\n").unwrap();
    let names = ["time", "q1", "q2"].map(str::to_owned);
    let mut table = Table::create(&folder.file("schema.parquet"), &names, false).unwrap();
    table.write("", &[0.0], [&[0.0, 0.0][..]]).unwrap();
    table.close().unwrap();
    let table = Table::create(&folder.file("empty.parquet"), &names, false).unwrap();
    table.close().unwrap();
    let (pattern, arm) = (folder.file("*.parquet"), robot_file("planar2r"));
    let out = folder.file("out.parquet");
    let base = over("residual", &pattern, &arm, &[]);
    let said = fails(&[&base[..], &["-o", text(&out)]].concat());
    let parts = [
        "back.parquet: row 12345: time goes back from 12.343 s to 1 s",
        "double.parquet: row 9001: the time 8.999 s is that of the row before",
        "clock.parquet: row 18: the time is NaN",
        "schema.parquet: there is no column `tau1`",
        "short.parquet: it is cut off or damaged: ",
        "text.parquet: this is CSV, not Parquet; Parquet and MCAP are read: `pandas.read_csv",
        "empty.parquet: ",
        "7 of 8 files cannot be used",
        "--skip-bad",
    ];
    says(&said, &parts);
    assert!(!out.exists());
    // Mistakes in numbers show when they are used.
    log(&folder, "number.parquet", |of| {
        of.quantities[1][20_000 + 15_554] = f64::NAN
    });
    let one = folder.file("number.parquet");
    for command in ["residual", "identify"] {
        let said = fails(&over(command, &one, &arm, &[]));
        let wanted = "number.parquet: row 15555: the velocity of joint 2 is NaN";
        says(&said, &[wanted]);
    }
    let skipped = fleet(&[&base[..], &["--skip-bad"]].concat());
    assert!(skipped.status.success());
    let said = String::from_utf8_lossy(&skipped.stderr).into_owned();
    assert_eq!(said.matches("left out: ").count(), 8, "{said}");
    let good = succeeds(&over("residual", &folder.file("good.parquet"), &arm, &[]));
    assert_eq!(String::from_utf8(skipped.stdout).unwrap(), good);
}

#[test]
fn other_formats_are_named() {
    let (folder, arm) = (Folder::new(), robot_file("planar2r"));
    for (name, bytes, said) in [
        ("a.csv", &b"time,q1\n0,1\n"[..], "this is CSV, not Parquet"),
        ("a.json", b" [{\"time\": 0}]", "this is JSON, not Parquet"),
        ("a.txt", b"hello\n", "this is text, not Parquet"),
        ("a.npz", b"PK\x03\x04\0\0", "this is ZIP, not Parquet"),
        ("a.h5", b"\x89HDF\r\n\x1a\n", "this is HDF5, not Parquet"),
        ("a.bag", b"\x89MCAP0\r\n", "this is MCAP, not Parquet"),
        ("a.dat", b"\x00\x01\x02", "an unknown format, not Parquet"),
        ("a.parquet", b"", "this is an empty file, not Parquet"),
        ("a.mcap", b"PAR1", "this is Parquet, not MCAP"),
    ] {
        let path = folder.file(name);
        fs::write(&path, bytes).unwrap();
        let why = fails(&over("residual", &path, &arm, &[]));
        says(&why, &[said, "Parquet and MCAP are read", name]);
    }
}

#[test]
fn damaged_pages_are_named() {
    let folder = Folder::new();
    log(&folder, "log.parquet", |_| {});
    let path = folder.file("log.parquet");
    let mut bytes = fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle..middle + 40_000].fill(0xff);
    fs::write(&path, bytes).unwrap();
    let said = fails(&over("residual", &path, &robot_file("planar2r"), &[]));
    says(&said, &["log.parquet: "]);
}

#[test]
fn flags_that_cannot_be_are_refused() {
    let folder = Folder::new();
    log(&folder, "log.parquet", |_| {});
    let (path, arm) = (folder.file("log.parquet"), robot_file("planar2r"));
    let base = over("residual", &path, &arm, &[]);
    let nowhere = folder.file("nowhere/out.parquet");
    let constants = "3 torque constants, and the robot has 2 joints";
    for (more, part) in [
        (&["-o", text(&nowhere)][..], "the folder does not exist"),
        (&["-o", text(&folder.0)], "it is a folder"),
        (&["--memory", "12Q"], "expected 512M or 4G"),
        (&["--memory", "1K"], "64M is the least"),
        (&["--torque-constants", "1,2,3"], constants),
        (
            &["--position", "q1"],
            "column `q1` is Float64; expected a list of 2 numbers, or one column a joint",
        ),
        (&["--position", "q1,q2,qd1"], "names 3 columns of position"),
    ] {
        says(&fails(&[&base[..], more].concat()), &[part]);
    }
    let none = folder.file("*.csv");
    let said = fails(&over("residual", &none, &arm, &[]));
    says(&said, &["no file matches"]);
    let said = fails(&["residual", text(&path), "--robot", "nobody.toml"]);
    says(&said, &["nobody.toml"]);
}

#[cfg(unix)]
#[test]
fn what_is_ended_leaves_nothing() {
    let folder = Folder::new();
    let (arm, logs) = (robot_file("planar2r"), folder.file("logs"));
    let simulate = ["simulate", "--robot", text(&arm), "-o", text(&logs)];
    let minutes = ["--files", "1", "--exact", "--seconds", "40000"];
    ended(&[&simulate[..], &minutes].concat(), &folder.0);
    assert!(folder.names().is_empty(), "{:?}", folder.names());

    simulated(&folder, "--files 1 --exact --seconds 2000 --encoders-only");
    let (pattern, out) = (folder.file("logs/*.parquet"), folder.file("out.parquet"));
    let work = folder.file("work");
    fs::create_dir(&work).unwrap();
    let more = ["-o", text(&out), "--work", text(&work)];
    ended(&over("residual", &pattern, &arm, &more), &work);
    assert_eq!(folder.names(), ["logs", "work"]);
    assert_eq!(fs::read_dir(&work).unwrap().count(), 0);
}

#[cfg(unix)]
fn ended(arguments: &[&str], folder: &Path) {
    let mut child = started(arguments, Stdio::piped);
    wait_until("something is begun", || {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        fs::read_dir(folder).unwrap().count() > 0
    });
    std::thread::sleep(Duration::from_millis(200));
    let mut kill = Command::new("kill");
    let sent = kill.args(["-INT", &child.id().to_string()]).status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{said}");
    says(&said, &["interrupted: nothing was written"]);
}
