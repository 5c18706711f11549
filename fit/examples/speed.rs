//! States a second and core: accumulating regressors that are there, and evaluating them at run
//! time. Each is the best of 20 runs: others may use the machine.

use std::time::Instant;

use dalembert_fit::random::{Random, within};
use dalembert_fit::{Accumulator, Model, Options};
use dalembert_model::read::parse;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: speed ROBOT.toml")?;
    let text = std::fs::read_to_string(path)?;
    let robot = parse(&text, &Default::default())
        .map_err(|why| why.to_string())?
        .robot;
    let model = Model::new(&robot, &Options::default())?;
    let mut random = Random::new(1);
    let mut draw = || -> Vec<f64> {
        (0..model.joints())
            .map(|_| within(&mut random, 2.0))
            .collect()
    };
    // No more than a cache holds: they come from whoever evaluated them a moment ago.
    let states: Vec<[Vec<f64>; 4]> = (0..50).map(|_| [(); 4].map(|()| draw())).collect();
    let mut rows = Vec::new();
    for [q, qd, qdd, _] in &states {
        rows.push(model.regressor(q, qd, qdd)?);
    }
    let mut data = Accumulator::new(&model);
    let [mut evaluated, mut added] = [f64::INFINITY; 2];
    for _ in 0..20 {
        let start = Instant::now();
        for [q, qd, qdd, _] in &states {
            std::hint::black_box(model.regressor(q, qd, qdd)?);
        }
        evaluated = evaluated.min(start.elapsed().as_secs_f64() / states.len() as f64);
        let (start, before) = (Instant::now(), data.states());
        for _ in 0..100 {
            for (y, [_, _, _, tau]) in rows.iter().zip(&states) {
                data.add_rows(&model, y, tau)?;
            }
        }
        let count = (data.states() - before) as f64;
        added = added.min(start.elapsed().as_secs_f64() / count);
    }
    let lengths: Vec<usize> = (0..model.joints()).map(|i| model.row(i).len()).collect();
    println!("columns of the joints' rows: {lengths:?}");
    println!("accumulating: {:.2} M states/s", 1e-6 / added);
    println!(
        "evaluating Y at run time: {:.3} M states/s",
        1e-6 / evaluated
    );
    println!("kept: {} bytes", data.to_bytes().len());
    Ok(())
}
