//! Links that are fixed to each other, as one body of each joint that moves.

use std::collections::BTreeMap;
use std::fmt::Display;

use dalembert_model::equations::matrix::{Columns, Vector};
use dalembert_model::number::parse::write_decimal;
use dalembert_model::number::recover::rounded;
use dalembert_model::number::{Rational, Wide};
use dalembert_model::placed::Body;
use dalembert_model::placed::frame::{direction, moved, placement, pose, turned};
use dalembert_model::robot::{Defect, Inertia, Placement, Position};
use dalembert_model::scalar::Scalar;
use num_traits::{One, Signed, Zero};

use crate::meant::{NOTHING, power};
use crate::model::{Inertial, Joint, Link, Model, Role};
use crate::problems::Problems;
use crate::select::{Selection, State};

/// A robot as a tree: each joint that moves, with all that is fixed to its link as one body.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// The base with all that is fixed to it, if it floats.
    pub(crate) base: Option<Body>,
    /// Each body after the one that it hangs on.
    pub(crate) bodies: Vec<Branch>,
    /// Every link that moves, in the frame of the joint that moves it, or of a base that floats.
    pub(crate) frames: Vec<Frame>,
    /// The tips that move, each in the frame of its body.
    pub(crate) ends: Vec<(usize, Placement)>,
}

#[derive(Clone, Debug)]
pub(crate) struct Branch {
    /// The joint, by its place in the model.
    pub(crate) joint: usize,
    /// The body that the joint hangs on; none where that is the base.
    pub(crate) parent: Option<usize>,
    /// The joint's frame at q = 0 in that of the body it hangs on.
    pub(crate) pose: Columns<Wide>,
    pub(crate) placement: Placement,
    pub(crate) axis: Vector<Wide>,
    pub(crate) body: Body,
}

#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) link: usize,
    /// None for a base that floats.
    pub(crate) body: Option<usize>,
    pub(crate) placement: Placement,
}

pub(crate) fn merged(
    model: &Model,
    selection: &Selection,
    problems: &mut Problems,
) -> Option<Tree> {
    let length = |joint: &usize| model.joints[*joint].origin.placement().size();
    let size = size_of(selection.order.iter().map(length).sum());
    let mut bodies: Vec<Branch> = Vec::new();
    // For each link: its body, its pose in the body, and true if that is the body's frame.
    let mut places: BTreeMap<usize, (Option<usize>, Columns<Wide>, bool)> = BTreeMap::new();
    places.insert(selection.base, (None, Columns::identity(), true));
    for index in &selection.order {
        let joint = &model.joints[*index];
        let [parent, child] = model.ends[*index];
        let (body, way, is_its_frame) = places.get(&parent)?.clone();
        let placed = way.then(&pose(&joint.origin.placement()));
        let place = match &selection.states[*index] {
            State::Stays(None) => (body, placed, false),
            State::Stays(Some(at)) => (body, placed.then(&displaced(joint, at)?), false),
            State::Moves => {
                // Without a fixed link between, keep the file's placement.
                let placement = match is_its_frame {
                    true => joint.origin.placement(),
                    false => placement(&placed, &size),
                };
                bodies.push(Branch {
                    joint: *index,
                    parent: body,
                    pose: placed,
                    placement,
                    axis: direction_of(joint)?,
                    body: combined(&[]),
                });
                (Some(bodies.len() - 1), Columns::identity(), true)
            }
        };
        places.insert(child, place);
    }
    let mut frames = Vec::new();
    let mut good = true;
    let mut base = selection.floats.then(|| combined(&[]));
    let of_base = base.iter_mut().map(|body| (None, body));
    let branches = bodies.iter_mut().enumerate();
    let of_joints = branches.map(|(index, branch)| (Some(index), &mut branch.body));
    for (index, merged) in of_base.chain(of_joints) {
        let mut parts = Vec::new();
        for (link, (_, way, _)) in places.iter().filter(|(_, (body, ..))| *body == index) {
            frames.push(Frame {
                link: *link,
                body: index,
                placement: placement(way, &size),
            });
            let link = &model.links[*link];
            let Some(inertial) = &link.inertial else {
                continue;
            };
            let origin = inertial.origin.placement();
            let inertia = possible(link, inertial, &(&size + origin.size()), problems);
            let Some(inertia) = inertia else {
                good = false;
                continue;
            };
            let body = Body {
                inertia,
                ..inertial.body()
            };
            let pose = way.then(&pose(&origin));
            parts.push(moved(&body, &pose, &(&size + origin.size())));
        }
        *merged = combined(&parts);
    }
    if !good {
        return None;
    }
    let has_nothing = |branch: &&Branch| {
        let tensor = &branch.body.inertia.rows();
        branch.body.mass.is_zero() && tensor.iter().flatten().all(Zero::is_zero)
    };
    let branches = bodies.iter().filter(has_nothing);
    let links = branches.map(|branch| &model.links[model.ends[branch.joint][1]]);
    let empty: Vec<&Link> = links.filter(|link| link.role == Role::Body).collect();
    if let Some(first) = empty.first() {
        let names: Vec<&str> = empty.iter().map(|link| link.name.as_str()).collect();
        let id = match names.len() {
            1 => "massless",
            _ => "massless_links",
        };
        problems.report(id, &first.at, &[&names.join("`, `")]);
    }
    let ends = selection.tips.iter().filter_map(|tip| {
        let (body, way, _) = places.get(tip)?;
        Some((body.as_ref().copied()?, placement(way, &size)))
    });
    Some(Tree {
        base,
        ends: ends.collect(),
        bodies,
        frames,
    })
}

impl Tree {
    /// True if a body carries two others, or the base does.
    pub(crate) fn branches(&self) -> bool {
        let mut bodies = self.bodies.iter().enumerate();
        bodies.any(|(index, body)| body.parent != index.checked_sub(1))
    }

    /// True if joints are placed in the robot file, and have no rows: it branches, or its base floats.
    pub(crate) fn is_placed(&self) -> bool {
        self.base.is_some() || self.branches()
    }

    /// Returns the hand in the frame of the last body, if all bodies lie on one chain.
    pub(crate) fn hand(&self) -> Option<&Placement> {
        let place = self.bodies.len().checked_sub(1);
        let last = place.filter(|_| !self.is_placed())?;
        let (_, placement) = self.ends.iter().find(|(body, _)| *body == last)?;
        Some(placement)
    }
}

/// Returns the inertia of a link whose defects are no larger than rounding errors without them.
/// Other defects are said: a negative moment as an error.
fn possible(
    link: &Link,
    inertial: &Inertial,
    size: &Rational,
    problems: &mut Problems,
) -> Option<Inertia<Rational>> {
    let exact = inertial.inertia.map(|entry| entry.value.clone());
    let Some(defect) = exact.defect(&inertial.mass.value) else {
        return Some(exact);
    };
    let at = &inertial.inertia.xx.at;
    let words: [&dyn Display; 2] = [&link.name, &defect.message()];
    if defect != Defect::NegativeMoment {
        problems.report("impossible", at, &words);
        return Some(exact);
    }
    let rows = exact.rows();
    let entries = rows.iter().flatten().map(Signed::abs);
    let largest = entries.max().unwrap_or_default();
    let dust = largest.max(&inertial.mass.value * size * size) * power(NOTHING);
    let swept = exact.map(|entry| match entry.abs() <= dust {
        true => Rational::zero(),
        false => entry.clone(),
    });
    let lifted = shifted(&swept, &dust);
    let is_possible = |inertia: &Inertia<Rational>| {
        inertia.defect(&Rational::one()) != Some(Defect::NegativeMoment)
    };
    let inertia = [swept, lifted].into_iter().find(is_possible);
    let id = inertia.as_ref().map_or("negative_moment", |_| "dust");
    problems.report(id, at, &words);
    inertia
}

/// Returns a tensor with all principal moments larger by this.
pub(crate) fn shifted(tensor: &Inertia<Rational>, by: &Rational) -> Inertia<Rational> {
    let rows = tensor.rows();
    Inertia::symmetric(|i, k| match i == k {
        true => &rows[i][k] + by,
        false => rows[i][k].clone(),
    })
}

/// Returns the length scale: the sum of all lengths, or 1 without any.
pub(crate) fn size_of(sum: Rational) -> Rational {
    if sum.is_zero() { One::one() } else { sum }
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

/// Returns bodies in one frame that are fixed to each other as one body.
pub(crate) fn combined(parts: &[Body]) -> Body {
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
    Body { mass, com, inertia }
}

/// Returns a decimal that a person would write, or 20 digits.
fn short(value: Rational) -> Rational {
    match write_decimal(&value) {
        Some(text) if text.len() < 28 => value,
        _ => rounded(&value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::select::select;
    use crate::{Options, Text, read_model};

    /// Two arms on one torso are a tree, whose branches are those of each arm by itself.
    #[test]
    fn several_tips_make_a_tree() {
        let folder = env!("CARGO_MANIFEST_DIR");
        let path = format!("{folder}/../../gallery/urdf/baxter.urdf");
        let text = Text::of("baxter", std::fs::read_to_string(path).unwrap());
        let tree = |tips: &[&str]| {
            let mut problems = Problems::of(&text);
            let options = Options {
                lock: vec![("*".to_owned(), "0".to_owned())],
                tips: tips.iter().map(|tip| (*tip).to_owned()).collect(),
                ..Options::default()
            };
            let model = read_model(&text, &options, &mut problems).unwrap();
            let selection = select(&model, &options, &mut problems).unwrap();
            merged(&model, &selection, &mut problems).unwrap()
        };
        let hands = ["left_hand_link", "right_hand_link"];
        let both = tree(&hands);
        assert_eq!((both.bodies.len(), both.ends.len()), (14, 2));
        assert!(both.branches() && both.hand().is_none());
        let first = both.bodies.iter().filter(|body| body.parent.is_none());
        assert_eq!(first.count(), 2);
        for (tip, (_, tool)) in hands.iter().zip(&both.ends) {
            let alone = tree(&[tip]);
            assert_eq!((alone.bodies.len(), alone.hand()), (7, Some(tool)));
            for (index, body) in alone.bodies.iter().enumerate() {
                assert_eq!(body.parent, index.checked_sub(1));
                let mut others = both.bodies.iter();
                let same = others.find(|other| other.joint == body.joint).unwrap();
                assert_eq!((&same.body, &same.placement), (&body.body, &body.placement));
                let parent = |tree: &Tree, of: &Branch| Some(tree.bodies[of.parent?].joint);
                assert_eq!(parent(&both, same), parent(&alone, body));
            }
        }
    }
}
