//! The tree of bodies.

use std::collections::BTreeSet;

use dalembert_model::number::Rational;
use num_traits::Zero;

use super::Mjcf;
use super::joint::fixed;
use crate::bounds::massless;
use crate::model::{Inertial, Joint, Kind, Link, MAX_LINKS, Role};
use crate::orientation::Pose;
use crate::problems::mass_part;
use crate::text::Span;
use crate::xml::Element;

const MADE_ELSEWHERE: [&str; 4] = ["replicate", "composite", "flexcomp", "attach"];
/// The elements of a body that are checked where they are read.
const READ_APART: [&str; 7] = [
    "body",
    "frame",
    "joint",
    "freejoint",
    "geom",
    "site",
    "inertial",
];

pub(super) struct Item<'e> {
    pub(super) element: &'e Element,
    /// The pose of the frames around it, in the body.
    pub(super) frame: Pose,
}

/// The names that are taken.
#[derive(Default)]
pub(super) struct Names {
    links: BTreeSet<String>,
    joints: BTreeSet<String>,
}

fn fresh(names: &mut BTreeSet<String>, wish: String) -> String {
    let mut name = wish.clone();
    let mut count = names.len();
    while !names.insert(name.clone()) {
        count += 1;
        name = format!("{wish}_{count}");
    }
    name
}

impl Mjcf<'_, '_, '_> {
    pub(super) fn world(&mut self, root: &Element) -> Option<()> {
        let at = root.at.clone();
        self.model.links.push(Link::new("world".to_owned(), &at));
        let names = |tags: &[&'static str]| {
            let elements = tags.iter().flat_map(|tag| root.all_inside(tag));
            let names = elements.filter_map(|element| element.value("name"));
            names.map(str::to_owned).collect::<BTreeSet<String>>()
        };
        // Names that the file gives are not given to elements without one.
        self.names.links = names(&["body"]);
        self.names.joints = names(&["joint", "freejoint"]);
        self.names.links.insert("world".to_owned());
        let (mut open, mut made) = (Vec::new(), Vec::new());
        for part in root.all("worldbody") {
            let enter = is_apart_from_bodies;
            self.reader.check_around("mujoco", part, "the world", enter);
            let items = self.items(part);
            self.keep_places(&items, "world");
            let elsewhere = items.iter().filter(|item| is_made_elsewhere(item));
            made.extend(elsewhere.map(|item| item.element));
            open.extend(bodies(items, "world"));
        }
        let id = match open.is_empty() {
            true => "made_for_all",
            false => "made_elsewhere",
        };
        for element in &made {
            self.reader.report(id, &element.at, &[&element.tag]);
        }
        open.reverse();
        while let Some((item, on)) = open.pop() {
            let inside = self.body(&item, on);
            open.extend(inside.into_iter().rev());
            let (what, count) = ("bodies, sites and weights", self.model.links.len());
            if !self.reader.are_few(&at, what, count, MAX_LINKS) {
                return None;
            }
        }
        if self.model.links.len() == 1 {
            return self.reader.refuse("no_bodies", &at, &[]);
        }
        let bodies = root.all_inside("body").into_iter();
        let mut held: Vec<_> = bodies.filter_map(|body| body.get("gravcomp")).collect();
        held.retain(|part| part.value.trim().parse() != Ok(0.0));
        if let Some(first) = held.first() {
            self.reader.report("weightless", &first.at, &[&held.len()]);
        }
        let links = self.model.links.iter().map(|link| (&link.name, &link.at));
        self.reader.unique("body", links);
        let joints = self.model.joints.iter();
        let movers = joints.filter(|joint| joint.kind != Kind::Fixed);
        let moving = movers.map(|joint| (&joint.name, &joint.at));
        self.reader.unique("joint", moving);
        Some(())
    }

    /// Returns the elements of a body, those inside of frames too.
    fn items<'e>(&mut self, body: &'e Element) -> Vec<Item<'e>> {
        let mut items = Vec::new();
        let inside = |element: &'e Element, frame: &Pose| {
            let inside = element.inside.iter().rev();
            let items = inside.map(|element| Item {
                element,
                frame: frame.clone(),
            });
            items.collect::<Vec<_>>()
        };
        let mut open = inside(body, &Pose::identity(body.at.clone()));
        while let Some(item) = open.pop() {
            if item.element.tag != "frame" {
                items.push(item);
                continue;
            }
            let (element, enter) = (item.element, is_apart_from_bodies);
            self.reader.check_around("body", element, "a frame", enter);
            let pose = self.pose(element);
            open.extend(inside(element, &item.frame.then(&pose)));
        }
        items
    }

    /// Adds a body with its joints, weights and sites; returns the bodies on it.
    fn body<'e>(&mut self, item: &Item<'e>, on: String) -> Vec<(Item<'e>, String)> {
        let element = item.element;
        let name = match element.value("name") {
            Some(name) => name.to_owned(),
            None => fresh(&mut self.names.links, "body".to_owned()),
        };
        let of = format!("body `{name}`");
        let around = self.reader.problems.enter(&element.at);
        let enter = is_apart_from_bodies;
        self.reader.check_around("body", element, &of, enter);
        let pose = item.frame.then(&self.pose(element));
        let items = self.items(element);
        self.keep_places(&items, &name);
        let mut link = Link::new(name.clone(), &element.at);
        // A mass matters where the body moves, its place on the way there, too.
        let place = self.reader.problems.enter(&mass_part(&element.at));
        let solids = self.mass(&items, &mut link);
        self.reader.problems.leave(place);
        for part in items.iter().filter(|item| is_made_elsewhere(item)) {
            let Element { tag, at, .. } = part.element;
            self.reader.report("made_on_body", at, &[tag, &of]);
        }
        self.reader.problems.leave(around);
        if self.settings.bounds.bound_bodies() && link.inertial.is_none() && solids.is_empty() {
            // Without the frames around it, which are part of the joint's origin.
            link.inertial = Some(massless(self.reader.vector(element, "pos")));
        }
        self.model.links.push(link);
        self.joints_of(&name, on, pose, &items);
        let identity = Pose::identity(element.at.clone());
        for (index, solid) in solids.into_iter().enumerate() {
            let part = fresh(&mut self.names.links, format!("{name}, geom {}", index + 1));
            self.mark([&name, &part], &element.at, &identity, Some(solid));
        }
        for site in items.iter().filter(|item| item.element.tag == "site") {
            self.site(site, &name);
        }
        bodies(items, &name)
    }

    /// Adds a frame or a weight that is fixed to a body.
    fn mark(&mut self, ends: [&str; 2], at: &Span, pose: &Pose, inertial: Option<Inertial>) {
        self.model.joints.push(fixed(ends, at, pose));
        self.model.links.push(Link {
            inertial,
            role: Role::Mark,
            ..Link::new(ends[1].to_owned(), at)
        });
    }

    fn joints_of(&mut self, body: &str, mut on: String, mut at: Pose, items: &[Item]) {
        let is_joint = |item: &&Item| ["joint", "freejoint"].contains(&item.element.tag.as_str());
        let joints: Vec<&Item> = items.iter().filter(is_joint).collect();
        for (index, item) in joints.iter().enumerate() {
            let name = match item.element.value("name") {
                Some(name) => name.to_owned(),
                None => fresh(&mut self.names.joints, format!("{body}_joint")),
            };
            let (joint, anchor) = self.joint(item, name, &at);
            let back = anchor.each_ref().map(|x| -x);
            at = Pose::identity(joint.at.clone()).shift(&back);
            let is_last = index + 1 == joints.len() && anchor.iter().all(Rational::is_zero);
            let child = match is_last {
                true => body.to_owned(),
                false => {
                    let name = fresh(&mut self.names.links, format!("{body}, {}", joint.name));
                    self.model.links.push(Link {
                        role: Role::Between,
                        ..Link::new(name.clone(), &joint.at)
                    });
                    name
                }
            };
            let place = joint.at.clone();
            self.model.joints.push(Joint {
                parent: (std::mem::replace(&mut on, child.clone()), place.clone()),
                child: (child, place),
                ..joint
            });
        }
        if on != body {
            let link = self.model.links.iter().find(|link| link.name == body);
            let place = link.map_or(0..0, |link| link.at.clone());
            self.model.joints.push(fixed([&on, body], &place, &at));
        }
    }

    /// Adds a site with a name, unless a body has the same.
    fn site(&mut self, item: &Item, body: &str) {
        let element = item.element;
        let around = self.reader.problems.enter(&element.at);
        self.reader.check("body", element, "a site");
        let between = self.between(element, -1);
        let pose = between.map_or_else(|| self.pose(element), |(pose, _)| pose);
        self.reader.problems.leave(around);
        let name = element.value("name").map(str::to_owned);
        if let Some(name) = name.filter(|name| self.names.links.insert(name.clone())) {
            let at = item.frame.then(&pose);
            self.mark([body, &name], &element.at, &at, None);
        }
    }

    /// Keeps the bodies of sites and geoms, which ties name.
    fn keep_places(&mut self, items: &[Item], body: &str) {
        let has_name = |item: &&Item| ["site", "geom"].contains(&item.element.tag.as_str());
        for element in items.iter().filter(has_name).map(|item| item.element) {
            if let Some(name) = element.value("name") {
                let name = format!("{} {name}", element.tag);
                self.places.insert(name, body.to_owned());
            }
        }
    }
}

fn is_apart_from_bodies(element: &Element) -> bool {
    !READ_APART.contains(&element.tag.as_str())
}

fn is_made_elsewhere(item: &Item) -> bool {
    MADE_ELSEWHERE.contains(&item.element.tag.as_str())
}

fn bodies<'e>(items: Vec<Item<'e>>, on: &str) -> Vec<(Item<'e>, String)> {
    let bodies = items.into_iter().filter(|item| item.element.tag == "body");
    bodies.map(|item| (item, on.to_owned())).collect()
}
