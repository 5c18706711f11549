//! Chains of 1 to 60 joints: what generation and compilation cost.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use std::{env, fs, process};

use dalembert_codegen::workspace::task::Request;
use dalembert_report::stress::growth::{Growth, JOINTS, measure};
use serde_json::json;

use crate::args::StressArgs;
use crate::files::folder::Folder;
use crate::outcome::Outcome;
use crate::output;
use crate::plot::curves::Chart;

/// A length of chain, and how long rustc took: `None` without one.
struct Line {
    growth: Growth,
    compile: Option<Duration>,
}

const CHART: &str = "growth.svg";

/// Runs `dalembert stress --growth`.
pub fn run(args: &StressArgs) -> Outcome {
    let output = args.output.as_deref();
    let output = output.map(|folder| Folder::at(folder, &[CHART], None));
    let output = output.transpose()?;
    let mut lines = Vec::new();
    for n in JOINTS {
        output::note(&format!("… {n} joints"));
        let growth = measure(n, &Request::default())?;
        let compile = compile(&growth.text);
        lines.push(Line { growth, compile });
    }
    if args.json {
        let rows = lines.iter().map(|line| {
            let growth = &line.growth;
            json!({
                "joints": growth.joints,
                "mul": growth.counts.mul,
                "add": growth.counts.add,
                "sincos": growth.counts.sincos,
                "generate_s": growth.time.as_secs_f64(),
                "rustc_s": line.compile.map(|t| t.as_secs_f64()),
                "bytes": growth.text.len(),
                "normwise_in_u": growth.error,
            })
        });
        output::print_json(&json!({ "chains": rows.collect::<Vec<_>>() }))?;
    } else {
        output::print(&text(&lines))?;
    }
    if let Some(folder) = output {
        folder.write(&[(CHART.to_owned(), chart(&lines).svg())])?;
    }
    Ok(())
}

fn text(lines: &[Line]) -> String {
    let head = [
        "joints",
        "mul",
        "add",
        "per joint",
        "generate, s",
        "rustc, s",
        "kB",
        "error, u",
    ];
    let mut rows = vec![head.map(String::from).to_vec()];
    for Line { growth, compile } in lines {
        let operations = growth.counts.mul + growth.counts.add;
        rows.push(vec![
            growth.joints.to_string(),
            growth.counts.mul.to_string(),
            growth.counts.add.to_string(),
            (operations / growth.joints.max(1)).to_string(),
            format!("{:.2}", growth.time.as_secs_f64()),
            compile.map_or("–".into(), |t| format!("{:.2}", t.as_secs_f64())),
            format!("{:.1}", growth.text.len() as f64 / 1e3),
            format!("{:.1}", growth.error),
        ]);
    }
    format!(
        "inverse dynamics of general chains, f64\n{}",
        output::table(&rows, 0)
    )
}

fn chart(lines: &[Line]) -> Chart {
    let curve = |name: &str, value: &dyn Fn(&Line) -> Option<f64>| {
        let points = lines
            .iter()
            .filter_map(|line| Some((line.growth.joints as f64, value(line)?)));
        (name.to_owned(), points.collect())
    };
    Chart {
        title: "growth of inverse dynamics".into(),
        x: "joints".into(),
        y: "operations, ms, u".into(),
        bound: None,
        curves: vec![
            curve("operations", &|line| {
                Some((line.growth.counts.mul + line.growth.counts.add) as f64)
            }),
            curve("generate, ms", &|line| {
                Some(line.growth.time.as_secs_f64() * 1e3)
            }),
            curve("rustc, ms", &|line| Some(line.compile?.as_secs_f64() * 1e3)),
            curve("error, u", &|line| Some(line.growth.error)),
        ],
    }
}

/// Sine and cosine for code that is only compiled.
const MATH: &str = "pub mod math {
    pub fn sin(x: f64) -> f64 { x.sin() }
    pub fn cos(x: f64) -> f64 { x.cos() }
    pub fn sincos(x: f64) -> (f64, f64) { x.sin_cos() }
}
";

/// Returns the time that rustc -O takes for the module.
fn compile(text: &str) -> Option<Duration> {
    let folder = env::temp_dir().join(format!("dalembert-growth-{}", process::id()));
    fs::create_dir_all(&folder).ok()?;
    let source = folder.join("chain.rs");
    let written = fs::write(&source, format!("{text}\n{MATH}"));
    let begin = Instant::now();
    let status = written.ok().and_then(|()| {
        Command::new("rustc")
            .args([
                "--edition",
                "2021",
                "--crate-type",
                "lib",
                "-O",
                "--out-dir",
            ])
            .arg(&folder)
            .arg(&source)
            .stderr(Stdio::null())
            .status()
            .ok()
    });
    let time = begin.elapsed();
    // A folder in the temporary folder that stays is no failure.
    let _ = fs::remove_dir_all(&folder);
    status?.success().then_some(time)
}
