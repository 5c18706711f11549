//! A sheet of SVG: lines, shapes and texts in the fonts and colours that all pictures share.

use crate::terminal::printable;

/// Rules of paper (p), ink (i) and tables (c) on a light screen. Texts have an outline in the colour
/// of the paper, so that they are legible on lines.
const LIGHT: &str = "\
svg{font:12px sans-serif;color:#222}\
.p{fill:#fff}.i{fill:currentColor;stroke:#fff;stroke-width:3;paint-order:stroke}.c{font:12px monospace}";
const DARK: &str = "svg{color:#ddd}.p{fill:#111}.i{stroke:#111}";

/// An SVG drawing that is being written. Lengths are in pixels, y points down.
pub(crate) struct Paper(String);

impl Paper {
    pub(crate) fn new(
        [width, height]: [f64; 2],
        title: &str,
        subcommand: &str,
        [light, dark]: [&str; 2],
    ) -> Paper {
        let title = escaped(title);
        Paper(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             role=\"img\">\n<title>{title}</title>\n<!-- by dalembert {subcommand} -->\n\
             <style>{LIGHT}{light}\
             @media screen and (prefers-color-scheme:dark){{{DARK}{dark}}}</style>\n\
             <rect class=\"p\" width=\"{width}\" height=\"{height}\"/>\n"
        ))
    }

    pub(crate) fn element(&mut self, element: &str) {
        self.0 += element;
        self.0.push('\n');
    }

    pub(crate) fn line(&mut self, class: &str, [x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) {
        self.element(&format!(
            "<path class=\"{class}\" d=\"M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}\"/>"
        ));
    }

    pub(crate) fn polyline(&mut self, class: &str, points: impl Iterator<Item = [f64; 2]>) {
        let pairs: Vec<String> = points.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let line = pairs.join(" ");
        self.element(&format!("<polyline class=\"{class}\" points=\"{line}\"/>"));
    }

    pub(crate) fn circle(&mut self, class: &str, [x, y]: [f64; 2], radius: f64) {
        self.element(&format!(
            "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"/>"
        ));
    }

    pub(crate) fn text(&mut self, class: &str, [x, y]: [f64; 2], text: &str) {
        let text = escaped(text);
        self.element(&format!(
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{text}</text>"
        ));
    }

    pub(crate) fn end(self) -> String {
        self.0 + "</svg>\n"
    }
}

fn escaped(text: &str) -> String {
    let text: String = text.chars().map(printable).collect();
    text.replace('&', "&amp;").replace('<', "&lt;")
}
