//! From logs of an arm to a robot file with its parameters, end to end: a trajectory that
//! excites them, four logs of an arm that its file does not know, residuals before and after.
//!
//! ```sh
//! cargo run --release -p dalembert-fit --example identify -- generated/robots/ur10.toml -o new.toml
//! ```

use std::error::Error;
use std::path::Path;

use dalembert_fit::random::{Random, within};
use dalembert_fit::robot_file::{replaceable, save};
use dalembert_fit::simulate::{LogSettings, record};
use dalembert_fit::{
    Accumulator, Effort, Model, consistent, cross_validation, excite, fit, identified,
};
use dalembert_model::read::parse_bytes;
use dalembert_model::robot::write;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let usage = "usage: identify ROBOT.toml [-o NEW.toml]";
    let path = arguments.next().ok_or(usage)?;
    let output = match (arguments.next().as_deref(), arguments.next()) {
        (None, _) => None,
        (Some("-o"), Some(output)) => Some(output),
        _ => return Err(usage.into()),
    };
    if let Some(output) = &output {
        replaceable(Path::new(output)).map_err(|why| format!("{output}: {why}"))?;
    }
    let bytes = std::fs::read(&path).map_err(|why| format!("{path}: {why}"))?;
    let reading = parse_bytes(&bytes).map_err(|why| why.to_string())?;
    let model = Model::new(&reading.robot)?;
    let n = model.joints();

    // The arm that is logged: parameters a fifth off, and friction.
    let mut random = Random::new(1);
    let mut right = model.parameters().to_vec();
    for (k, value) in right.iter_mut().enumerate() {
        *value *= 1.0 + within(&mut random, 0.2);
        let name = model.name(k);
        if name.starts_with("coulomb") {
            *value += 2.0;
        } else if name.starts_with("viscous") {
            *value += 1.0;
        }
    }

    let noise = vec![0.3; n];
    let (trajectory, condition) = excite(&model, &noise, 10.0, &Effort::default())?;
    println!("trajectory of 10 s: condition {condition:.0}");
    let mut files = Vec::new();
    for seed in 0..4 {
        let recording = LogSettings {
            period: 2e-3,
            states: 5000,
            noise: noise.clone(),
            resolution: 0.0,
            seed,
        };
        let log = record(&model, &right, &trajectory, &recording)?;
        let mut data = Accumulator::new(&model);
        for k in 0..recording.states {
            data.add(&model, [&log.q[k], &log.qd[k], &log.qdd[k]], &log.tau[k])?;
        }
        files.push(data);
    }
    println!("a log is kept in {} bytes", files[0].to_bytes().len());

    let mut sum = Accumulator::new(&model);
    for file in &files {
        sum.merge(file)?;
    }
    let fit = fit(&model, &sum)?;
    println!("\n{:>12} {:>12}  parameter", "value", "std. error");
    for k in 0..model.columns().len() {
        let [value, error] = [fit.parameters[k], fit.standard_errors[k]];
        println!("{value:12.5} {error:12.5}  {}", model.name(k));
    }
    for one in &fit.unexcited {
        println!("not excited: {one}");
    }
    println!("\nresiduals of logs that were left out, N·m: before -> after");
    for (k, file) in cross_validation(&model, &files)?.iter().enumerate() {
        let pairs = file.before.iter().zip(&file.after);
        let residuals = Vec::from_iter(pairs.map(|(b, a)| format!("{b:.2} -> {a:.2}")));
        println!("log {k}: {}", residuals.join(", "));
    }
    let bodies = consistent(&model, &fit)?;
    println!(
        "\nconsistent bodies: {:.2} standard errors from the free parameters altogether",
        bodies.distance
    );
    let robot = identified(&model, &bodies)?;
    match output {
        Some(output) => {
            save(Path::new(&output), &robot).map_err(|why| format!("{output}: {why}"))?;
        }
        None => print!("\n{}", write(&robot)),
    }
    Ok(())
}
