//! A link: its name, and where its mass is.

use std::ops::Range;

use dalembert_model::robot::Inertia;
use num_traits::Signed;
use roxmltree::Node;

use super::{Number, Origin, child, start_tag};
use crate::problems::Problems;

#[derive(Clone, Debug, Default)]
pub(crate) struct Link {
    pub(crate) name: String,
    pub(crate) span: Range<usize>,
    /// None for a frame without mass.
    pub(crate) inertial: Option<Inertial>,
    /// What of its mass cannot be read: an error where the link moves.
    pub(crate) unread: Vec<Unread>,
    pub(crate) role: Role,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Role {
    #[default]
    Body,
    /// Nothing: it lies between two joints of one body.
    Between,
    /// A frame or a weight on a body, at which no chain ends unless that is asked for.
    Mark,
}

#[derive(Clone, Debug)]
pub(crate) struct Unread {
    pub(crate) span: Range<usize>,
    pub(crate) message: String,
    pub(crate) help: &'static str,
}

#[derive(Clone, Debug)]
pub(crate) struct Inertial {
    /// The centre of mass, and the axes of the inertia.
    pub(crate) origin: Origin,
    pub(crate) mass: Number,
    pub(crate) inertia: Inertia<Number>,
}

impl Problems<'_> {
    pub(super) fn link(&mut self, node: Node) -> Option<Link> {
        let (name, _) = self.attribute(node, "name")?;
        let inertial = match child(node, "inertial") {
            None => None,
            Some(inertial) => Some(self.inertial(inertial, name)?),
        };
        Some(Link {
            name: name.to_owned(),
            span: start_tag(node),
            inertial,
            ..Link::default()
        })
    }

    fn inertial(&mut self, node: Node, link: &str) -> Option<Inertial> {
        let origin = self.origin(node);
        let [mass, inertia] = ["mass", "inertia"].map(|name| {
            let found = child(node, name);
            if found.is_none() {
                let span = start_tag(node);
                let message = format!("the inertial of link `{link}` has no <{name}>");
                let help = "an <inertial> has <mass value=\"…\"/> and <inertia ixx=\"…\" …/>; a link without mass has none";
                self.error(&span, message, help);
            }
            found
        });
        let mass = mass.and_then(|mass| self.required(mass, "value"));
        let tensor = inertia.and_then(|node| {
            let keys = ["ixx", "iyy", "izz", "ixy", "iyz", "ixz"];
            let [xx, yy, zz, xy, yz, xz] = keys.map(|key| self.required(node, key));
            Some(Inertia::of([xx?, yy?, zz?, xy?, yz?, xz?]))
        });
        let (origin, mass, inertia) = (origin?, mass?, tensor?);
        if mass.value.is_negative() {
            let message = format!("the mass of link `{link}` is negative");
            return self.refuse(&mass.span, message, "a mass is zero or more, in kg");
        }
        Some(Inertial {
            origin,
            mass,
            inertia,
        })
    }
}
