//! What a URDF says: links, joints, and the rotors of transmissions.
//!
//! Shapes, materials and sensors are not looked at, nor is what simulators add.

mod joint;
mod link;
mod number;

use std::collections::BTreeSet;
use std::ops::Range;

use roxmltree::{Document, Node};

use crate::problems::Problems;

pub(crate) use joint::{Joint, Kind, Mimic};
pub(crate) use link::{Inertial, Link, Role, Unread};
pub(crate) use number::{Number, Origin, Value, constant, positive};

pub(crate) const MAX_LINKS: usize = 1024;

/// A URDF, every joint with a parent and a child that there are.
#[derive(Clone, Debug)]
pub(crate) struct Urdf {
    pub(crate) name: String,
    pub(crate) span: Range<usize>,
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<Joint>,
    /// The names of all links and of all joints, those that cannot be read included.
    pub(crate) names: [BTreeSet<String>; 2],
    /// Gravity in the axes of the root, where the file says it.
    pub(crate) gravity: Option<[Number; 3]>,
    pub(crate) ties: Vec<Tie>,
}

#[derive(Clone, Debug)]
pub(crate) struct Tie {
    pub(crate) span: Range<usize>,
    /// As messages call it: ``the fixed tendon `split` ``.
    pub(crate) name: String,
    pub(crate) ends: Tied,
}

#[derive(Clone, Debug)]
pub(crate) enum Tied {
    /// Joints, none of which moves by itself.
    Joints(Vec<String>),
    Links(Vec<String>),
}

impl Urdf {
    /// From the root outwards, each branch to its ends before the next in the file.
    pub(crate) fn moving(&self) -> Vec<usize> {
        let joints = || self.joints.iter().enumerate().rev();
        let is_root = |link: &str| self.joints.iter().all(|joint| joint.child.0 != link);
        let roots = joints().filter(|(_, joint)| is_root(&joint.parent.0));
        let mut open: Vec<(usize, &Joint)> = roots.collect();
        let (mut seen, mut moving) = (BTreeSet::new(), Vec::new());
        while let Some((place, joint)) = open.pop() {
            if seen.insert(place) {
                moving.extend((joint.kind != Kind::Fixed).then_some(place));
                open.extend(joints().filter(|(_, next)| next.parent.0 == joint.child.0));
            }
        }
        moving
    }

    /// Finds a joint by its name, or by its number, from 1, among those that move.
    pub(crate) fn joint(&self, name: &str) -> Option<usize> {
        let named = self.joints.iter().position(|joint| joint.name == name);
        named.or_else(|| {
            let number: usize = name.parse().ok()?;
            self.moving().get(number.checked_sub(1)?).copied()
        })
    }

    pub(crate) fn untie(&mut self, problems: &mut Problems) {
        let mut ties: Vec<(Range<usize>, String)> = Vec::new();
        ties.extend(self.ties.drain(..).map(|tie| (tie.span, tie.name)));
        for joint in &mut self.joints {
            if let Some(mimic) = joint.mimic.take_if(|mimic| mimic.line.is_none()) {
                let name = format!("the equality of joint `{}`", joint.name);
                ties.push((mimic.span, name));
            }
        }
        let Some((first, _)) = ties.first() else {
            return;
        };
        let names: Vec<&str> = ties.iter().map(|(_, name)| name.as_str()).collect();
        let names = names.join(", ");
        let message = format!("what ties joints and links is ignored: {names}");
        let help = "the torques are those of the chain without it";
        problems.difference(first, message, help);
    }
}

pub(crate) fn read(document: &Document, problems: &mut Problems) -> Option<Urdf> {
    let root = document.root_element();
    let span = start_tag(root);
    if let Some(help) = other_format(root) {
        let message = format!("<{}> is no URDF", root.tag_name().name());
        return problems.refuse(&span, message, help);
    }
    let elements = |name: &'static str| root.children().filter(move |node| node.has_tag_name(name));
    let links = elements("link").filter_map(|node| problems.link(node));
    let links: Vec<Link> = links.collect();
    let joints = elements("joint").filter_map(|node| problems.joint(node));
    let mut joints: Vec<Joint> = joints.collect();
    for node in elements("transmission") {
        problems.transmission(node, &mut joints);
    }
    problems.unique("link", links.iter().map(|link| (&link.name, &link.span)));
    let names = joints.iter().map(|joint| (&joint.name, &joint.span));
    problems.unique("joint", names);
    for (what, count) in [("links", links.len()), ("joints", joints.len())] {
        if !problems.are_few(&span, what, count, MAX_LINKS) {
            return None;
        }
    }
    if links.is_empty() {
        let help = "a URDF has a <link> for every body";
        return problems.refuse(&span, "there are no links", help);
    }
    let names = ["link", "joint"].map(|kind| {
        let names = elements(kind).filter_map(|node| node.attribute("name"));
        names.map(str::to_owned).collect()
    });
    Some(Urdf {
        name: root.attribute("name").unwrap_or("arm").to_owned(),
        span,
        links,
        joints,
        names,
        gravity: None,
        ties: Vec::new(),
    })
}

fn other_format(root: Node) -> Option<&'static str> {
    match root.tag_name().name() {
        "robot" => None,
        "mujocoinclude" => Some("this is a part of an MJCF: give the file that includes it"),
        "sdf" => Some("this is SDF, which is not read: take the URDF that it was made from"),
        _ => Some("a URDF begins with <robot name=\"arm\">, MJCF with <mujoco>"),
    }
}

impl Problems<'_> {
    pub(crate) fn are_few(
        &mut self,
        span: &Range<usize>,
        what: &str,
        count: usize,
        few: usize,
    ) -> bool {
        if count > few {
            let message = format!("there are {count} {what}, more than {few}");
            let help = "is this a robot? cut out the arm";
            self.error(span, message, help);
        }
        count <= few
    }

    pub(crate) fn unique<'n>(
        &mut self,
        what: &str,
        names: impl Iterator<Item = (&'n String, &'n Range<usize>)>,
    ) {
        let mut seen = BTreeSet::new();
        for (name, span) in names {
            if !seen.insert(name) {
                let message = format!("there is a {what} `{name}` already");
                let help = "names tell them apart: give it another";
                self.error(span, message, help);
            }
        }
    }
}

pub(crate) fn start_tag(node: Node) -> Range<usize> {
    let range = node.range();
    let source = node.document().input_text();
    let text = source.get(range.clone()).unwrap_or_default();
    let line = text.lines().next().unwrap_or_default();
    let end = line.find('>').map_or(line.len(), |end| end + 1);
    range.start..range.start + end
}

pub(crate) fn child<'a, 'd>(node: Node<'a, 'd>, name: &str) -> Option<Node<'a, 'd>> {
    node.children()
        .find(|child| child.tag_name().name() == name)
}
