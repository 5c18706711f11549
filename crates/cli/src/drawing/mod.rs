//! A drawing of an arm as SVG, which makes a wrong sign visible: two views with frames, joint axes,
//! centres of mass and inertias, and the table that they come from.
//!
//! A link's inertia is drawn as the solid ellipsoid of uniform density that has this inertia.
//! Impossible inertias are named below the table. The same robot and position give the same bytes:
//! sines are libm's, and numbers have one decimal.
//!
//! - this file: the arm and its bodies; `paper`: lines, shapes and texts; `page`: those of an arm, in
//!   two projections; `table`: the DH rows, masses and centres of mass

mod page;
pub(crate) mod paper;
mod table;

use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::equations::matrix::{Columns, Vector};
use dalembert_model::equations::{Arm, Link};
use dalembert_model::number::Rounded;
use dalembert_model::reference::Reference;
use dalembert_model::robot::{Convention, JointKind, Robot};
use nalgebra::DVector;

pub(crate) use table::lines;

use page::View;
use paper::Paper;

struct Body {
    mass: f64,
    centre: Vector<f64>,
    /// The inertia about the centre of mass, in base axes.
    inertia: [[f64; 3]; 3],
}

/// Everything that is drawn, in base axes.
struct Scene<'r> {
    robot: &'r Robot,
    first: Columns<f64>,
    frames: Vec<Columns<f64>>,
    /// The hand, if the links have one end.
    hand: Option<Columns<f64>>,
    bodies: Vec<Body>,
}

/// Draws the arm at a position, as SVG.
///
/// # Errors
/// The position does not have one value per joint.
pub fn svg(robot: &Robot, q: &[f64]) -> Result<String, Diagnostic> {
    let runtime = Reference::<f64>::from_robot(robot);
    let at = DVector::from_column_slice(q);
    let frames = runtime.poses(&at)?;
    let scene = Scene {
        robot,
        first: runtime.arm().base.clone().unwrap_or_else(Columns::identity),
        hand: match robot.is_tree() {
            true => None,
            false => Some(runtime.hand(&at)?),
        },
        bodies: bodies(runtime.arm(), &frames),
        frames,
    };
    let mut page = Paper::of_arm(&robot.name, &table::lines(robot, q));
    for view in View::both(&scene.points(), &scene.outlines()) {
        scene.draw(&view, &mut page);
    }
    Ok(page.end())
}

/// A base that floats is a body, too, and its frame is that of the drawing.
fn bodies(arm: &Arm<f64>, frames: &[Columns<f64>]) -> Vec<Body> {
    let body = |(link, frame): (&Link<f64>, &Columns<f64>)| {
        let inertia = link.inertia.rows();
        // R I Rᵀ
        let half = inertia.map(|row| frame.rotate(&row));
        let column = |k: usize| frame.rotate(&[half[0][k], half[1][k], half[2][k]]);
        Body {
            mass: link.mass,
            centre: frame.apply(&link.com, &1.0),
            inertia: [column(0), column(1), column(2)],
        }
    };
    let (virtual_joints, base) = (arm.base_joints(), Columns::identity());
    let last = virtual_joints.checked_sub(1);
    let base = last.map(|last| (&arm.links[last], &base));
    let links = arm.links.iter().skip(virtual_joints).zip(frames);
    let bodies = base.into_iter().chain(links).map(body);
    bodies.filter(|body| body.mass > 0.0).collect()
}

impl Body {
    /// Returns an entry of 5 Σ/m, where Σ = ∫ x xᵀ dm = ½ tr(I) 1 − I. The ellipsoid of uniform density is
    /// xᵀ (5 Σ/m)⁻¹ x ≤ 1, since a half axis a has second moment m a²/5.
    fn square(&self, i: usize, k: usize) -> f64 {
        let [[x, ..], [_, y, _], [.., z]] = self.inertia;
        let diagonal = if i == k { 0.5 * (x + y + z) } else { 0.0 };
        5.0 * (diagonal - self.inertia[i][k]) / self.mass
    }

    /// Returns the half axes of the ellipse in a view, m, and the angle of the first from the right,
    /// degrees; `None` for a point or an impossible inertia. The shadow of xᵀ M⁻¹ x ≤ 1 on a plane
    /// is yᵀ N⁻¹ y ≤ 1, where N is M's block for that plane.
    fn ellipse(&self, [right, up]: [usize; 2]) -> Option<([f64; 2], f64)> {
        let [a, b, c] = [(right, right), (right, up), (up, up)].map(|(i, k)| self.square(i, k));
        let (mean, difference) = (0.5 * (a + c), 0.5 * (a - c));
        let spread = libm::sqrt(difference * difference + b * b);
        let [large, small] = [mean + spread, mean - spread];
        // By rounding, a flat body seen from its side may be thinner than zero.
        let is_body = large > 0.0 && small >= -1e-9 * large;
        let turned = 0.5 * libm::atan2(b, difference).to_degrees();
        is_body.then(|| ([large, small.max(0.0)].map(libm::sqrt), turned))
    }
}

impl Scene<'_> {
    fn points(&self) -> Vec<Vector<f64>> {
        let mut points = vec![[0.0; 3], self.first.origin];
        points.extend(self.hand.iter().map(|hand| hand.origin));
        points.extend(self.frames.iter().map(|frame| frame.origin));
        points.extend(self.bodies.iter().map(|body| body.centre));
        points
    }

    fn outlines(&self) -> Vec<Vector<f64>> {
        let boxes = self.bodies.iter().filter_map(|body| {
            let half = [0, 1, 2].map(|k| libm::sqrt(body.square(k, k).max(0.0)));
            let corner = |sign: f64| [0, 1, 2].map(|k| body.centre[k] + sign * half[k]);
            let is_body = half.iter().all(|half| half.is_finite());
            is_body.then(|| [corner(-1.0), corner(1.0)])
        });
        boxes.flatten().collect()
    }

    fn axis(&self, row: usize) -> (Vector<f64>, Vector<f64>) {
        let frame = match (self.robot.convention, row) {
            _ if self.robot.is_tree() => &self.frames[row],
            (Convention::Standard, 0) => &self.first,
            (Convention::Standard, _) => &self.frames[row - 1],
            (Convention::Modified, _) => &self.frames[row],
        };
        (frame.origin, frame.axes[2])
    }

    /// The frames along each limb, from what carries its first link to its end.
    fn limbs(&self) -> Vec<Vec<&Columns<f64>>> {
        let mut limbs: Vec<(Option<usize>, Vec<&Columns<f64>>)> = Vec::new();
        for (row, frame) in self.frames.iter().enumerate() {
            let carrier = self.robot.carrier(row);
            let goes_on = limbs.iter_mut().find(|(last, _)| *last == carrier);
            match goes_on.filter(|_| carrier.is_some()) {
                Some((last, limb)) => {
                    *last = Some(row);
                    limb.push(frame);
                }
                None => {
                    let from = carrier.map_or(&self.first, |carrier| &self.frames[carrier]);
                    limbs.push((Some(row), vec![from, frame]));
                }
            }
        }
        if let Some(hand) = &self.hand {
            limbs.iter_mut().for_each(|(_, limb)| limb.push(hand));
        }
        limbs.into_iter().map(|(_, limb)| limb).collect()
    }

    fn draw(&self, view: &View, page: &mut Paper) {
        for body in &self.bodies {
            let centre = view.place(&body.centre);
            if let Some((half, turned)) = body.ellipse(view.coordinates) {
                page.ellipse(centre, half.map(|half| view.scale * half), turned);
            }
            let radius = (2.5 * libm::cbrt(body.mass)).clamp(1.5, 9.0);
            page.circle("m", centre, radius);
        }
        for limb in self.limbs() {
            page.polyline("l", limb.into_iter().map(|frame| view.place(&frame.origin)));
        }
        let mut labels: Vec<([f64; 2], String)> = Vec::new();
        // A joint that follows another has the number of the joint that moves it.
        for (row, joint) in self.robot.rows().into_iter().enumerate() {
            let (through, along) = self.axis(row);
            let end = |by: f64| {
                let by = by * view.reach;
                view.place(&[0, 1, 2].map(|k| through[k] + by * along[k]))
            };
            let class = match joint.kind {
                JointKind::Revolute => "t",
                JointKind::Prismatic => "s",
            };
            let to = end(0.12);
            page.arrow(class, end(-0.09), to);
            label(&mut labels, to, (self.robot.mover_of(row) + 1).to_string());
        }
        if let Some(hand) = &self.hand {
            let hand = view.place(&hand.origin);
            label(&mut labels, [hand[0], hand[1] + 16.0], "hand".to_owned());
        }
        view.triad(&Columns::identity(), 0.16, page);
        for frame in &self.frames {
            view.triad(frame, 0.06, page);
        }
        if let Some(hand) = &self.hand {
            view.triad(hand, 0.1, page);
        }
        // Drawn last, so that no line crosses a text.
        view.head(page);
        let gravity = self.robot.gravity.each_ref().map(f64::nearest_rational);
        view.gravity(&gravity, page);
        for (at, text) in labels {
            page.label(at, &text);
        }
    }
}

/// Appends the text to a label that it would overlap, as those of coaxial joints do.
fn label(labels: &mut Vec<([f64; 2], String)>, at: [f64; 2], text: String) {
    /// Labels nearer than this, in pixels, overlap.
    const NEAR: [f64; 2] = [14.0, 12.0];
    let is_near = |other: &[f64; 2]| (0..2).all(|k| (other[k] - at[k]).abs() < NEAR[k]);
    match labels.iter_mut().find(|(other, _)| is_near(other)) {
        Some((_, there)) => *there += &format!(", {text}"),
        None => labels.push((at, text)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A solid ellipsoid with half axes 3, 2 and 1 along x, y and z: I_xx = m (b² + c²)/5.
    #[test]
    fn half_axes_come_back() {
        let body = |inertia| Body {
            mass: 5.0,
            centre: [0.0; 3],
            inertia,
        };
        let solid = body([[5.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 13.0]]);
        assert_eq!(solid.ellipse([0, 1]), Some(([3.0, 2.0], 0.0)));
        assert_eq!(solid.ellipse([1, 0]), Some(([3.0, 2.0], 90.0)));
        assert_eq!(solid.ellipse([0, 2]), Some(([3.0, 1.0], 0.0)));
        // No body has one moment above the sum of the others, and a point has no outline.
        let impossible = body([[9.0, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
        assert_eq!(impossible.ellipse([0, 1]), None);
        assert_eq!(body([[0.0; 3]; 3]).ellipse([0, 1]), None);
    }
}
