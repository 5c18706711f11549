//! Geoms that weigh something: simple bodies, each as a link that is fixed to its body.

use dalembert_model::number::recover::rounded;
use dalembert_model::number::{Angle, Rational, Wide};
use dalembert_model::placed::frame::length;
use dalembert_model::robot::Inertia;
use num_traits::{One, Signed, Zero};
use roxmltree::Node;

use super::Mjcf;
use super::world::Item;
use crate::urdf::{Inertial, Number, constant};

/// Shapes whose volume is known, with the sizes that they have.
const SHAPES: [(&str, usize); 5] = [
    ("sphere", 1),
    ("capsule", 2),
    ("cylinder", 2),
    ("ellipsoid", 3),
    ("box", 3),
];

pub(super) enum Weight {
    Nothing,
    Something(Box<Inertial>),
    /// That of a mesh, or of what could not be read.
    Unknown,
}

impl<'a> Mjcf<'a, '_, '_> {
    pub(super) fn weight(&mut self, item: &Item<'a, '_>) -> Weight {
        let class = self.class_of(item.node, "class", item.class);
        let group = self.number(item.node, class, "group");
        let group = group.map_or(0, |group| {
            i64::try_from(group.value.to_integer()).unwrap_or(0)
        });
        let [low, high] = self.settings.groups;
        let has_mass = self.text(item.node, class, "mass").is_some();
        let key = if has_mass { "mass" } else { "density" };
        let given = self.number(item.node, class, key);
        let is_nothing = given.as_ref().is_some_and(|given| given.value.is_zero());
        if is_nothing || !(low..=high).contains(&group) {
            return Weight::Nothing;
        }
        let inertial = self.solid(item, class, key, given);
        inertial.map_or(Weight::Unknown, |inertial| {
            Weight::Something(Box::new(inertial))
        })
    }

    fn solid(
        &mut self,
        item: &Item<'a, '_>,
        class: usize,
        key: &str,
        given: Option<Number>,
    ) -> Option<Inertial> {
        let (node, frame) = (item.node, &item.frame);
        let word = self.text(node, class, "type");
        let word = word.map_or("sphere", |(word, _)| word);
        let (_, count) = SHAPES.iter().find(|(shape, _)| *shape == word)?;
        let is_shell = self.text(node, class, "shellinertia");
        if is_shell.is_some_and(|(word, _)| word == "true") {
            return None;
        }
        let mut sizes = Vec::new();
        let (text, span) = self.text(node, class, "size")?;
        for word in text.split_ascii_whitespace().take(3) {
            sizes.push(self.problems.parse(word, span.clone())?.value);
        }
        let at = match self.text(node, class, "fromto") {
            // How it is turned about its length matters to a box.
            Some(_) if *count == 3 => return None,
            Some((text, span)) => {
                let ends: [Number; 6] = self.problems.list("fromto", text, span)?;
                let (at, half) = self.between(node, ends)?;
                sizes.truncate(1);
                sizes.push(half);
                at
            }
            None => self.pose(node, class)?,
        };
        let sizes = sizes.get(..*count)?;
        if sizes.iter().any(|size| !size.is_positive()) {
            return None;
        }
        let (volume, moments) = moments(word, sizes);
        let [ton, zero] = constant(node, ["1000", "0"]);
        let given = given.unwrap_or(ton);
        let mass = match key {
            "mass" => given.value.clone(),
            _ => rounded(&(&given.value * volume)),
        };
        let number = |value: Rational| Number {
            value,
            ..given.clone()
        };
        let [xx, yy, zz] = moments.map(|moment| number(rounded(&(moment * &mass))));
        Some(Inertial {
            origin: frame.then(&at).origin(),
            mass: number(mass),
            inertia: Inertia::of([xx, yy, zz, zero.clone(), zero.clone(), zero]),
        })
    }

    fn between(&self, node: Node, ends: [Number; 6]) -> Option<(super::pose::Pose, Rational)> {
        let two = Rational::from_integer(2.into());
        let [a, b, c, d, e, f] = ends;
        let along = [(&d, &a), (&e, &b), (&f, &c)].map(|(to, from)| &to.value - &from.value);
        let middle =
            [(&d, &a), (&e, &b), (&f, &c)].map(|(to, from)| (&to.value + &from.value) / &two);
        let whole = length(&along.each_ref().map(Wide::from_rational)).to_rational();
        let half = rounded(&(whole / &two));
        let at = self.along(node, &along, &middle)?;
        Some((at, half))
    }
}

/// Sizes are half lengths or radii; the moments are for a mass of one.
fn moments(shape: &str, sizes: &[Rational]) -> (Rational, [Rational; 3]) {
    let pi = Angle::PiTimes(Rational::one()).radians();
    let ratio = |n: i64, d: i64| Rational::new(n.into(), d.into());
    let [a, b, c] = [0, 1, 2].map(|i| sizes.get(i).cloned().unwrap_or_else(Rational::zero));
    let square = |x: &Rational| x * x;
    match shape {
        "sphere" => {
            let moment = ratio(2, 5) * square(&a);
            let volume = ratio(4, 3) * pi * square(&a) * &a;
            (volume, [moment.clone(), moment.clone(), moment])
        }
        "capsule" => {
            // A cylinder of length h, and two halves of a sphere.
            let h = &b * ratio(2, 1);
            let ends = &a * ratio(4, 1) / (&a * ratio(4, 1) + &h * ratio(3, 1));
            let middle = ratio(1, 1) - &ends;
            let ball = ratio(2, 5) * &ends * square(&a);
            let across = &middle * (ratio(3, 1) * square(&a) + square(&h)) / ratio(12, 1)
                + &ball
                + &ends * &h * (&a * ratio(3, 1) + &h * ratio(2, 1)) / ratio(8, 1);
            let along = &middle * square(&a) / ratio(2, 1) + ball;
            let volume = pi * square(&a) * (&h + ratio(4, 3) * &a);
            (volume, [across.clone(), across, along])
        }
        "cylinder" => {
            let across = (ratio(3, 1) * square(&a) + ratio(4, 1) * square(&b)) / ratio(12, 1);
            let along = square(&a) / ratio(2, 1);
            let volume = pi * square(&a) * b * ratio(2, 1);
            (volume, [across.clone(), across, along])
        }
        _ => {
            let (part, volume) = match shape {
                "ellipsoid" => (ratio(1, 5), ratio(4, 3) * pi),
                _ => (ratio(1, 3), ratio(8, 1)),
            };
            let squares = [&a, &b, &c].map(square);
            let [x, y, z] = &squares;
            let moments = [y + z, x + z, x + y].map(|sum| sum * &part);
            (volume * a * b * c, moments)
        }
    }
}
