//! `dalembert import`: makes a robot file from a chain of a URDF or an MJCF.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use dalembert_import::{
    ChainArgs, Change, Import, Options, SharedJoints, Snap, Text, arms, import_text, is_model,
    open_text,
};
use dalembert_model::number::Rational;
use dalembert_model::read::{Diagnostics, RobotWarning, Severity};
use dalembert_model::robot::Joint;
use dalembert_stamp::{Comment, sealed};
use serde_json::{Value, json};

use crate::args::values::{acceleration_parser, name_parser};
use crate::files::{Files, ends_in};
use crate::output::{Context, Done, Failure, Outcome};
use crate::report::{Cell, Report, Table, cells, counted};
use crate::source::{ACCELERATION, defaults, unopened};

/// Arguments of `import`.
///
/// Links that are fixed to each other become one. Rounded numbers are replaced by the exact
/// ones that were probably meant, for example 1.57079632679 by pi/2; each is listed with its
/// line, and the change of the torques is bounded. --exact keeps all numbers; --snap also replaces
/// those that change a torque by more than 1e-6 of its limit. Expand a xacro first:
/// `xacro FILE.xacro > FILE.urdf`.
#[derive(Debug, clap::Args)]
pub struct ImportArgs {
    /// The model: a URDF or an MJCF (MuJoCo)
    model: PathBuf,
    /// Write the robot file here [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write a robot file for every arm into the folder of -o, with all other joints locked, and
    /// list the arms that move each other
    #[arg(long, requires = "output", conflicts_with = "tip")]
    all: bool,
    /// Keep every number exactly as the model has it; if links branch and more than six angles are
    /// odd, these within 2^-52 rad
    #[arg(long)]
    exact: bool,
    /// Replace rounded numbers by the exact ones that were probably meant, even where that
    /// changes a torque by more than 1e-6 of its limit
    #[arg(long, conflicts_with = "exact")]
    snap: bool,
    /// The acceleration limit of each joint that has none in the model, rad/s² or m/s²
    /// [default: 10]
    #[arg(long, value_name = "A", value_parser = acceleration_parser(), allow_hyphen_values = true)]
    acceleration: Option<Rational>,
    /// The name of the robot [default: the model's]
    #[arg(long, value_name = "NAME", value_parser = name_parser())]
    name: Option<String>,
    #[command(flatten)]
    chain: ChainArgs,
}

impl ImportArgs {
    fn options(&self) -> Options {
        let defaults = defaults(&self.model);
        self.chain.choose(Options {
            exact: self.exact,
            snap: self.snap,
            acceleration: self.acceleration.clone().or(defaults.acceleration),
            name: self.name.clone(),
            ..defaults
        })
    }
}

pub(crate) fn run(args: &ImportArgs, context: &Context) -> Outcome {
    let path = &args.model;
    let mut files = Files::new(context, &[path]);
    let mut target = None;
    if !args.all {
        ends_in(args.output.as_deref(), "toml")?;
        target = Some(files.output(args.output.as_deref())?);
    }
    let source = open_text(path).map_err(|error| unopened(path, error))?;
    if !is_model(source.as_str().as_bytes()) {
        return Err(Failure::Input(format!(
            "error: `{}` is not XML, so neither a URDF nor an MJCF\n  = help: a robot file needs no import: pass \
             it to any subcommand",
            path.display()
        )));
    }
    let options = args.options();
    let wrong = |errors: Diagnostics| Failure::Input(errors.render());
    let (made, shared) = match args.all {
        true => arms(&source, &options).map_err(wrong)?,
        false => {
            let made = import_text(&source, &options).map_err(wrong)?;
            (vec![made], Vec::new())
        }
    };
    say(args, context, &made, &source);
    let mut done = Done::from(match made.as_slice() {
        [import] if !args.all => report_of_arm(import, path, &source),
        _ => report_of_arms(&made, shared, path, &source),
    });
    done.is_aside = true;
    for made in made {
        let target = match &target {
            Some(target) => target.clone(),
            None => {
                let into = args.output.as_deref().unwrap_or(Path::new("."));
                files.add_in(into, &format!("{}.toml", made.robot.name))?
            }
        };
        let text = sealed(Comment::Toml, "dalembert import", &made.text);
        done.files.push((target, text));
    }
    Ok(done)
}

fn say(args: &ImportArgs, context: &Context, made: &[Import], source: &Text) {
    let mut said = BTreeSet::new();
    for note in made.iter().flat_map(|made| &made.notes) {
        context.heard(note.severity == Severity::Warning);
        let note = note.render();
        if said.insert(note.clone()) && !context.json {
            context.say(&note);
        }
    }
    if context.json {
        return;
    }
    for made in made.iter().filter(|_| !args.all) {
        for snap in made.snaps.iter().filter(|snap| snap.changes) {
            let (name, line) = source.line(snap.span.start);
            context.say(&format!("{name}:{line}: {snap}"));
        }
        if let Some(counted) = Snap::counted(&made.snaps) {
            context.say(&counted);
        }
    }
    let default = defaults(&args.model).acceleration;
    let joints = made.iter().flat_map(|made| &made.robot.joints);
    let is_default = |joint: &Joint| joint.limits.acceleration == default;
    if args.acceleration.is_none() && joints.into_iter().any(is_default) {
        context.say(&format!(
            "the acceleration limit is set to {ACCELERATION} rad/s² or m/s² for each joint that has none in \
             the model; --acceleration changes it"
        ));
    }
}

fn report_of_arm(made: &Import, path: &Path, source: &Text) -> Report {
    let mut report = values(made, path, source);
    let joints = counted(made.robot.joints.len(), "joint");
    report.line(format!("{}: {joints}", made.robot.name));
    let Some(change) = &made.change else {
        return report;
    };
    let snaps = counted(made.snaps.len(), "rounded number");
    let replaced = format!("{snaps} replaced by exact ones");
    report.line(format!("{replaced}; the torques change by: {change}"));
    let limits = change.limits();
    let bounds = change.torques(limits);
    // If no torque changes, the line before says so.
    if bounds.iter().any(|bound| *bound > 0.0) {
        for (i, joint) in made.robot.rows().into_iter().enumerate() {
            report.line(format!(
                "  {}: ≤ {} N·m or N, at velocities up to {:.3} and accelerations up to {:.3} (SI)",
                joint.name.as_deref().unwrap_or_default(),
                Change::in_digits(bounds[i]),
                limits.velocity[i],
                limits.acceleration[i]
            ));
        }
    }
    let hand = change.hand(limits);
    if hand.position > 0.0 || hand.angle > 0.0 {
        let [moves, turns] = [hand.position, hand.angle].map(Change::in_digits);
        report.line(match made.robot.is_tree() {
            true => format!("  the ends of limbs move by ≤ {moves} m and turn by ≤ {turns} rad"),
            false => format!("  the hand moves by ≤ {moves} m and turns by ≤ {turns} rad"),
        });
    }
    report.line("  --exact keeps all numbers as the model has them");
    report
}

fn report_of_arms(
    made: &[Import],
    shared: Vec<SharedJoints>,
    path: &Path,
    source: &Text,
) -> Report {
    let mut report = Report::default();
    let arms = made.iter().map(|made| json!(values(made, path, source)));
    report.value("arms", arms.collect::<Value>());
    for made in made {
        let change = made.change.as_ref().map(|change| {
            let snaps = counted(made.snaps.len(), "rounded number");
            format!(", {snaps} replaced by exact ones: the torques change by {change}")
        });
        let joints = counted(made.robot.joints.len(), "joint");
        let (name, change) = (&made.robot.name, change.unwrap_or_default());
        report.line(format!("{name}.toml: {joints}{change}"));
    }
    let mut table = Table::new("arms|joints");
    for SharedJoints { arms, joints } in shared {
        let [one, other] = &arms;
        let through = joints.join(", ");
        report.line(format!(
            "{one} and {other} move each other through {through}: each file locks the other arm, \
             so its torques are right only while the other arm stands still",
        ));
        table.row(cells![Cell::json(arms.to_vec()), Cell::json(joints)]);
    }
    report.value("shared", table.json());
    report
}

fn values(made: &Import, path: &Path, source: &Text) -> Report {
    let robot = &made.robot;
    let notes = made.notes.iter().map(|note| {
        json!({
            "severity": note.severity.to_string(),
            "warning": note.warning.map(RobotWarning::name),
            "line": note.line(),
            "column": note.excerpt().map(|excerpt| excerpt.column),
            "message": note.message,
            "help": note.help,
        })
    });
    let snaps = made.snaps.iter().map(|snap| {
        let line = source.line(snap.span.start).1;
        json!({ "line": line, "of": snap.of, "from": snap.from, "to": snap.to })
    });
    let change = made.change.as_ref().map(|change| {
        let limits = change.limits();
        // One row per joint, including joints that follow others.
        let rows = robot.rows().into_iter().zip(change.torques(limits));
        let joints = rows.enumerate().map(|(i, (joint, torque))| {
            json!({
                "joint": joint.name,
                "torque": torque,
                "velocity": limits.velocity[i],
                "acceleration": limits.acceleration[i],
            })
        });
        let hand = change.hand(limits);
        json!({
            "of_efforts": change.of_efforts(),
            "joints": joints.collect::<Value>(),
            "hand": { "position": hand.position, "angle": hand.angle },
        })
    });
    let joints = robot.joints.iter().map(|joint| json!(joint.name));
    let mut report = Report::default();
    report.value("model", path.display().to_string());
    report.value("robot", robot.name.as_str());
    report.value("input", robot.short_hash());
    report.value("joints", joints.collect::<Value>());
    report.value("notes", notes.collect::<Value>());
    report.value("taken_for_others", snaps.collect::<Value>());
    report.value("change", change);
    report
}
