//! A URDF as a model. Where a value is wrong, the default of the format stands in its place.
//!
//! Takes the root `Element` of a file; returns a `Model`, and reports to the `Reader` what it
//! leaves out.

mod joint;

use crate::keywords::MJCF;
use crate::mjcf::Settings;
use crate::model::{
    Ends, Format, Inertial, Joint, Link, MAX_LINKS, Model, Number, Origin, Role, Tie,
};
use crate::orientation::{Pose, of_quaternion};
use crate::read::Reader;
use crate::xml::Element;
use dalembert_model::number::Angle;
use dalembert_model::robot::Inertia;
use joint::{joint, transmission};

/// Elements that close a loop of links.
const LOOPS: [&str; 5] = [
    "loop_joint",
    "loop",
    "coupling",
    "drake:ball_constraint",
    "pin",
];
/// The parts of a file that are checked where they are read.
const READ_APART: [&str; 4] = ["link", "joint", "transmission", "gazebo"];

pub(crate) fn read(root: &Element, reader: &mut Reader) -> Option<Model> {
    let help = match root.tag.as_str() {
        "robot" => "",
        "mujocoinclude" => "this is a part of an MJCF: give the file that includes it",
        "sdf" => "this is SDF, which is not read: take the URDF that it was made from",
        _ => "a URDF begins with <robot name=\"arm\">, MJCF with <mujoco>",
    };
    if !help.is_empty() {
        return reader.refuse("not_a_model", &root.at, &[&root.tag, &help]);
    }
    reader.check_attributes("", root, "the robot");
    let mut model = Model {
        format: Format::Urdf,
        name: root.value("name").unwrap_or("arm").to_owned(),
        at: root.at.clone(),
        links: root.all("link").map(|part| link(part, reader)).collect(),
        joints: root.all("joint").map(|part| joint(part, reader)).collect(),
        ..Model::default()
    };
    let frames = root.all("frame").take(MAX_LINKS + 1);
    frames.for_each(|element| frame(element, &mut model, reader));
    for (what, count) in [("links", model.links.len()), ("joints", model.joints.len())] {
        if !reader.are_few(&root.at, what, count, MAX_LINKS) {
            return None;
        }
    }
    if model.links.is_empty() {
        return reader.refuse("no_links", &root.at, &[]);
    }
    let links = model.links.iter().map(|link| (&link.name, &link.at));
    reader.unique("link", links);
    let joints = model.joints.iter().map(|joint| (&joint.name, &joint.at));
    reader.unique("joint", joints);
    model.resolve(reader.problems);
    let transmissions = root.all("transmission");
    transmissions.for_each(|element| transmission(element, &mut model.joints, reader));
    root.all("gazebo")
        .for_each(|element| gazebo(element, &model, reader));
    let enter = |inside: &Element| !READ_APART.contains(&inside.tag.as_str());
    reader.check_inside("", root, "the robot", enter);
    let loops = LOOPS.into_iter().flat_map(|tag| root.all_inside(tag));
    model.ties = loops.map(|element| tie(element, &model)).collect();
    for element in root.all("mujoco") {
        let mut mjcf = reader.with(&MJCF);
        mjcf.check("", element, "the robot");
        mjcf.report_unknown();
        let (bounds, gravity) = Settings::of_urdf(element, &mut mjcf);
        model.gravity = gravity.or(model.gravity.take());
        bounds.apply(&mut model, reader);
    }
    for param in root.all_inside("param") {
        let value = param.text.as_ref().map_or("", |text| &text.value);
        if param.value("name") == Some("mimic") {
            reader.report("plugin mimicJoint", &param.at, &[&value]);
        }
    }
    Some(model)
}

fn link(element: &Element, reader: &mut Reader) -> Link {
    let (name, _) = reader.required(element, "name");
    let around = reader.problems.enter(&element.at);
    reader.check("robot", element, &format!("link `{name}`"));
    let inertial = only(element, "inertial", reader)
        .and_then(|inertial| self::inertial(inertial, &name, reader));
    reader.problems.leave(around);
    Link {
        inertial,
        ..Link::new(name, &element.at)
    }
}

/// Returns the first element of a tag, which is the one that counts.
fn only<'e>(element: &'e Element, tag: &'e str, reader: &mut Reader) -> Option<&'e Element> {
    if let Some(second) = element.all(tag).nth(1) {
        reader.report("second", &second.at, &[&tag]);
    }
    element.first(tag)
}

fn inertial(element: &Element, link: &str, reader: &mut Reader) -> Option<Inertial> {
    let [mass, inertia] = ["mass", "inertia"].map(|tag| {
        let part = element.first(tag);
        if part.is_none() {
            reader.report("no_inertial_part", &element.at, &[&link, &tag]);
        }
        part
    });
    let origin = origin(element, reader);
    let mass = mass.map(|mass| reader.required_number(mass, "value"));
    let what = format!("the mass of link `{link}`");
    reader.not_negative(mass.as_ref(), &what, "a mass is zero or more, in kg");
    let keys = ["ixx", "iyy", "izz", "ixy", "iyz", "ixz"];
    let tensor = inertia.map(|inertia| keys.map(|key| reader.required_number(inertia, key)));
    let inertia = Inertia::of(tensor?);
    Some(Inertial {
        origin,
        mass: mass?,
        inertia,
    })
}

/// Reads where something is: roll, pitch and yaw, or the quaternion of URDF 1.1.
fn origin(element: &Element, reader: &mut Reader) -> Origin {
    let none = Element {
        tag: "origin".to_owned(),
        at: element.at.clone(),
        ..Element::default()
    };
    let origin = only(element, "origin", reader).unwrap_or(&none);
    let xyz = reader.vector(origin, "xyz");
    let Some(quaternion) = origin.get("quat_xyzw") else {
        return rolled([xyz, reader.vector(origin, "rpy")]);
    };
    if let Some(rpy) = origin.get("rpy") {
        reader.report("two_orientations", &rpy.at, &[&"rpy` and `quat_xyzw"]);
    }
    let numbers = reader.numbers(origin, "quat_xyzw");
    match numbers.map(|[x, y, z, w]| of_quaternion([w, x, y, z])) {
        Some(Some(turned)) => return Pose::of(xyz, turned, &quaternion.at).origin(),
        Some(None) => reader.report("orientation_of_zero", &quaternion.at, &[&"quat_xyzw"]),
        None => {}
    }
    Origin {
        xyz,
        ..Origin::default()
    }
}

fn rolled([xyz, rpy]: [[Number; 3]; 2]) -> Origin {
    let rpy = rpy.map(|number| number.map(|value| Angle::Radians(value).canonical()));
    let meant = None;
    Origin { xyz, rpy, meant }
}

/// Reads a frame of Drake's: a name for a place on a link.
fn frame(element: &Element, model: &mut Model, reader: &mut Reader) {
    let around = reader.problems.enter(&element.at);
    let ends = ["link", "name"].map(|key| reader.required(element, key));
    let origin = rolled(["xyz", "rpy"].map(|key| reader.vector(element, key)));
    reader.problems.leave(around);
    model.links.push(Link {
        role: Role::Mark,
        ..Link::new(ends[1].0.clone(), &element.at)
    });
    let joint = Joint::fixed(ends, &element.at, origin);
    model.joints.push(joint);
}

/// Reports what Gazebo's extension of a link or a joint has that is left out.
fn gazebo(element: &Element, model: &Model, reader: &mut Reader) {
    let reference = element.value("reference").unwrap_or_default();
    let link = model.links.iter().find(|link| link.name == reference);
    let joint = model.joints.iter().find(|joint| joint.name == reference);
    let (of, at) = match (link, joint) {
        (Some(link), _) => (format!("link `{reference}`"), &link.at),
        (None, Some(joint)) => (format!("joint `{reference}`"), &joint.at),
        (None, None) => return reader.check("robot", element, "the robot"),
    };
    let around = reader.problems.enter(at);
    reader.check("robot", element, &of);
    reader.problems.leave(around);
}

/// Returns the tie of an element that closes a loop: over the links that it names.
fn tie(element: &Element, model: &Model) -> Tie {
    let mut ends: Vec<String> = Vec::new();
    let mut open = vec![element];
    while let Some(element) = open.pop() {
        let values = element.attributes.iter().chain(&element.text);
        let named = values.filter(|value| value.key != "name" || element.tag.contains("body"));
        let links = named.filter(|value| model.link(&value.value).is_some());
        ends.extend(links.map(|link| link.value.clone()));
        open.extend(element.inside.iter().rev());
    }
    Tie {
        at: element.at.clone(),
        name: element.named(&format!("<{}>", element.tag)),
        ends: Ends::Links(ends),
    }
}
