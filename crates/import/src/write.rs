//! The robot file of a part of a model.

use std::collections::BTreeSet;
use std::fmt::Display;

use dalembert_model::number::{Angle, Rational};
use dalembert_model::placed::Body;
use dalembert_model::robot::values::{
    lines, list, number, numbers, one_line, placement, position, quoted, table, texts, unless_zero,
};
use dalembert_model::robot::{
    FloatingBase, HAND, Parent, Placement, Robot, is_frame_name, suggested_name, write_frame,
};
use num_traits::{Signed, Zero};

use crate::Options;
use crate::follow;
use crate::merge::{Branch, Tree};
use crate::model::{Format, Joint, Kind, Model, Number, positive};
use crate::problems::Problems;
use crate::select::Selection;
use crate::select::position::right;
use crate::snap::Snap;

/// If links branch and more angles are odd, constants would be polynomials of too many terms in
/// their sines.
const MOST_ODD: usize = 6;

/// `stays`: digits stay as they stand, and the reader of the file does not warn of them.
pub(crate) fn file(
    model: &Model,
    selection: &Selection,
    tree: &Tree,
    (snaps, stays): (&[Snap], bool),
    options: &Options,
    problems: &mut Problems,
) -> String {
    let link = |link: usize| model.links[link].name.as_str();
    let base = link(selection.base);
    let file = match options.file.as_str() {
        "" if model.format == Format::Mjcf => "an MJCF",
        "" => "a URDF",
        file => file,
    };
    let gravity = match model.gravity {
        None => "taken to pull against its z",
        Some(_) => "the model's in them",
    };
    let tips: Vec<&str> = selection.tips.iter().map(|tip| link(*tip)).collect();
    let part = match tips.as_slice() {
        _ if tree.base.is_some() && options.tips.is_empty() => {
            format!("All that moves on link {base}, which floats,")
        }
        _ if options.tree && tree.branches() => format!("All that moves on link {base}"),
        [tip] => format!("From link {base} to link {tip}"),
        tips => format!("From link {base} to the links {}", tips.join(", ")),
    };
    let axes = match tree.base {
        None => format!("Base axes are those of {base}; gravity is {gravity}."),
        Some(_) => "Gravity is in the world; functions take it in the base's axes.".to_owned(),
    };
    let mut head = vec![format!("{part} of {file}, by `dalembert import`."), axes];
    if snaps.iter().any(|snap| snap.changes) {
        head.push("Numbers that were taken for others, with their lines there:".to_owned());
    }
    for snap in snaps.iter().filter(|snap| snap.changes) {
        let line = problems.text.place(snap.span.start);
        head.push(format!("  {line}: {snap}"));
    }
    head.extend(Snap::counted(snaps).map(|counted| counted + "."));
    let odd = odd_angles(tree);
    let on_the_circle = tree.is_placed() && (!options.exact || odd > MOST_ODD);
    if on_the_circle && options.exact {
        head.push(format!(
            "{odd} odd angles are within 2^-52 rad of the model's: points of the circle with \
             rational coordinates."
        ));
    }
    let mut text: String = head.iter().map(|what| comment(what)).collect();
    text.push('\n');
    let name = options.name.as_ref().unwrap_or(&model.name);
    let name = suggested_name(name).unwrap_or_else(|| "arm".to_owned());
    let gravity = match &model.gravity {
        None => "[0, 0, -9.81]".to_owned(),
        Some(gravity) => list(gravity.iter().map(|x| number(&x.value))),
    };
    let gravity = ("gravity", Some(gravity));
    let joint_of = |branch: &Branch| &model.joints[branch.joint];
    let joints: Vec<&Joint> = tree.bodies.iter().map(joint_of).collect();
    let writer = Writer {
        model,
        tree,
        on_the_circle,
        without_room: follow::without_room(&joints, problems),
    };
    let hand = tree.hand().filter(|hand| !hand.is_identity());
    let tool = hand.map(|hand| writer.placement(hand));
    let allow = stays.then(|| "[\"near_right_angle\"]".to_owned());
    let (tool, allow) = (("tool", tool), ("allow", allow));
    let name = ("name", Some(quoted(&name)));
    report_left_out(&joints, problems);
    let messages = problems.differences();
    let differences: Vec<String> = messages.iter().map(|message| one_line(message)).collect();
    let notes = ("notes", texts(&differences));
    lines(&mut text, [name, gravity, tool, allow, notes]);
    let joint_names: Vec<String> = (joints.iter().enumerate())
        .map(|(index, joint)| name_of(joint, index, problems))
        .collect();
    if let Some(body) = &tree.base {
        text.push_str("\n[[joint]]\n");
        let kind = Some(quoted(FloatingBase::KIND));
        lines(&mut text, [("name", Some(quoted(base))), ("kind", kind)]);
        lines(&mut text, inertial(body));
    }
    let root = tree.base.as_ref().map_or(Parent::BASE, |_| base);
    for (index, (model_joint, link)) in joints.iter().zip(&tree.bodies).enumerate() {
        text.push_str("\n[[joint]]\n");
        let carrier = link.parent.map_or(root, |parent| &joint_names[parent]);
        // The link before is the default.
        let is_written = link.parent != index.checked_sub(1);
        let parent = is_written.then(|| quoted(carrier));
        let name = Some(quoted(&joint_names[index]));
        lines(&mut text, [("name", name), ("parent", parent)]);
        writer.joint(&mut text, model_joint, link, options);
        lines(&mut text, [("mimic", follow::mimic(model_joint, &joints))]);
    }
    writer.frames(&mut text);
    text
}

/// Counts the angles between joints that are no parts of π, without their signs.
fn odd_angles(tree: &Tree) -> usize {
    let angles = tree.bodies.iter().flat_map(|body| &body.placement.rpy);
    let odd = angles.filter_map(|angle| match right(angle.clone()) {
        Angle::Radians(value) if !value.is_zero() => Some(value.abs()),
        _ => None,
    });
    odd.collect::<BTreeSet<Rational>>().len()
}

struct Writer<'m> {
    model: &'m Model,
    tree: &'m Tree,
    /// Write angles that are no parts of π as points of the circle with rational coordinates.
    on_the_circle: bool,
    without_room: BTreeSet<&'m str>,
}

impl Writer<'_> {
    fn frames(&self, text: &mut String) {
        let mut taken = BTreeSet::from([HAND.to_owned()]);
        for frame in self.tree.frames.iter().take(Robot::MAX_FRAMES) {
            let link_name = self.model.links[frame.link].name.as_str();
            let Some(name) = frame_name(link_name, &taken) else {
                continue;
            };
            text.push('\n');
            if name != link_name {
                text.push_str(&comment(&format!("Link {link_name}.")));
            }
            text.push_str("[[frame]]\n");
            let link = match frame.body {
                Some(body) => (body + 1).to_string(),
                None => quoted(Parent::BASE),
            };
            lines(text, [("name", Some(quoted(&name))), ("link", Some(link))]);
            write_frame(text, &self.as_read(&frame.placement));
            taken.insert(name);
        }
    }

    fn joint(&self, text: &mut String, joint: &Joint, link: &Branch, options: &Options) {
        let kind = match joint.kind {
            Kind::Prismatic => "prismatic",
            _ => "revolute",
        };
        let range = follow::range(joint).filter(|_| !self.without_room.contains(&*joint.name));
        let range = range.map(|range| list(range.each_ref().map(position)));
        let limit = |limit: &Option<Number>| positive(limit).map(|limit| number(&limit.value));
        let acceleration = limit(&joint.acceleration).or(options.acceleration.as_ref().map(number));
        let limits = table([
            ("position", range),
            ("velocity", limit(&joint.velocity)),
            ("torque", limit(&joint.effort)),
            ("acceleration", acceleration),
        ]);
        let axis = joint.axis.each_ref().map(|x| number(&x.value));
        let damping = joint.damping.as_ref();
        let viscous = damping.and_then(|damping| unless_zero(number(&damping.value)));
        let head = [
            ("kind", Some(quoted(kind))),
            ("placement", Some(self.placement(&link.placement))),
            ("axis", Some(list(axis))),
        ];
        let keys = [
            ("viscous", viscous),
            ("armature", unless_zero(number(&joint.armature))),
            ("limits", limits),
        ];
        let tail = inertial(&link.body).into_iter().chain(keys);
        lines(text, head.into_iter().chain(tail));
    }

    /// Returns a placement whose angles the reader of robot files takes without a warning.
    fn as_read(&self, placement: &Placement) -> Placement {
        let angle = |angle: Angle| match right(angle) {
            Angle::Radians(value) if self.on_the_circle => Angle::Radians(value).on_the_circle(),
            angle => angle,
        };
        Placement {
            xyz: placement.xyz.clone(),
            rpy: placement.rpy.clone().map(angle),
        }
    }

    fn placement(&self, at: &Placement) -> String {
        placement(&self.as_read(at))
    }
}

fn inertial(body: &Body) -> [(&'static str, Option<String>); 3] {
    [
        ("mass", Some(number(&body.mass))),
        ("com", Some(list(body.com.iter().map(number)))),
        ("inertia", Some(numbers(body.inertia.entries()))),
    ]
}

fn frame_name(link_name: &str, taken: &BTreeSet<String>) -> Option<String> {
    let suggested = suggested_name(link_name)?;
    let words = suggested.split('_').filter(|word| !word.is_empty());
    let name = words.collect::<Vec<_>>().join("_");
    let numbered = (2..=taken.len() + 2).map(|number| format!("{name}_{number}"));
    let mut names = [name.clone()].into_iter().chain(numbered);
    names.find(|name| !taken.contains(name) && is_frame_name(name))
}

/// Returns the name of a joint in the robot file, which is not the number of another one.
fn name_of(joint: &Joint, index: usize, problems: &mut Problems) -> String {
    let name = &joint.name;
    match name.trim().parse::<i64>() {
        Ok(number) if usize::try_from(number) != Ok(index + 1) => {
            let other = format!("joint_{number}");
            problems.report("number_as_name", &joint.at, &[name, &(index + 1), &other]);
            other
        }
        _ => name.clone(),
    }
}

fn having<'u>(
    joints: &[&'u Joint],
    number: fn(&Joint) -> Option<&Number>,
) -> Vec<(&'u Joint, &'u Number)> {
    let with_number = |&joint: &&'u Joint| Some((joint, number(joint)?));
    joints.iter().filter_map(with_number).collect()
}

fn is_no_limit(limit: &&Number) -> bool {
    !limit.value.is_positive()
}

fn report_left_out(joints: &[&Joint], problems: &mut Problems) {
    report_friction(joints, problems);
    report_rotors(joints, problems);
    let springs = having(joints, |joint| joint.spring.as_ref());
    if let Some((_, first)) = springs.first() {
        problems.report("springs", &first.at, &[&names(&springs)]);
    }
    let velocity = having(joints, |joint| joint.velocity.as_ref().filter(is_no_limit));
    let torque = having(joints, |joint| joint.effort.as_ref().filter(is_no_limit));
    for (key, limits) in [("velocity", velocity), ("torque", torque)] {
        match limits.as_slice() {
            [] => {}
            [(joint, limit)] => {
                problems.report("no_limit", &limit.at, &[&key, &joint.name, &limit.text]);
            }
            [(_, first), ..] => problems.report("no_limits", &first.at, &[&key, &names(&limits)]),
        }
    }
}

/// Reports the products of inertias and reductions, and what a joint has beside them.
fn report_rotors(joints: &[&Joint], problems: &mut Problems) {
    let armature = |joint: &&Joint| {
        let product = |[rotor, ratio]: &[Number; 2]| {
            let value = &rotor.value * &ratio.value * &ratio.value;
            (format!("{} kg·m² × {}²", rotor.text, ratio.text), value)
        };
        let (mut products, values): (Vec<_>, Vec<_>) = joint.rotors.iter().map(product).unzip();
        let rest = &joint.armature - values.iter().sum::<Rational>();
        if !rest.is_zero() {
            products.insert(0, number(&rest));
        }
        let (sum, total) = (products.join(" + "), number(&joint.armature));
        format!("`{}` {sum} = {total}", joint.name)
    };
    let mut driven = joints.to_vec();
    driven.retain(|joint| !joint.rotors.is_empty());
    if let Some([inertia, _]) = driven.first().and_then(|joint| joint.rotors.first()) {
        let armatures: Vec<String> = driven.iter().map(armature).collect();
        problems.report("rotors", &inertia.at, &[&armatures.join(", ")]);
    }
}

fn report_friction(joints: &[&Joint], problems: &mut Problems) {
    let friction = having(joints, |joint| {
        let friction = joint.friction.as_ref();
        friction.filter(|friction| !friction.value.is_zero())
    });
    let Some((joint, first)) = friction.first() else {
        return;
    };
    let unit = match joint.kind {
        Kind::Prismatic => "m/s",
        _ => "rad/s",
    };
    let (of, whose) = match friction.as_slice() {
        [_] => (
            format!("joint `{}`, {},", joint.name, first.text),
            "the joint",
        ),
        entries => (names(entries), "each joint its own, such as"),
    };
    let words: [&dyn Display; 4] = [&of, &whose, &number(&first.value), &unit];
    problems.report("friction", &first.at, &words);
}

fn names(joints: &[(&Joint, &Number)]) -> String {
    let name = |(joint, number): &(&Joint, &Number)| format!("`{}` ({})", joint.name, number.text);
    let names: Vec<String> = joints.iter().map(name).collect();
    format!("the joints {}", names.join(", "))
}

/// Returns a comment of one line: names may be anything.
fn comment(what: &str) -> String {
    format!("# {}\n", one_line(what))
}
