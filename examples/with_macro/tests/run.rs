//! The example runs, and its numbers are right.

use std::process::Command;

fn numbers(line: &str) -> Vec<f64> {
    let words = line.split(|c: char| !(c.is_ascii_digit() || "-.".contains(c)));
    words.skip(1).filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn prints_the_torques() {
    let run = Command::new(env!("CARGO_BIN_EXE_with_macro")).output();
    let output = run.unwrap();
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let line = |start: &str| {
        let line = text.lines().find(|line| line.starts_with(start));
        numbers(&line.unwrap_or_else(|| panic!("no {start} in\n{text}"))[start.len()..])
    };
    // The carriage needs nothing to stay, the load m g a sin 0.2.
    let lift = 50.0 * 9.81 * 2.0 * 0.2_f64.sin();
    for (start, tolerance) in [("crane hold", 1e-3), ("crane in f32", 2e-3)] {
        let [carriage, load] = line(start)[..] else {
            panic!("{text}")
        };
        assert!(carriage.abs() < tolerance && (load.abs() - lift).abs() < tolerance);
    }
    // 62 kg at 1 m/s² and 3 N·s/m at 0.5 m/s.
    assert!((line("crane start")[0] - (62.0 + 1.5)).abs() < 1e-3);
    // The axis of the waist is upright.
    assert!(line("puma560 hold")[0].abs() < 1e-3 && line("puma560 start")[0].abs() > 0.1);
}
