//! ROS 2's recordings give what Parquet files of the same states give.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use mcap::Writer;
use mcap::records::MessageHeader;

use crate::support::{Folder, fails, over, robot_file, rows, says, simulated, succeeds};
use dalembert_fleet::logs::{Blocks, Columns};

/// Bytes of a message: XCDR1, as ROS 2 writes them.
struct Cdr {
    bytes: Vec<u8>,
    is_little: bool,
}

impl Cdr {
    fn put<const N: usize>(&mut self, mut word: [u8; N]) {
        while !(self.bytes.len() - 4).is_multiple_of(N) {
            self.bytes.push(0);
        }
        if !self.is_little {
            word.reverse();
        }
        self.bytes.extend(word);
    }

    fn text(&mut self, text: &str) {
        self.put((text.len() as u32 + 1).to_le_bytes());
        self.bytes.extend(text.as_bytes());
        self.bytes.push(0);
    }

    fn floats(&mut self, values: &[f64]) {
        self.put((values.len() as u32).to_le_bytes());
        values.iter().for_each(|x| self.put(x.to_le_bytes()));
    }
}

fn message(time: f64, names: &[&str], values: [&[f64]; 3], is_little: bool) -> Vec<u8> {
    let bytes = vec![0, u8::from(is_little), 0, 0];
    let mut cdr = Cdr { bytes, is_little };
    let nanoseconds = (time * 1e9).round() as u64;
    cdr.put(((nanoseconds / 1_000_000_000) as u32).to_le_bytes());
    cdr.put(((nanoseconds % 1_000_000_000) as u32).to_le_bytes());
    cdr.text("base_link");
    cdr.put((names.len() as u32).to_le_bytes());
    names.iter().for_each(|name| cdr.text(name));
    values.iter().for_each(|values| cdr.floats(values));
    cdr.bytes
}

/// Joints of a recording: their names, and their places in the robot, of which a gripper has none.
type Joints = [(&'static str, Option<usize>)];

fn header(channel_id: u16, time: u64) -> MessageHeader {
    MessageHeader {
        channel_id,
        sequence: 0,
        log_time: time,
        publish_time: time,
    }
}

fn record(log: &Path, to: &Path, joints: &Joints, is_little: bool) {
    let mut writer = Writer::new(BufWriter::new(File::create(to).unwrap())).unwrap();
    let mut channel = |topic: &str, schema: &str| {
        let schema = writer.add_schema(schema, "ros2msg", b"").unwrap();
        let channel = writer.add_channel(schema, topic, "cdr", &BTreeMap::new());
        channel.unwrap()
    };
    let other = channel("/chatter", "std_msgs/msg/String");
    let states = channel("/joint_states", "sensor_msgs/msg/JointState");
    let mut put = |channel_id: u16, time: f64, data: &[u8]| {
        let header = header(channel_id, (time * 1e9) as u64);
        writer.write_to_known_channel(&header, data).unwrap();
    };
    let mut names: Vec<&str> = joints.iter().map(|(name, _)| *name).collect();
    names.retain(|name| !name.is_empty());
    let columns = Columns::canonical(2);
    for block in Blocks::open(log, &columns).unwrap() {
        let block = block.unwrap();
        for (s, time) in block.time.iter().enumerate() {
            let at = |of| -> Vec<f64> {
                let value = |joint| block.column(of, joint)[s];
                let entries = joints.iter().map(|(_, joint)| joint.map_or(0.5, value));
                entries.collect()
            };
            let data = message(*time, &names, [&at(0), &[], &at(3)], is_little);
            put(other, *time, b"\0\x01\0\0");
            put(states, *time, &data);
        }
    }
    writer.finish().unwrap();
}

#[test]
fn joints_of_other_names_are_refused() {
    let (folder, arm) = (Folder::new(), robot_file("planar2r"));
    simulated(&folder, "--files 1 --seconds 5 --encoders-only");
    let (log, path) = (folder.file("logs/log0000.parquet"), folder.file("log.mcap"));
    let residual = over("residual", &path, &arm, &[]);
    record(&log, &path, &[("b", Some(1)), ("a", Some(0))], true);
    let why = fails(&residual);
    let said =
        "it has no joint shoulder, elbow: its joints are b, a, those of the robot shoulder, elbow";
    says(&why, &[said, "--joint-names"]);
    record(&log, &path, &[("", Some(0)), ("", Some(1))], true);
    let unnamed_rows = rows(&succeeds(&residual), "log.mcap");
    let named = over("residual", &path, &arm, &["--joint-names", "a,b"]);
    record(&log, &path, &[("b", Some(1)), ("a", Some(0))], true);
    assert_eq!(unnamed_rows, rows(&succeeds(&named), "log.mcap"));
}

#[test]
fn recordings_without_efforts_are_refused() {
    let folder = Folder::new();
    let path = folder.file("log.mcap");
    let mut writer = Writer::new(BufWriter::new(File::create(&path).unwrap())).unwrap();
    let schema = writer.add_schema("sensor_msgs/msg/JointState", "ros2msg", b"");
    let (schema, none) = (schema.unwrap(), BTreeMap::new());
    let channel = writer.add_channel(schema, "/joint_states", "cdr", &none);
    let header = header(channel.unwrap(), 0);
    let data = message(0.5, &[], [&[0.1, 0.2], &[], &[]], true);
    writer.write_to_known_channel(&header, &data).unwrap();
    writer.finish().unwrap();
    let why = fails(&over("residual", &path, &robot_file("planar2r"), &[]));
    let wanted = "log.mcap: message 1 has no efforts: residuals need measured torques";
    says(&why, &[wanted]);
}

#[test]
fn recordings_give_what_parquet_files_give() {
    let (folder, arm) = (Folder::new(), robot_file("planar2r"));
    simulated(&folder, "--files 1 --seconds 5 --encoders-only");
    let log = folder.file("logs/log0000.parquet");
    let table = succeeds(&over("residual", &log, &arm, &[]));
    let wanted = rows(&table, "log0000.parquet");
    for is_little in [true, false] {
        let path = folder.file("log.mcap");
        let joints = [("b", Some(1)), ("gripper", None), ("a", Some(0))];
        record(&log, &path, &joints, is_little);
        let base = over("residual", &path, &arm, &[]);
        let named = [&base[..], &["--joint-names", "a,b"]].concat();
        let rows = rows(&succeeds(&named), "log.mcap");
        assert_eq!(rows.len(), 2);
        for (row, wanted) in rows.iter().zip(&wanted) {
            for (x, y) in row.iter().zip(wanted) {
                assert!((x - y).abs() <= 2e-3 * y.abs(), "{row:?} {wanted:?}");
            }
        }
        says(&fails(&base), &["--joint-names", "b, gripper, a"]);
        let why = fails(&[&named[..], &["--topic", "/chatter"]].concat());
        says(&why, &["std_msgs/msg/String"]);
        let why = fails(&[&base[..], &["--joint-names", "a,wrist"]].concat());
        says(&why, &["message 1: it has no joint wrist: its joints"]);
        let bytes = std::fs::read(&path).unwrap();
        std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
        says(&fails(&named), &["log.mcap: "]);
    }
}
