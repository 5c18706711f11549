//! Numbers that were meant to be others.

use std::fmt;
use std::ops::Range;

use dalembert_model::number::Rational;
use dalembert_model::robot::Position;
use num_traits::{One, Signed, Zero};

use crate::meant::{NOTHING, meant, power};
use crate::tree::Chain;
use crate::urdf::{Number, Origin, Urdf, Value};

/// A number that was taken for another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snap {
    /// Where it is in the URDF, in bytes.
    pub span: Range<usize>,
    /// The element and the attribute: `joint elbow, rpy`.
    pub of: String,
    /// As it stands there.
    pub from: String,
    /// The number that it was taken for, as a robot file has it.
    pub to: String,
}

impl Snap {
    /// The line of the URDF, from one.
    pub fn line(&self, source: &str) -> usize {
        crate::problems::place(source, self.span.start).0
    }
}

impl fmt::Display for Snap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} is taken for {}", self.of, self.from, self.to)
    }
}

/// The URDF with every number of the chain taken for what it was meant to be.
pub(crate) fn snapped(urdf: &Urdf, chain: &Chain) -> (Urdf, Vec<Snap>) {
    let mut urdf = urdf.clone();
    let mut snaps = Snaps(Vec::new());
    for joint in chain.joints() {
        let joint = &mut urdf.joints[joint];
        let of = |what: &str| format!("joint {}, {what}", joint.name);
        snaps.origin(&mut joint.origin, &of("xyz"), &of("rpy"));
        for component in &mut joint.axis {
            snaps.component(component, &of("axis"));
        }
        for limit in joint.position.iter_mut().flatten() {
            snaps.limit(limit, &of("limit"));
        }
    }
    for link in chain.links() {
        let link = &mut urdf.links[link];
        let Some(inertial) = &mut link.inertial else {
            continue;
        };
        let of = |what: &str| format!("link {}, {what}", link.name);
        snaps.origin(
            &mut inertial.origin,
            &of("centre of mass"),
            &of("axes of inertia"),
        );
        let tensor = &mut inertial.inertia;
        let moments = [&tensor.xx, &tensor.yy, &tensor.zz];
        let moments = moments.map(|moment| moment.value.abs());
        let largest = moments.into_iter().max().unwrap_or_else(Rational::zero);
        for product in [&mut tensor.xy, &mut tensor.yz, &mut tensor.xz] {
            snaps.length(product, &(&largest * power(NOTHING)), &of("inertia"));
        }
    }
    snaps.0.sort_by_key(|snap| snap.span.start);
    (urdf, snaps.0)
}

/// Collects them.
struct Snaps(Vec<Snap>);

impl Snaps {
    fn take<T>(&mut self, value: &mut Value<T>, meant: T, to: String, of: &str) {
        self.0.push(Snap {
            span: value.span.clone(),
            of: of.to_owned(),
            from: value.text.clone(),
            to,
        });
        value.value = meant;
    }

    fn origin(&mut self, origin: &mut Origin, xyz: &str, rpy: &str) {
        for length in &mut origin.xyz {
            self.length(length, &power(NOTHING), xyz);
        }
        if let Some(meant) = origin.meant.take() {
            let to = meant.rpy.each_ref().map(ToString::to_string).join(" ");
            let from = origin.rpy.each_ref().map(|angle| angle.text.as_str());
            self.0.push(Snap {
                span: origin.rpy[0].span.clone(),
                of: rpy.to_owned(),
                from: from.join(" "),
                to,
            });
            for (angle, meant) in origin.rpy.iter_mut().zip(meant.rpy) {
                angle.value = meant;
            }
            // Where it is turned is where its parts are.
            for (length, meant) in origin.xyz.iter_mut().zip(meant.xyz) {
                length.value = meant;
            }
            for length in &mut origin.xyz {
                self.length(length, &power(NOTHING), xyz);
            }
            return;
        }
        for angle in &mut origin.rpy {
            if let Some(meant) = meant(&angle.value, &angle.text) {
                let to = meant.to_string();
                self.take(angle, meant, to, rpy);
            }
        }
    }

    /// Nothing, where it is less than this.
    fn length(&mut self, length: &mut Number, least: &Rational, of: &str) {
        if !length.value.is_zero() && length.value.abs() < *least {
            self.take(length, Rational::zero(), "0".to_owned(), of);
        }
    }

    fn component(&mut self, component: &mut Number, of: &str) {
        let whole = component.value.round();
        let off = (&component.value - &whole).abs();
        if !off.is_zero() && off < power(NOTHING) && whole.abs() <= Rational::one() {
            let to = whole.to_string();
            self.take(component, whole, to, of);
        }
    }

    fn limit(&mut self, limit: &mut Value<Position>, of: &str) {
        let Position::Angle(angle) = &limit.value else {
            return;
        };
        if let Some(meant) = meant(angle, &limit.text) {
            let to = meant.to_string();
            self.take(limit, Position::Angle(meant), to, of);
        }
    }
}
