//! The page of an arm: its table, its shapes, and the two projections onto the paper.

use dalembert_model::equations::matrix::{Columns, Vector};

use super::paper::Paper;

/// The side of a view, and the room above both, in pixels.
const SIDE: f64 = 440.0;
const HEAD: f64 = 64.0;
const ROW: f64 = 17.0;
/// The width of a character of the table, pixels: that of the widest common monospaced font.
const CHARACTER: f64 = 7.5;

/// Rules of the classes, for white and black paper: x, y and z axes of frames; t and s axes of
/// revolute and prismatic joints; m masses; e bodies; l links; b bars.
const STYLE: [&str; 2] = [
    "\
.x,.y,.z,.t,.s,.l,.b{fill:none;stroke-width:1.5}\
.x{stroke:#c03030}.y{stroke:#2b8a4b}.z{stroke:#1b6ca8}\
.t,.s{stroke:#9b3fa0;stroke-width:1}.s{stroke-dasharray:5 3}\
.l{stroke:currentColor;stroke-width:4;stroke-opacity:.25;stroke-linejoin:round}\
.b{stroke:currentColor}.m{fill:#c2571a}.e{fill:#c2571a;fill-opacity:.14;stroke:#c2571a}",
    "\
.x{stroke:#ff8080}.y{stroke:#6cc98c}.z{stroke:#62b0ea}.t,.s{stroke:#d68ada}\
.m{fill:#f0935a}.e{fill:#f0935a;stroke:#f0935a}",
];

const LEGEND: [&str; 2] = [
    "frames: x red, y green, z blue; numbered arrows: axes of joints, dashed if prismatic",
    "dots: centres of mass; ellipses: bodies of uniform density with the links' inertias",
];

impl Paper {
    pub(super) fn of_arm(title: &str, table: &[String]) -> Paper {
        let rows = table.len() as f64;
        let widest = table.iter().map(|line| line.chars().count()).max();
        let table_width = 32.0 + CHARACTER * widest.unwrap_or(0) as f64;
        let width = table_width.max(2.0 * SIDE);
        let height = HEAD + SIDE + ROW * (rows + 1.5);
        let mut page = Paper::new([width, height], title, "show", STYLE);
        page.text("i", [16.0, 20.0], title);
        for (line, text) in LEGEND.iter().enumerate() {
            page.text("i", [16.0, 36.0 + 15.0 * line as f64], text);
        }
        for (index, line) in table.iter().enumerate() {
            // Some SVG viewers merge spaces.
            let y = HEAD + SIDE + ROW * (index as f64 + 1.0);
            page.text("i c", [16.0, y], &line.replace("  ", "\u{a0}\u{a0}"));
        }
        page
    }

    pub(super) fn arrow(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let length = libm::sqrt(x * x + y * y);
        if length < 2.0 {
            return self.circle(class, from, 6.0);
        }
        self.line(class, from, to);
        let [x, y] = [5.0 * x / length, 5.0 * y / length];
        for side in [-0.6, 0.6] {
            self.line(class, to, [to[0] - x - side * y, to[1] - y + side * x]);
        }
    }

    /// Draws a body's outline, turned counterclockwise by `turned` degrees.
    pub(super) fn ellipse(&mut self, [x, y]: [f64; 2], [a, b]: [f64; 2], turned: f64) {
        // SVG turns clockwise.
        let turned = 0.0 - turned;
        self.element(&format!(
            "<ellipse class=\"e\" rx=\"{a:.1}\" ry=\"{b:.1}\" \
             transform=\"translate({x:.1} {y:.1}) rotate({turned:.1})\"/>"
        ));
    }

    pub(super) fn label(&mut self, [x, y]: [f64; 2], text: &str) {
        self.text("i", [x + 5.0, y - 4.0], text);
    }
}

/// A projection onto the paper: along y, seen from the front, or along z, from above.
pub(super) struct View {
    name: &'static str,
    /// The coordinates that go to the right and upward.
    pub(super) coordinates: [usize; 2],
    /// Pixels per metre, the same in both views.
    pub(super) scale: f64,
    middle: [f64; 2],
    at: [f64; 2],
    /// The size of the arm, m.
    pub(super) reach: f64,
}

/// The margin around the arm, as a fraction of a view.
const MARGIN: f64 = 0.16;
/// The margin around bodies, so that none covers a view's name or its scale bar.
const EDGE: f64 = 0.07;

impl View {
    /// From the front (x to the right, z up) and from above (x to the right, y up).
    pub(super) fn both(points: &[Vector<f64>], outlines: &[Vector<f64>]) -> [View; 2] {
        let ranges = [0, 1, 2].map(|k| {
            let values = || points.iter().map(|point| point[k]);
            let low = values().fold(f64::INFINITY, f64::min);
            [low, values().fold(f64::NEG_INFINITY, f64::max)]
        });
        let lengths = ranges.iter().map(|[low, high]| high - low);
        let reach = lengths.fold(0.0, f64::max);
        // An arm without lengths still has axes to draw.
        let has_lengths = reach > 0.0 && reach.is_finite();
        let reach = if has_lengths { reach } else { 1.0 };
        let middle = |k: usize| 0.5 * (ranges[k][0] + ranges[k][1]);
        let offsets = |corner: &Vector<f64>| [0, 1, 2].map(|k| (corner[k] - middle(k)).abs());
        let furthest = outlines.iter().flat_map(offsets).fold(0.0, f64::max);
        let scale = SIDE * (1.0 - 2.0 * MARGIN) / reach;
        let view = |name, coordinates: [usize; 2], left: f64| View {
            name,
            coordinates,
            scale: match furthest > 0.0 {
                true => scale.min(SIDE * (0.5 - EDGE) / furthest),
                false => scale,
            },
            middle: coordinates.map(middle),
            at: [left + 0.5 * SIDE, HEAD + 0.5 * SIDE],
            reach,
        };
        [
            view("from the front: x to the right, z up", [0, 2], 0.0),
            view("from above: x to the right, y up", [0, 1], SIDE),
        ]
    }

    pub(super) fn place(&self, point: &Vector<f64>) -> [f64; 2] {
        let [right, up] = self.coordinates.map(|k| point[k]);
        [
            self.at[0] + self.scale * (right - self.middle[0]),
            self.at[1] - self.scale * (up - self.middle[1]),
        ]
    }

    pub(super) fn head(&self, page: &mut Paper) {
        let [x, y] = [self.at[0] - 0.5 * SIDE + 16.0, HEAD + 10.0];
        page.text("i", [x, y], self.name);
        // The largest of 1, 2 and 5 times a power of ten that is not above a third of the arm.
        let length = self.reach / 3.0;
        let power = libm::pow(10.0, libm::floor(libm::log10(length)));
        let digit = [5.0, 2.0].into_iter().find(|digit| digit * power <= length);
        let bar = digit.unwrap_or(1.0) * power;
        let from = [x, HEAD + SIDE - 14.0];
        page.line("b", from, [x + self.scale * bar, from[1]]);
        page.text("i", [x, from[1] - 5.0], &format!("{bar} m"));
    }

    pub(super) fn gravity(&self, gravity: &Vector<f64>, page: &mut Paper) {
        let size = libm::sqrt(gravity.iter().map(|g| g * g).sum());
        let from = [self.at[0] + 0.5 * SIDE - 40.0, HEAD + 60.0];
        if size == 0.0 {
            return page.text("i", [from[0] - 60.0, from[1]], "no gravity");
        }
        let [right, up] = self.coordinates;
        // Right × up points to the viewer.
        let sight = gravity[3 - right - up] * if (right + 1) % 3 == up { 1.0 } else { -1.0 };
        let [right, up] = [right, up].map(|k| 34.0 * gravity[k] / size);
        let to = [from[0] + right, from[1] - up];
        match right.abs() + up.abs() < 1.0 {
            true => page.label(from, if sight > 0.0 { "g ⊙" } else { "g ⊗" }),
            false => {
                page.arrow("b", from, to);
                page.label(to, "g");
            }
        }
    }

    pub(super) fn triad(&self, frame: &Columns<f64>, size: f64, page: &mut Paper) {
        let from = self.place(&frame.origin);
        let length = size * self.reach;
        for (class, axis) in ["x", "y", "z"].into_iter().zip(&frame.axes) {
            let end = [0, 1, 2].map(|k| frame.origin[k] + length * axis[k]);
            page.line(class, from, self.place(&end));
        }
    }
}
