//! The page of the gallery: the table of all arms, then a picture of each.

use dalembert_codegen::Counts;
use dalembert_model::robot::{JointKind, Robot};

use crate::made::Made;

const HEAD: &str = "\
# Gallery

Arms as robot files, each with a picture and what its dynamics cost. The command

```sh
cargo run --release -p dalembert-gallery
```

makes all of it, this page included, from the URDFs in `urdf/` and from robot files that are
elsewhere in the workspace; a test compares it byte for byte. Where the URDFs come from and
under which licence stands at the head of every robot file and in [`LICENCES.md`](LICENCES.md).

Multiplications/additions in f64, sines and cosines not counted, by the quick search, which takes
a second or two an arm; `--effort thorough` finds a few less. *Peer*: Newton-Euler,
composite bodies and the potential energy's gradient by CasADi with common subexpressions merged,
parameters regrouped as Gautier and Khalil do, the best of these (`benches/peers/peers.py counts`);
for the PUMA, Stanford, UR10 and Panda arms OpenSYMORO, SymPyBotics and CppADCodeGen were measured
too. Every function is proved before it is counted.

Compare arms with care: what an arm costs is decided by how its maker wrote it down. Doosan's M1013
says 1.571 where a right angle is meant, which is off by 2e-4 rad, more than `dalembert import` takes
for one; with \"pi/2\" in its robot file the torques take a third less. Where every
product of inertia is given, as for most arms of seven joints, each of them has to be computed with.
";

/// Returns the whole page.
pub fn text(rows: &[(Made, Vec<Counts>)]) -> String {
    let mut text = String::from(HEAD);
    text +=
        "\n| arm | joints | `inverse_dynamics` | peer | `gravity` | peer | `inertia` | peer |\n";
    text += "|---|---|---|---|---|---|---|---|\n";
    for (made, counts) in rows {
        text += &row(made, counts);
    }
    for (made, _) in rows {
        let arm = made.arm;
        text += &format!("\n## {}\n\n", arm.name);
        text += &format!(
            "{}: [robot file]({}). From {}; {}.\n\n![{}]({})\n",
            arm.title,
            arm.robot_file(),
            arm.from,
            arm.licence,
            arm.title,
            arm.picture()
        );
    }
    text
}

/// Returns the row of an arm.
pub fn row(made: &Made, counts: &[Counts]) -> String {
    let arm = made.arm;
    let mut text = format!(
        "| [{}](#{}) | {} |",
        arm.title,
        arm.name,
        joints(&made.robot)
    );
    for (i, counts) in counts.iter().enumerate() {
        let peer = arm.peer[i];
        text += &format!(" {}/{} | {peer} |", counts.mul, counts.add);
    }
    text + "\n"
}

/// Returns the kinds of the joints from the base on: `3P 3R`.
fn joints(robot: &Robot) -> String {
    let mut groups: Vec<(char, usize)> = Vec::new();
    for joint in &robot.joints {
        let letter = match joint.kind {
            JointKind::Revolute => 'R',
            JointKind::Prismatic => 'P',
        };
        match groups.last_mut() {
            Some((last, count)) if *last == letter => *count += 1,
            _ => groups.push((letter, 1)),
        }
    }
    let group = |(letter, count): &(char, usize)| format!("{count}{letter}");
    groups.iter().map(group).collect::<Vec<_>>().join(" ")
}
