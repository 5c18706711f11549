//! An SVG file as it grows: paper with a title, elements, texts.

/// An SVG file: drawings of arms and charts are made of it.
pub struct Svg(String);

impl Svg {
    /// Begins a file of this size in pixels: the title, `head`, the style, and the paper, of
    /// the class `p`.
    pub fn new(title: &str, [width, height]: [f64; 2], head: &str, style: &str) -> Svg {
        let name = escaped(title);
        Svg(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             role=\"img\">\n<title>{name}</title>\n{head}<style>{style}</style>\n\
             <rect class=\"p\" width=\"{width}\" height=\"{height}\"/>\n"
        ))
    }

    /// Adds an element.
    pub fn element(&mut self, element: &str) {
        self.0.push_str(element);
        self.0.push('\n');
    }

    /// Adds a line through points, with these attributes.
    pub fn polyline(&mut self, attributes: &str, points: &[[f64; 2]]) {
        let points = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}"));
        let points = points.collect::<Vec<_>>().join(" ");
        self.element(&format!("<polyline {attributes} points=\"{points}\"/>"));
    }

    /// Adds a text at a point, of a class, with these attributes besides.
    pub fn text(&mut self, class: &str, [x, y]: [f64; 2], attributes: &str, text: &str) {
        let text = escaped(text);
        self.element(&format!(
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\"{attributes}>{text}</text>"
        ));
    }

    /// Returns the text of the file.
    pub fn end(mut self) -> String {
        self.0.push_str("</svg>\n");
        self.0
    }
}

/// Returns text as XML has it; what XML cannot have is replaced.
pub fn escaped(text: &str) -> String {
    let plain = text
        .chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c });
    let plain: String = plain.collect();
    plain.replace('&', "&amp;").replace('<', "&lt;")
}
