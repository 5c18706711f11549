//! Defaults: classes of settings, each with those of the class around it.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::{Mjcf, Text, children};
use crate::problems::instead;

const MAX_CLASSES: usize = 512;

/// All classes: the first is that of elements that name none.
pub(super) struct Classes<'a> {
    all: Vec<Settings<'a>>,
    names: BTreeMap<&'a str, usize>,
}

type Settings<'a> = BTreeMap<(&'static str, &'static str), Text<'a>>;

impl<'a> Classes<'a> {
    pub(super) fn new() -> Self {
        Classes {
            all: vec![Settings::new()],
            names: [("main", 0)].into(),
        }
    }

    pub(super) fn setting(&self, class: usize, node: Node, key: &str) -> Option<Text<'a>> {
        let (kind, mut keys) = read(node)?;
        let key = keys.find(|own| *own == key)?;
        self.all.get(class)?.get(&(kind, key)).cloned()
    }
}

/// All actuators share one kind of defaults.
fn read(node: Node) -> Option<(&'static str, impl Iterator<Item = &'static str>)> {
    let (kind, keys) = match node.tag_name().name() {
        "joint" => (
            "joint",
            "type pos axis range limited ref armature damping frictionloss stiffness \
             actuatorfrcrange actuatorfrclimited",
        ),
        "geom" => (
            "geom",
            "type size fromto mass density group shellinertia \
             pos quat axisangle xyaxes zaxis euler",
        ),
        "site" => ("site", "pos quat axisangle xyaxes zaxis euler"),
        "general" | "motor" | "position" | "velocity" | "intvelocity" | "damper" | "cylinder"
        | "muscle" | "adhesion" | "dcmotor" | "plugin" | "actuator" => (
            "actuator",
            "gear forcerange forcelimited ctrlrange ctrllimited",
        ),
        _ => return None,
    };
    Some((kind, keys.split(' ')))
}

impl<'a> Mjcf<'a, '_, '_> {
    pub(super) fn classes(&mut self, root: Node<'a, '_>) {
        for top in children(root, "default") {
            // What it has is for all, under whichever name.
            if let Some(name) = top.attribute("class") {
                self.classes.names.insert(name, 0);
            }
            let mut open = vec![(top, 0)];
            while let Some((node, class)) = open.pop() {
                self.class_settings(node, class);
                let inner: Vec<Node> = children(node, "default").collect();
                // A class has what the one around it had by then.
                for node in inner.into_iter().rev() {
                    open.extend(self.new_class(node, class).map(|new| (node, new)));
                }
            }
        }
    }

    fn new_class(&mut self, node: Node<'a, '_>, around: usize) -> Option<usize> {
        let (name, _) = self.problems.attribute(node, "class")?;
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
            let Some((kind, keys)) = read(element) else {
                continue;
            };
            let own = keys.filter_map(|key| {
                let own = element.attribute_node(key)?;
                Some(((kind, key), (own.value(), own.range_value())))
            });
            if let Some(settings) = self.classes.all.get_mut(class) {
                settings.extend(own);
            }
        }
    }

    pub(super) fn class_of(&mut self, node: Node<'a, '_>, key: &str, around: usize) -> usize {
        let Some(own) = node.attribute_node(key) else {
            return around;
        };
        let names = &self.classes.names;
        let class = names.get(own.value()).copied();
        if class.is_none() {
            let message = format!("there is no class `{}`", own.value());
            let help = instead(own.value(), names.keys().copied());
            self.problems.error(&own.range_value(), message, &help);
        }
        class.unwrap_or(around)
    }
}
