//! Links that are fixed to each other, as one body a joint.

use dalembert_model::equations::matrix::{Columns, Vector};
use dalembert_model::number::parse::write_decimal;
use dalembert_model::number::recover::rounded;
use dalembert_model::number::{Rational, Wide};
use dalembert_model::placed::Body;
use dalembert_model::placed::frame::{direction, moved, placement, pose, turned};
use dalembert_model::robot::{Defect, Inertia, Placement, Position};
use dalembert_model::scalar::Scalar;
use num_traits::{One, Zero};

use crate::problems::Problems;
use crate::tree::{Chain, Moving, Step};
use crate::urdf::{self, Inertial, Joint, Role, Urdf};

#[derive(Clone, Debug)]
pub(crate) struct Arm {
    pub(crate) links: Vec<Link>,
    pub(crate) tool: Placement,
    /// Every link that moves, in the frame of the joint that moves it.
    pub(crate) frames: Vec<Frame>,
}

#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) link: usize,
    pub(crate) joint: usize,
    pub(crate) placement: Placement,
}

#[derive(Clone, Debug)]
pub(crate) struct Link {
    /// The joint's frame at q = 0 in that of the joint before.
    pub(crate) pose: Columns<Wide>,
    pub(crate) placement: Placement,
    pub(crate) axis: Vector<Wide>,
    pub(crate) body: Body,
}

pub(crate) fn arm(urdf: &Urdf, chain: &Chain, problems: &mut Problems) -> Option<Arm> {
    if !are_possible(urdf, chain, problems) {
        return None;
    }
    let joints = chain.joints().into_iter();
    let sizes = joints.map(|joint| urdf.joints[joint].origin.placement().size());
    let size = size_of(sizes.sum());
    let links = chain.moving.iter().map(|moving| {
        let joint = &urdf.joints[moving.joint];
        let own = pose(&joint.origin.placement());
        let before = way(urdf, &moving.before)?;
        // Where nothing lies between, the placement is the file's own.
        let pose = before.then(&own);
        let (pose, placement) = match moving.before.is_empty() {
            true => (own, joint.origin.placement()),
            false => (pose.clone(), placement(&pose, &size)),
        };
        Some(Link {
            pose,
            placement,
            body: body(urdf, moving, &size)?,
            axis: direction_of(joint)?,
        })
    });
    let links: Vec<Link> = links.collect::<Option<_>>()?;
    let empty = chain.moving.iter().zip(&links).filter(|(_, link)| {
        let body = &link.body.inertia.rows();
        link.body.mass.is_zero() && body.iter().flatten().all(Zero::is_zero)
    });
    let empty = empty.filter_map(|(moving, _)| {
        let child = &urdf.joints[moving.joint].child.0;
        let mut bodies = urdf.links.iter().filter(|link| link.role == Role::Body);
        bodies.find(|link| link.name == *child)
    });
    without_mass(&empty.collect::<Vec<_>>(), problems);
    let frames = chain.moving.iter().enumerate().flat_map(|(joint, moving)| {
        let size = &size;
        moving.links.iter().map(move |(link, steps)| {
            Some(Frame {
                link: *link,
                joint,
                placement: placement(&way(urdf, steps)?, size),
            })
        })
    });
    Some(Arm {
        links,
        tool: placement(&way(urdf, &chain.tool)?, &size),
        frames: frames.collect::<Option<_>>()?,
    })
}

fn are_possible(urdf: &Urdf, chain: &Chain, problems: &mut Problems) -> bool {
    let mut good = true;
    for link in chain.links() {
        let link = &urdf.links[link];
        for unread in &link.unread {
            problems.error(&unread.span, unread.message.clone(), unread.help);
            good = false;
        }
        let Some(Inertial { mass, inertia, .. }) = &link.inertial else {
            continue;
        };
        let exact = inertia.map(|entry| entry.value.clone());
        let Some(defect) = exact.defect(&mass.value) else {
            continue;
        };
        let message = format!("link `{}`: {}", link.name, defect.message());
        let span = &inertia.xx.span;
        let help = "the inertia is about the centre of mass, in kg·m²";
        if defect == Defect::NegativeMoment {
            problems.error(span, message, help);
            good = false;
        } else {
            problems.warning(span, message, &format!("{help}; it is taken as it stands"));
        }
    }
    good
}

fn without_mass(links: &[&urdf::Link], problems: &mut Problems) {
    let Some(first) = links.first() else {
        return;
    };
    let names: Vec<&str> = links.iter().map(|link| link.name.as_str()).collect();
    let names = names.join("`, `");
    let (message, help) = match links.len() {
        1 => (
            format!("link `{names}`, and what is fixed to it, has no mass"),
            "give it an <inertial>, unless it weighs nothing",
        ),
        _ => (
            format!("the links `{names}`, and what is fixed to them, have no mass"),
            "give each an <inertial>, unless it weighs nothing",
        ),
    };
    problems.warning(&first.span, message, help);
}

/// Returns what lengths are small against, from the sum of those that there are.
pub(crate) fn size_of(sum: Rational) -> Rational {
    if sum.is_zero() { One::one() } else { sum }
}

/// Returns the way from the first step's parent to the last one's child.
fn way(urdf: &Urdf, steps: &[Step]) -> Option<Columns<Wide>> {
    steps.iter().try_fold(Columns::identity(), |at, step| {
        let joint = &urdf.joints[step.joint];
        let placed = at.then(&pose(&joint.origin.placement()));
        Some(match &step.at {
            None => placed,
            Some(position) => placed.then(&displaced(joint, position)?),
        })
    })
}

fn displaced(joint: &Joint, position: &Position) -> Option<Columns<Wide>> {
    let axis = direction_of(joint)?;
    Some(match position {
        Position::Angle(angle) => turned(&axis, angle),
        Position::Length(length) => {
            let length = Wide::from_rational(length);
            Columns {
                origin: axis.map(|component| component.mul(&length)),
                ..Columns::identity()
            }
        }
    })
}

/// Returns the unit vector of an axis: a direction of length zero was refused when it was
/// read, and none that is not zero is taken for zero.
fn direction_of(joint: &Joint) -> Option<Vector<Wide>> {
    direction(&joint.axis.each_ref().map(|x| x.value.clone()))
}

/// The result is in the frame of the joint's child; `size` is that of the chain's lengths.
fn body(urdf: &Urdf, moving: &Moving, size: &Rational) -> Option<Body> {
    let mut parts: Vec<Body> = Vec::new();
    for (link, steps) in &moving.links {
        let Some(inertial) = &urdf.links[*link].inertial else {
            continue;
        };
        let own = Body {
            mass: inertial.mass.value.clone(),
            com: [(); 3].map(|()| Rational::zero()),
            inertia: inertial.inertia.map(|entry| entry.value.clone()),
        };
        let origin = inertial.origin.placement();
        let at = way(urdf, steps)?.then(&pose(&origin));
        let size = size + origin.size();
        parts.push(moved(&own, &at, &size));
    }
    let mass: Rational = parts.iter().map(|part| &part.mass).sum();
    let is_zero = mass.is_zero();
    let centre: [Rational; 3] = core::array::from_fn(|i| {
        let moment: Rational = parts.iter().map(|part| &part.mass * &part.com[i]).sum();
        if is_zero { moment } else { moment / &mass }
    });
    let entry = |i: usize, k: usize| {
        let parts = parts.iter().map(|part| {
            // m (d·d 1 − d dᵀ)
            let d: [Rational; 3] = core::array::from_fn(|i| &part.com[i] - &centre[i]);
            let square: Rational = d.iter().map(|x| x * x).sum();
            let diagonal = if i == k { square } else { Rational::zero() };
            &part.inertia.rows()[i][k] + &part.mass * (diagonal - &d[i] * &d[k])
        });
        short(parts.sum())
    };
    let inertia = Inertia::symmetric(entry);
    let com = centre.clone().map(short);
    Some(Body { mass, com, inertia })
}

/// Returns a decimal that a person would write, or 20 digits.
fn short(value: Rational) -> Rational {
    match write_decimal(&value) {
        Some(text) if text.len() < 28 => value,
        _ => rounded(&value),
    }
}
