//! What an MJCF says, in the terms of a URDF: bodies are links, and what a body may have
//! beyond them becomes joints that are fixed and links that weigh nothing.
//!
//! - `settings`: units, orders of angles, gravity
//! - `classes`: defaults and who inherits them
//! - `pose`: positions and orientations
//! - `world`: the tree of bodies
//! - `joint`: a joint and its limits; actuators, as limits of torque
//! - `mass`: a body's mass, and what of it cannot be read
//! - `geom`: the mass of simple shapes
//! - `tie`: equalities and tendons
//!
//! Meshes, materials, sensors and contacts are not looked at.

mod classes;
mod geom;
mod joint;
mod mass;
mod pose;
mod settings;
mod tie;
mod world;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use roxmltree::{Document, Node};

use crate::problems::Problems;
use crate::urdf::{Number, Urdf, start_tag};
use classes::Classes;
use settings::Settings;

/// The elements that take time, and the most that a robot has of them.
const MANY: &[(&[&str], usize)] = &[
    (&["body", "site", "frame", "weld", "connect"], 1024),
    (
        &["joint", "fixed", "spatial", "general", "motor", "position"],
        4096,
    ),
    (&["geom"], 8192),
];

pub(crate) fn read(document: &Document, problems: &mut Problems) -> Option<Urdf> {
    let root = document.root_element();
    let span = start_tag(root);
    let mut mjcf = Mjcf {
        problems,
        settings: Settings::new(),
        classes: Classes::new(),
    };
    if !mjcf.is_small(root) {
        return None;
    }
    mjcf.settings(root);
    mjcf.classes(root);
    let mut urdf = Urdf {
        name: root.attribute("model").unwrap_or("arm").to_owned(),
        span: span.clone(),
        links: Vec::new(),
        joints: Vec::new(),
        names: [BTreeSet::new(), BTreeSet::new()],
        gravity: Some(mjcf.settings.gravity(root)),
        ties: Vec::new(),
    };
    mjcf.world(root, &mut urdf)?;
    mjcf.total(&mut urdf);
    mjcf.forces(root, &mut urdf);
    mjcf.ties(root, &mut urdf);
    Some(urdf)
}

struct Mjcf<'a, 'p, 's> {
    problems: &'p mut Problems<'s>,
    settings: Settings,
    classes: Classes<'a>,
}

type Text<'a> = (&'a str, Range<usize>);

impl<'a> Mjcf<'a, '_, '_> {
    fn text(&self, node: Node<'a, '_>, class: usize, key: &str) -> Option<Text<'a>> {
        match node.attribute_node(key) {
            Some(own) => Some((own.value(), own.range_value())),
            None => self.classes.setting(class, node, key),
        }
    }

    fn number(&mut self, node: Node<'a, '_>, class: usize, key: &str) -> Option<Number> {
        let [number] = self.list(node, class, key)?;
        Some(number)
    }

    fn list<const N: usize>(
        &mut self,
        node: Node<'a, '_>,
        class: usize,
        key: &str,
    ) -> Option<[Number; N]> {
        let (text, span) = self.text(node, class, key)?;
        self.problems.list(key, text, span)
    }

    /// With `auto` or nothing, a range limits, unless `autolimits` is off.
    fn is_limited(&mut self, node: Node<'a, '_>, class: usize, key: &str, range: &str) -> bool {
        match self.text(node, class, key) {
            Some(("true", _)) => true,
            Some(("false", _)) => false,
            Some((word, span)) if word != "auto" => {
                let message = format!("`{key}` is `{word}`");
                self.problems.error(&span, message, "true, false or auto");
                false
            }
            _ => self.settings.auto_limits && self.text(node, class, range).is_some(),
        }
    }

    fn is_small(&mut self, root: Node) -> bool {
        let span = start_tag(root);
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for node in root.descendants() {
            *counts.entry(node.tag_name().name()).or_default() += 1;
        }
        MANY.iter().all(|(tags, few)| {
            tags.iter().all(|tag| {
                let count = counts.get(*tag).copied().unwrap_or(0);
                let what = format!("<{tag}>");
                self.problems.are_few(&span, &what, count, *few)
            })
        })
    }

    fn error(&mut self, node: Node, message: String, help: &str) {
        let span = start_tag(node);
        self.problems.error(&span, message, help);
    }

    fn difference(&mut self, node: Node, message: String, help: &str) {
        let span = start_tag(node);
        self.problems.difference(&span, message, help);
    }
}

fn children<'a, 'd: 'a>(
    node: Node<'a, 'd>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'd>> {
    node.children().filter(move |node| node.has_tag_name(name))
}

fn within<'a, 'd: 'a>(
    root: Node<'a, 'd>,
    part: &'static str,
) -> impl Iterator<Item = Node<'a, 'd>> {
    children(root, part).flat_map(|part| part.children().filter(Node::is_element))
}
