//! A body's mass: what its `inertial` says, and what of it cannot be read.

use dalembert_model::number::Rational;
use dalembert_model::robot::Inertia;
use dalembert_model::robot::values::number;
use num_traits::{Signed, Zero};

use super::Mjcf;
use super::geom::Weight;
use super::settings::FromGeoms;
use super::world::Item;
use crate::urdf::{Inertial, Link, Number, Unread, Urdf, constant, start_tag};

const WRITE_IT: &str = "give the body an <inertial>; MuJoCo writes them all: \
    load the model with <compiler saveinertial=\"true\"/> and save it by mj_saveLastXML";

impl<'a> Mjcf<'a, '_, '_> {
    pub(super) fn mass(&mut self, items: &[Item<'a, '_>], link: &mut Link) -> Vec<Inertial> {
        let own = items.iter().find(|item| item.node.has_tag_name("inertial"));
        link.inertial = own.and_then(|item| self.inertial(item, &link.name));
        self.bounds(link);
        let geoms = items.iter().filter(|item| item.node.has_tag_name("geom"));
        let geoms: Vec<&Item> = match self.settings.from_geoms {
            FromGeoms::None => Vec::new(),
            FromGeoms::Some if own.is_some() => Vec::new(),
            _ => geoms.collect(),
        };
        let mut solids = Vec::new();
        for geom in &geoms {
            match self.weight(geom) {
                Weight::Nothing => {}
                Weight::Something(solid) => solids.push(*solid),
                Weight::Unknown => link.unread.push(Unread {
                    span: start_tag(geom.node),
                    message: format!("the mass of body `{}` is that of its geoms", link.name),
                    help: WRITE_IT,
                }),
            }
        }
        if !geoms.is_empty() {
            // They have it, and not what is written beside them.
            link.inertial = None;
        }
        solids
    }

    pub(super) fn total(&mut self, urdf: &mut Urdf) {
        let Some(total) = self.settings.total.take() else {
            return;
        };
        let unread = urdf.links.iter().flat_map(|link| &link.unread).next();
        let own = urdf.links.iter().filter_map(|link| link.inertial.as_ref());
        let own: Rational = own.map(|inertial| &inertial.mass.value).sum();
        if unread.is_some() || own.is_zero() {
            let message = "`settotalmass` is of bodies whose masses are not all known".to_owned();
            self.problems.error(&total.span, message, WRITE_IT);
            return;
        }
        let ratio = &total.value / own;
        let scaled = |own: &Number| {
            let value = &own.value * &ratio;
            Number::new(value.clone(), number(&value), &own.span)
        };
        let links = urdf.links.iter_mut();
        for inertial in links.filter_map(|link| link.inertial.as_mut()) {
            inertial.mass = scaled(&inertial.mass);
            inertial.inertia = inertial.inertia.map(scaled);
        }
    }

    fn bounds(&mut self, link: &mut Link) {
        let Some(Inertial { mass, inertia, .. }) = &link.inertial else {
            return;
        };
        let name = &link.name;
        let [least_mass, least_moment] = &self.settings.least;
        let is_less = |own: &Number, least: &Option<Number>| {
            least.as_ref().is_some_and(|least| own.value < least.value)
        };
        let moments = [&inertia.xx, &inertia.yy, &inertia.zz];
        let small = moments.into_iter().find(|own| is_less(own, least_moment));
        let light = is_less(mass, least_mass).then_some(mass);
        for (own, key) in [(light, "boundmass"), (small, "boundinertia")] {
            link.unread.extend(own.map(|own| Unread {
                span: own.span.clone(),
                message: format!("`{key}` of the compiler is more than body `{name}` has"),
                help: "write the number that shall count, and leave the bound out",
            }));
        }
    }

    fn inertial(&mut self, item: &Item<'a, '_>, body: &str) -> Option<Inertial> {
        let Item { node, frame, .. } = item;
        let at = self.pose(*node, 0);
        let mass = self.problems.required(*node, "mass");
        let [diagonal, full] = ["diaginertia", "fullinertia"].map(|key| node.has_attribute(key));
        let moments = match (diagonal, full) {
            (true, true) => {
                let message = format!("body `{body}` has two inertias");
                self.error(*node, message, "`diaginertia` or `fullinertia`, not both");
                None
            }
            (_, true) => {
                let (text, span) = self.problems.attribute(*node, "fullinertia")?;
                self.problems.list("fullinertia", text, span)
            }
            (is_given, false) => {
                let [xx, yy, zz] = match is_given {
                    true => self.problems.triple(*node, "diaginertia")?,
                    false => constant(*node, ["0", "0", "0"]),
                };
                let [xy, xz, yz] = constant(*node, ["0", "0", "0"]);
                Some([xx, yy, zz, xy, xz, yz])
            }
        };
        let inertia = moments.map(|[xx, yy, zz, xy, xz, yz]| Inertia::of([xx, yy, zz, xy, yz, xz]));
        let (at, mass, inertia) = (at?, mass?, inertia?);
        if mass.value.is_negative() {
            let message = format!("the mass of body `{body}` is negative");
            let help = "a mass is zero or more, in kg";
            return self.problems.refuse(&mass.span, message, help);
        }
        let moments = [&inertia.xx, &inertia.yy, &inertia.zz];
        if let Some(moment) = moments.into_iter().find(|own| own.value.is_negative()) {
            let message = format!("a moment of inertia of body `{body}` is negative");
            let help = "the inertia is about the centre of mass, in kg·m²";
            return self.problems.refuse(&moment.span, message, help);
        }
        Some(Inertial {
            origin: frame.then(&at).origin(),
            mass,
            inertia,
        })
    }
}
