//! A projection onto the paper: along y, seen from the front, or along z, from
//! above.

use dalembert_model::equations::matrix::{Columns, Vector};

use super::page::{HEAD, Page, SIDE};

/// Where the coordinates of base axes go.
pub(super) struct View {
    name: &'static str,
    /// The coordinates that go to the right and upward.
    pub(super) coordinates: [usize; 2],
    /// Pixels a metre, the same in both views.
    scale: f64,
    /// The point in the middle of the view, and its place on the paper.
    middle: [f64; 2],
    at: [f64; 2],
    /// The size of the arm, m.
    reach: f64,
}

/// Room around what is drawn, as a part of a view.
const MARGIN: f64 = 0.16;
/// Room around bodies.
const EDGE: f64 = 0.02;

impl View {
    /// Returns the view from the front, x to the right and z upward, and from above, x to
    /// the right and y upward. Both have room for what is drawn at the points, and
    /// for the outlines of bodies.
    pub(super) fn both(points: &[Vector<f64>], outlines: &[Vector<f64>]) -> [View; 2] {
        let range = |k: usize| {
            let values = || points.iter().map(move |point| point[k]);
            [
                values().fold(f64::INFINITY, f64::min),
                values().fold(f64::NEG_INFINITY, f64::max),
            ]
        };
        let ranges = [range(0), range(1), range(2)];
        let reach = ranges
            .iter()
            .map(|[low, high]| high - low)
            .fold(0.0, f64::max);
        // An arm without lengths still has axes.
        let reach = if reach > 0.0 && reach.is_finite() {
            reach
        } else {
            1.0
        };
        let middle = |k: usize| 0.5 * (ranges[k][0] + ranges[k][1]);
        let offsets = outlines.iter().flat_map(|corner| {
            let offset = |k: usize| (corner[k] - middle(k)).abs();
            [0, 1, 2].map(offset)
        });
        let furthest = offsets.fold(0.0, f64::max);
        let scale = SIDE * (1.0 - 2.0 * MARGIN) / reach;
        let scale = match furthest > 0.0 {
            true => scale.min(SIDE * (0.5 - EDGE) / furthest),
            false => scale,
        };
        let view = |name, coordinates: [usize; 2], left: f64| View {
            name,
            coordinates,
            scale,
            middle: coordinates.map(middle),
            at: [left + 0.5 * SIDE, HEAD + 0.5 * SIDE],
            reach,
        };
        [
            view("from the front: x to the right, z up", [0, 2], 0.0),
            view("from above: x to the right, y up", [0, 1], SIDE),
        ]
    }

    /// Returns the size of the arm, m.
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// Pixels a metre.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// Returns where a point is on the paper.
    pub(super) fn place(&self, point: &Vector<f64>) -> [f64; 2] {
        let [right, up] = self.coordinates.map(|k| point[k]);
        [
            self.at[0] + self.scale * (right - self.middle[0]),
            self.at[1] - self.scale * (up - self.middle[1]),
        ]
    }

    /// Draws the view's name, and a bar that says how long a length is.
    pub(super) fn head(&self, page: &mut Page) {
        let [x, y] = [self.at[0] - 0.5 * SIDE + 16.0, HEAD + 10.0];
        page.text([x, y], self.name);
        let bar = decade(self.reach / 3.0);
        let from = [x, HEAD + SIDE - 14.0];
        page.line("b", from, [x + self.scale * bar, from[1]]);
        page.text([x, from[1] - 5.0], &format!("{bar} m"));
    }

    /// Returns how much of a vector comes towards who looks: right × up points there.
    fn toward_the_eye(&self, vector: &Vector<f64>) -> f64 {
        let [right, up] = self.coordinates;
        let depth = 3 - right - up;
        match (right + 1) % 3 == up {
            true => vector[depth],
            false => -vector[depth],
        }
    }

    /// Draws where gravity pulls; ⊙ and ⊗ along the line of sight, towards the eye and away from
    /// it.
    pub(super) fn gravity(&self, gravity: &Vector<f64>, page: &mut Page) {
        let square: f64 = gravity.iter().map(|g| g * g).sum();
        let size = libm::sqrt(square);
        let from = [self.at[0] + 0.5 * SIDE - 40.0, HEAD + 60.0];
        if size == 0.0 {
            page.text([from[0] - 60.0, from[1]], "no gravity");
            return;
        }
        let [right, up] = self.coordinates.map(|k| 34.0 * gravity[k] / size);
        let to = [from[0] + right, from[1] - up];
        match right.abs() + up.abs() < 1.0 {
            true if self.toward_the_eye(gravity) > 0.0 => page.label(from, "g ⊙"),
            true => page.label(from, "g ⊗"),
            false => {
                page.arrow("b", from, to);
                page.label(to, "g");
            }
        }
    }

    /// Draws the axes of a frame, x, y and z in their colours.
    pub(super) fn triad(&self, frame: &Columns<f64>, size: f64, page: &mut Page) {
        let from = self.place(&frame.origin);
        for (class, axis) in ["x", "y", "z"].into_iter().zip(&frame.axes) {
            let length = size * self.reach;
            let end: Vector<f64> = core::array::from_fn(|k| frame.origin[k] + length * axis[k]);
            page.line(class, from, self.place(&end));
        }
    }
}

/// Returns the largest of 1, 2 and 5 times a power of ten that is not above a length.
fn decade(length: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(length)));
    let digit = [5.0, 2.0].into_iter().find(|digit| digit * power <= length);
    digit.unwrap_or(1.0) * power
}
