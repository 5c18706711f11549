//! Equalities and tendons: what ties joints or bodies to each other beside the tree.

use std::ops::Range;

use dalembert_model::number::Rational;
use dalembert_model::robot::values::number;
use num_traits::{One, Signed, Zero};
use roxmltree::Node;

use super::{Mjcf, children, within};
use crate::lock::compare;
use crate::problems::instead;
use crate::urdf::{Mimic, Tie, Tied, Urdf, Value, start_tag};

impl<'a> Mjcf<'a, '_, '_> {
    pub(super) fn ties(&mut self, root: Node<'a, '_>, urdf: &mut Urdf) {
        for node in within(root, "equality") {
            if node.attribute("active") == Some("false") {
                continue;
            }
            match node.tag_name().name() {
                "joint" => self.follower(node, urdf),
                "connect" | "weld" => links_tied(root, node, urdf),
                _ => {}
            }
        }
        for node in within(root, "tendon") {
            let part = match node.tag_name().name() {
                "fixed" => "joint",
                "spatial" => "site",
                _ => continue,
            };
            let parts: Vec<Node> = children(node, part).collect();
            if let ("joint", [joint]) = (part, parts.as_slice()) {
                self.limiting(node, *joint, urdf);
                continue;
            }
            let names = parts.iter().filter_map(|child| child.attribute(part));
            let names = names.map(str::to_owned).collect();
            let (word, ends) = match part {
                "joint" => ("fixed tendon", Tied::Joints(names)),
                _ => ("spatial tendon", Tied::Links(names)),
            };
            urdf.ties.push(tie(node, word, ends));
        }
    }

    fn limiting(&mut self, node: Node<'a, '_>, joint: Node<'a, '_>, urdf: &mut Urdf) {
        let class = self.class_of(node, "class", 0);
        let is_limited = self.is_limited(node, class, "limited", "range");
        let range = is_limited.then(|| self.list::<2>(node, class, "range"));
        let Some((name, span)) = self.problems.attribute(joint, "joint") else {
            return;
        };
        let coefficient = self.problems.required(joint, "coef");
        let Some(own) = self.joint_named(name, &span, urdf) else {
            return;
        };
        let own = &mut urdf.joints[own];
        for key in ["stiffness", "damping", "frictionloss", "armature"] {
            let left_out = self.number(node, class, key);
            if left_out.is_some_and(|value| !value.value.is_zero()) {
                let message = format!("the {key} of the tendon over joint `{name}` is left out");
                self.difference(node, message, "the torques are those without it");
            }
        }
        let Some((Some(mut range), by)) = range.zip(coefficient) else {
            return;
        };
        if by.value.is_zero() {
            return;
        }
        if by.value.is_negative() {
            range.reverse();
        }
        let (kind, is_one) = (own.kind, by.value.is_one());
        let [low, high] = range.map(|end| {
            let value = end.value / &by.value;
            let text = if is_one { end.text } else { number(&value) };
            Value::new(kind.position(value), text, &end.span)
        });
        let mut position = own.position.take().unwrap_or([low.clone(), high.clone()]);
        if compare(&low.value, &position[0].value).is_gt() {
            position[0] = low;
        }
        if compare(&high.value, &position[1].value).is_lt() {
            position[1] = high;
        }
        if compare(&position[0].value, &position[1].value).is_gt() {
            let message = format!("the tendon leaves joint `{name}` no position within its limits");
            let help = "range=\"lowest highest\" of coef times the position";
            self.error(node, message, help);
        }
        own.position = Some(position);
    }

    fn joint_named(&mut self, name: &str, span: &Range<usize>, urdf: &Urdf) -> Option<usize> {
        let found = urdf.joints.iter().position(|joint| joint.name == name);
        found.or_else(|| {
            let message = format!("there is no joint `{name}`");
            let help = instead(name, &urdf.names[1]);
            self.problems.refuse(span, message, &help)
        })
    }

    fn follower(&mut self, node: Node<'a, '_>, urdf: &mut Urdf) {
        let place = |this: &mut Self, key: &str| {
            let (name, span) = this.problems.attribute(node, key)?;
            this.joint_named(name, &span, urdf)
        };
        let Some(own) = place(self, "joint1") else {
            return;
        };
        let has_other = node.has_attribute("joint2");
        let other = has_other.then(|| place(self, "joint2")).flatten();
        let name = urdf.joints[own].name.clone();
        let Some(other) = other else {
            // It stays where it is.
            urdf.ties
                .push(tie(node, "equality", Tied::Joints(vec![name])));
            return;
        };
        let Some(terms) = self.polynomial(node) else {
            return;
        };
        // Both are counted from where the model has them at first.
        let [start, from] = [own, other].map(|joint| &urdf.joints[joint].start);
        let is_line = terms[2..].iter().all(Zero::is_zero);
        let line = is_line.then(|| {
            let [offset, multiplier] = [&terms[0], &terms[1]];
            [multiplier.clone(), start + offset - multiplier * from]
        });
        urdf.joints[own].mimic = Some(Mimic {
            joint: urdf.joints[other].name.clone(),
            span: start_tag(node),
            line,
        });
    }

    fn polynomial(&mut self, node: Node<'a, '_>) -> Option<Vec<Rational>> {
        let mut terms = vec![Rational::zero(); 5];
        terms[1] = Rational::one();
        let Some(own) = node.attribute_node("polycoef") else {
            return Some(terms);
        };
        let words = own.value().split_ascii_whitespace();
        if words.clone().count() > terms.len() {
            let message = "`polycoef` has more than 5 numbers";
            let help = "polycoef=\"0 1 0 0 0\" is the same as the other joint";
            return self.problems.refuse(&own.range_value(), message, help);
        }
        for (term, word) in terms.iter_mut().zip(words) {
            *term = self.problems.parse(word, own.range_value())?.value;
        }
        Some(terms)
    }
}

fn links_tied(root: Node, node: Node, urdf: &mut Urdf) {
    let keys = match node.has_attribute("site1") {
        true => ["site1", "site2"],
        false => ["body1", "body2"],
    };
    let names = keys.map(|key| node.attribute(key).unwrap_or("world"));
    let links = names.map(|name| match urdf.names[0].contains(name) {
        true => name.to_owned(),
        false => body_of_site(root, name).unwrap_or(name).to_owned(),
    });
    let word = format!("equality `{}`", node.tag_name().name());
    urdf.ties.push(tie(node, &word, Tied::Links(links.into())));
}

fn body_of_site<'a>(root: Node<'a, '_>, name: &str) -> Option<&'a str> {
    let mut sites = root.descendants().filter(|node| node.has_tag_name("site"));
    let site = sites.find(|site| site.attribute("name") == Some(name))?;
    let mut bodies = site.ancestors().filter(|node| node.has_tag_name("body"));
    bodies.next()?.attribute("name")
}

fn tie(node: Node, word: &str, ends: Tied) -> Tie {
    let name = match node.attribute("name") {
        Some(name) => format!("{word} `{name}`"),
        None => word.to_owned(),
    };
    Tie {
        span: start_tag(node),
        name,
        ends,
    }
}
