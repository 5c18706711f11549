//! `generate --report`: what functions take of processors, to people and programs.

use std::fs;

use crate::support::{Ran, robot, run, temporary};
use serde_json::Value;

fn report(arguments: &[&str]) -> Ran {
    let planar = robot("planar2r");
    let generate = ["generate", &planar, "--outputs", "inverse_dynamics"];
    run(&[&generate[..], arguments].concat())
}

/// Returns the words of the line that begins with a function, in the table behind a head.
fn row(ran: &Ran, head: &str) -> Vec<String> {
    assert_eq!(ran.code, 0, "{}", ran.err);
    let mut lines = ran.out.lines().skip_while(|line| !line.starts_with(head));
    let line = lines.find(|line| line.trim_start().starts_with("inverse_dynamics"));
    let line = line.unwrap_or_else(|| panic!("no {head}: {}", ran.out));
    line.split_whitespace().map(str::to_owned).collect()
}

/// The report is on standard output and the code nowhere; with a file, the code is
/// there as without a report.
#[test]
fn the_report_takes_the_place_of_the_code() {
    let alone = report(&["--report"]);
    // mul, add, div, alive, depth, parallel, pairs, and by whom the sines are.
    let expected = ["13", "10", "0", "6", "9", "2.6"];
    assert_eq!(row(&alone, "f64")[1..7], expected);
    assert_eq!(row(&alone, "f32")[1..7], expected);
    assert!(alone.out.contains("2 libm::sincosf"), "{}", alone.out);
    assert!(!alone.out.contains("pub fn"));
    // What every run says is where it was.
    assert!(alone.err.contains("joints, input"), "{}", alone.err);

    let code = report(&[]).out;
    let file = temporary("processor_code").join("arm.rs");
    let name = file.to_str().unwrap();
    let both = report(&["--report", "-o", name]);
    assert_eq!((both.code, &both.out), (0, &alone.out), "{}", both.err);
    assert_eq!(fs::read_to_string(&file).unwrap(), code);
    assert_eq!(report(&["--report", "-o", name, "--check"]).code, 0);
}

#[test]
fn libm_in_f32_is_warned_of_where_f64_is_software() {
    let warns = |arguments: &[&str]| {
        let ran = report(&[&["--report"][..], arguments].concat());
        assert_eq!(ran.code, 0, "{}", ran.err);
        ran.out.contains("warning: libm's f32 sines compute in f64")
    };
    assert!(warns(&[]));
    assert!(warns(&["--scalar", "f32", "--target", "cortex-m4f,x86-64"]));
    assert!(!warns(&["--scalar", "f64"]));
    assert!(!warns(&["--target", "cortex-m7"]));
    assert!(!warns(&["--sincos", "together"]));
    assert!(!warns(&["--sincos", "polynomial"]));
    let inline = report(&["--report", "--sincos", "polynomial", "--scalar", "f32"]);
    let row = row(&inline, "f32");
    // Calls, f64 and branches.
    assert!(
        row.ends_with(&["none", "none", "none"].map(String::from)),
        "{row:?}"
    );
}

/// JSON has the numbers of the table, and needs no file: there is no code on standard
/// output that it would be mixed with.
#[test]
fn programs_read_it_too() {
    let target = ["--report", "--target", "cortex-m4f"];
    let table = report(&target);
    let ran = report(&[&target[..], &["--json"]].concat());
    assert_eq!(ran.code, 0, "{}", ran.err);
    let said: Value = serde_json::from_str(&ran.out).unwrap();
    // Beside what it says without.
    assert_eq!(said["functions"]["inverse_dynamics"]["counts"]["mul"], 13);
    let processors = &said["processors"];
    let of = &processors["scalars"]["f32"]["inverse_dynamics"];
    assert_eq!((&of["alive"], &of["depth"]), (&6.into(), &9.into()));
    assert_eq!(of["calls"]["libm::sincosf"], 2);
    assert_eq!(of["sines"]["libm"], 2);
    let row = row(&table, "f32");
    assert_eq!(&row[4..6], ["6", "9"]);
    // It has no f64, and libm's f32 sines compute in it.
    assert!(table.out.contains("warning: cortex-m4f has no f64"));
    assert_eq!(processors["warnings"].as_array().unwrap().len(), 2);
}

#[test]
fn what_cannot_be_reported_is_refused() {
    let slip = report(&["--report", "--target", "cortex-m4"]);
    assert_eq!(slip.code, 2);
    for name in ["cortex-m4f", "cortex-m7", "aarch64", "x86-64"] {
        assert!(slip.err.contains(name), "{}", slip.err);
    }
    let alone = report(&["--target", "cortex-m7"]);
    assert_eq!(alone.code, 2);
    assert!(alone.err.contains("--report"), "{}", alone.err);
    // The code would be on the same stream.
    let json = report(&["--json"]);
    assert_eq!(json.code, 2);
    assert!(json.err.contains("--output"), "{}", json.err);
}
