//! Equalities and tendons: what ties joints or bodies to each other beside the tree.

use std::collections::BTreeMap;

use dalembert_model::number::Rational;
use dalembert_model::robot::values::number;
use num_traits::{One, Signed, Zero};

use super::Mjcf;
use crate::model::{Ends, Kind, Mimic, Tie, Value, or_zero};
use crate::problems::instead;
use crate::select::position::compare;
use crate::text::Span;
use crate::xml::Element;

/// The joints of each fixed tendon, with their coefficients.
pub(super) type Tendons = BTreeMap<String, Vec<(usize, Rational)>>;

impl Mjcf<'_, '_, '_> {
    pub(super) fn ties(&mut self, root: &Element) -> Tendons {
        let mut tendons = Tendons::new();
        for element in self.section(root, "tendon") {
            let of = element.named(&format!("{} tendon", element.tag));
            let over = match element.tag.as_str() {
                "spatial" => {
                    self.reader.check("tendon", element, &of);
                    let ends = self.path(element);
                    self.tie(element, of, ends);
                    continue;
                }
                "fixed" => self.over(element),
                _ => continue,
            };
            if let [(joint, coefficient)] = &over[..] {
                let at = self.model.joints[*joint].at.clone();
                let around = self.reader.problems.enter(&at);
                self.reader.check("tendon", element, &of);
                self.limiting(element, *joint, coefficient);
                self.reader.problems.leave(around);
            } else {
                self.reader.check("tendon", element, &of);
                self.tie(element, of, self.joints_tied(&over));
            }
            let name = element.value("name").map(str::to_owned);
            tendons.extend(name.map(|name| (name, over)));
        }
        for element in self.section(root, "equality") {
            let of = element.named(&match element.tag.as_str() {
                "joint" => "equality".to_owned(),
                tag => format!("equality `{tag}`"),
            });
            self.reader.check("equality", element, &of);
            let words = [("true", true), ("false", false)];
            let is_active = self.reader.word(element, "active", &words);
            if is_active == Some(false) || self.settings.is_off("equality") {
                continue;
            }
            let ends = match element.tag.as_str() {
                "joint" => self.follower(element),
                "connect" | "weld" => Some(self.links_tied(element)),
                "tendon" => {
                    let names = ["tendon1", "tendon2"].map(|key| element.value(key));
                    let over = names.iter().flatten().filter_map(|name| tendons.get(*name));
                    Some(self.joints_tied(&over.flatten().cloned().collect::<Vec<_>>()))
                }
                _ => None,
            };
            ends.into_iter()
                .for_each(|ends| self.tie(element, of.clone(), ends));
        }
        tendons
    }

    fn tie(&mut self, element: &Element, name: String, ends: Ends) {
        let at = element.at.clone();
        self.model.ties.push(Tie { at, name, ends });
    }

    fn joints_tied(&self, over: &[(usize, Rational)]) -> Ends {
        let name = |(joint, _): &(usize, Rational)| self.model.joints[*joint].name.clone();
        Ends::Joints(over.iter().map(name).collect())
    }

    fn links_tied(&self, element: &Element) -> Ends {
        let sites = ["site1", "site2"].map(|key| element.value(key));
        let bodies = ["body1", "body2"].map(|key| element.value(key).unwrap_or("world"));
        let ends = match sites {
            [Some(one), Some(other)] => [one, other].map(|name| self.body_of("site", name)),
            _ => bodies.map(str::to_owned),
        };
        Ends::Links(ends.into())
    }

    /// Returns the bodies that a spatial tendon runs over.
    fn path(&self, element: &Element) -> Ends {
        let mut bodies = Vec::new();
        for part in &element.inside {
            for (key, kind) in [("site", "site"), ("sidesite", "site"), ("geom", "geom")] {
                bodies.extend(part.value(key).map(|name| self.body_of(kind, name)));
            }
        }
        Ends::Links(bodies)
    }

    fn body_of(&self, kind: &str, name: &str) -> String {
        let body = self.places.get(&format!("{kind} {name}"));
        body.map_or("world", String::as_str).to_owned()
    }

    fn over(&mut self, element: &Element) -> Vec<(usize, Rational)> {
        let over = element.all("joint").filter_map(|path| {
            let (name, at) = self.reader.required(path, "joint");
            let coefficient = self.reader.required_number(path, "coef");
            Some((self.joint_named(&name, &at)?, coefficient.value))
        });
        over.collect()
    }

    /// Adds what a tendon over one joint has to that joint: limits, armature and damping.
    fn limiting(&mut self, element: &Element, joint: usize, by: &Rational) {
        let name = self.model.joints[joint].name.clone();
        let range = self.limits(element, "limited", "range");
        let of = format!("the tendon over joint `{name}`");
        let [armature, damping] = self.loads(element, &of);
        for key in ["stiffness", "frictionloss"] {
            let attribute = element.get(key);
            let terms = attribute.and_then(|attribute| self.reader.list(attribute));
            if terms.is_some_and(|terms| terms.iter().any(|term| !term.value.is_zero())) {
                self.reader.report("of_tendon", &element.at, &[&key, &name]);
            }
        }
        let tied = &mut self.model.joints[joint];
        tied.armature += or_zero(armature) * by * by;
        tied.add_damping(damping, by);
        let Some(mut range) = range.filter(|_| !by.is_zero()) else {
            return;
        };
        if by.is_negative() {
            range.reverse();
        }
        let [low, high] = range.map(|end| {
            let value = end.value / by;
            let text = match by.is_one() {
                true => end.text,
                false => number(&value),
            };
            Value::new(tied.kind.position(value), text, &end.at)
        });
        let mut position = tied.position.take().unwrap_or([low.clone(), high.clone()]);
        if compare(&low.value, &position[0].value).is_gt() {
            position[0] = low;
        }
        if compare(&high.value, &position[1].value).is_lt() {
            position[1] = high;
        }
        if compare(&position[0].value, &position[1].value).is_gt() {
            self.reader
                .report("tendon_leaves_nothing", &element.at, &[&name]);
        }
        tied.position = Some(position);
    }

    pub(super) fn joint_named(&mut self, name: &str, at: &Span) -> Option<usize> {
        let joints = || self.model.joints.iter();
        let place = joints().position(|joint| joint.name == name);
        if place.is_none() {
            let moving = joints().filter(|joint| joint.kind != Kind::Fixed);
            let help = instead(name, moving.map(|joint| &joint.name));
            self.reader.report("no_joint", at, &[&name, &help]);
        }
        place
    }

    /// Reads a joint that follows another; returns one that stands still.
    fn follower(&mut self, element: &Element) -> Option<Ends> {
        let (name, at) = self.reader.required(element, "joint1");
        let follower = self.joint_named(&name, &at)?;
        let Some(leader) = element.get("joint2") else {
            return Some(Ends::Joints(vec![name]));
        };
        let other = self.joint_named(&leader.value, &leader.at)?;
        let mut terms = vec![Rational::zero(); 5];
        terms[1] = Rational::one();
        if let Some(coefficients) = element.get("polycoef") {
            let numbers = self.reader.list(coefficients)?;
            if numbers.len() > terms.len() {
                return self.reader.refuse("polycoef", &coefficients.at, &[]);
            }
            let pairs = terms.iter_mut().zip(numbers);
            pairs.for_each(|(term, number)| *term = number.value);
        }
        // Both are counted from their positions in the model's first pose.
        let [start, from] = [follower, other].map(|joint| &self.model.joints[joint].start);
        let is_line = terms[2..].iter().all(Zero::is_zero);
        let line = is_line.then(|| {
            let [offset, multiplier] = [&terms[0], &terms[1]];
            [multiplier.clone(), start + offset - multiplier * from]
        });
        let mimic = Mimic {
            leader: leader.value.clone(),
            at: element.at.clone(),
            line,
        };
        // A second leader holds the joint where both agree.
        let is_second = self.model.joints[follower].mimic.replace(mimic).is_some();
        is_second.then(|| Ends::Joints(vec![name]))
    }
}
