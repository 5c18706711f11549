//! The front as SVG: operations, those of polynomials for sines included, over
//! certified error, both logarithmic.
//!
//! Each variant is a dot at its certified error with a whisker to what was
//! observed. A line joins the front of each kind; dominated variants are grey.
//! Kinds differ in colour and in shape, so that print without colours is
//! legible; the paper is part of the picture, white or dark as the reader's
//! pages are.

use std::fmt::Write;

use super::ladder::Point;
use crate::plot::escaped;

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 152.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 50.0;

const STYLE: &str = "\
svg{font:12px sans-serif}.p{fill:#fff}.i{fill:#222}\
.g{stroke:#222;stroke-opacity:.14}.l{fill:none;stroke-width:1.5}.w{stroke-width:1;stroke-opacity:.55}\
.k0{stroke:#1b6ca8;fill:#1b6ca8}.k1{stroke:#c2571a;fill:#c2571a}\
.k2{stroke:#2b8a4b;fill:#2b8a4b}.k3{stroke:#9b3fa0;fill:#9b3fa0}\
.d{stroke:#999;fill:#999;opacity:.6}.l{fill:none}\
@media(prefers-color-scheme:dark){.p{fill:#111}.i{fill:#ddd}.g{stroke:#ddd}\
.k0{stroke:#62b0ea;fill:#62b0ea}.k1{stroke:#f0935a;fill:#f0935a}\
.k2{stroke:#6cc98c;fill:#6cc98c}.k3{stroke:#d68ada;fill:#d68ada}.l{fill:none}}\
@media print{.p{fill:#fff}.i{fill:#000}}";

/// The kinds of variants, as the legend names them.
const KINDS: [&str; 4] = [
    "f64, libm",
    "f32, libm",
    "f64, polynomials",
    "f32, polynomials",
];

/// The chart's text.
pub fn svg(title: &str, points: &[Point]) -> String {
    let counts = |point: &Point| {
        let counts = point.counts();
        (counts.operations() + counts.trig_mul + counts.trig_add) as f64
    };
    let errors = points.iter().map(|point| point.certified);
    let x = Axis::over(errors, [LEFT, WIDTH - RIGHT], 1.0);
    let y = Axis::over(points.iter().map(counts), [HEIGHT - BOTTOM, TOP], 0.05);
    let mut picture = Picture::new(title);
    picture.frame(&x, &y);
    for (kind, name) in KINDS.into_iter().enumerate() {
        let mut mine: Vec<&Point> = points.iter().filter(|p| p.kind() == kind).collect();
        if mine.is_empty() {
            continue;
        }
        picture.legend(kind, &format!("k{kind}"), name);
        mine.sort_by(|a, b| a.certified.total_cmp(&b.certified));
        let front = mine.iter().filter(|point| !point.dominated);
        let path: Vec<String> = front
            .map(|p| format!("{:.1},{:.1}", x.place(p.certified), y.place(counts(p))))
            .collect();
        picture.line(&format!(
            "<polyline class=\"k{kind} l\" points=\"{}\"/>",
            path.join(" ")
        ));
        for point in mine {
            let class = if point.dominated {
                "d".into()
            } else {
                format!("k{kind}")
            };
            let at = [x.place(point.certified), y.place(counts(point))];
            if point.observed > 0.0 {
                let seen = x.place(point.observed);
                picture.line(&format!(
                    "<path class=\"{class} w\" d=\"M{:.1} {1:.1}H{seen:.1}M{seen:.1} {2:.1}v6\"/>",
                    at[0],
                    at[1],
                    at[1] - 3.0
                ));
            }
            picture.dot(kind, &class, at);
        }
    }
    if points.iter().any(|point| point.dominated) {
        picture.legend(0, "d", "dominated");
    }
    picture.end()
}

/// A logarithmic axis.
struct Axis {
    /// Decimal logarithms of the ends.
    ends: [f64; 2],
    /// Where the ends are in the picture.
    places: [f64; 2],
}

impl Axis {
    /// Over values above zero, up to multiples of a step of the logarithm.
    fn over(values: impl Iterator<Item = f64>, places: [f64; 2], step: f64) -> Axis {
        let logs = values.filter(|v| *v > 0.0 && v.is_finite()).map(f64::log10);
        let nothing = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = logs.fold(nothing, |[low, high], v| [low.min(v), high.max(v)]);
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let low = ((low + 1e-9) / step).floor() * step;
        let high = ((high - 1e-9) / step).ceil() * step;
        Axis {
            ends: [low, high.max(low + step)],
            places,
        }
    }

    fn place(&self, value: f64) -> f64 {
        let [low, high] = self.ends;
        let log = if value > 0.0 { value.log10() } else { low };
        let [from, to] = self.places;
        from + ((log - low) / (high - low)).clamp(0.0, 1.0) * (to - from)
    }

    /// Powers of ten.
    fn decades(&self) -> Vec<f64> {
        let [low, high] = self.ends;
        let all = low.ceil() as i32..=high.floor() as i32;
        all.map(|k| 10f64.powi(k)).collect()
    }

    /// Round numbers, equally far apart: for less than two decades.
    fn round(&self) -> Vec<f64> {
        let [low, high] = self.ends.map(|end| 10f64.powf(end));
        let decade = 10f64.powi((high - low).log10().floor() as i32);
        let steps = [0.1, 0.2, 0.5, 1.0].map(|part| part * decade);
        let step = steps.into_iter().find(|step| (high - low) / step <= 10.0);
        let step = step.unwrap_or(decade);
        let first = (low / step).ceil() as i64;
        let last = (high / step).floor() as i64;
        (first..=last).map(|k| k as f64 * step).collect()
    }
}

/// The text as it grows.
struct Picture {
    svg: String,
    legends: usize,
}

impl Picture {
    fn new(title: &str) -> Picture {
        let title = escaped(title);
        let mut picture = Picture {
            svg: format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
                 role=\"img\">\n<title>{title}</title>\n<style>{STYLE}</style>\n\
                 <rect class=\"p\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/>\n"
            ),
            legends: 0,
        };
        picture.text([(LEFT + WIDTH - RIGHT) / 2.0, 22.0], "middle", &title);
        picture
    }

    fn line(&mut self, element: &str) {
        self.svg.push_str(element);
        self.svg.push('\n');
    }

    fn text(&mut self, [x, y]: [f64; 2], anchor: &str, text: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            self.svg,
            "<text class=\"i\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>"
        );
    }

    /// Grid, ticks and the names of the axes.
    fn frame(&mut self, x: &Axis, y: &Axis) {
        let decades = x.decades();
        let every = decades.len().div_ceil(10);
        for (index, tick) in decades.into_iter().enumerate() {
            let at = x.place(tick);
            let (top, foot) = (TOP, HEIGHT - BOTTOM);
            self.line(&format!("<path class=\"g\" d=\"M{at:.1} {top}V{foot}\"/>"));
            if index % every == 0 {
                self.text([at, foot + 16.0], "middle", &format!("{tick:e}"));
            }
        }
        let ticks = match y.round() {
            few if few.len() < 12 => few,
            _ => y.decades(),
        };
        for tick in ticks {
            let at = y.place(tick);
            let (left, right) = (LEFT, WIDTH - RIGHT);
            self.line(&format!(
                "<path class=\"g\" d=\"M{left} {at:.1}H{right}\"/>"
            ));
            self.text(
                [LEFT - 6.0, at + 4.0],
                "end",
                &format!("{}", (tick * 1e6).round() / 1e6),
            );
        }
        let centre = (LEFT + WIDTH - RIGHT) / 2.0;
        let below = "certified error, relative to T; whiskers: the largest observed";
        self.text([centre, HEIGHT - 12.0], "middle", below);
        let middle = (TOP + HEIGHT - BOTTOM) / 2.0;
        self.line(&format!(
            "<text class=\"i\" x=\"16\" y=\"{middle}\" text-anchor=\"middle\" \
             transform=\"rotate(-90 16 {middle})\">multiplications and additions, the polynomials' too</text>"
        ));
    }

    fn legend(&mut self, kind: usize, class: &str, name: &str) {
        let at = TOP + 10.0 + 18.0 * self.legends as f64;
        self.legends += 1;
        self.dot(kind, class, [WIDTH - RIGHT + 16.0, at]);
        self.text([WIDTH - RIGHT + 28.0, at + 4.0], "start", name);
    }

    /// A shape of its own for each kind.
    fn dot(&mut self, kind: usize, class: &str, [x, y]: [f64; 2]) {
        let path = match kind {
            0 => "m-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0",
            1 => "m-3.5 -3.5h7v7h-7z",
            2 => "m0 -5l5 5l-5 5l-5 -5z",
            _ => "m0 -5l4.5 8h-9z",
        };
        self.line(&format!(
            "<path class=\"{class}\" d=\"M{x:.1} {y:.1}{path}\"/>"
        ));
    }

    fn end(mut self) -> String {
        self.svg.push_str("</svg>\n");
        self.svg
    }
}
