//! `dalembert certify`: a certificate checked again, part by part.
//!
//! - this file: the check and what is said of it
//! - [`read`]: a certificate from its file
//! - [`complete`]: fields that follow from the others

mod complete;
mod read;

use dalembert_codegen::certify::attack::attack;
use dalembert_codegen::certify::certificate::Certificate;
use dalembert_codegen::certify::input_box::InputBox;
use dalembert_codegen::certify::interval::Interval;
use dalembert_codegen::emit::figures::inside;
use dalembert_codegen::generate::GenerateError;
use dalembert_codegen::plan::SceneKey;
use dalembert_codegen::scene::Setting;
use dalembert_model::read::Reading;
use dalembert_model::scene::Scene;
use serde_json::Value;

use crate::args::CertifyArgs;
use crate::generate::report;
use crate::outcome::{Failure, Outcome};
use crate::{input, output};
use complete::complete;
use read::read;

/// Runs the subcommand.
pub fn run(args: &CertifyArgs) -> Outcome {
    let reading = input::reading(&args.robot)?;
    let certificates = read(&args.certificate)?;
    for (certificate, json) in &certificates {
        one(args, &reading, certificate, json)?;
    }
    Ok(())
}

fn one(args: &CertifyArgs, reading: &Reading, certificate: &Certificate, json: &Value) -> Outcome {
    let name = args.certificate.display();
    let own = certificate.scene.as_ref().map(|scene| &scene.name);
    let scene = args.scene.as_ref().or(own);
    let scene = scene.map(|scene| input::scene(&args.robot, reading, scene));
    let scene = scene.transpose()?;
    // What `tradeoff` finds for other tolerances is about the scene without its.
    let bare = scene.map(Scene::without_tolerance);
    let is_bare = certificate.scene == bare.as_ref().map(SceneKey::of);
    let scene = if is_bare { bare.as_ref() } else { scene };
    let setting = Setting::of(&reading.robot, scene).map_err(GenerateError::Scene)?;
    let checked = certificate
        .check_in(&setting)
        .map_err(|why| Failure::Check(format!("error: {name}: {why}")))?;
    complete(certificate, json).map_err(|why| Failure::Check(format!("error: {name}: {why}")))?;
    let of = scene.map_or_else(String::new, |scene| format!(" in scene {}", scene.name));
    let mut text = format!(
        "{name} holds for `{}` in {} of {}{of}\n  {}\n",
        certificate.emitted.function, certificate.scalar, reading.robot.name, checked.proof
    );
    text += &over(certificate, scene);
    for finding in &checked.findings {
        text += &format!("warning: {finding}\n");
    }
    let mut rows = report::bounds(certificate);
    let mut seen = None;
    if args.samples > 0 {
        let attack = attack(certificate, args.samples, args.climbs, 1)
            .map_err(|error| Failure::Check(format!("error: {name}: {error}")))?;
        rows[0].push("observed".into());
        for (row, observed) in rows[1..].iter_mut().zip(&attack.observed) {
            row.push(format!("{observed:.3e}"));
        }
        seen = Some(attack);
    }
    text += &output::table(&rows, 0);
    output::print(&text)?;
    if let Some(attack) = seen {
        output::note(&format!("run at {} states", attack.states));
        if let Some((index, state)) = attack.violation {
            return Err(Failure::Check(format!(
                "error: {name}: {} errs more than E at q = {:?}, qd = {:?}, qdd = {:?}",
                certificate.emitted.entry(index),
                state.q,
                state.qd,
                state.qdd
            )));
        }
    }
    Ok(())
}

/// The box, inside which everything holds.
fn over(certificate: &Certificate, scene: Option<&Scene>) -> String {
    let InputBox {
        position,
        velocity,
        acceleration,
    } = &certificate.limits;
    let mut rows = vec![["over", "q", "qd", "qdd"].map(str::to_owned).to_vec()];
    let range = |x: &Interval| inside(x.low(), x.high());
    let joints = position.iter().zip(velocity).zip(acceleration);
    for (joint, ((q, qd), qdd)) in joints.enumerate() {
        let name = format!("joint {}", joint + 1);
        rows.push(match scene.and_then(|scene| scene.locked(joint)) {
            Some(_) => vec![name, "locked".into()],
            None => vec![name, range(q), range(qd), range(qdd)],
        });
    }
    output::table(&rows, 0)
}
