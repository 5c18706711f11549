//! States a second: accumulating regressors that are there, and evaluating them as well.

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
    let states: Vec<[Vec<f64>; 4]> = (0..1000).map(|_| [(); 4].map(|()| draw())).collect();
    let mut rows = Vec::new();
    let start = Instant::now();
    for [q, qd, qdd, _] in &states {
        rows.push(model.regressor(q, qd, qdd)?);
    }
    let evaluated = start.elapsed().as_secs_f64() / states.len() as f64;
    let mut data = Accumulator::new(&model);
    let start = Instant::now();
    for _ in 0..200 {
        for (y, [_, _, _, tau]) in rows.iter().zip(&states) {
            data.add_rows(&model, y, tau)?;
        }
    }
    let added = start.elapsed().as_secs_f64() / data.states() as f64;
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
