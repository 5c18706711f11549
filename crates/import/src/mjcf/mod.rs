//! An MJCF as a model: bodies are links, and what a body may have beyond them becomes joints that
//! are fixed and links that weigh nothing.
//!
//! - `settings`: units, orders of angles, switches, gravity
//! - `defaults`: classes, whose values are filled into the elements
//! - `place`: positions and orientations
//! - `world`: the tree of bodies
//! - `joint`: a joint and its limits
//! - `mass`: the mass of a body, from its `inertial` or from simple shapes
//! - `drive`: actuators, as limits of torque, armature and damping
//! - `tie`: equalities and tendons
//!
//! Takes the root `Element` of a file; returns a `Model`, and reports to the `Reader` what it
//! leaves out.

mod defaults;
mod drive;
mod joint;
mod mass;
mod place;
mod settings;
mod tie;
mod world;

use std::collections::BTreeMap;

use num_traits::Zero;

use crate::model::{Format, Model, Number};
use crate::read::Reader;
use crate::xml::Element;
pub(crate) use settings::Settings;
use world::Names;

/// The elements that take time, and the most that a robot has of them.
const MANY: &[(&[&str], usize)] = &[
    (&["default"], 512),
    (&["body", "site", "frame", "weld", "connect"], 1024),
    (&["joint", "fixed", "spatial"], 4096),
    (&["general", "motor", "position"], 4096),
    (&["geom"], 8192),
];
/// The parts of a file that are checked where they are read.
const READ_APART: [&str; 5] = ["worldbody", "default", "tendon", "equality", "actuator"];

pub(crate) fn read(root: &Element, reader: &mut Reader) -> Option<Model> {
    for part in ["actuator", "tendon", "equality"] {
        let count = root.all(part).map(|part| part.inside.len()).sum();
        if !reader.are_few(&root.at, &format!("elements of <{part}>"), count, 4096) {
            return None;
        }
    }
    for (tags, few) in MANY {
        for tag in *tags {
            let count = root.all_inside(tag).len();
            if !reader.are_few(&root.at, &format!("<{tag}>"), count, *few) {
                return None;
            }
        }
    }
    let enter = |part: &Element| !READ_APART.contains(&part.tag.as_str());
    reader.check_around("", root, "the model", enter);
    let root = &defaults::filled(root, reader);
    let settings = Settings::read(root, reader);
    let model = Model {
        format: Format::Mjcf,
        name: root.value("model").unwrap_or("arm").to_owned(),
        at: root.at.clone(),
        gravity: Some(settings.gravity(root)),
        ..Model::default()
    };
    let mut mjcf = Mjcf {
        reader,
        settings,
        model,
        places: BTreeMap::new(),
        names: Names::default(),
    };
    mjcf.world(root)?;
    mjcf.model.resolve(mjcf.reader.problems);
    let tendons = mjcf.ties(root);
    mjcf.drives(root, &tendons);
    mjcf.settings.bounds.apply(&mut mjcf.model, mjcf.reader);
    Some(mjcf.model)
}

struct Mjcf<'r, 'p, 't> {
    reader: &'r mut Reader<'p, 't>,
    settings: Settings,
    model: Model,
    /// The bodies of sites and geoms: `site tip` is on one.
    places: BTreeMap<String, String>,
    names: Names,
}

impl Mjcf<'_, '_, '_> {
    /// Returns the elements of a section of the file, and says those that are unknown.
    fn section<'e>(&mut self, root: &'e Element, tag: &'e str) -> Vec<&'e Element> {
        let of = format!("the section <{tag}>");
        for part in root.all(tag) {
            self.reader.check_around("mujoco", part, &of, |_| false);
        }
        root.all(tag).flat_map(|part| &part.inside).collect()
    }

    /// Reads a range that limits: its word says so or, by itself or as `auto`, `autolimits` is on.
    fn limits(&mut self, element: &Element, word: &str, range: &str) -> Option<[Number; 2]> {
        let words = [("true", Some(true)), ("false", Some(false)), ("auto", None)];
        let limits = self.reader.word(element, word, &words).flatten();
        match limits.unwrap_or(self.settings.auto_limits) {
            true => self.reader.numbers(element, range),
            false => None,
        }
    }

    /// Reads a number that may be the first of a polynomial in the velocity or the position, whose
    /// other terms are left out.
    fn first_term(&mut self, element: &Element, key: &str, of: &str) -> Option<Number> {
        let attribute = element.get(key)?;
        let terms = self.reader.list(attribute)?;
        if terms.iter().skip(1).any(|term| !term.value.is_zero()) {
            let words: [&dyn std::fmt::Display; 3] = [&key, &of, &attribute.value];
            self.reader.report("polynomial", &attribute.at, &words);
        }
        terms.into_iter().next()
    }

    fn loads(&mut self, element: &Element, of: &str) -> [Option<Number>; 2] {
        let armature = self.reader.number(element, "armature");
        let damping = self.first_term(element, "damping", of);
        self.not_negative("armature", &armature, of);
        self.not_negative("damping", &damping, of);
        let is_off = self.settings.is_off("damper");
        [armature, damping.filter(|_| !is_off)]
    }

    fn not_negative(&mut self, key: &str, load: &Option<Number>, of: &str) {
        let what = format!("the {key} of {of}");
        let help = "it adds inertia or takes energy out: zero or more";
        self.reader.not_negative(load.as_ref(), &what, help);
    }
}
