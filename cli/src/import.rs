//! `dalembert import`: a robot file of a chain of a URDF or an MJCF.

use std::collections::BTreeSet;
use std::path::Path;
use std::slice;

use dalembert_import::{Arms, Change, Imported, Shared, Text, arms, import_text};
use dalembert_model::robot::Robot;
use serde_json::{Value, json};

use crate::args::ImportArgs;
use crate::files::folder::Folder;
use crate::files::target::Target;
use crate::files::{distinct, write};
use crate::outcome::{Failure, Outcome};
use crate::{model, output};

/// Runs the subcommand.
pub fn run(args: &ImportArgs) -> Outcome {
    if let Some(folder) = args.output.as_deref().filter(|_| args.all) {
        return all(args, folder);
    }
    let target = Target::output(args.output.as_deref(), args.json)?;
    distinct::distinct(&[("the URDF", &args.urdf)], &[("the robot file", &target)])?;
    target.ends_in("toml")?;
    target.check()?;
    if !args.force {
        target.ours()?;
    }
    let name = args.urdf.display().to_string();
    let source = model::text(&args.urdf, &args.xacro)?;
    let imported = import_text(&source, &args.chain.options(&args.urdf))
        .map_err(|errors| Failure::Input(source.render(&errors.0)))?;
    let document = args.json.then(|| json(&imported, &name, &source));
    if !args.json {
        notes(&imported, &source);
        args.chain
            .assumed()
            .iter()
            .for_each(|said| output::note(said));
    }
    undenied(document.as_ref())?;
    write::write(&[(&target, &imported.text)])?;
    match document {
        Some(document) => output::print_json(&document),
        None => {
            report(&imported);
            Ok(())
        }
    }
}

/// Fails where there are warnings and they are denied; the document that lists them is printed first.
fn undenied(document: Option<&Value>) -> Outcome {
    let denied = output::undenied();
    match document {
        Some(document) if denied.is_err() => output::print_json(document).and(denied),
        _ => denied,
    }
}

/// Writes a robot file of every arm into a folder, all or none.
fn all(args: &ImportArgs, folder: &Path) -> Outcome {
    let name = args.urdf.display().to_string();
    let source = model::text(&args.urdf, &args.xacro)?;
    let Arms { arms, shared } = arms(&source, &args.chain.options(&args.urdf))
        .map_err(|errors| Failure::Input(source.render(&errors.0)))?;
    let named = arms
        .iter()
        .map(|(arm, made)| (format!("{arm}.toml"), made.text.clone()));
    let files: Vec<(String, String)> = named.collect();
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    let into = Folder::at(folder, &names, Some(&args.urdf))?;
    for name in names.iter().filter(|_| !args.force && folder.is_dir()) {
        Target::at(&folder.join(name))?.ours()?;
    }
    let mut said = BTreeSet::new();
    let made = arms
        .iter()
        .flat_map(|(_, made)| &made.notes)
        .filter(|_| !args.json);
    for note in made.map(|note| source.render(slice::from_ref(note))) {
        if said.insert(note.clone()) {
            output::note(&note);
        }
    }
    args.chain
        .assumed()
        .iter()
        .filter(|_| !args.json)
        .for_each(|said| output::note(said));
    let document = args.json.then(|| {
        let arms = arms.iter().map(|(_, made)| json(made, &name, &source));
        let shared = shared
            .iter()
            .map(|pair| json!({ "arms": pair.arms, "joints": pair.joints }));
        json!({ "arms": arms.collect::<Vec<_>>(), "shared": shared.collect::<Vec<_>>() })
    });
    undenied(document.as_ref())?;
    into.write(&files)?;
    if let Some(document) = document {
        return output::print_json(&document);
    }
    for (arm, made) in &arms {
        let joints = made.robot.joints.len();
        let snaps = made.snaps.len();
        let change = made.change.as_ref().map(|change| {
            format!(
                ", {snaps} rounded numbers replaced by exact ones: the torques change by {change}"
            )
        });
        let change = change.unwrap_or_default();
        output::note(&format!("{arm}.toml: {joints} joints{change}"));
    }
    for Shared {
        arms: [one, other],
        joints,
    } in &shared
    {
        output::note(&format!(
            "{one} and {other} move each other through {}: each file holds the other arm, \
             so its torques are right where that stands still",
            joints.join(", ")
        ));
    }
    Ok(())
}

/// Describes a robot, its notes and its replaced numbers as JSON.
fn json(imported: &Imported, name: &str, source: &Text) -> Value {
    let robot = &imported.robot;
    let snaps = imported.snaps.iter().map(|snap| {
        json!({
            "line": source.line(snap.span.start).1,
            "of": snap.of,
            "from": snap.from,
            "to": snap.to,
        })
    });
    let change = imported.change.as_ref().map(|change| {
        let limits = change.limits();
        let bounds = change.torques(limits);
        // Of each row, those that follow others too.
        let joints = robot.rows().into_iter().zip(bounds).enumerate();
        let joints = joints.map(|(i, (joint, bound))| {
            json!({
                "joint": joint.name,
                "torque": bound,
                "velocity": limits.velocity[i],
                "acceleration": limits.acceleration[i],
            })
        });
        let hand = change.hand(limits);
        json!({
            "of_efforts": change.of_efforts(),
            "joints": joints.collect::<Vec<_>>(),
            "hand": { "position": hand.position, "angle": hand.angle },
        })
    });
    let joints = robot.joints.iter().map(|joint| &joint.name);
    json!({
        "urdf": name,
        "robot": robot.name,
        "input": robot.short_hash(),
        "joints": joints.collect::<Vec<_>>(),
        "notes": imported.notes.iter().map(output::diagnostic).collect::<Vec<_>>(),
        "taken_for_others": snaps.collect::<Vec<_>>(),
        "change": change,
    })
}

/// Prints what was left out, and which numbers were replaced by others.
fn notes(imported: &Imported, source: &Text) {
    for note in &imported.notes {
        output::note(&source.render(slice::from_ref(note)));
    }
    for snap in &imported.snaps {
        let (name, line) = source.line(snap.span.start);
        output::note(&format!("{name}:{line}: {snap}"));
    }
}

/// Prints the robot, and the change that replaced numbers make.
fn report(imported: &Imported) {
    let Robot { name, joints, .. } = &imported.robot;
    output::note(&format!("{name}: {} joints", joints.len()));
    if let Some(change) = &imported.change {
        let n = imported.snaps.len();
        output::note(&format!(
            "{n} rounded numbers were replaced by exact ones; the torques change by: {change}"
        ));
        let limits = change.limits();
        let bounds = change.torques(limits);
        // Of torques that stay as they are, the first line said it.
        let moved = bounds.iter().any(|bound| *bound > 0.0);
        for (i, joint) in joints.iter().enumerate().filter(|_| moved) {
            let label = joint.name.as_deref().unwrap_or_default();
            output::note(&format!(
                "  {label}: ≤ {} N·m or N, at rates up to {:.3} and {:.3} a second",
                Change::in_digits(bounds[i]),
                limits.velocity[i],
                limits.acceleration[i]
            ));
        }
        let hand = change.hand(limits);
        if hand.position > 0.0 || hand.angle > 0.0 {
            output::note(&format!(
                "  the hand: ≤ {} m and ≤ {} rad from where it was",
                Change::in_digits(hand.position),
                Change::in_digits(hand.angle)
            ));
        }
        output::note("  --exact takes every digit as it stands");
    }
}
