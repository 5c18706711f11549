//! The picture as it grows: paper, axes, curves, marks and a legend.
//!
//! Curves differ in colour and in dashes, marks in colour and in shape, so
//! that print without colours is legible. The paper is part of the picture,
//! white or dark as the reader's screen is.

use crate::drawing::svg::{Svg, escaped};

use super::axis::Axis;

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 172.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 50.0;

/// Room for a number beside or below an axis.
const ABOVE_EACH_OTHER: f64 = 18.0;
const BESIDE_EACH_OTHER: f64 = 48.0;

/// Colours of equal weight on white and on black; what they are for names
/// them, and whatever is drawn takes them from there.
const STYLE: &str = "\
svg{font:12px sans-serif;color:#222}\
.k0{color:#1b6ca8}.k1{color:#c2571a}.k2{color:#2b8a4b}.k3{color:#9b3fa0}.d{color:#777}\
.p{fill:#fff}.i{fill:currentColor}.g{stroke:currentColor;stroke-opacity:.14}\
.l{fill:none;stroke:currentColor;stroke-width:1.75}\
.b{fill:none;stroke:currentColor;stroke-dasharray:4 4}\
.w{fill:none;stroke:currentColor;stroke-opacity:.7}\
.f{fill:currentColor}.o{fill:#fff;stroke:currentColor;stroke-width:1.75}\
@media screen and (prefers-color-scheme:dark){svg{color:#ddd}.p,.o{fill:#111}\
.k0{color:#62b0ea}.k1{color:#f0935a}.k2{color:#6cc98c}.k3{color:#d68ada}.d{color:#999}}";

/// Dashes tell curves apart where colours do not print.
const DASHES: [&str; 4] = ["", "7 4", "2 3", "9 3 2 3"];

/// The look of a mark. An open one shows a full one that lies on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    Ring,
    Dot,
    OpenDiamond,
    Diamond,
}

/// A picture.
pub struct Picture {
    svg: Svg,
    legends: usize,
}

impl Picture {
    /// Returns the horizontal axis over values.
    pub fn across(values: impl Iterator<Item = f64>) -> Axis {
        Axis::over(values, [LEFT, WIDTH - RIGHT], BESIDE_EACH_OTHER)
    }

    /// Returns the vertical axis over values.
    pub fn upward(values: impl Iterator<Item = f64>) -> Axis {
        Axis::over(values, [HEIGHT - BOTTOM, TOP], ABOVE_EACH_OTHER)
    }

    /// Returns the paper with its title, the axes and their names.
    pub fn new(title: &str, [x, y]: [&Axis; 2], [below, beside]: [&str; 2]) -> Picture {
        let mut picture = Picture {
            svg: Svg::new(title, [WIDTH, HEIGHT], "", STYLE),
            legends: 0,
        };
        let (right, foot) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
        picture.text([(LEFT + right) / 2.0, 22.0], "middle", title);
        for tick in x.ticks() {
            let at = tick.place;
            picture
                .svg
                .element(&format!("<path class=\"g\" d=\"M{at:.1} {TOP}V{foot}\"/>"));
            if let Some(name) = tick.name {
                picture.text([at, foot + 16.0], "middle", &name);
            }
        }
        for tick in y.ticks() {
            let at = tick.place;
            picture.svg.element(&format!(
                "<path class=\"g\" d=\"M{LEFT} {at:.1}H{right}\"/>"
            ));
            if let Some(name) = tick.name {
                picture.text([LEFT - 6.0, at + 4.0], "end", &name);
            }
        }
        picture.text([(LEFT + right) / 2.0, HEIGHT - 12.0], "middle", below);
        let (middle, beside) = ((TOP + foot) / 2.0, escaped(beside));
        picture.svg.element(&format!(
            "<text class=\"i\" x=\"16\" y=\"{middle}\" text-anchor=\"middle\" \
             transform=\"rotate(-90 16 {middle})\">{beside}</text>"
        ));
        picture
    }

    /// Draws a curve in one of four colours and one of four dashes.
    pub fn curve(&mut self, colour: usize, dashes: usize, points: &[[f64; 2]]) {
        let colour = colour % DASHES.len();
        let dashes = match DASHES[dashes % DASHES.len()] {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        let attributes = format!("class=\"k{colour} l\"{dashes}");
        self.svg.polyline(&attributes, points);
    }

    /// Draws a line from a mark to where its end is marked, not shorter than a mark: that could
    /// not be seen.
    pub fn whisker(&mut self, class: &str, [x, y]: [f64; 2], end: f64) {
        if (x - end).abs() > 6.0 {
            let top = y - 3.0;
            self.svg.element(&format!(
                "<path class=\"{class} w\" d=\"M{x:.1} {y:.1}H{end:.1}M{end:.1} {top:.1}v6\"/>"
            ));
        }
    }

    /// Draws a mark.
    pub fn mark(&mut self, shape: Shape, class: &str, [x, y]: [f64; 2]) {
        let (fill, path) = match shape {
            Shape::Ring => ("o", "m-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0"),
            Shape::Dot => ("f", "m-2.6 0a2.6 2.6 0 1 0 5.2 0a2.6 2.6 0 1 0 -5.2 0"),
            Shape::OpenDiamond => ("o", "m0 -6l6 6l-6 6l-6 -6z"),
            Shape::Diamond => ("f", "m0 -3.4l3.4 3.4l-3.4 3.4l-3.4 -3.4z"),
        };
        self.svg.element(&format!(
            "<path class=\"{class} {fill}\" d=\"M{x:.1} {y:.1}{path}\"/>"
        ));
    }

    /// Returns a name in the legend; where to draw what it stands for: from, to.
    pub fn legend(&mut self, name: &str) -> [[f64; 2]; 2] {
        let at = TOP + 10.0 + 18.0 * self.legends as f64;
        self.legends += 1;
        let left = WIDTH - RIGHT + 14.0;
        self.text([left + 36.0, at + 4.0], "start", name);
        [[left, at], [left + 28.0, at]]
    }

    /// Returns the text.
    pub fn end(self) -> String {
        self.svg.end()
    }

    fn text(&mut self, at: [f64; 2], anchor: &str, text: &str) {
        let anchor = format!(" text-anchor=\"{anchor}\"");
        self.svg.text("i", at, &anchor, text);
    }
}
