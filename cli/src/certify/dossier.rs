//! A checklist of a generated file for whoever argues that it is safe: what the checker found
//! is filled in, what a person has to answer for is left open.

use std::path::Path;

use dalembert_checker::exact::{Line, RATE, Report};
use dalembert_codegen::workspace::certificate::format::text_hash;

use super::body::Body;
use crate::args::CertifyArgs;
use crate::files::distinct;
use crate::files::target::Target;
use crate::input;
use crate::outcome::Failure;

/// What only a person knows.
const OPEN: [&str; 8] = [
    "The robot file is the arm: its numbers were compared with measurements.",
    "Limits and boxes of the robot file are those of the application.",
    "What calls the functions keeps to the box, or asks `in_box` before it uses a result.",
    "The flags of the compiler allow no other arithmetic (no `-ffast-math`, no `-Ofast`), and its version is",
    "The library that computes sines is within one ulp; it is",
    "The file is generated anew in continuous integration and compared (`dalembert renew --check`).",
    "A test on the machine compared torques with measured ones.",
    "The known problems of the guide's page on safety were read for this version.",
];

/// Finds where the checklist goes; what was filled in by hand is not written over.
///
/// # Errors
/// It cannot be written there, or something is there.
pub fn target(args: &CertifyArgs, path: &Path) -> Result<Target, Failure> {
    let target = Target::at(path)?;
    distinct::distinct(
        &[
            ("the generated file", &args.certificate),
            ("the robot file", &args.robot),
        ],
        &[("the dossier", &target)],
    )?;
    let is_there = target.file().is_some_and(Path::exists);
    match is_there && !args.force {
        true => Err(Failure::Input(format!(
            "error: `{}` is there already, and what was filled in would be lost\n  \
             = help: give another name, or --force to write over it",
            path.display()
        ))),
        false => target.check().map(|()| target),
    }
}

/// Writes the checklist.
///
/// # Errors
/// The robot file is none.
pub fn write(
    args: &CertifyArgs,
    source: &str,
    report: &Report,
    ranges: &[Vec<[f64; 2]>; 3],
) -> Result<String, Failure> {
    let robot = input::robot(&args.robot)?;
    let head = source.lines().next().unwrap_or("");
    let first = head
        .trim_start_matches(['/', '*', ' '])
        .trim_end_matches([' ', '*', '/']);
    let is_of_robot = source.contains(&format!("Input hash {}.", robot.short_hash()));
    let file = args.certificate.file_name().unwrap_or_default();
    let mut text = format!("# Dossier of `{}`\n\n", file.to_string_lossy());
    let scene = args.scene.as_ref();
    let scene = scene.map_or_else(
        || "none: the whole robot".to_owned(),
        |name| format!("`{name}`"),
    );
    for (what, is) in [
        ("file", format!("SHA-256 {}", text_hash(source))),
        ("its first line", first.to_owned()),
        (
            "robot",
            format!(
                "`{}`, {} joints, input hash {}",
                robot.name,
                robot.joints.len(),
                robot.short_hash()
            ),
        ),
        ("scene", scene),
        (
            "checked by",
            format!("dalembert-checker {}", env!("CARGO_PKG_VERSION")),
        ),
    ] {
        text += &format!("- {what}: {is}\n");
    }
    text += "\nWritten by `dalembert certify --dossier`. A box with a cross was filled in by the checker. \
             An open box is for a person: sign it, or say why not.\n\n## Box\n\n\
             | joint | q, rad or m | q̇, per s | q̈, per s² |\n|---|---|---|---|\n";
    for (joint, own) in robot.joints.iter().enumerate() {
        let name = own
            .name
            .as_ref()
            .map_or(String::new(), |name| format!(" {name}"));
        let range = |which: usize| match ranges[which].get(joint) {
            Some([low, high]) if low <= high => format!("{low} to {high}"),
            _ => format!("no limit; checked to ±{RATE}"),
        };
        let cells = [0, 1, 2].map(range).join(" | ");
        text += &format!("| {}{name} | {cells} |\n", joint + 1);
    }
    text += "\n## Functions\n\nBounds hold over the whole box and are relative to the entry's largest value; \
             u is half an ulp of that. Operations and calls are counted in the text.\n\n\
             | function | mul | add | div | fused | calls | branches | in real numbers | rounding | both |\n\
             |---|---|---|---|---|---|---|---|---|---|\n";
    let functions: Vec<(&Line, Body)> = report
        .lines
        .iter()
        .map(|line| (line, Body::of(&line.text.0)))
        .collect();
    for (line, body) in &functions {
        let counts = body.operations.map(|count| count.to_string()).join(" | ");
        let calls: Vec<String> = body.calls.iter().map(|call| format!("`{call}`")).collect();
        let calls = if calls.is_empty() {
            "nothing".to_owned()
        } else {
            calls.join(", ")
        };
        let branches = if body.is_straight { "none" } else { "some" };
        let bound = match &line.result {
            Ok(found) if found.tried > 0 => format!("tried | | {:.0} u seen", found.units()),
            Ok(found) => format!(
                "{:.2e} | {:.2e} | {:.0} u",
                found.edits,
                found.rounding,
                found.units()
            ),
            Err(_) => "not checked | |".to_owned(),
        };
        text += &format!(
            "| {} | {counts} | {calls} | {branches} | {bound} |\n",
            title(line)
        );
    }
    text += "\n## What the checker found\n\n";
    let mut item = |is_good: bool, good: &str, bad: &str| {
        let (mark, said) = if is_good { ("x", good) } else { (" ", bad) };
        text += &format!("- [{mark}] {said}\n");
    };
    item(
        is_of_robot,
        "The input hash in the file's documentation is that of the robot file.",
        "The input hash in the file's documentation is not that of the robot file: generate it anew, or say why.",
    );
    item(
        !report.is_unlimited,
        "Every joint has limits of position and rates.",
        "Some joint has no limit; rates were checked up to the box above.",
    );
    let straight = functions.iter().all(|(_, body)| body.is_straight);
    item(
        straight,
        "No function has a branch or a loop.",
        "Some function has a branch or a loop: see the table.",
    );
    let is_alone = functions.iter().all(|(_, body)| body.calls.is_empty());
    item(
        is_alone,
        "No function calls another: `core` alone, in C without `math.h`.",
        "Functions call others: what these are and how they are trusted has to be argued.",
    );
    for (line, _) in &functions {
        let title = title(line);
        match &line.result {
            Ok(found) if found.tried > 0 => {
                let (states, units, limit) = (found.tried, found.units(), found.is_shown());
                let limit = if limit { "" } else { ", too much for rounding" };
                let said = format!(
                    "{title} solves its equation of motion to {units:.0} u of the terms at {states} states{limit}. \
                     That is no bound: it rests on the generator's proof."
                );
                item(false, "", &said);
            }
            Ok(found) if found.is_shown() => {
                item(
                    true,
                    &format!(
                        "{title} is within {:.0} u of the dynamics everywhere in the box.",
                        found.units()
                    ),
                    "",
                );
            }
            Ok(found) => {
                let both = found.edits + found.rounding;
                let why = format!(
                    "{title} is within {both:.2e} of the dynamics, more than rounding: of a scene with a tolerance \
                     add what `certify` says of its certificate, of polynomials for sines say why that is enough."
                );
                item(false, "", &why);
            }
            Err(fault) => {
                let proof = proof(source, line.text.1);
                let proof = proof.map_or("no proof stands above it".to_owned(), |proof| {
                    format!("the generator says: {proof}")
                });
                item(
                    false,
                    "",
                    &format!(
                        "{title} is not checked ({fault}). It rests on the generator; {proof}"
                    ),
                );
            }
        }
    }
    text += "\n## What a person answers for\n\n";
    for open in OPEN {
        text += &format!("- [ ] {open}\n");
    }
    text += "\n## Known problems that concern this file\n\n";
    for (concerns, problem) in problems(&functions, source) {
        if concerns {
            text += &format!("- {problem}\n");
        }
    }
    text += "- Everything under *Known problems* in the guide's page on safety.\n";
    Ok(text)
}

/// Returns a function with its module, if that has a name.
fn title(line: &Line) -> String {
    match line.module.as_str() {
        "" => format!("`{}`", line.name),
        module => format!("`{module}` `{}`", line.name),
    }
}

/// Returns what the generator says above a function of its proof.
fn proof(source: &str, line: usize) -> Option<&str> {
    let before: Vec<&str> = source.lines().take(line.saturating_sub(1)).collect();
    let is_end = |line: &&&str| !["}", "};"].contains(&line.trim());
    let mut above = before.iter().rev().take_while(is_end);
    let found = above.find_map(|line| line.split_once("Checked: "));
    found.map(|(_, proof)| proof.trim())
}

fn problems(functions: &[(&Line, Body)], source: &str) -> [(bool, &'static str); 4] {
    let calls = |word: &str| {
        let mut calls = functions.iter().flat_map(|(_, body)| &body.calls);
        calls.any(|call| call.contains(word))
    };
    let steps = ["let x1 = ", "const double x", "const float x"];
    let is_step = |line: &str| steps.iter().any(|step| line.trim().starts_with(step));
    let polynomials = functions
        .iter()
        .any(|(line, _)| line.text.0.lines().any(is_step));
    let divides = functions.iter().any(|(_, body)| body.operations[2] > 0);
    [
        (
            calls("sin"),
            "Sines take longer for angles that are far: of `libm` and `dalembert-sines` above 8192 rad, in f32 100.",
        ),
        (
            divides,
            "What divides is as inaccurate as the condition of D says near a singular D; nothing stops a caller there.",
        ),
        (
            source.contains("in_box("),
            "The code holds inside a box only, and does not ask by itself whether a state is inside; the checker does not \
             look at `in_box`.",
        ),
        (
            polynomials,
            "Sines by polynomials are off by more than rounding; the table's bounds count that.",
        ),
    ]
}
