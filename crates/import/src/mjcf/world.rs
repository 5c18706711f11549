//! The tree of bodies.

use std::collections::BTreeSet;

use roxmltree::Node;

use super::joint::fixed;
use super::pose::Pose;
use super::{Mjcf, children};
use crate::urdf::{Joint, Kind, Link, MAX_LINKS, Role, Unread, Urdf, start_tag};

const MADE_ELSEWHERE: [&str; 4] = ["replicate", "composite", "flexcomp", "attach"];

pub(super) struct Item<'a, 'd> {
    pub(super) node: Node<'a, 'd>,
    pub(super) class: usize,
    /// The frames' pose in the body.
    pub(super) frame: Pose,
}

/// A body, and the link that it hangs on.
type Open<'a, 'd> = (Item<'a, 'd>, String);

type Names = BTreeSet<String>;

fn fresh(names: &mut Names, wish: String) -> String {
    let mut name = wish.clone();
    let mut count = names.len();
    while !names.insert(name.clone()) {
        count += 1;
        name = format!("{wish}_{count}");
    }
    name
}

impl<'a> Mjcf<'a, '_, '_> {
    pub(super) fn world(&mut self, root: Node<'a, '_>, urdf: &mut Urdf) -> Option<()> {
        let world = link("world".to_owned(), urdf.span.clone());
        urdf.links.push(world);
        let identity = Pose::identity(urdf.span.clone());
        let mut open = Vec::new();
        for part in children(root, "worldbody") {
            let class = self.class_of(part, "childclass", 0);
            open.extend(bodies(self.items(part, class, &identity), "world"));
        }
        open.reverse();
        let given = |kind: &'static str| {
            let nodes = root.descendants();
            let nodes = nodes.filter(move |node| node.has_tag_name(kind));
            nodes.filter_map(|node| node.attribute("name").map(str::to_owned))
        };
        // Names that the file gives are not given to what has none.
        let mut links: Names = given("body").chain(["world".to_owned()]).collect();
        let mut joints: Names = given("joint").chain(given("freejoint")).collect();
        while let Some(next) = open.pop() {
            let own = self.body(next, urdf, &mut links, &mut joints);
            open.extend(own.into_iter().rev());
            let (what, count) = ("bodies, sites and weights", urdf.links.len());
            if !self.problems.are_few(&urdf.span, what, count, MAX_LINKS) {
                return None;
            }
        }
        if urdf.links.len() == 1 {
            let help = "<worldbody> has a <body> for every link";
            self.error(root, "there are no bodies".to_owned(), help);
            return None;
        }
        self.say_weightless(root);
        let links = urdf.links.iter().map(|link| (&link.name, &link.span));
        let moving = urdf.joints.iter().filter(|joint| joint.kind != Kind::Fixed);
        let moving = moving.map(|joint| (&joint.name, &joint.span));
        self.problems.unique("body", links.clone());
        self.problems.unique("joint", moving.clone());
        urdf.names = [
            links.map(|(name, _)| name.clone()).collect(),
            moving.map(|(name, _)| name.clone()).collect(),
        ];
        Some(())
    }

    fn say_weightless(&mut self, root: Node<'a, '_>) {
        let bodies = root.descendants().filter(|node| node.has_tag_name("body"));
        let mut held =
            bodies.filter(|body| body.attribute("gravcomp").is_some_and(|part| part != "0"));
        if let Some(first) = held.next() {
            let message = format!("`gravcomp` of {} bodies is left out", 1 + held.count());
            let help = "the joints carry their weight: the load that holds it up is `gravity`";
            self.difference(first, message, help);
        }
    }

    fn items<'d>(&mut self, body: Node<'a, 'd>, class: usize, at: &Pose) -> Vec<Item<'a, 'd>> {
        let mut items = Vec::new();
        let mut open: Vec<(Node, usize, Pose)> = vec![(body, class, at.clone())];
        while let Some((node, mut class, mut frame)) = open.pop() {
            if node != body && !node.has_tag_name("frame") {
                items.push(Item { node, class, frame });
                continue;
            }
            if node != body {
                class = self.class_of(node, "childclass", class);
                let own = self.pose(node, class);
                frame = own.map_or(frame.clone(), |own| frame.then(&own));
            }
            let children: Vec<Node> = node.children().filter(Node::is_element).collect();
            let inside = children.into_iter().rev();
            open.extend(inside.map(|child| (child, class, frame.clone())));
        }
        items
    }

    fn body<'d>(
        &mut self,
        open: Open<'a, 'd>,
        urdf: &mut Urdf,
        links: &mut Names,
        joints: &mut Names,
    ) -> Vec<Open<'a, 'd>> {
        let (Item { node, class, frame }, on) = open;
        let class = self.class_of(node, "childclass", class);
        let span = start_tag(node);
        let name = match node.attribute("name") {
            Some(name) => name.to_owned(),
            None => fresh(links, "body".to_owned()),
        };
        let identity = Pose::identity(span.clone());
        let own = self.pose(node, class).unwrap_or(identity.clone());
        let items = self.items(node, class, &identity);
        let mut link = link(name.clone(), span.clone());
        let solids = self.mass(&items, &mut link);
        for part in &items {
            let word = part.node.tag_name().name();
            if MADE_ELSEWHERE.contains(&word) {
                link.unread.push(Unread {
                    span: start_tag(part.node),
                    message: format!("<{word}> on body `{name}` is not read"),
                    help: "save the model by MuJoCo's mj_saveLastXML, which writes it out",
                });
            }
        }
        urdf.links.push(link);
        self.joints_of(&name, on, &frame.then(&own), &items, urdf, [links, joints]);
        for (index, solid) in solids.into_iter().enumerate() {
            let part = fresh(links, format!("{name}, geom {}", index + 1));
            urdf.joints.push(fixed([&name, &part], &span, &identity));
            urdf.links.push(Link {
                inertial: Some(solid),
                role: Role::Mark,
                ..self::link(part, span.clone())
            });
        }
        for site in items.iter().filter(|item| item.node.has_tag_name("site")) {
            self.site(site, &name, urdf, links);
        }
        bodies(items, &name)
    }

    fn joints_of(
        &mut self,
        body: &str,
        mut on: String,
        at: &Pose,
        items: &[Item<'a, '_>],
        urdf: &mut Urdf,
        [links, joints]: [&mut Names; 2],
    ) {
        let is_joint = |item: &&Item| ["joint", "freejoint"].contains(&item.node.tag_name().name());
        let mut at = at.clone();
        let own: Vec<&Item> = items.iter().filter(is_joint).collect();
        for (index, item) in own.iter().enumerate() {
            let name = item.node.attribute("name").map(str::to_owned);
            let name = name.unwrap_or_else(|| fresh(joints, format!("{body}_joint")));
            let Some((joint, anchor)) = self.joint(item, name, &at) else {
                continue;
            };
            let shift = anchor.each_ref().map(|x| -x);
            at = Pose::identity(joint.span.clone()).shift(&shift);
            let is_last = index + 1 == own.len() && anchor.iter().all(num_traits::Zero::is_zero);
            let child = match is_last {
                true => body.to_owned(),
                false => {
                    let name = fresh(links, format!("{body}, {}", joint.name));
                    urdf.links.push(Link {
                        role: Role::Between,
                        ..link(name.clone(), joint.span.clone())
                    });
                    name
                }
            };
            let span = joint.span.clone();
            urdf.joints.push(Joint {
                parent: (std::mem::replace(&mut on, child.clone()), span.clone()),
                child: (child, span),
                ..joint
            });
        }
        if on != body {
            let span = urdf.links.iter().find(|link| link.name == body);
            let span = span.map_or(0..0, |link| link.span.clone());
            urdf.joints.push(fixed([&on, body], &span, &at));
        }
    }

    /// A site that is called as a body is left out.
    fn site(&mut self, item: &Item<'a, '_>, body: &str, urdf: &mut Urdf, links: &mut Names) {
        let class = self.class_of(item.node, "class", item.class);
        let Some(name) = item.node.attribute("name") else {
            return;
        };
        let Some(own) = self.pose(item.node, class) else {
            return;
        };
        if !links.insert(name.to_owned()) {
            return;
        }
        let span = start_tag(item.node);
        let at = item.frame.then(&own);
        urdf.joints.push(fixed([body, name], &span, &at));
        urdf.links.push(Link {
            role: Role::Mark,
            ..link(name.to_owned(), span)
        });
    }
}

fn bodies<'a, 'd>(items: Vec<Item<'a, 'd>>, on: &str) -> Vec<Open<'a, 'd>> {
    let bodies = items.into_iter();
    let bodies = bodies.filter(|item| item.node.has_tag_name("body"));
    bodies.map(|item| (item, on.to_owned())).collect()
}

fn link(name: String, span: std::ops::Range<usize>) -> Link {
    Link {
        name,
        span,
        ..Link::default()
    }
}
