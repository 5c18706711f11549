//! Lines, shapes and texts as SVG.

use super::svg::Svg;

/// The side of a view, and the room above both, in pixels.
pub(super) const SIDE: f64 = 440.0;
pub(super) const HEAD: f64 = 64.0;
/// The height of a line of the table.
pub(super) const ROW: f64 = 17.0;

/// The room for a character of the table: the widest of common monospaced fonts.
const CHARACTER: f64 = 7.5;

/// Colours of equal weight on white and on black. x, y and z of frames; t and s
/// the axes of joints that turn and slide; m masses; l links; b bars.
const STYLE: &str = "\
svg{font:12px sans-serif;color:#222}\
.p{fill:#fff}.i{fill:currentColor}.c{font:12px monospace}\
.x,.y,.z,.t,.s,.l,.b{fill:none;stroke-width:1.5}\
.x{stroke:#c03030}.y{stroke:#2b8a4b}.z{stroke:#1b6ca8}\
.t,.s{stroke:#9b3fa0;stroke-width:1}.s{stroke-dasharray:5 3}\
.l{stroke:currentColor;stroke-width:4;stroke-opacity:.25;stroke-linejoin:round}\
.b{stroke:currentColor}.m{fill:#c2571a}.e{fill:#c2571a;fill-opacity:.14;stroke:#c2571a}\
@media screen and (prefers-color-scheme:dark){svg{color:#ddd}.p{fill:#111}\
.x{stroke:#ff8080}.y{stroke:#6cc98c}.z{stroke:#62b0ea}.t,.s{stroke:#d68ada}\
.m{fill:#f0935a}.e{fill:#f0935a;stroke:#f0935a}}";

/// The meaning of the marks.
const LEGEND: [&str; 2] = [
    "frames: x red, y green, z blue; arrows with numbers: axes of joints, dashed where they slide",
    "dots: centres of mass; ellipses: bodies of uniform density with the links' inertias",
];

/// Half axes in pixels, and how far the first is turned from the right, in
/// degrees upward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ellipse {
    pub(super) half: [f64; 2],
    pub(super) turned: f64,
}

/// A drawing as it grows.
pub(super) struct Page {
    svg: Svg,
}

impl Page {
    /// Returns the paper with its title, and room for a table of this height.
    pub(super) fn new(title: &str, table: f64) -> Page {
        let (width, height) = (2.0 * SIDE, HEAD + SIDE + table);
        let head = "<!-- by dalembert show -->\n";
        let svg = Svg::new(title, [width, height], head, STYLE);
        let mut page = Page { svg };
        page.text([16.0, 20.0], title);
        for (line, text) in LEGEND.iter().enumerate() {
            page.text([16.0, 36.0 + 15.0 * line as f64], text);
        }
        page
    }

    /// Draws a line.
    pub(super) fn line(&mut self, class: &str, [x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) {
        self.svg.element(&format!(
            "<path class=\"{class}\" d=\"M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}\"/>"
        ));
    }

    /// Draws a line with a point at its end; a ring where it is seen end on.
    pub(super) fn arrow(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let length = libm::sqrt(x * x + y * y);
        if length < 2.0 {
            let [x, y] = from;
            self.svg.element(&format!(
                "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\"/>"
            ));
            return;
        }
        self.line(class, from, to);
        let [x, y] = [5.0 * x / length, 5.0 * y / length];
        for side in [-0.6, 0.6] {
            let back = [to[0] - x - side * y, to[1] - y + side * x];
            self.line(class, to, back);
        }
    }

    /// Draws the links, from origin to origin.
    pub(super) fn chain(&mut self, points: &[[f64; 2]]) {
        self.svg.polyline("class=\"l\"", points);
    }

    /// Draws a centre of mass: the dot's volume grows with the mass.
    pub(super) fn dot(&mut self, [x, y]: [f64; 2], mass: f64) {
        let radius = (2.5 * libm::cbrt(mass)).clamp(1.5, 9.0);
        self.svg.element(&format!(
            "<circle class=\"m\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"/>"
        ));
    }

    /// Draws a body's outline.
    pub(super) fn ellipse(&mut self, [x, y]: [f64; 2], ellipse: Ellipse) {
        let Ellipse {
            half: [a, b],
            turned,
        } = ellipse;
        // Angles of the paper go downward.
        let turned = 0.0 - turned;
        self.svg.element(&format!(
            "<ellipse class=\"e\" rx=\"{a:.1}\" ry=\"{b:.1}\" \
             transform=\"translate({x:.1} {y:.1}) rotate({turned:.1})\"/>"
        ));
    }

    /// Draws a name beside a point.
    pub(super) fn label(&mut self, [x, y]: [f64; 2], text: &str) {
        self.text([x + 5.0, y - 4.0], text);
    }

    /// Draws a text that begins at a point.
    pub(super) fn text(&mut self, at: [f64; 2], text: &str) {
        self.svg.text("i", at, "", text);
    }

    /// Writes a line of the table: cells, each so many characters from the left. Every cell
    /// is a text of its own, since not everything that draws SVG keeps spaces.
    pub(super) fn row(&mut self, index: usize, cells: &[(usize, String)]) {
        let y = HEAD + SIDE + ROW * (index as f64 + 1.0);
        for (characters, text) in cells.iter().filter(|(_, text)| !text.is_empty()) {
            let x = 16.0 + CHARACTER * *characters as f64;
            self.svg.text("i c", [x, y], "", text);
        }
    }

    /// Returns the text of the file.
    pub(super) fn end(self) -> String {
        self.svg.end()
    }
}
