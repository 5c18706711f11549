//! The robot file of a chain.

use std::collections::BTreeSet;
use std::fmt::Write;

use dalembert_model::number::Angle;
use dalembert_model::robot::values::{list, number, placement, position, quoted};
use dalembert_model::robot::{
    HAND, Placement, Position, Robot, is_frame_name, suggested_name, write_frame,
};
use num_traits::{Signed, Zero};

use crate::Options;
use crate::lock::{OTHERS, right};
use crate::merge::{Arm, Link};
use crate::problems::Problems;
use crate::snap::Snap;
use crate::tree::{Chain, Moving};
use crate::urdf::{Joint, Kind, Mimic, Number, Urdf};

/// Writes the robot file, and says what of the URDF is not in it; where digits stay as they stand, its
/// reader does not warn of them.
pub(crate) fn file(
    urdf: &Urdf,
    chain: &Chain,
    arm: &Arm,
    (snaps, stays): (&[Snap], bool),
    options: &Options,
    problems: &mut Problems,
) -> String {
    let [base, tip] = [chain.base, chain.tip].map(|link| urdf.links[link].name.as_str());
    let file = match options.file.as_str() {
        "" if urdf.gravity.is_some() => "an MJCF",
        "" => "a URDF",
        file => file,
    };
    let mut text = String::new();
    comment(
        &mut text,
        &format!("From link {base} to link {tip} of {file}, by `dalembert import`."),
    );
    comment(
        &mut text,
        &match urdf.gravity {
            None => {
                format!("Base axes are those of {base}; gravity is taken to pull against its z.")
            }
            Some(_) => format!("Base axes are those of {base}; gravity is the model's in them."),
        },
    );
    let locked = options.lock.iter().filter(|(joint, _)| joint != OTHERS);
    let locked = locked.filter_map(|(joint, value)| {
        let joint = &urdf.joints[urdf.joint(joint)?].name;
        Some(format!("--lock {joint}={value}"))
    });
    let without = options.without.iter();
    let without = without.map(|link| format!("--without {link}"));
    let chosen: Vec<String> = locked.chain(without).collect();
    if !chosen.is_empty() {
        comment(
            &mut text,
            &format!("What hangs on it: {}.", chosen.join(" ")),
        );
    }
    for (held, at) in &chain.held {
        let name = &urdf.joints[*held].name;
        comment(&mut text, &format!("Held: {name} = {}", position(at)));
    }
    if !snaps.is_empty() {
        comment(
            &mut text,
            "Numbers that were taken for others, with their lines there:",
        );
        for snap in snaps {
            let line = problems.line(snap.span.start);
            comment(&mut text, &format!("  {line}: {snap}"));
        }
    }
    text.push('\n');
    let name = options.name.as_ref().unwrap_or(&urdf.name);
    let name = suggested_name(name).unwrap_or_else(|| "arm".to_owned());
    line(&mut text, "name", &quoted(&name));
    match &urdf.gravity {
        None => line(&mut text, "gravity", "[0, 0, -9.81]"),
        Some(gravity) => {
            let gravity = gravity.iter().map(|x| number(&x.value));
            line(&mut text, "gravity", &list(gravity));
        }
    }
    if !arm.tool.is_identity() {
        line(&mut text, "tool", &placement(&as_read(&arm.tool)));
    }
    if stays {
        line(&mut text, "allow", "[\"near_right_angle\"]");
    }
    let mut left_out = LeftOut::default();
    for (index, (moving, link)) in chain.moving.iter().zip(&arm.links).enumerate() {
        text.push_str("\n[[joint]]\n");
        let own = &urdf.joints[moving.joint];
        let name = name_of(own, index, problems);
        line(&mut text, "name", &quoted(&name));
        joint(&mut text, own, link, options, &mut left_out);
        if let Some(Mimic {
            joint: leader,
            line: Some([multiplier, offset]),
            ..
        }) = &own.mimic
        {
            let name = |moving: &Moving| urdf.joints[moving.joint].name == *leader;
            let row = chain.moving.iter().position(name).unwrap_or_default() + 1;
            let offset = match own.kind {
                Kind::Prismatic => Position::Length(offset.clone()),
                _ => Position::Angle(right(Angle::Radians(offset.clone()).canonical())),
            };
            let (by, at) = (number(multiplier), position(&offset));
            let mimic = format!("{{ joint = {row}, multiplier = {by}, offset = {at} }}");
            line(&mut text, "mimic", &mimic);
        }
    }
    left_out.say(problems);
    frames(&mut text, urdf, arm);
    text
}

/// Writes the frame of every link that moves, by its name or, where that cannot name a
/// frame, by one that is like it.
fn frames(text: &mut String, urdf: &Urdf, arm: &Arm) {
    let mut taken = BTreeSet::from([HAND.to_owned()]);
    for frame in arm.frames.iter().take(Robot::MAX_FRAMES) {
        let own = urdf.links[frame.link].name.as_str();
        let Some(name) = frame_name(own, &taken) else {
            continue;
        };
        text.push('\n');
        if name != own {
            comment(text, &format!("Link {own}."));
        }
        text.push_str("[[frame]]\n");
        line(text, "name", &quoted(&name));
        line(text, "link", &(frame.joint + 1).to_string());
        write_frame(text, &as_read(&frame.placement));
        taken.insert(name);
    }
}

/// Returns a name of a frame that is none of these yet; none where nothing is left of the link's.
fn frame_name(own: &str, taken: &BTreeSet<String>) -> Option<String> {
    let words = suggested_name(own)?;
    let words = words.split('_').filter(|word| !word.is_empty());
    let name = words.collect::<Vec<_>>().join("_");
    let numbered = (2..=taken.len() + 2).map(|number| format!("{name}_{number}"));
    let mut names = [name.clone()].into_iter().chain(numbered);
    names.find(|name| !taken.contains(name) && is_frame_name(name))
}

/// Returns what a joint is called in the robot file: not by another one's number.
fn name_of(joint: &Joint, index: usize, problems: &mut Problems) -> String {
    let name = &joint.name;
    match name.trim().parse::<i64>() {
        Ok(number) if usize::try_from(number) != Ok(index + 1) => {
            let other = format!("joint_{number}");
            let message = format!("joint `{name}` is joint {} of the chain", index + 1);
            let help = format!("it is called `{other}` in the robot file, where numbers count");
            problems.note(&joint.span, message, &help);
            other
        }
        _ => name.clone(),
    }
}

fn joint<'u>(
    text: &mut String,
    joint: &'u Joint,
    link: &Link,
    options: &Options,
    left_out: &mut LeftOut<'u>,
) {
    let kind = match joint.kind {
        Kind::Prismatic => "prismatic",
        _ => "revolute",
    };
    line(text, "kind", &quoted(kind));
    line(text, "placement", &placement(&as_read(&link.placement)));
    line(
        text,
        "axis",
        &list(joint.axis.iter().map(|x| number(&x.value))),
    );
    line(text, "mass", &number(&link.mass));
    line(text, "com", &list(link.body.com.iter().map(number)));
    let i = &link.body.inertia;
    line(
        text,
        "inertia",
        &list([&i.xx, &i.yy, &i.zz, &i.xy, &i.yz, &i.xz].map(number)),
    );
    if let Some(damping) = joint.damping.as_ref().filter(|b| !b.value.is_zero()) {
        line(text, "viscous", &number(&damping.value));
    }
    if !joint.armature.is_zero() {
        line(text, "armature", &number(&joint.armature));
    }
    if !joint.rotors.is_empty() {
        left_out.rotors.push(joint);
    }
    if let Some(friction) = joint.friction.as_ref().filter(|f| !f.value.is_zero()) {
        left_out.friction.push((joint, friction));
    }
    if let Some(spring) = &joint.spring {
        left_out.springs.push((joint, spring));
    }
    let mut limits = Vec::new();
    if let Some(range) = &joint.position {
        let [low, high] = range.each_ref().map(|end| match &end.value {
            Position::Angle(angle) => position(&Position::Angle(right(angle.clone()))),
            length => position(length),
        });
        limits.push(format!("position = [{low}, {high}]"));
    }
    for (key, limit) in [("velocity", &joint.velocity), ("torque", &joint.effort)] {
        limits.extend(limit_of(joint, key, limit.as_ref(), left_out));
    }
    let acceleration = options.acceleration.as_ref();
    limits.extend(acceleration.map(|most| format!("acceleration = {}", number(most))));
    if !limits.is_empty() {
        line(text, "limits", &format!("{{ {} }}", limits.join(", ")));
    }
}

/// Returns the placement as the reader of robot files takes it, so that it has nothing to
/// say of the digits.
fn as_read(own: &Placement) -> Placement {
    Placement {
        xyz: own.xyz.clone(),
        rpy: own.rpy.clone().map(right),
    }
}

/// A limit of zero is one that was never filled in.
fn limit_of<'u>(
    joint: &'u Joint,
    key: &'static str,
    limit: Option<&'u Number>,
    left_out: &mut LeftOut<'u>,
) -> Option<String> {
    let limit = limit?;
    if limit.value.is_positive() {
        return Some(format!("{key} = {}", number(&limit.value)));
    }
    left_out.limits.push((key, joint, limit));
    None
}

/// Parts of the URDF that are not in the robot file, or as something else: one note says it of all
/// joints.
#[derive(Default)]
struct LeftOut<'u> {
    rotors: Vec<&'u Joint>,
    springs: Vec<(&'u Joint, &'u Number)>,
    friction: Vec<(&'u Joint, &'u Number)>,
    limits: Vec<(&'static str, &'u Joint, &'u Number)>,
}

impl LeftOut<'_> {
    fn say(&self, problems: &mut Problems) {
        self.say_friction(problems);
        self.say_rotors(problems);
        if let Some((_, first)) = self.springs.first() {
            let message = format!("the springs at {} are left out", names(&self.springs));
            let help = "the torques are those without them: add stiffness times displacement to what is commanded";
            problems.note(&first.span, message, help);
        }
        for key in ["velocity", "torque"] {
            let own = self.limits.iter().filter(|(own, ..)| *own == key);
            let own: Vec<(&Joint, &Number)> =
                own.map(|(_, joint, limit)| (*joint, *limit)).collect();
            let Some((_, first)) = own.first() else {
                continue;
            };
            let message = match own.as_slice() {
                [(joint, limit)] => {
                    format!(
                        "the limit of {key} of joint `{}` is {}",
                        joint.name, limit.text
                    )
                }
                _ => format!("the limits of {key} of {} are zero or less", names(&own)),
            };
            let help = match own.len() {
                1 => "it is left out: nothing would move",
                _ => "they are left out: nothing would move",
            };
            problems.note(&first.span, message, help);
        }
    }

    fn say_rotors(&self, problems: &mut Problems) {
        let Some(first) = self.rotors.first().and_then(|joint| joint.rotors.first()) else {
            return;
        };
        let armature = |joint: &&Joint| {
            let product = |[inertia, ratio]: &[Number; 2]| {
                format!("{} kg·m² × {}²", inertia.text, ratio.text)
            };
            let products: Vec<String> = joint.rotors.iter().map(product).collect();
            let (products, sum) = (products.join(" + "), number(&joint.armature));
            format!("`{}` {products} = {sum}", joint.name)
        };
        let all: Vec<String> = self.rotors.iter().map(armature).collect();
        let message = format!("rotors are the joints' armatures: {}", all.join(", "));
        problems.note(
            &first[0].span,
            message,
            "each is the inertia times the square of the reduction",
        );
    }

    fn say_friction(&self, problems: &mut Problems) {
        let Some((joint, first)) = self.friction.first() else {
            return;
        };
        let unit = match joint.kind {
            Kind::Prismatic => "m/s",
            _ => "rad/s",
        };
        let message = match self.friction.as_slice() {
            [_] => format!(
                "the Coulomb friction of joint `{}`, {}, is left out",
                joint.name, first.text
            ),
            all => format!("the Coulomb friction of {} is left out", names(all)),
        };
        let whose = match self.friction.len() {
            1 => "the joint",
            _ => "each joint its own, such as",
        };
        let help = format!(
            "to have it in the torques, give {whose} `coulomb = {}` and `coulomb_width = 0.01`, \
             the speed in {unit} over which its sign is smoothed",
            number(&first.value)
        );
        problems.note(&first.span, message, &help);
    }
}

/// Joints by their names, with the numbers that they have.
fn names(joints: &[(&Joint, &Number)]) -> String {
    let name = |(joint, number): &(&Joint, &Number)| format!("`{}` ({})", joint.name, number.text);
    let names: Vec<String> = joints.iter().map(name).collect();
    format!("the joints {}", names.join(", "))
}

fn line(text: &mut String, key: &str, value: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{key} = {value}");
}

/// Writes a comment on one line: names may be anything.
fn comment(text: &mut String, what: &str) {
    let plain = what
        .chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c });
    let plain: String = plain.collect();
    let _ = writeln!(text, "# {plain}");
}
