//! The commands, from simulated logs to residuals, contacts and a new robot file.

use std::sync::Arc;

use dalembert_fit::Model;
use dalembert_fleet::logs::{Blocks, Mapping};
use dalembert_fleet::{Dynamics, Residuals, register};
use dalembert_model::number::parse::parse_decimal;
use datafusion::arrow::array::AsArray;
use datafusion::arrow::compute::concat_batches;
use datafusion::arrow::datatypes::Float64Type;
use datafusion::prelude::{ParquetReadOptions, SessionContext};

use crate::support::{
    Folder, Sample, fails, fitted, over, robot, robot_file, rows, says, simulated, succeeds, text,
};

#[test]
fn identification_closes_the_loop() {
    let folder = Folder::new();
    simulated(&folder, "--files 3 --seconds 12 --rate 500 --vary 0.2");
    let (old, new) = (robot_file("planar2r"), folder.file("new.toml"));
    let training_logs = folder.file("logs/log000[01].parquet");
    let unseen = folder.file("logs/log0002.parquet");
    let said = succeeds(&over("identify", &training_logs, &old, &["-o", text(&new)]));
    says(&said, &["std. error", "with parameters from the others"]);
    let rms = |robot: &std::path::Path| -> Vec<f64> {
        let table = succeeds(&over("residual", &unseen, robot, &[]));
        let rows = rows(&table, "log0002.parquet");
        rows.iter().map(|row| row[1]).collect()
    };
    let (before, after) = (rms(&old), rms(&new));
    println!("{before:?} -> {after:?}");
    assert_eq!(before.len(), 2);
    for (before, after) in before.iter().zip(&after) {
        assert!(after < &(0.1 * before), "{before} -> {after}");
    }
    // As right as the arm's own file: what is left is the sensors' noise.
    let truth_rms = rms(&folder.file("logs/truth.toml"));
    for (after, truth) in after.iter().zip(&truth_rms) {
        assert!(*after < 1.05 * truth, "{after} {truth}");
    }
    let generated = dalembert_jit::Arm::load(&new, &Default::default());
    assert!(generated.is_ok(), "the new file is not read");
    // Whoever edits the file keeps the edits.
    let edited = std::fs::read_to_string(&new).unwrap() + "# mine\n";
    std::fs::write(&new, &edited).unwrap();
    let said = fails(&over("identify", &training_logs, &old, &["-o", text(&new)]));
    says(&said, &["new.toml: the file was edited since"]);
    assert_eq!(std::fs::read_to_string(&new).unwrap(), edited);
}

/// No file can have this arm: a rotor's inertia is negative, and its sensors have offsets.
#[test]
fn the_written_file_leaves_what_the_table_says() {
    let folder = Folder::new();
    let arm = robot("planar2r", false);
    for (seed, name) in [(12, "a.parquet"), (13, "b.parquet")] {
        let mut sample = Sample::new(arm.as_ref(), 4000, seed);
        let [.., qdd, tau] = &mut sample.quantities;
        for (tau, qdd) in tau.iter_mut().zip(qdd.iter()).skip(4000) {
            *tau += 2.0 - 0.5 * *qdd;
        }
        sample.write(&folder.file(name));
    }
    let (logs, old) = (folder.file("*.parquet"), robot_file("planar2r"));
    let new = folder.file("new.toml");
    let said = succeeds(&over("identify", &logs, &old, &["-o", text(&new)]));
    let stopped = said.lines().find(|line| line.starts_with("stopped at 0"));
    let hint = |line: &str| line.contains("armature2") && line.contains("--without-rotors");
    assert!(stopped.is_some_and(hint), "{said}");
    // The part that the second joint's rotor cannot have is taken from bodies that the first one feels.
    let worse = "warning: joint 1: the written file leaves ";
    let offset = "its sensor has an offset of ";
    says(&said, &["written file", offset, worse]);
    let left = succeeds(&over("residual", &logs, &new, &[]));
    for name in ["a.parquet", "b.parquet"] {
        let [said, left] = [&said, &left].map(|table| rows(table, name));
        assert_eq!((said.len(), left.len()), (2, 2));
        for (said, left) in said.iter().zip(&left) {
            assert!((said[3] / left[1] - 1.0).abs() < 2e-3, "{said:?} {left:?}");
        }
        // The free parameters leave the noise: those of real bodies do not.
        assert!(said[1][3] > 1.5 * said[1][2], "{said:?}");
    }
    let loaded = dalembert_jit::Arm::load(&new, &Default::default()).unwrap();
    assert!(loaded.robot().joints[1].armature == parse_decimal("0").unwrap());
    // Without a file there is no such column, and without rotors none of theirs.
    let said = succeeds(&over("identify", &logs, &old, &["--without-rotors"]));
    let has = ["written file", "armature"].map(|part| said.contains(part));
    assert_eq!(has, [false; 2], "{said}");
}

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
    let more = ["-o", text(&out), "--svg", text(&svg), "--worst", "1"];
    let table = succeeds(&over("residual", &pattern, &arm, &more));
    for (sample, name) in samples.iter().zip(["a.parquet", "b.parquet"]) {
        let rows = rows(&table, name);
        for (i, row) in rows.iter().enumerate() {
            let residuals = sample.residuals(robot.as_ref(), i);
            let rms =
                (residuals.iter().map(|r| r * r).sum::<f64>() / residuals.len() as f64).sqrt();
            let worst = residuals.iter().fold(0.0f64, |max, r| max.max(r.abs()));
            let place = residuals.iter().position(|r| r.abs() == worst).unwrap();
            assert!((row[1] / rms - 1.0).abs() < 1e-3, "{row:?} {rms}");
            assert!((row[3] / worst - 1.0).abs() < 1e-3, "{row:?} {worst}");
            assert!((row[4] - sample.time[place]).abs() < 1e-3, "{row:?}");
        }
        assert_eq!(rows.len(), 2);
    }
    says(&table, &["40000 states in 2 files"]);
    let drawn = std::fs::read_to_string(&svg).unwrap();
    assert_eq!(drawn.matches("<polygon").count(), 2);
    let mapping = Mapping {
        effort: Some("residual{}".to_owned()),
        ..Default::default()
    };
    let columns = mapping.resolve(robot.robot()).unwrap();
    let mut place = 0;
    let wanted = samples.map(|sample| sample.residuals(robot.as_ref(), 1));
    for block in Blocks::open(&out, &columns).unwrap() {
        let block = block.unwrap();
        for residual in block.column(3, 1) {
            let wanted = wanted[place / 20_000][place % 20_000];
            assert_eq!(*residual, wanted, "row {place}");
            place += 1;
        }
    }
    assert_eq!(place, 40_000);
    let names = ["a.parquet", "b.parquet", "out.parquet", "out.svg"];
    assert_eq!(folder.names(), names);
}

#[test]
fn collisions_are_found_and_nothing_else() {
    let folder = Folder::new();
    let said = simulated(&folder, "--files 2 --seconds 30 --collisions 2");
    let contact = |line: &str| -> Option<(String, f64, usize)> {
        let (name, rest) = line.split_once(": contact from ")?;
        let words: Vec<&str> = rest.split_whitespace().collect();
        let joint = words[5].trim_end_matches(',').parse().unwrap();
        Some((name.to_owned(), words[0].parse().unwrap(), joint))
    };
    let happened: Vec<_> = said.lines().filter_map(contact).collect();
    assert_eq!(happened.len(), 4, "{said}");
    let (logs, arm) = (folder.file("logs/*.parquet"), robot_file("planar2r"));
    let more = ["--watch-for", "collision"];
    let table = succeeds(&over("residual", &logs, &arm, &more));
    let (_, listed) = table.split_once("contact in").expect("contacts");
    let words = listed.lines().skip(1).map(str::split_whitespace);
    let contacts: Vec<Vec<&str>> = words.map(|words| words.collect()).collect();
    assert_eq!(contacts.len(), 4, "{table}");
    for ((name, from, joint), contact) in happened.iter().zip(&contacts) {
        assert!(contact[0].ends_with(name), "{contact:?}");
        let start: f64 = contact[1].parse().unwrap();
        assert!(start >= *from && start < from + 0.1, "{from}: {contact:?}");
        assert_eq!(contact[3], joint.to_string(), "{contact:?}");
    }
}

#[test]
fn a_payload_is_found() {
    let folder = Folder::new();
    simulated(&folder, "--files 1 --seconds 20 --payload 0.5");
    let robot = robot("planar2r", true);
    let model = robot.model().unwrap();
    let mut loaded = robot.robot().clone();
    let hand = loaded.joints.last_mut().unwrap();
    hand.mass = &hand.mass + &parse_decimal("0.5").unwrap();
    let loaded = Model::new(&loaded).unwrap();
    let right = [model.parameters(), loaded.parameters()];

    let context = SessionContext::new();
    let dynamics: Arc<dyn Dynamics> = robot.clone();
    register(&context, "arm", &dynamics);
    let columns = "q1, q2, qd1, qd2, qdd1, qdd2, tau1, tau2";
    let sql = format!(
        "SELECT arm_rms({columns}), arm_fit({columns}) FROM log GROUP BY time >= 10 \
         ORDER BY time >= 10"
    );
    let batch = tokio::runtime::Runtime::new().unwrap().block_on(async {
        let log = folder.file("logs/log0000.parquet");
        let read = ParquetReadOptions::default();
        let registered = context.register_parquet("log", text(&log), read);
        registered.await.unwrap();
        let batches = context.sql(&sql).await.unwrap().collect().await.unwrap();
        concat_batches(&batches[0].schema(), &batches).unwrap()
    });
    let rows = batch.column(0).as_fixed_size_list().values().clone();
    let rms = rows.as_primitive::<Float64Type>().values();
    let fits = batch.column(1).as_binary::<i32>();
    for half in 0..2 {
        assert!(rms[2 + half] > 10.0 * rms[half], "{rms:?}");
        let fit = fitted(model, fits.value(half));
        let away = |right: &[f64]| -> f64 {
            let parts = fit.parameters.iter().zip(right).zip(&fit.standard_errors);
            let squares = parts.map(|((x, right), error)| ((x - right) / error).powi(2));
            (squares.sum::<f64>() / right.len() as f64).sqrt()
        };
        let [distance, other] = [away(right[half]), away(right[1 - half])];
        println!("half {half}: {distance:.2} standard errors from it, {other:.1} from the other");
        assert!(distance < 3.0, "{distance} {other}");
        assert!(other > 10.0 * distance, "{distance} {other}");
    }
}

#[test]
fn simulated_logs_are_the_same_every_time() {
    for more in ["--exact --zstd", ""] {
        let bytes = [1, 2].map(|_| {
            let folder = Folder::new();
            let flags = format!("--files 1 --seconds 2 --collisions 1 {more}");
            simulated(&folder, &flags);
            std::fs::read(folder.file("logs/log0000.parquet")).unwrap()
        });
        assert_eq!(bytes[0], bytes[1]);
    }
    let folder = Folder::new();
    simulated(&folder, "--files 1 --seconds 1");
    let (arm, logs) = (robot_file("planar2r"), folder.file("logs"));
    let why = fails(&["simulate", "--robot", text(&arm), "-o", text(&logs)]);
    says(&why, &["something in it already"]);
}

#[test]
fn damaged_bytes_are_refused() {
    for bytes in [&[][..], &[1, 0, 0], &[7; 64], &[0; 8]] {
        assert!(Residuals::from_bytes(bytes).is_err(), "{bytes:?}");
    }
}
