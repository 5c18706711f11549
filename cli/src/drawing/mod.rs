//! A drawing of an arm, so that a wrong sign is seen: two views with frames,
//! joint axes, centres of mass and inertias, and the table that they come from.
//!
//! - this file: what is drawn where
//! - `view`: a projection onto the paper
//! - `labels`: the numbers of joints at their axes
//! - `outline`: the ellipse that a link's inertia is seen as
//! - [`mod@svg`]: an SVG file as it grows; `page`: lines, texts and shapes in it
//! - `table`: the DH rows, masses and centres as text
//!
//! A link's inertia is drawn as the solid ellipsoid of uniform density that has it.
//! Bodies that no link can have are named below the table. The same robot and position
//! give the same bytes: sines are libm's, numbers have one decimal.

mod labels;
mod outline;
mod page;
pub mod svg;
mod table;
mod view;

use dalembert_model::equations::matrix::{Columns, Vector};
use dalembert_model::number::Rounded;
use dalembert_model::reference::{Reference, WrongLength};
use dalembert_model::robot::{Convention, JointKind, Robot};
use nalgebra::DVector;

use labels::Labels;
use page::Page;
use view::View;

/// Draws the arm at a position, as SVG.
///
/// # Errors
/// The position has not one value a joint.
pub fn svg(robot: &Robot, q: &[f64]) -> Result<String, WrongLength> {
    let runtime = Reference::<f64>::from_robot(robot);
    let at = DVector::from_column_slice(q);
    let frames = runtime.poses(&at)?;
    let base = runtime.arm().base.clone();
    let first = base.unwrap_or_else(Columns::identity);
    let scene = Scene {
        robot,
        hand: runtime.hand(&at)?,
        bodies: bodies(robot, &frames),
        axes: axes(robot, &first, &frames),
        first,
        frames,
    };
    let points = scene.points();
    let mut page = Page::new(&robot.name, table::height(robot, q));
    for view in View::both(&points, &scene.outlines()) {
        scene.draw(&view, &mut page);
    }
    table::write(robot, q, &mut page);
    Ok(page.end())
}

/// Everything that is drawn, in base axes.
struct Scene<'r> {
    robot: &'r Robot,
    first: Columns<f64>,
    frames: Vec<Columns<f64>>,
    hand: Columns<f64>,
    axes: Vec<Axis>,
    bodies: Vec<Body>,
}

/// A joint's axis.
struct Axis {
    through: Vector<f64>,
    along: Vector<f64>,
}

/// A link's mass, where it is.
struct Body {
    mass: f64,
    centre: Vector<f64>,
    /// About the centre in base axes.
    inertia: [[f64; 3]; 3],
}

fn axes(robot: &Robot, first: &Columns<f64>, frames: &[Columns<f64>]) -> Vec<Axis> {
    let axis = |i: usize| {
        let frame = match (robot.convention, i) {
            (Convention::Standard, 0) => first,
            (Convention::Standard, _) => &frames[i - 1],
            (Convention::Modified, _) => &frames[i],
        };
        Axis {
            through: frame.origin,
            along: frame.axes[2],
        }
    };
    (0..frames.len()).map(axis).collect()
}

fn bodies(robot: &Robot, frames: &[Columns<f64>]) -> Vec<Body> {
    let body = |(joint, frame): (&dalembert_model::robot::Joint, &Columns<f64>)| {
        let com = joint.com.each_ref().map(f64::nearest_rational);
        let own = joint.inertia.map(f64::nearest_rational).rows();
        // R I Rᵀ
        let half = own.map(|row| frame.rotate(&row));
        let column = |k: usize| frame.rotate(&[half[0][k], half[1][k], half[2][k]]);
        Body {
            mass: f64::nearest_rational(&joint.mass),
            centre: frame.apply(&com, &1.0),
            inertia: [column(0), column(1), column(2)],
        }
    };
    robot.rows().into_iter().zip(frames).map(body).collect()
}

impl Scene<'_> {
    /// Points that both views must have room for.
    fn points(&self) -> Vec<Vector<f64>> {
        let mut points = vec![[0.0; 3], self.first.origin, self.hand.origin];
        points.extend(self.frames.iter().map(|frame| frame.origin));
        points.extend(self.bodies.iter().map(|body| body.centre));
        points
    }

    /// Returns the corners of boxes around the bodies, for which the paper must have room.
    fn outlines(&self) -> Vec<Vector<f64>> {
        let solid = self.bodies.iter().filter(|body| body.mass > 0.0);
        let boxes = solid.filter_map(|body| {
            let half = outline::reach(body.mass, &body.inertia)?;
            let corner = |sign: f64| core::array::from_fn(|k| body.centre[k] + sign * half[k]);
            Some([corner(-1.0), corner(1.0)])
        });
        boxes.flatten().collect()
    }

    fn draw(&self, view: &View, page: &mut Page) {
        view.head(page);
        let gravity = self.robot.gravity.each_ref().map(f64::nearest_rational);
        view.gravity(&gravity, page);
        for body in &self.bodies {
            if body.mass > 0.0 {
                if let Some(outline) = outline::seen(body.mass, &body.inertia, view) {
                    page.ellipse(view.place(&body.centre), outline);
                }
                page.dot(view.place(&body.centre), body.mass);
            }
        }
        // From frame to frame, and on to the hand.
        let origins = [&self.first].into_iter().chain(&self.frames);
        let origins = origins
            .chain([&self.hand])
            .map(|frame| view.place(&frame.origin));
        page.chain(&origins.collect::<Vec<_>>());
        let reach = view.reach();
        let mut labels = Labels::default();
        // Those that follow others have the number of the joint that moves them.
        for (row, (axis, joint)) in self.axes.iter().zip(self.robot.rows()).enumerate() {
            let end = |by: f64| -> Vector<f64> {
                core::array::from_fn(|k| axis.through[k] + by * axis.along[k])
            };
            let class = match joint.kind {
                JointKind::Revolute => "t",
                JointKind::Prismatic => "s",
            };
            let (from, to) = (
                view.place(&end(-0.09 * reach)),
                view.place(&end(0.12 * reach)),
            );
            page.arrow(class, from, to);
            labels.add(to, self.robot.mover_of(row) + 1);
        }
        labels.write(page);
        view.triad(&Columns::identity(), 0.16, page);
        for frame in &self.frames {
            view.triad(frame, 0.06, page);
        }
        view.triad(&self.hand, 0.1, page);
    }
}
