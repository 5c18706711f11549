//! Logs in other columns, units and shapes, and logs that lack rates.

use std::path::Path;
use std::sync::Arc;

use dalembert_fleet::Dynamics;
use dalembert_fleet::logs::{Blocks, Columns, Table, canonical_names};
use datafusion::arrow::array::{
    ArrayRef, FixedSizeListArray, Float32Array, Float64Array, LargeListArray, ListArray,
    RecordBatch,
};
use datafusion::arrow::datatypes::{DataType, Field, Float64Type};
use parquet::arrow::ArrowWriter;

use crate::support::{
    Folder, Sample, fails, over, robot, robot_file, rows, says, simulated, succeeds, text,
};

type Row = Vec<Option<f64>>;

fn write(path: &Path, batch: &RecordBatch) {
    let file = std::fs::File::create(path).unwrap();
    let mut writer = ArrowWriter::try_new(file, batch.schema(), None).unwrap();
    writer.write(batch).unwrap();
    writer.close().unwrap();
}

#[test]
fn rows_with_a_null_are_left_out() {
    let (folder, count) = (Folder::new(), 9000);
    let sample = Sample::new(robot("planar2r", false).as_ref(), count, 11);
    let quantities = sample.quantities.iter();
    let columns = quantities.flat_map(|of| of.chunks_exact(count));
    let columns = columns.map(|column| -> ArrayRef {
        // More than are read at once.
        let rows = column.iter().enumerate();
        let some = rows.map(|(row, x)| (row >= 8500).then_some(*x));
        Arc::new(some.collect::<Float64Array>())
    });
    let time: ArrayRef = Arc::new(Float64Array::from(sample.time.clone()));
    let columns = std::iter::once(time).chain(columns);
    let batch = RecordBatch::try_from_iter(canonical_names(2).into_iter().zip(columns));
    let (path, out) = (folder.file("log.parquet"), folder.file("out.parquet"));
    write(&path, &batch.unwrap());
    let arm = robot_file("planar2r");
    let table = succeeds(&over("residual", &path, &arm, &["-o", text(&out)]));
    let left_out = "log.parquet: 8500 rows left out: a value is null\n";
    says(&table, &["500 states in 1 files", left_out]);
    let table = succeeds(&over("identify", &path, &arm, &[]));
    says(&table, &[left_out]);
    let columns = Columns::canonical(2);
    let blocks = Blocks::open(&out, &columns).unwrap();
    assert_eq!(blocks.map(|block| block.unwrap().len()).sum::<usize>(), 500);
}

#[test]
fn columns_and_units_are_the_logs() {
    let folder = Folder::new();
    let robot = robot("planar2r", false);
    let sample = Sample::new(robot.as_ref(), 3000, 10);
    sample.write(&folder.file("plain.parquet"));
    let degrees = 180.0 / core::f64::consts::PI;
    let names = ["stamp", "pa", "pb", "va", "vb", "aa", "ab", "ia", "ib"].map(str::to_owned);
    let path = folder.file("other.parquet");
    let mut table = Table::create(&path, &names, false).unwrap();
    let stamps: Vec<f64> = sample.time.iter().map(|time| 1e3 * time).collect();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for quantity in 0..4 {
        for (i, constant) in [0.5, -2.0].iter().enumerate() {
            let factor = [degrees, degrees, degrees, 1.0 / constant][quantity];
            let values = sample.column(quantity, i).iter();
            columns.push(values.map(|x| x * factor).collect());
        }
    }
    let slices = columns.iter().map(Vec::as_slice);
    table.write("", &stamps, slices).unwrap();
    table.close().unwrap();
    let mapping = folder.file("mapping.toml");
    let flags = "time = 'stamp'\ntime-unit = 'ms'\nposition = 'pa, pb'\nvelocity = 'va,vb'\n\
                 acceleration = 'aa,ab'\neffort = 'ia,ib'\nunits = 'rad'\n\
                 torque-constants = [0.5, -2.0]\n";
    std::fs::write(&mapping, flags).unwrap();
    let arm = robot_file("planar2r");
    let plain = succeeds(&over("residual", &folder.file("plain.parquet"), &arm, &[]));
    let more = ["--mapping", text(&mapping), "--units", "deg"];
    let other = succeeds(&over("residual", &path, &arm, &more));
    assert_eq!(rows(&plain, "plain.parquet"), rows(&other, "other.parquet"));
    std::fs::write(&mapping, "positon = 'q{}'\n").unwrap();
    let why = fails(&over("residual", &path, &arm, &more));
    says(&why, &["positon", "position"]);
    let why = fails(&over("residual", &path, &arm, &[]));
    says(&why, &["no column `time`", "stamp, pa"]);
}

/// Episodes as LeRobot has them: a list of floats in degrees, without rates; with currents.
#[test]
fn lists_of_floats_in_degrees_are_read() {
    let folder = Folder::new();
    simulated(&folder, "--files 1 --seconds 20 --noise 0.02");
    let log = folder.file("logs/log0000.parquet");
    let robot = robot("planar2r", false);
    let (mut time, mut state, mut current) = (Vec::new(), Vec::new(), Vec::new());
    for block in Blocks::open(&log, &Columns::canonical(2)).unwrap() {
        let block = block.unwrap();
        for (s, at) in block.time.iter().enumerate() {
            time.push(*at);
            for (i, constant) in [0.5, -2.0].iter().enumerate() {
                state.push(block.column(0, i)[s].to_degrees() as f32);
                current.push((block.column(3, i)[s] / constant) as f32);
            }
        }
    }
    let list = |values: Vec<f32>| -> ArrayRef {
        let item = Arc::new(Field::new_list_field(DataType::Float32, true));
        let values = Arc::new(Float32Array::from(values));
        Arc::new(FixedSizeListArray::try_new(item, 2, values, None).unwrap())
    };
    let columns: [(&str, ArrayRef); 3] = [
        ("timestamp", Arc::new(Float64Array::from(time))),
        ("observation.state", list(state)),
        ("observation.current", list(current)),
    ];
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    let path = folder.file("episode.parquet");
    write(&path, &batch);

    let arm = robot_file("planar2r");
    let plain = succeeds(&over("residual", &log, &arm, &[]));
    let base = over("residual", &path, &arm, &[]);
    let named = [
        &base[..],
        &["--time", "timestamp", "--position", "observation.state"],
        &["--effort", "observation.current", "--units", "deg"],
        &["--motion-frequency", "2", "--torque-constants"],
    ]
    .concat();
    let listed = succeeds(&[&named[..], &["0.5,-2"]].concat());
    let plain = rows(&plain, "log0000.parquet");
    let listed = rows(&listed, "episode.parquet");
    assert_eq!(listed.len(), robot.joints());
    for (plain, listed) in plain.iter().zip(&listed) {
        assert!((listed[1] / plain[1] - 1.0).abs() < 0.05, "{listed:?}");
    }
    let three = robot_file("planar3r");
    let wide = over("residual", &path, &three, &named[4..]);
    let why = fails(&[&wide[..], &["1,1,1"]].concat());
    let wanted =
        "column `observation.state` is FixedSizeList(2 x Float32); expected a list of 3 numbers";
    says(&why, &[wanted]);
}

/// Lists whose type does not say how long they are, as pandas and polars write them.
#[test]
fn lists_of_any_length_are_read() {
    let (folder, count) = (Folder::new(), 600);
    let sample = Sample::new(robot("planar2r", false).as_ref(), count, 14);
    sample.write(&folder.file("plain.parquet"));
    let value = |quantity: usize, i: usize, s: usize| Some(sample.column(quantity, i)[s]);
    let written = |name: &str, change: &dyn Fn(usize, &mut Option<Row>)| {
        let time: ArrayRef = Arc::new(Float64Array::from(sample.time.clone()));
        let mut columns = vec![("time", time)];
        for (quantity, name) in ["q", "qd", "qdd", "tau"].into_iter().enumerate() {
            let rows = (0..count).map(|s| {
                let mut list = Some(vec![value(quantity, 0, s), value(quantity, 1, s)]);
                if quantity == 0 {
                    change(s, &mut list);
                }
                list
            });
            type Large = LargeListArray;
            let lists: ArrayRef = match quantity % 2 {
                0 => Arc::new(ListArray::from_iter_primitive::<Float64Type, _, _>(rows)),
                _ => Arc::new(Large::from_iter_primitive::<Float64Type, _, _>(rows)),
            };
            columns.push((name, lists));
        }
        let path = folder.file(name);
        write(&path, &RecordBatch::try_from_iter(columns).unwrap());
        path
    };
    let arm = robot_file("planar2r");
    let plain = succeeds(&over("residual", &folder.file("plain.parquet"), &arm, &[]));
    let lists = written("lists.parquet", &|_, _| {});
    // Without `q1` the list `q` is taken, with or without its name.
    let flags = "--position q --velocity qd --acceleration qdd --effort tau";
    let names: Vec<&str> = flags.split(' ').collect();
    for more in [&[][..], &names[..]] {
        let said = succeeds(&over("residual", &lists, &arm, more));
        assert_eq!(rows(&said, "lists.parquet"), rows(&plain, "plain.parquet"));
    }
    let short = written("short.parquet", &|s, list| {
        if let (17, Some(numbers)) = (s, list) {
            numbers.pop();
        }
    });
    let why = fails(&over("residual", &short, &arm, &[]));
    let wanted = "short.parquet: row 18: column `q` has 1 numbers; expected 2";
    says(&why, &[wanted]);
    let gaps = written("gaps.parquet", &|s, list| match (s % 100, list) {
        (3, list) => *list = None,
        (4, Some(numbers)) => numbers[1] = None,
        _ => {}
    });
    let said = succeeds(&over("residual", &gaps, &arm, &[]));
    let left_out = "gaps.parquet: 12 rows left out: a value is null";
    says(&said, &["588 states in 1 files", left_out]);
    let three = robot_file("planar3r");
    let why = fails(&over("residual", &lists, &three, &[]));
    says(&why, &["row 1: column `q` has 2 numbers; expected 3"]);
}

fn without_accelerations(log: &Path, to: &Path, factor: Option<f64>) {
    let mut names = canonical_names(2);
    names.retain(|name| !name.starts_with(if factor.is_some() { "qdd" } else { "qd" }));
    let mut table = Table::create(to, &names, false).unwrap();
    for block in Blocks::open(log, &Columns::canonical(2)).unwrap() {
        let block = block.unwrap();
        let [q, qd, _, tau] = block.quantities;
        let scaled = factor.map(|factor| qd.iter().map(|qd| factor * qd).collect::<Vec<f64>>());
        let vectors = [Some(q), scaled, Some(tau)];
        let columns = vectors.iter().flatten().map(Vec::as_slice);
        table.write("", &block.time, columns).unwrap();
    }
    table.close().unwrap();
}

/// Differentiating once leaves less of the encoders' steps than twice.
#[test]
fn measured_velocities_are_used() {
    let folder = Folder::new();
    let flags = "--files 1 --seconds 10 --noise 0.002 --encoder 2000";
    simulated(&folder, flags);
    let (log, arm) = (folder.file("logs/log0000.parquet"), robot_file("planar2r"));
    let [once, twice, wrong] = [Some(1.0), None, Some(0.0)].map(|factor| {
        let path = folder.file("log.parquet");
        without_accelerations(&log, &path, factor);
        succeeds(&over("residual", &path, &arm, &[]))
    });
    let said = "log.parquet: accelerations are differentiated from measured velocities\n";
    let ends = "rows left out: at the ends there are no derivatives";
    says(&once, &[said, ends]);
    let said = "log.parquet: velocities and accelerations are differentiated from positions";
    says(&twice, &[&format!("{said}\n")]);
    let why = ", since the measured velocities of joint 1 are not their rates\n";
    says(&wrong, &[&format!("{said}{why}")]);
    let [once, twice, wrong] = [once, twice, wrong].map(|said| rows(&said, "log.parquet"));
    assert_eq!(twice, wrong);
    for (once, twice) in once.iter().zip(&twice) {
        assert!(once[1] < 0.5 * twice[1], "{once:?} {twice:?}");
    }
    let more = ["--motion-frequency", "100", "--acceleration", "none{}"];
    let why = fails(&over("residual", &log, &arm, &more));
    let wanted = "1000 states a second carry motion up to 42.13 Hz, and --motion-frequency is 100";
    says(&why, &[wanted]);
}

#[test]
fn rates_that_are_missing_are_differentiated() {
    let [with, without] = ["", "--encoders-only"].map(|more| {
        let folder = Folder::new();
        let flags = format!("--files 1 --seconds 20 --noise 0.02 {more}");
        simulated(&folder, &flags);
        let logs = folder.file("logs/*.parquet");
        let (arm, work) = (robot_file("planar2r"), folder.file(""));
        // The motion has 0.6 Hz: a filter for 5 Hz lets more of the encoder's steps through.
        let more = ["--work", text(&work), "--motion-frequency", "2"];
        let table = succeeds(&over("residual", &logs, &arm, &more));
        assert_eq!(folder.names(), ["logs"], "what was converted is gone");
        rows(&table, "log0000.parquet")
    });
    for (with, without) in with.iter().zip(&without) {
        let ratio = without[1] / with[1];
        assert!((ratio - 1.0).abs() < 0.05, "{with:?} {without:?}");
    }
}
