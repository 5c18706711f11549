//! Lines over time as SVG: panels below each other over one axis of seconds.
//!
//! - this file: what a chart has, and where it goes
//! - `ticks`: round numbers along an axis, linear or logarithmic
//! - `page`: lines and texts as SVG, in colours for white and for black
//!
//! The same numbers give the same bytes on every machine: logarithms are libm's, and
//! places have one decimal.

mod page;
mod ticks;

use page::Page;
use ticks::Axis;
pub use ticks::Scale;

/// A chart.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The title.
    pub title: &'static str,
    /// Below each other.
    pub panels: Vec<Panel>,
}

/// Lines over the same quantity.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The quantity and its unit.
    pub title: &'static str,
    /// The scale of the vertical axis.
    pub scale: Scale,
    /// The lines, three at most: there are so many colours.
    pub lines: Vec<Line>,
}

/// A line.
#[derive(Clone, Debug)]
pub struct Line {
    /// The label of the line.
    pub name: &'static str,
    /// Seconds, and the quantity.
    pub points: Vec<[f64; 2]>,
}

const WIDTH: f64 = 720.0;
const LEFT: f64 = 64.0;
const RIGHT: f64 = 704.0;
/// The room above the first panel, above each panel's frame, and below the last.
const HEAD: f64 = 26.0;
const TITLE: f64 = 26.0;
const FOOT: f64 = 38.0;
const PANEL: f64 = 150.0;
/// The most points that a line is drawn of.
const POINTS: usize = 320;

impl Chart {
    /// Its text.
    pub fn svg(&self) -> String {
        let lines = || self.panels.iter().flat_map(|panel| &panel.lines);
        let times = lines().flat_map(|line| line.points.iter().map(|[time, _]| *time));
        let across = Axis::new(Scale::Linear, times).between(LEFT, RIGHT);
        let panels = self.panels.len() as f64;
        let mut page = Page::new(self.title, WIDTH, HEAD + panels * (TITLE + PANEL) + FOOT);
        let mut top = HEAD;
        for panel in &self.panels {
            top += TITLE;
            panel.draw(&mut page, &across, top);
            top += PANEL;
        }
        for (time, text) in across.ticks() {
            page.text("m", [across.place(time), top + 15.0], &text);
        }
        page.text("m", [(LEFT + RIGHT) / 2.0, top + 31.0], "time, s");
        page.end()
    }
}

impl Panel {
    fn draw(&self, page: &mut Page, across: &Axis, top: f64) {
        let values = self.lines.iter().flat_map(|line| &line.points);
        let values = values.map(|[_, value]| *value);
        let up = Axis::new(self.scale, values).between(top + PANEL, top);
        for (time, _) in across.ticks() {
            let x = across.place(time);
            page.line("g", &[[x, top], [x, top + PANEL]]);
        }
        for (value, text) in up.ticks() {
            let y = up.place(value);
            page.line("g", &[[LEFT, y], [RIGHT, y]]);
            page.text("e", [LEFT - 6.0, y + 4.0], &text);
        }
        page.text("b", [LEFT, top - 7.0], self.title);
        // Names stand above the frame, from the right, each after a piece of its line.
        let mut end = RIGHT;
        for (index, line) in self.lines.iter().enumerate().rev() {
            let class = format!("l{index}");
            let from = end - 6.6 * line.name.chars().count() as f64;
            page.text("s", [from, top - 7.0], line.name);
            page.line(
                &class,
                &[[from - 24.0, top - 11.0], [from - 6.0, top - 11.0]],
            );
            end = from - 38.0;
            let thin = line.points.len().div_ceil(POINTS).max(1);
            let last = line.points.last().into_iter();
            let points = line.points.iter().step_by(thin).chain(last);
            let points = points.map(|[time, value]| [across.place(*time), up.place(*value)]);
            page.line(&class, &points.collect::<Vec<_>>());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chart_has_its_lines_and_names() {
        let chart = Chart {
            title: "a < b & c",
            panels: vec![Panel {
                title: "error, rad",
                scale: Scale::Logarithmic,
                lines: vec![Line {
                    name: "one",
                    points: (0..2000).map(|i| [f64::from(i), 1e-3]).collect(),
                }],
            }],
        };
        let text = chart.svg();
        assert!(text.contains("a &lt; b &amp; c") && text.contains(">one</text>"));
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        let longest = text.lines().map(|line| line.matches(' ').count()).max();
        assert!(longest.unwrap() <= POINTS + 3);
    }
}
