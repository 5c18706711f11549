//! Lines and texts as SVG.

use std::fmt::Write;

/// Colours of equal weight on white and on black. p the paper, g the grid, l0 to l2 the
/// lines, told apart by dashes too; texts from the left, b bold, e to the right, m about
/// their middle.
const STYLE: &str = "\
svg{font:12px sans-serif;color:#222}text{fill:currentColor}\
.p{fill:#fff}.b{font-weight:bold}.e{text-anchor:end}.m{text-anchor:middle}\
.g,.l0,.l1,.l2{fill:none}.g{stroke:currentColor;stroke-opacity:.15}\
.l0,.l1,.l2{stroke-width:1.8;stroke-linejoin:round}\
.l0{stroke:#1b6ca8}.l1{stroke:#c2571a;stroke-dasharray:7 3}.l2{stroke:#2b8a4b;stroke-dasharray:2 3}\
@media screen and (prefers-color-scheme:dark){svg{color:#ddd}.p{fill:#111}\
.l0{stroke:#62b0ea}.l1{stroke:#f0935a}.l2{stroke:#6cc98c}}";

/// A drawing as it grows.
pub struct Page {
    svg: String,
}

impl Page {
    /// Begins a page with its title.
    pub fn new(title: &str, width: f64, height: f64) -> Page {
        let name = escaped(title);
        let mut page = Page {
            svg: format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
                 role=\"img\">\n<title>{name}</title>\n<style>{STYLE}</style>\n\
                 <rect class=\"p\" width=\"{width}\" height=\"{height}\"/>\n"
            ),
        };
        page.text("b", [16.0, 20.0], title);
        page
    }

    /// A line through points.
    pub fn line(&mut self, class: &str, points: &[[f64; 2]]) {
        let points = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}"));
        let points = points.collect::<Vec<_>>().join(" ");
        self.element(&format!(
            "<polyline class=\"{class}\" points=\"{points}\"/>"
        ));
    }

    /// A text that begins at a point, or as its class says.
    pub fn text(&mut self, class: &str, [x, y]: [f64; 2], text: &str) {
        let text = escaped(text);
        self.element(&format!(
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{text}</text>"
        ));
    }

    /// Returns the text of the file.
    pub fn end(mut self) -> String {
        self.svg.push_str("</svg>\n");
        self.svg
    }

    fn element(&mut self, element: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.svg, "{element}");
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}
