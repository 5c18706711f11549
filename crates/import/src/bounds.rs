//! Settings of MuJoCo's compiler that change masses: least masses and moments of inertia, moments
//! that satisfy the triangle inequality, and the total mass.

use dalembert_model::equations::matrix::Columns;
use dalembert_model::number::recover::rounded;
use dalembert_model::number::{Rational, Wide};
use dalembert_model::placed::Body;
use dalembert_model::placed::frame::{moved, pose};
use dalembert_model::robot::{Defect, Inertia};
use dalembert_model::scalar::Scalar;
use num_traits::{One, Signed, Zero};

use crate::merge::{combined, shifted, size_of};
use crate::model::{Format, Inertial, Joint, Kind, Model, Number, Origin, Role};
use crate::read::Reader;
use crate::xml::Element;

/// Rounds of rotations after which a symmetric matrix is diagonal in all digits that are kept.
const ROUNDS: usize = 12;

#[derive(Default)]
pub(crate) struct Bounds {
    mass: Option<Number>,
    moment: Option<Number>,
    balance: bool,
    total: Option<Number>,
}

impl Bounds {
    /// Reads the settings of a `compiler` element: the last of several counts.
    pub(crate) fn read(&mut self, element: &Element, reader: &mut Reader) {
        for (key, bound) in [
            ("boundmass", &mut self.mass),
            ("boundinertia", &mut self.moment),
            ("settotalmass", &mut self.total),
        ] {
            if let Some(number) = reader.number(element, key) {
                *bound = Some(number).filter(|number| number.value.is_positive());
            }
        }
        let words = [("false", false), ("true", true)];
        let balance = reader.word(element, "balanceinertia", &words);
        self.balance = balance.unwrap_or(self.balance);
    }

    pub(crate) fn bound_bodies(&self) -> bool {
        self.mass.is_some() || self.moment.is_some() || self.balance
    }

    /// Applies the bounds to each body, in MuJoCo's order, and the total mass to the sum.
    pub(crate) fn apply(&self, model: &mut Model, reader: &mut Reader) {
        let links = (0..model.links.len()).filter(|_| self.bound_bodies());
        let changed = Vec::from_iter(links.filter_map(|link| self.apply_to(link, model)));
        if !changed.is_empty() {
            let keys = [
                self.mass.as_ref().map(|_| "`boundmass`"),
                self.moment.as_ref().map(|_| "`boundinertia`"),
                self.balance.then_some("`balanceinertia`"),
            ];
            let keys = Vec::from_iter(keys.into_iter().flatten()).join(", ");
            reader.report("bounded", &model.at, &[&keys, &changed.join("`, `")]);
        }
        if let Some(total) = &self.total {
            scale(total, model, reader);
        }
    }

    /// Applies the bounds to the body of a link; returns its name if that changes something.
    fn apply_to(&self, link: usize, model: &mut Model) -> Option<String> {
        let joint = &model.joints[model.above[link]?];
        let body = &model.links[link];
        if body.role != Role::Body || body.has_unknown_mass {
            return None;
        }
        let mut parts: Vec<(usize, &Joint)> = vec![(link, joint)];
        let joints = model.joints.iter().zip(&model.ends);
        let below = joints.filter(|(_, [parent, _])| *parent == link);
        parts.extend(below.map(|(joint, [_, child])| (*child, joint)));
        parts.retain(|(part, _)| *part == link || model.links[*part].role == Role::Mark);
        parts.retain(|(part, _)| model.links[*part].inertial.is_some());
        let (holder, before) = match parts[..] {
            // A weight that is not given is as far from the link, for MuJoCo, as that is from the
            // one before.
            [] => (link, massless(joint.origin.xyz.clone())),
            [(only, _)] => (only, model.links[only].inertial.clone()?),
            _ => (link, in_one_frame(&parts, link, model)?),
        };
        let is_fused = model.format == Format::Urdf && joint.kind == Kind::Fixed;
        if is_fused && self.mass.is_none() && before.mass.value.is_zero() {
            // MuJoCo makes the link part of the one before, and adds nothing.
            return None;
        }
        let is_less = |least: &&Number| before.mass.value < least.value;
        let least = self.mass.as_ref().filter(is_less);
        let mass = least.unwrap_or(&before.mass).clone();
        let tensor = before.inertia.map(|entry| entry.value.clone());
        let mut bounded = tensor.clone();
        if let Some(least) = &self.moment {
            bounded = with_moments_of(&bounded, &least.value);
        }
        if self.balance && bounded.defect(&Rational::one()) == Some(Defect::Triangle) {
            let mean = (&bounded.xx + &bounded.yy + &bounded.zz) / Rational::from_integer(3.into());
            bounded = diagonal(|_| mean.clone());
        }
        if mass.value == before.mass.value && bounded == tensor {
            return None;
        }
        for (part, _) in parts {
            model.links[part].inertial = None;
        }
        let entry = |value: &Rational| Number::of(value, &before.mass.at);
        let inertia = bounded.map(entry);
        model.links[holder].inertial = Some(Inertial {
            mass,
            inertia,
            ..before
        });
        Some(model.links[link].name.clone())
    }
}

fn diagonal(entry: impl Fn(usize) -> Rational) -> Inertia<Rational> {
    Inertia::symmetric(|i, k| if i == k { entry(i) } else { Rational::zero() })
}

pub(crate) fn massless(xyz: [Number; 3]) -> Inertial {
    let zero = xyz[0].clone().map(|_| Rational::zero());
    Inertial {
        origin: Origin {
            xyz,
            ..Origin::default()
        },
        mass: zero.clone(),
        inertia: Inertia::of([(); 6].map(|()| zero.clone())),
    }
}

/// Returns several weights that are fixed to a link as one, in its frame.
fn in_one_frame(parts: &[(usize, &Joint)], link: usize, model: &Model) -> Option<Inertial> {
    let mut bodies = Vec::new();
    for (part, joint) in parts {
        let inertial = model.links[*part].inertial.as_ref()?;
        let origin = inertial.origin.placement();
        let (mut way, mut size) = (pose(&origin), origin.size());
        if *part != link {
            let placement = joint.origin.placement();
            (way, size) = (pose(&placement).then(&way), size + placement.size());
        }
        bodies.push(moved(&inertial.body(), &way, &size_of(size)));
    }
    let Body { mass, com, inertia } = combined(&bodies);
    let at = &model.links[link].at;
    let entry = |value: &Rational| Number::of(value, at);
    Some(Inertial {
        origin: Origin {
            xyz: com.each_ref().map(entry),
            ..Origin::default()
        },
        mass: entry(&mass),
        inertia: inertia.map(entry),
    })
}

/// Returns a tensor whose principal moments are at least this.
fn with_moments_of(tensor: &Inertia<Rational>, least: &Rational) -> Inertia<Rational> {
    let rows = tensor.rows();
    if shifted(tensor, &-least).defect(&Rational::one()) != Some(Defect::NegativeMoment) {
        return tensor.clone();
    }
    let products = [&tensor.xy, &tensor.yz, &tensor.xz];
    if products.iter().all(|product| product.is_zero()) {
        return diagonal(|i| rows[i][i].clone().max(least.clone()));
    }
    let (moments, axes) = principal(rows);
    let bounded = moments.map(|moment| moment.to_rational().max(least.clone()));
    let moments = bounded.each_ref().map(Wide::from_rational);
    Inertia::symmetric(|i, k| {
        let terms = (0..3).map(|m| moments[m].mul(&axes[i][m]).mul(&axes[k][m]));
        let sum = terms.fold(Wide::zero(), |sum, term| sum.add(&term));
        rounded(&sum.to_rational())
    })
}

/// Returns the principal moments of a symmetric matrix and, in columns, their axes: by Jacobi's
/// rotations, each of which makes one pair of entries zero.
fn principal(rows: [[Rational; 3]; 3]) -> ([Wide; 3], [[Wide; 3]; 3]) {
    let mut a = rows.map(|row| row.map(|entry| Wide::from_rational(&entry)));
    let mut axes = Columns::<Wide>::identity().axes;
    let absolute = |x: &Wide| if x.is_negative() { x.neg() } else { *x };
    let hypotenuse = |x: &Wide| x.mul(x).add(&Wide::one()).sqrt();
    let pairs = [(0, 1), (0, 2), (1, 2)].into_iter().cycle();
    for (p, q) in pairs.take(3 * ROUNDS) {
        // θ = cot 2φ = (a_qq − a_pp) / 2 a_pq, and tan φ = ±1 / (|θ| + √(θ² + 1)).
        let Some(theta) = a[q][q].sub(&a[p][p]).over(&a[p][q].add(&a[p][q])) else {
            continue;
        };
        let mut size = absolute(&theta).add(&hypotenuse(&theta));
        if theta.is_negative() {
            size = size.neg();
        }
        let Some(tangent) = Wide::one().over(&size) else {
            continue;
        };
        let Some(cos) = Wide::one().over(&hypotenuse(&tangent)) else {
            continue;
        };
        let sin = tangent.mul(&cos);
        let turn = |x: &Wide, y: &Wide| [cos.mul(x).sub(&sin.mul(y)), sin.mul(x).add(&cos.mul(y))];
        for row in a.iter_mut().chain(&mut axes) {
            [row[p], row[q]] = turn(&row[p], &row[q]);
        }
        let columns = [0, 1, 2].map(|k| turn(&a[p][k], &a[q][k]));
        a[p] = columns.map(|[x, _]| x);
        a[q] = columns.map(|[_, y]| y);
    }
    ([a[0][0], a[1][1], a[2][2]], axes)
}

/// Scales all masses to a total, in a URDF without the links that MuJoCo makes part of the world.
fn scale(total: &Number, model: &mut Model, reader: &mut Reader) {
    let moves = |joint: usize| model.joints[joint].kind != Kind::Fixed;
    let is_body = |link: &usize| model.format == Format::Mjcf || model.way(*link).any(moves);
    let links: Vec<usize> = (0..model.links.len()).filter(is_body).collect();
    let bodies = links.iter().map(|link| &model.links[*link]);
    let inertials = bodies.clone().flat_map(|link| &link.inertial);
    let sum: Rational = inertials.map(|inertial| &inertial.mass.value).sum();
    if bodies.into_iter().any(|link| link.has_unknown_mass) || sum.is_zero() {
        return reader.report("total_unknown", &total.at, &[]);
    }
    let ratio = &total.value / sum;
    let scaled = |before: &Number| Number::of(&(&before.value * &ratio), &before.at);
    for link in links {
        if let Some(inertial) = &mut model.links[link].inertial {
            inertial.mass = scaled(&inertial.mass);
            inertial.inertia = inertial.inertia.map(scaled);
        }
    }
}
