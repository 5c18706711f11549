//! The mass of a body: its `inertial`, or simple shapes, each as a link that is fixed to the body.

use dalembert_model::number::recover::rounded;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::Inertia;
use num_traits::{One, Signed, Zero};

use super::Mjcf;
use super::settings::FromGeoms;
use super::world::Item;
use crate::model::{Inertial, Link, Number, or_zero};
use crate::xml::Element;

/// Shapes whose volume is known, with the sizes that they have.
const SHAPES: [(&str, usize); 5] = [
    ("sphere", 1),
    ("capsule", 2),
    ("cylinder", 2),
    ("ellipsoid", 3),
    ("box", 3),
];

impl Mjcf<'_, '_, '_> {
    /// Reads the mass of a body into its link, and returns that of its shapes.
    pub(super) fn mass(&mut self, items: &[Item], link: &mut Link) -> Vec<Inertial> {
        let of = |tag: &'static str| items.iter().filter(move |item| item.element.tag == tag);
        let named = format!("body `{}`", link.name);
        for item in of("inertial").chain(of("geom")) {
            self.reader.check("body", item.element, &named);
        }
        let inertial = of("inertial").next();
        if let Some(second) = of("inertial").nth(1) {
            self.reader
                .report("second", &second.element.at, &[&"inertial"]);
        }
        link.inertial = inertial.and_then(|item| self.inertial(item, &link.name));
        let geoms: Vec<&Item> = match self.settings.from_geoms {
            FromGeoms::None => Vec::new(),
            FromGeoms::Some if inertial.is_some() => Vec::new(),
            _ => of("geom").collect(),
        };
        let mut solids = Vec::new();
        for geom in geoms {
            let Some((key, amount)) = self.amount(geom.element) else {
                continue;
            };
            if let Some(solid) = self.solid(geom, key, amount) {
                solids.push(solid);
                continue;
            }
            // The mass of a mesh, or of an unreadable shape.
            link.has_unknown_mass = true;
            let at = &geom.element.at;
            let reader = &mut *self.reader;
            match geom.element.get("mesh") {
                Some(mesh) => reader.report("mass_of_mesh", at, &[&named, &mesh.value]),
                None => reader.report("mass_of_geoms", at, &[&named]),
            }
        }
        if !solids.is_empty() || link.has_unknown_mass {
            // The shapes replace the `inertial`.
            link.inertial = None;
        }
        solids
    }

    fn inertial(&mut self, item: &Item, body: &str) -> Option<Inertial> {
        let Item { element, frame } = item;
        let at = self.pose(element);
        let mass = self.reader.required_number(element, "mass");
        let full = element.get("fullinertia");
        if let (Some(full), Some(_)) = (full, element.get("diaginertia")) {
            self.reader.report("two_inertias", &full.at, &[&body]);
        }
        let [xx, yy, zz, xy, xz, yz] = match full {
            Some(_) => self.reader.numbers(element, "fullinertia")?,
            None => {
                let [xx, yy, zz] = self.reader.vector(element, "diaginertia");
                let [xy, xz, yz] = Number::constants(["0", "0", "0"], &element.at);
                [xx, yy, zz, xy, xz, yz]
            }
        };
        let (what, help) = (
            format!("the mass of body `{body}`"),
            "a mass is zero or more, in kg",
        );
        self.reader.not_negative(Some(&mass), &what, help);
        Some(Inertial {
            origin: frame.then(&at).origin(),
            mass,
            inertia: Inertia::of([xx, yy, zz, xy, yz, xz]),
        })
    }

    /// Reads the mass or the density of a geom, with its key, unless the geom weighs nothing.
    fn amount(&mut self, element: &Element) -> Option<(&'static str, Option<Number>)> {
        let [low, high] = &self.settings.groups;
        let group = or_zero(self.reader.number(element, "group"));
        let key = match element.get("mass") {
            Some(_) => "mass",
            None => "density",
        };
        let amount = self.reader.number(element, key);
        let is_nothing = amount.as_ref().is_some_and(|number| number.value.is_zero());
        let is_flat = matches!(element.value("type"), Some("plane" | "hfield"));
        let weighs = !is_nothing && !is_flat && (low..=high).contains(&&group);
        weighs.then_some((key, amount))
    }

    fn solid(&mut self, item: &Item, key: &str, amount: Option<Number>) -> Option<Inertial> {
        let Item { element, frame } = item;
        let word = element.get("type").map_or("sphere", |word| &word.value);
        let (_, count) = SHAPES.iter().find(|(shape, _)| *shape == word)?;
        let is_shell = element.get("shellinertia");
        // The size of a shape with a mesh is fitted to that.
        if is_shell.is_some_and(|word| word.value == "true") || element.get("mesh").is_some() {
            return None;
        }
        let given_sizes = self.reader.list(element.get("size")?)?.into_iter();
        let mut sizes: Vec<Rational> = given_sizes.take(3).map(|size| size.value).collect();
        let at = match element.get("fromto") {
            // A box also needs its rotation about its length, which `fromto` does not give.
            Some(_) if *count == 3 => return None,
            Some(_) => {
                let (at, half) = self.between(element, 1)?;
                sizes.truncate(1);
                sizes.push(half);
                at
            }
            None => self.pose(element),
        };
        let sizes = sizes.get(..*count)?;
        if sizes.iter().any(|size| !size.is_positive()) {
            return None;
        }
        let (volume, moments) = moments(word, sizes);
        let amount = amount.unwrap_or_else(|| Number::constant("1000", &element.at));
        let mass = match key {
            "mass" => amount.value.clone(),
            _ => rounded(&(&amount.value * volume)),
        };
        let number = |value: Rational| amount.clone().map(|_| value);
        let [xx, yy, zz] = moments.map(|moment| number(rounded(&(moment * &mass))));
        let zero = Number::constant("0", &element.at);
        Some(Inertial {
            origin: frame.then(&at).origin(),
            mass: number(mass),
            inertia: Inertia::of([xx, yy, zz, zero.clone(), zero.clone(), zero]),
        })
    }
}

/// Returns the volume of a shape and its moments of inertia for a mass of one; sizes are half
/// lengths or radii.
fn moments(shape: &str, sizes: &[Rational]) -> (Rational, [Rational; 3]) {
    let pi = Angle::PiTimes(Rational::one()).radians();
    let ratio = |n: i64, d: i64| Rational::new(n.into(), d.into());
    // A sphere has one size, and is an ellipsoid with that in all directions.
    let size = |i: usize| sizes.get(i).or(sizes.first()).cloned();
    let [a, b, c] = [0, 1, 2].map(|i| size(i).unwrap_or_default());
    let square = |x: &Rational| x * x;
    match shape {
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
                "sphere" | "ellipsoid" => (ratio(1, 5), ratio(4, 3) * pi),
                _ => (ratio(1, 3), ratio(8, 1)),
            };
            let squares = [&a, &b, &c].map(square);
            let [x, y, z] = &squares;
            let moments = [y + z, x + z, x + y].map(|sum| sum * &part);
            (volume * a * b * c, moments)
        }
    }
}
