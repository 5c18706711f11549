//! The front of a trade-off as SVG: cost over the bound of the error.
//!
//! Each kind of variant (scalar and source of sines) has a colour, a line through its variants and its
//! name at the end of the line. Marks are open for f64, full for f32, and faint where another variant
//! is neither dearer nor worse. A whisker leads from the bound to the observed error. Decades
//! without a variant are left out.

use dalembert_codegen::ScalarType;

use crate::drawing::paper::Paper;
use crate::ladder::called_sine_cost;

/// One variant, as the chart shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dot {
    /// The index of its kind: scalar, and twice the source of sines.
    pub kind: usize,
    /// Operations, those of its sines included.
    pub cost: f64,
    pub bound: f64,
    pub observed: Option<f64>,
    /// True if another variant is neither dearer nor worse.
    pub dominated: bool,
}

const KINDS: [&str; 4] = [
    "f64, called sines",
    "f32, called sines",
    "f64, polynomials",
    "f32, polynomials",
];

/// Rules of the classes, for white and black paper: k0 to k3 colours of series; t titles; e and m texts
/// that end or are centred at their place; g grid and leaders; w axes and whiskers; o lines, s dashed;
/// f and h full and open marks; d faint ones. Drawings by hand and by `bars.py` have the same.
const STYLE: [&str; 2] = [
    "\
.t{font-weight:bold}.e{text-anchor:end}.m{text-anchor:middle}\
.g,.w,.o{fill:none;stroke:currentColor}.g{stroke-opacity:.2}.o{stroke-width:2}.s{stroke-dasharray:7 4}\
.f{fill:currentColor}.h{fill:#fff;stroke:currentColor;stroke-width:2}.d{opacity:.35}\
.k0{color:#1b6ca8}.k1{color:#c2571a}.k2{color:#2b8a4b}.k3{color:#9b3fa0}",
    ".h{fill:#111}.k0{color:#62b0ea}.k1{color:#f0935a}.k2{color:#6cc98c}.k3{color:#d68ada}",
];

/// The paper, and the sides of the plot on it, in pixels.
const SIZE: [f64; 2] = [720.0, 400.0];
const LEFT: f64 = 48.0;
const RIGHT: f64 = 586.0;
const TOP: f64 = 60.0;
const BOTTOM: f64 = 344.0;

/// Draws the chart; errors are relative to `relative_to`.
pub fn svg(title: &str, relative_to: &str, dots: &[Dot]) -> String {
    let mut paper = Paper::new(SIZE, title, "tradeoff", STYLE);
    let observed: Vec<f64> = dots.iter().filter_map(|dot| dot.observed).collect();
    let bound = dots.iter().map(|dot| dot.bound);
    let across = Across::around(bound.chain(observed.iter().copied()));
    let up = Up::around(dots.iter().map(|dot| dot.cost));
    paper.text("i t", [LEFT, 20.0], title);
    let [double, single] = ScalarType::ALL.map(called_sine_cost);
    let cost = format!(
        "operations; a called sine and its cosine count as {double}, in f32 as {single}, as libm computes them"
    );
    paper.text("i", [LEFT, 38.0], &cost);
    up.draw(&mut paper);
    across.draw(&mut paper);
    let whiskers = observed.first().map_or("", |_| "; whiskers: observed");
    let error = format!("bound of the error, relative to {relative_to}{whiskers}");
    paper.text("i m", [0.5 * (LEFT + RIGHT), BOTTOM + 40.0], &error);
    let mut ends: Vec<([f64; 2], usize)> = Vec::new();
    for kind in 0..KINDS.len() {
        let mut variants: Vec<&Dot> = dots.iter().filter(|dot| dot.kind == kind).collect();
        variants.sort_by(|a, b| a.bound.total_cmp(&b.bound));
        let place = |dot: &&Dot| [across.place(dot.bound), up.place(dot.cost)];
        let places: Vec<[f64; 2]> = variants.iter().map(place).collect();
        let Some(end) = places.last() else {
            continue;
        };
        ends.push((*end, kind));
        paper.element(&format!("<g class=\"k{kind}\">"));
        paper.polyline(["o", "o s"][kind % 2], places.iter().copied());
        for (dot, at) in variants.iter().zip(&places) {
            let faint = if dot.dominated { " d" } else { "" };
            if let Some(error) = dot.observed.filter(|error| *error > 0.0) {
                paper.line(&format!("w{faint}"), *at, [across.place(error), at[1]]);
            }
            paper.circle(&format!("{}{faint}", ["h", "f"][kind % 2]), *at, 4.0);
        }
        paper.element("</g>");
    }
    // Names beside the ends of the lines, none on another.
    ends.sort_by(|(a, _), (b, _)| a[1].total_cmp(&b[1]));
    let mut y = 0.0;
    for ([from, height], kind) in ends {
        y = f64::max(y + 15.0, height);
        paper.element(&format!("<g class=\"k{kind}\">"));
        paper.line("g", [from + 7.0, height], [RIGHT + 6.0, y]);
        paper.text("i", [RIGHT + 10.0, y + 4.0], KINDS[kind]);
        paper.element("</g>");
    }
    paper.end()
}

/// The axis of errors: logarithmic, in parts, without the decades in which nothing is.
struct Across {
    parts: Vec<[f64; 2]>,
    /// Pixels per decade.
    scale: f64,
}

impl Across {
    const MARGIN: f64 = 0.25;
    const GAP: f64 = 1.0;
    /// The room between two parts, in pixels.
    const BREAK: f64 = 22.0;

    fn around(values: impl Iterator<Item = f64>) -> Across {
        let positive = values.filter(|x| *x > 0.0 && x.is_finite());
        let mut exponents: Vec<f64> = positive.map(libm::log10).collect();
        exponents.sort_by(f64::total_cmp);
        let mut parts: Vec<[f64; 2]> = Vec::new();
        for exponent in exponents {
            let decade = libm::round(exponent);
            let low = decade.min(exponent - Across::MARGIN);
            let high = decade.max(exponent + Across::MARGIN);
            match parts.last_mut() {
                Some([_, end]) if low - *end <= Across::GAP => *end = f64::max(*end, high),
                _ => parts.push([low, high]),
            }
        }
        if parts.is_empty() {
            parts.push([-1.0, 0.0]);
        }
        let decades: f64 = parts.iter().map(|[low, high]| high - low).sum();
        let breaks = Across::BREAK * (parts.len() - 1) as f64;
        let scale = (RIGHT - LEFT - breaks) / decades;
        Across { parts, scale }
    }

    fn place(&self, value: f64) -> f64 {
        self.place_of_exponent(libm::log10(value))
    }

    fn place_of_exponent(&self, exponent: f64) -> f64 {
        let mut from = LEFT;
        for [low, high] in &self.parts {
            if exponent <= *high {
                return from + self.scale * (exponent - low).max(0.0);
            }
            from += self.scale * (high - low) + Across::BREAK;
        }
        RIGHT
    }

    fn draw(&self, paper: &mut Paper) {
        for (index, [low, high]) in self.parts.iter().enumerate() {
            let [from, to] = [*low, *high].map(|exponent| self.place_of_exponent(exponent));
            paper.line("w", [from, BOTTOM], [to, BOTTOM]);
            for decade in libm::ceil(*low) as i32..=libm::floor(*high) as i32 {
                let x = self.place_of_exponent(f64::from(decade));
                paper.line("w", [x, BOTTOM], [x, BOTTOM + 5.0]);
                paper.text("i m", [x, BOTTOM + 19.0], &format!("1e{decade}"));
            }
            if index > 0 {
                for aside in [-3.0, 3.0] {
                    let x = from - 0.5 * Across::BREAK + aside;
                    paper.line("w", [x - 3.0, BOTTOM + 5.0], [x + 3.0, BOTTOM - 5.0]);
                }
            }
        }
    }
}

struct Up {
    low: f64,
    high: f64,
    step: f64,
}

impl Up {
    const STEPS: f64 = 6.0;

    fn around(values: impl Iterator<Item = f64> + Clone) -> Up {
        let least = values.clone().fold(f64::INFINITY, f64::min);
        let most = values.fold(least, f64::max);
        let mut step = 1.0;
        // 1, 2, 5, 10, 20 …
        for factor in [2.0, 2.5, 2.0].into_iter().cycle() {
            if most - least <= Up::STEPS * step || !most.is_finite() {
                break;
            }
            step *= factor;
        }
        let low = step * libm::floor(least / step);
        let high = (step * libm::ceil(most / step)).max(low + step);
        Up { low, high, step }
    }

    fn place(&self, cost: f64) -> f64 {
        BOTTOM - (BOTTOM - TOP) * (cost - self.low) / (self.high - self.low)
    }

    fn draw(&self, paper: &mut Paper) {
        let steps = ((self.high - self.low) / self.step) as u32;
        for tick in (0..=steps).map(|k| self.low + self.step * f64::from(k)) {
            let y = self.place(tick);
            paper.line("g", [LEFT, y], [RIGHT, y]);
            paper.text("i e", [LEFT - 8.0, y + 4.0], &tick.to_string());
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use dalembert_codegen::ScalarType;
    use dalembert_stamp::{Comment, sealed};

    use super::{Dot, svg};
    use crate::ladder::called_sine_cost;

    fn dots(csv: &str) -> Vec<Dot> {
        let mut rows = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let head = rows.next().unwrap();
        rows.map(|row| {
            let cell = |name: &str| row[head.iter().position(|cell| *cell == name).unwrap()];
            let number = |name: &str| cell(name).parse::<f64>().unwrap();
            let kind = usize::from(cell("scalar") == "f32");
            let is_called = cell("sincos_by") == "libm";
            let sines = match is_called {
                true => number("sincos") * called_sine_cost(ScalarType::ALL[kind]) as f64,
                false => number("trig_mul") + number("trig_add"),
            };
            Dot {
                kind: kind + 2 * usize::from(!is_called),
                cost: number("mul") + number("add") + sines,
                bound: number("bound"),
                observed: cell("observed").parse().ok(),
                dominated: cell("front") != "yes",
            }
        })
        .collect()
    }

    /// A chart that differs is drawn anew before the test fails.
    #[test]
    fn the_checked_in_charts_are_those_of_their_tables() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let folder = root.join("generated/tradeoff");
        let mut differing = Vec::new();
        for robot in ["puma560", "ur10", "panda"] {
            let csv = fs::read_to_string(folder.join(format!("{robot}.csv"))).unwrap();
            let title = format!("{robot}: inverse_dynamics");
            let chart = svg(&title, "the actuators' limits", &dots(&csv));
            let chart = sealed(Comment::Xml, "dalembert tradeoff", &chart);
            let mut files = vec![folder.join(format!("{robot}.svg"))];
            if robot == "puma560" {
                files.push(root.join("docs/src/tradeoff.svg"));
            }
            for file in files {
                if fs::read_to_string(&file).is_ok_and(|text| text == chart) {
                    continue;
                }
                fs::write(&file, &chart).unwrap();
                differing.push(file);
            }
        }
        assert!(differing.is_empty(), "drawn anew: {differing:?}");
    }
}
