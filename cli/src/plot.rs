//! Charts as SVG: both axes logarithmic, legible in print and on dark pages.

use std::fmt::Write;

/// A chart.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Above it.
    pub title: String,
    /// Below the horizontal axis.
    pub x: String,
    /// Beside the vertical axis.
    pub y: String,
    /// A level to mark, with its name.
    pub bound: Option<(f64, String)>,
    /// The curves: name and points. Points not above zero are drawn at the
    /// foot of the chart.
    pub curves: Vec<(String, Vec<(f64, f64)>)>,
}

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 400.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 150.0;
const TOP: f64 = 36.0;
const BOTTOM: f64 = 48.0;

/// Dashes tell the curves apart where colours do not print.
const DASHES: [&str; 4] = ["", "7 4", "2 3", "9 3 2 3"];

/// Colours of equal weight on white and on black.
const STYLE: &str = "\
svg{font:12px sans-serif;color:#222;background:#fff}\
.i{fill:currentColor}.g{stroke:currentColor;stroke-opacity:.15}\
.b{stroke:currentColor;stroke-dasharray:4 4}.c{fill:none;stroke-width:2}\
.c0{stroke:#1b6ca8}.c1{stroke:#c2571a}.c2{stroke:#2b8a4b}.c3{stroke:#9b3fa0}\
@media(prefers-color-scheme:dark){svg{color:#ddd;background:#111}\
.c0{stroke:#62b0ea}.c1{stroke:#f0935a}.c2{stroke:#6cc98c}.c3{stroke:#d68ada}}\
@media print{svg{color:#000;background:#fff}}";

/// Whole decades that hold values; at least one decade.
struct Decades {
    low: f64,
    high: f64,
}

impl Decades {
    fn of(values: impl Iterator<Item = f64>, start: [f64; 2]) -> Decades {
        let logs = values.filter(|v| *v > 0.0 && v.is_finite()).map(f64::log10);
        let [low, high] = logs.fold(start, |[low, high], v| [low.min(v), high.max(v)]);
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let (low, high) = ((low + 1e-9).floor(), (high - 1e-9).ceil());
        Decades {
            low,
            high: high.max(low + 1.0),
        }
    }

    /// 0 to 1.
    fn place(&self, value: f64) -> f64 {
        let log = if value > 0.0 { value.log10() } else { self.low };
        ((log - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    fn ticks(&self) -> Vec<i32> {
        let (low, high) = (self.low as i32, self.high as i32);
        let step = ((high - low) / 9 + 1) as usize;
        (low..=high).step_by(step).collect()
    }
}

impl Chart {
    /// The chart's text.
    pub fn svg(&self) -> String {
        let points = || self.curves.iter().flat_map(|(_, points)| points);
        let xs = Decades::of(points().map(|p| p.0), [f64::INFINITY, f64::NEG_INFINITY]);
        let bound = self.bound.iter().map(|(level, _)| *level);
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        let ys = Decades::of(points().map(|p| p.1.max(0.1)).chain(bound), start);
        let x = |value: f64| LEFT + xs.place(value) * (WIDTH - LEFT - RIGHT);
        let y = |value: f64| HEIGHT - BOTTOM - ys.place(value) * (HEIGHT - TOP - BOTTOM);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
             role=\"img\">\n<title>{0}</title>\n<style>{STYLE}</style>\n",
            escaped(&self.title)
        );
        let mut text = |x: f64, y: f64, anchor: &str, turn: &str, text: &str| {
            let _ = writeln!(
                svg,
                "<text class=\"i\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\"{turn}>{}</text>",
                escaped(text)
            );
        };
        let centre = (LEFT + WIDTH - RIGHT) / 2.0;
        text(centre, 20.0, "middle", "", &self.title);
        text(centre, HEIGHT - 10.0, "middle", "", &self.x);
        let middle = (TOP + HEIGHT - BOTTOM) / 2.0;
        let turn = format!(" transform=\"rotate(-90 16 {middle:.1})\"");
        text(16.0, middle, "middle", &turn, &self.y);
        for tick in xs.ticks() {
            text(
                x(10f64.powi(tick)),
                HEIGHT - BOTTOM + 16.0,
                "middle",
                "",
                &format!("1e{tick}"),
            );
        }
        for tick in ys.ticks() {
            text(
                LEFT - 6.0,
                y(10f64.powi(tick)) + 4.0,
                "end",
                "",
                &format!("1e{tick}"),
            );
        }
        for (index, (name, _)) in self.curves.iter().enumerate() {
            text(
                WIDTH - RIGHT + 44.0,
                TOP + 14.0 + 18.0 * index as f64,
                "start",
                "",
                name,
            );
        }
        if let Some((level, name)) = &self.bound {
            text(WIDTH - RIGHT + 4.0, y(*level) + 4.0, "start", "", name);
        }
        let mut line = |class: &str, [x1, y1, x2, y2]: [f64; 4], dash: &str| {
            let _ = writeln!(
                svg,
                "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"{dash}/>"
            );
        };
        for tick in xs.ticks() {
            let at = x(10f64.powi(tick));
            line("g", [at, TOP, at, HEIGHT - BOTTOM], "");
        }
        for tick in ys.ticks() {
            let at = y(10f64.powi(tick));
            line("g", [LEFT, at, WIDTH - RIGHT, at], "");
        }
        if let Some((level, _)) = &self.bound {
            line("b", [LEFT, y(*level), WIDTH - RIGHT, y(*level)], "");
        }
        for (index, (_, points)) in self.curves.iter().enumerate() {
            let class = format!("c c{}", index % 4);
            let dash = match DASHES[index % 4] {
                "" => String::new(),
                dashes => format!(" stroke-dasharray=\"{dashes}\""),
            };
            let at = TOP + 10.0 + 18.0 * index as f64;
            line(
                &class,
                [WIDTH - RIGHT + 10.0, at, WIDTH - RIGHT + 38.0, at],
                &dash,
            );
            for pair in points.windows(2) {
                let [a, b] = [pair[0], pair[1]];
                line(&class, [x(a.0), y(a.1), x(b.0), y(b.1)], &dash);
            }
        }
        svg.push_str("</svg>\n");
        svg
    }
}

/// Text as XML has it.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}
