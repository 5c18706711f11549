//! The commands, from simulated logs to residuals, contacts and a new robot file.

use dalembert_fleet::logs::{Blocks, Columns, Table};
use dalembert_fleet::{Dynamics, Residuals};

use crate::support::{Folder, Sample, fails, robot, robot_file, rows, succeeds, text};

/// Simulates logs of the planar arm with two joints into a folder `logs`.
fn simulated(folder: &Folder, more: &[&str]) -> String {
    let (robot, logs) = (robot_file("planar2r"), folder.file("logs"));
    let mut arguments = vec!["simulate", "--robot", text(&robot), "-o", text(&logs)];
    arguments.extend(more);
    succeeds(&arguments)
}

/// What README and issue promise: logs of an arm that is not its file's; its residuals; its
/// parameters; and residuals of logs that the fit has not seen, with the new file.
#[test]
fn identification_closes_the_loop() {
    let folder = Folder::new();
    simulated(
        &folder,
        &[
            "--files",
            "3",
            "--seconds",
            "12",
            "--rate",
            "500",
            "--vary",
            "0.2",
        ],
    );
    let (old, new) = (robot_file("planar2r"), folder.file("new.toml"));
    let (seen, unseen) = (
        folder.file("logs/log000[01].parquet"),
        folder.file("logs/log0002.parquet"),
    );
    let said = succeeds(&[
        "identify",
        text(&seen),
        "--robot",
        text(&old),
        "-o",
        text(&new),
    ]);
    assert!(said.contains("std. error") && said.contains("with parameters from the others"));
    let rms = |robot: &std::path::Path| -> Vec<f64> {
        let table = succeeds(&["residual", text(&unseen), "--robot", text(robot)]);
        rows(&table, "log0002.parquet")
            .iter()
            .map(|row| row[1])
            .collect()
    };
    let (before, after) = (rms(&old), rms(&new));
    println!("{before:?} -> {after:?}");
    assert_eq!(before.len(), 2);
    for (before, after) in before.iter().zip(&after) {
        assert!(after < &(0.1 * before), "{before} -> {after}");
    }
    // As right as the arm's own file: what is left is the sensors' noise.
    let own = rms(&folder.file("logs/truth.toml"));
    for (after, own) in after.iter().zip(&own) {
        assert!(*after < 1.05 * own, "{after} {own}");
    }
    let generated = dalembert_jit::Arm::load(&new, &Default::default());
    assert!(
        generated.is_ok(),
        "the generator does not read the new file"
    );
}

/// The table is that of the states themselves, in one file and in all.
#[test]
fn tables_and_rows_are_those_of_the_states() {
    let folder = Folder::new();
    let robot = robot("planar2r", false);
    let samples = [(8, "a"), (9, "b")].map(|(seed, name)| {
        let sample = Sample::new(robot.as_ref(), 20_000, seed);
        sample.write(&folder.file(&format!("{name}.parquet")));
        sample
    });
    let (pattern, arm) = (folder.file("*.parquet"), robot_file("planar2r"));
    let (out, svg) = (folder.file("out.parquet"), folder.file("out.svg"));
    let table = succeeds(&[
        "residual",
        text(&pattern),
        "--robot",
        text(&arm),
        "-o",
        text(&out),
        "--svg",
        text(&svg),
        "--worst",
        "1",
    ]);
    for (sample, name) in samples.iter().zip(["a.parquet", "b.parquet"]) {
        let found = rows(&table, name);
        for (i, row) in found.iter().enumerate() {
            let own = sample.residuals(robot.as_ref(), i);
            let rms = (own.iter().map(|r| r * r).sum::<f64>() / own.len() as f64).sqrt();
            let worst = own.iter().fold(0.0f64, |max, r| max.max(r.abs()));
            let place = own.iter().position(|r| r.abs() == worst).unwrap();
            assert!((row[1] / rms - 1.0).abs() < 1e-3, "{row:?} {rms}");
            assert!((row[3] / worst - 1.0).abs() < 1e-3, "{row:?} {worst}");
            assert!((row[4] - sample.time[place]).abs() < 1e-3, "{row:?}");
        }
        assert_eq!(found.len(), 2);
    }
    assert!(table.contains("40000 states in 2 files"), "{table}");
    let drawn = std::fs::read_to_string(&svg).unwrap();
    assert_eq!(
        drawn.matches("<polygon").count(),
        2,
        "one file of two joints"
    );
    // Rows are in order, with all that they are of.
    let names = ["q", "qd", "qdd", "residual"].map(|name| format!("{name}{{}}"));
    let mapping = dalembert_fleet::logs::Mapping {
        effort: Some(names[3].clone()),
        ..Default::default()
    };
    let columns = mapping.resolve(robot.robot()).unwrap();
    let mut place = 0;
    let wanted = samples
        .each_ref()
        .map(|sample| sample.residuals(robot.as_ref(), 1));
    for block in Blocks::open(&out, &columns).unwrap() {
        let block = block.unwrap();
        for residual in block.column(3, 1) {
            assert_eq!(
                *residual,
                wanted[place / 20_000][place % 20_000],
                "row {place}"
            );
            place += 1;
        }
    }
    assert_eq!(place, 40_000);
    assert_eq!(
        folder.names(),
        ["a.parquet", "b.parquet", "out.parquet", "out.svg"]
    );
}

/// Logs in degrees, of other names, as lists, with currents, in milliseconds.
#[test]
fn columns_and_units_are_the_logs() {
    let folder = Folder::new();
    let robot = robot("planar2r", false);
    let sample = Sample::new(robot.as_ref(), 3000, 10);
    sample.write(&folder.file("plain.parquet"));
    let degrees = 180.0 / core::f64::consts::PI;
    let names: Vec<String> = ["stamp", "pa", "pb", "va", "vb", "aa", "ab", "ia", "ib"]
        .map(str::to_owned)
        .to_vec();
    let path = folder.file("other.parquet");
    let mut table = Table::create(&path, &names, false).unwrap();
    let stamps: Vec<f64> = sample.time.iter().map(|time| 1e3 * time).collect();
    let mut columns = vec![stamps];
    for quantity in 0..4 {
        for (i, constant) in [0.5, -2.0].iter().enumerate() {
            let factor = if quantity == 3 {
                1.0 / constant
            } else {
                degrees
            };
            columns.push(
                sample
                    .column(quantity, i)
                    .iter()
                    .map(|x| x * factor)
                    .collect(),
            );
        }
    }
    let slices: Vec<&[f64]> = columns.iter().map(|column| &column[..]).collect();
    table.write("", &slices).unwrap();
    table.close().unwrap();
    let mapping = folder.file("mapping.toml");
    let flags = "time = 'stamp'\ntime-unit = 'ms'\nposition = 'pa, pb'\nvelocity = 'va,vb'\n\
                 acceleration = 'aa,ab'\neffort = 'ia,ib'\nunits = 'rad'\n\
                 torque-constants = [0.5, -2.0]\n";
    std::fs::write(&mapping, flags).unwrap();
    let arm = robot_file("planar2r");
    let plain = succeeds(&[
        "residual",
        text(&folder.file("plain.parquet")),
        "--robot",
        text(&arm),
    ]);
    let other = succeeds(&[
        "residual",
        text(&path),
        "--robot",
        text(&arm),
        "--mapping",
        text(&mapping),
        "--units",
        "deg",
    ]);
    assert_eq!(rows(&plain, "plain.parquet"), rows(&other, "other.parquet"));
    std::fs::write(&mapping, "positon = 'q{}'\n").unwrap();
    let why = fails(&[
        "residual",
        text(&path),
        "--robot",
        text(&arm),
        "--mapping",
        text(&mapping),
    ]);
    assert!(why.contains("positon") && why.contains("position"), "{why}");
    let why = fails(&["residual", text(&path), "--robot", text(&arm)]);
    assert!(
        why.contains("no column `time`") && why.contains("stamp, pa"),
        "{why}"
    );
}

/// Encoders alone: rates are differentiated, and residuals stay near the torques' noise.
#[test]
fn rates_that_are_missing_are_differentiated() {
    let [with, without] = [&[][..], &["--encoders-only"][..]].map(|more| {
        let folder = Folder::new();
        let mut arguments = vec!["--files", "1", "--seconds", "20", "--noise", "0.02"];
        arguments.extend(more);
        simulated(&folder, &arguments);
        let logs = folder.file("logs/*.parquet");
        let arm = robot_file("planar2r");
        let work = folder.file("");
        // The motion has 0.6 Hz: a filter for 5 Hz lets more of the encoder's steps through.
        let table = succeeds(&[
            "residual",
            text(&logs),
            "--robot",
            text(&arm),
            "--work",
            text(&work),
            "--motion-frequency",
            "2",
        ]);
        assert_eq!(folder.names(), ["logs"], "what was converted is gone");
        rows(&table, "log0000.parquet")
    });
    for (with, without) in with.iter().zip(&without) {
        println!("{} {}", with[1], without[1]);
        assert!(
            (without[1] / with[1] - 1.0).abs() < 0.05,
            "{with:?} {without:?}"
        );
    }
}

/// Every contact is listed once, with its joint, and nothing else is.
#[test]
fn collisions_are_found_and_nothing_else() {
    let folder = Folder::new();
    let said = simulated(
        &folder,
        &["--files", "2", "--seconds", "30", "--collisions", "2"],
    );
    let happened: Vec<(String, f64, usize)> = said
        .lines()
        .filter_map(|line| {
            let (name, rest) = line.split_once(": contact from ")?;
            let words: Vec<&str> = rest.split_whitespace().collect();
            let joint = words[5].trim_end_matches(',').parse().unwrap();
            Some((name.to_owned(), words[0].parse().unwrap(), joint))
        })
        .collect();
    assert_eq!(happened.len(), 4, "{said}");
    let (logs, arm) = (folder.file("logs/*.parquet"), robot_file("planar2r"));
    let table = succeeds(&[
        "residual",
        text(&logs),
        "--robot",
        text(&arm),
        "--watch-for",
        "collision",
    ]);
    let (_, listed) = table.split_once("contact in").expect("contacts");
    let found: Vec<Vec<&str>> = listed
        .lines()
        .skip(1)
        .map(|line| line.split_whitespace().collect())
        .collect();
    assert_eq!(found.len(), 4, "{table}");
    for ((name, from, joint), found) in happened.iter().zip(&found) {
        assert!(found[0].ends_with(name), "{found:?}");
        let start: f64 = found[1].parse().unwrap();
        assert!(start >= *from && start < from + 0.1, "{from}: {found:?}");
        assert_eq!(found[3], joint.to_string(), "{found:?}");
    }
}

/// A payload that is taken up in the middle shows in the second half, and a fit of it says so.
#[test]
fn a_payload_is_found() {
    let folder = Folder::new();
    simulated(
        &folder,
        &["--files", "1", "--seconds", "20", "--payload", "0.5"],
    );
    let robot = robot("planar2r", false);
    let columns = Columns::canonical(2);
    let mut halves = [vec![0.0; 2], vec![0.0; 2]];
    for block in Blocks::open(&folder.file("logs/log0000.parquet"), &columns).unwrap() {
        let block = block.unwrap();
        let [q, qd, qdd, measured] = &block.quantities;
        let mut tau = vec![0.0; measured.len()];
        let states = dalembert_fleet::States {
            count: block.len(),
            q,
            qd,
            qdd,
        };
        robot.inverse_dynamics(states, &mut tau).unwrap();
        for (s, time) in block.time.iter().enumerate() {
            for (i, sum) in halves[usize::from(*time >= 10.0)].iter_mut().enumerate() {
                let place = i * block.len() + s;
                *sum += (measured[place] - tau[place]).powi(2);
            }
        }
    }
    for (loaded, free) in halves[1].iter().zip(&halves[0]) {
        assert!(*loaded > 100.0 * free, "{halves:?}");
    }
}

/// The same seed, the same bytes.
#[test]
fn simulated_logs_are_the_same_every_time() {
    for more in [&["--exact"][..], &[][..]] {
        let bytes = [1, 2].map(|_| {
            let folder = Folder::new();
            let mut arguments = vec!["--files", "1", "--seconds", "2", "--collisions", "1"];
            arguments.extend(more);
            simulated(&folder, &arguments);
            std::fs::read(folder.file("logs/log0000.parquet")).unwrap()
        });
        assert_eq!(bytes[0], bytes[1]);
    }
    let folder = Folder::new();
    simulated(&folder, &["--files", "1", "--seconds", "1"]);
    let (arm, logs) = (robot_file("planar2r"), folder.file("logs"));
    let why = fails(&["simulate", "--robot", text(&arm), "-o", text(&logs)]);
    assert!(why.contains("something in it already"), "{why}");
}

/// What an executor sends that is damaged is an error, and no table.
#[test]
fn damaged_bytes_are_refused() {
    for bytes in [&[][..], &[1, 0, 0], &[7; 64], &[0; 8]] {
        assert!(Residuals::from_bytes(bytes).is_err(), "{bytes:?}");
    }
}
