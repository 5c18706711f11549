//! `peers values ROBOT FUNCTION LIBRARY FOLDER` prints what a library computes at the
//! states of `FOLDER/states`, a line a state; `peers time …` prints the nanoseconds
//! that it takes a state, the median of many batches.
//!
//! A library is `dalembert`, `dalembert_fma` for code with `mul_add`, or one of the
//! crates that read `FOLDER/ROBOT.urdf` or `FOLDER/ROBOT.chain` at run time.

mod chain;
mod generated;

use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

type Compute = Box<dyn FnMut(&[f64], &[f64], &[f64], &mut Vec<f64>)>;

/// A timer of a function over states: nanoseconds a state, batch by batch.
type Timed = Box<dyn FnMut(&[Vec<f64>]) -> f64>;

struct Ready {
    compute: Compute,
    batch: Timed,
}

const BATCHES: usize = 301;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [what, robot, function, library, folder] = &arguments[..] else {
        return Err("usage: peers values|time ROBOT FUNCTION LIBRARY FOLDER".into());
    };
    let folder = Path::new(folder);
    let states = read(&folder.join(format!("{robot}.states")))?;
    let mut ready = match library.as_str() {
        "dalembert" => generated::ready(robot, function, false),
        "dalembert_fma" => generated::ready(robot, function, true),
        "dynibo" => chain::dynibo(&folder.join(format!("{robot}.urdf")), function)?,
        "phyz" => chain::phyz(&read(&folder.join(format!("{robot}.chain")))?, function),
        _ => None,
    }
    .ok_or_else(|| format!("{library} has no {function} of {robot}"))?;
    if what == "values" {
        let mut out = Vec::new();
        for state in &states {
            let (q, rest) = state.split_at(state.len() / 3);
            let (qd, x) = rest.split_at(q.len());
            out.clear();
            (ready.compute)(q, qd, x, &mut out);
            let line: Vec<String> = out.iter().map(|x| format!("{x:e}")).collect();
            println!("{}", line.join(" "));
        }
        return Ok(());
    }
    let mut times: Vec<f64> = (0..BATCHES).map(|_| (ready.batch)(&states)).collect();
    times.sort_by(f64::total_cmp);
    println!("{}", times[BATCHES / 2]);
    Ok(())
}

fn read(path: &Path) -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
    let text = std::fs::read_to_string(path)?;
    text.lines()
        .map(|line| line.split(' ').map(|x| Ok(x.parse::<f64>()?)).collect())
        .collect()
}

/// Nanoseconds a state of what is done with each.
fn timed<S>(states: &[S], mut each: impl FnMut(&S)) -> f64 {
    let start = Instant::now();
    for state in states {
        each(black_box(state));
    }
    start.elapsed().as_secs_f64() * 1e9 / states.len() as f64
}
