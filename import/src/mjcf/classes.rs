//! Defaults: classes of settings, each with those of the class around it.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::{Mjcf, Text};
use crate::problems::instead;

/// No model has more.
const MAX_CLASSES: usize = 512;
/// What is read of defaults; every actuator has the same ones.
const READ: [(&str, &[&str]); 4] = [
    (
        "joint",
        &[
            "type",
            "pos",
            "axis",
            "range",
            "limited",
            "ref",
            "armature",
            "damping",
            "frictionloss",
            "stiffness",
            "actuatorfrcrange",
            "actuatorfrclimited",
        ],
    ),
    (
        "geom",
        &[
            "type",
            "size",
            "fromto",
            "mass",
            "density",
            "group",
            "shellinertia",
            "pos",
            "quat",
            "axisangle",
            "xyaxes",
            "zaxis",
            "euler",
        ],
    ),
    (
        "site",
        &["pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"],
    ),
    (
        ACTUATOR,
        &[
            "gear",
            "forcerange",
            "forcelimited",
            "ctrlrange",
            "ctrllimited",
        ],
    ),
];
const ACTUATOR: &str = "actuator";
const ACTUATORS: [&str; 12] = [
    "general",
    "motor",
    "position",
    "velocity",
    "intvelocity",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
    "dcmotor",
    "plugin",
    ACTUATOR,
];

/// All classes: the first is that of elements that name none.
pub(super) struct Classes<'a> {
    all: Vec<Settings<'a>>,
    names: BTreeMap<&'a str, usize>,
}

/// Kinds of elements and attributes, and what these are by default.
type Settings<'a> = BTreeMap<(&'static str, &'static str), Text<'a>>;

impl<'a> Classes<'a> {
    pub(super) fn new() -> Self {
        Classes {
            all: vec![Settings::new()],
            names: [("main", 0)].into(),
        }
    }

    /// Returns what a class has for an attribute of an element.
    pub(super) fn setting(&self, class: usize, node: Node, key: &str) -> Option<Text<'a>> {
        let kind = kind(node.tag_name().name())?;
        // Both come from the table: their texts decide.
        let (_, key) =
            row(kind).and_then(|keys| Some((kind, *keys.iter().find(|own| **own == key)?)))?;
        self.all.get(class)?.get(&(kind, key)).cloned()
    }
}

/// Returns the kind of element that has defaults.
fn kind(name: &str) -> Option<&'static str> {
    let name = match ACTUATORS.contains(&name) {
        true => ACTUATOR,
        false => name,
    };
    READ.iter()
        .find(|(kind, _)| *kind == name)
        .map(|(kind, _)| *kind)
}

fn row(kind: &str) -> Option<&'static [&'static str]> {
    READ.iter()
        .find(|(own, _)| *own == kind)
        .map(|(_, keys)| *keys)
}

impl<'a> Mjcf<'a, '_, '_, '_> {
    /// Reads all defaults.
    pub(super) fn classes(&mut self, root: Node<'a, '_>) {
        let tops = root.children().filter(|node| node.has_tag_name("default"));
        for top in tops {
            // What it has is for all, under whichever name.
            if let Some(name) = top.attribute("class") {
                self.classes.names.insert(name, 0);
            }
            let mut open = vec![(top, 0)];
            while let Some((node, class)) = open.pop() {
                self.class_settings(node, class);
                let inner = node.children().filter(|node| node.has_tag_name("default"));
                let inner: Vec<Node> = inner.collect();
                // A class has what the one around it had by then.
                for node in inner.into_iter().rev() {
                    let Some(new) = self.new_class(node, class) else {
                        continue;
                    };
                    open.push((node, new));
                }
            }
        }
    }

    fn new_class(&mut self, node: Node<'a, '_>, around: usize) -> Option<usize> {
        let (name, _) = self.reader.attribute(node, "class")?;
        let new = self.classes.all.len();
        if new > MAX_CLASSES {
            let message = format!("there are more than {MAX_CLASSES} classes of defaults");
            self.error(node, message, "is this a robot? cut out the arm");
            return None;
        }
        if self.classes.names.insert(name, new).is_some() {
            let message = format!("there is a class `{name}` already");
            let help = "each class has its settings in one place: give it another name";
            self.error(node, message, help);
            return None;
        }
        let settings = self.classes.all.get(around).cloned().unwrap_or_default();
        self.classes.all.push(settings);
        Some(new)
    }

    fn class_settings(&mut self, node: Node<'a, '_>, class: usize) {
        for element in node.children().filter(Node::is_element) {
            let Some(kind) = kind(element.tag_name().name()) else {
                continue;
            };
            for key in row(kind).into_iter().flatten() {
                let own = element.attribute_node(*key);
                let settings = self.classes.all.get_mut(class);
                if let Some((own, settings)) = own.zip(settings) {
                    settings.insert((kind, key), (own.value(), own.range_value()));
                }
            }
        }
    }

    /// Returns the class of an element: its own, or that of the bodies around it.
    pub(super) fn class_of(&mut self, node: Node<'a, '_>, key: &str, around: usize) -> usize {
        let Some(own) = node.attribute_node(key) else {
            return around;
        };
        let names = &self.classes.names;
        let class = names.get(own.value()).copied();
        if class.is_none() {
            let message = format!("there is no class `{}`", own.value());
            let help = instead(own.value(), names.keys().copied());
            self.reader
                .problems
                .error(&own.range_value(), message, &help);
        }
        class.unwrap_or(around)
    }
}
