//! The front of a trade-off as SVG: operations over certified error.
//!
//! Each kind of variant (scalar and source of sines) has a colour and a mark, open for f64 and full for
//! f32. A line joins its best variants; dominated ones are grey. A whisker leads from the certified to
//! the observed error.

use std::error::Error;
use std::ops::Range;

use plotters::prelude::*;

/// One variant, as the chart shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dot {
    /// The index of its kind: scalar, and twice the source of sines.
    pub kind: usize,
    /// Operations, those of polynomials included.
    pub operations: f64,
    /// The bound of the error.
    pub certified: f64,
    /// The largest error that was seen.
    pub observed: Option<f64>,
    /// True if another variant is neither dearer nor worse.
    pub dominated: bool,
}

/// The kinds, as the legend names them, with colours that are told apart in print.
const KINDS: [(&str, RGBColor); 4] = [
    ("f64, called sines", RGBColor(0x1b, 0x6c, 0xa8)),
    ("f32, called sines", RGBColor(0xc2, 0x57, 0x1a)),
    ("f64, polynomials", RGBColor(0x2b, 0x8a, 0x4b)),
    ("f32, polynomials", RGBColor(0x9b, 0x3f, 0xa0)),
];
const GREY: RGBColor = RGBColor(0x99, 0x99, 0x99);

/// Draws the chart; errors are relative to `relative_to`.
///
/// # Errors
/// Those of plotters; writing to a string has none of its own.
pub fn svg(title: &str, relative_to: &str, dots: &[Dot]) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    let root = SVGBackend::with_string(&mut text, (720, 440)).into_drawing_area();
    root.fill(&WHITE)?;
    let observed = dots.iter().filter_map(|dot| dot.observed);
    let has_whiskers = observed.clone().next().is_some();
    let across = range(dots.iter().map(|dot| dot.certified).chain(observed));
    let least = across.start;
    let most = dots.iter().map(|dot| dot.operations).fold(1.0, f64::max);
    let mut chart = ChartBuilder::on(&root)
        .caption(title, ("sans-serif", 16))
        .margin(14)
        .x_label_area_size(44)
        .y_label_area_size(56)
        .build_cartesian_2d(across.log_scale(), 0.0..1.1 * most)?;
    let whiskers = match has_whiskers {
        true => "; whiskers: observed",
        false => "",
    };
    let across = format!("certified error, relative to {relative_to}{whiskers}");
    chart
        .configure_mesh()
        .x_desc(across)
        .y_desc("operations, polynomials included")
        .x_label_formatter(&|x| format!("1e{:.0}", x.log10()))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .light_line_style(TRANSPARENT)
        .label_style(("sans-serif", 12))
        .draw()?;
    let (grey, best): (Vec<Dot>, Vec<Dot>) = dots.iter().partition(|dot| dot.dominated);
    for dot in &grey {
        chart.draw_series(marks(dot, GREY, least))?;
    }
    for (kind, (name, colour)) in KINDS.into_iter().enumerate() {
        let own = best.iter().filter(|dot| dot.kind == kind);
        let mut front: Vec<Dot> = own.copied().collect();
        front.sort_by(|a, b| a.certified.total_cmp(&b.certified));
        if front.is_empty() {
            continue;
        }
        let line = front.iter().map(|dot| (dot.certified, dot.operations));
        let dash = if kind % 2 == 0 { 10_000 } else { 7 };
        chart
            .draw_series(DashedLineSeries::new(line, dash, 3, colour.stroke_width(2)))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
        for dot in &front {
            chart.draw_series(marks(dot, colour, least))?;
        }
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .background_style(WHITE.mix(0.8))
        .border_style(GREY)
        .label_font(("sans-serif", 12))
        .draw()?;
    root.present()?;
    // The text is written when the drawing ends.
    drop((chart, root));
    let start = text.find("<svg");
    let head = start.and_then(|at| Some(at + text[at..].find('>')? + 1));
    // By this mark the command knows its charts.
    text.insert_str(head.unwrap_or(0), "\n<desc>by dalembert tradeoff</desc>\n");
    Ok(text)
}

type Mark<'a> = DynElement<'static, SVGBackend<'a>, (f64, f64)>;

/// Returns a mark and its whisker.
fn marks<'a>(dot: &Dot, colour: RGBColor, least: f64) -> Vec<Mark<'a>> {
    let at = (dot.certified, dot.operations);
    let (size, style) = match dot.kind % 2 {
        0 => (5, colour.stroke_width(2)),
        _ => (3, colour.filled()),
    };
    let mark = match dot.kind / 2 {
        0 => Circle::new(at, size, style).into_dyn(),
        _ => TriangleMarker::new(at, size + 1, style).into_dyn(),
    };
    let end = dot.observed.unwrap_or(dot.certified).max(least);
    let whisker = PathElement::new([at, (end, dot.operations)], colour.stroke_width(1));
    vec![whisker.into_dyn(), mark]
}

/// Returns a range around positive values, wider on each side by a twentieth of the logarithm.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let logs = values
        .filter(|x| *x > 0.0 && x.is_finite())
        .map(libm::log10);
    let nothing = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = logs.fold(nothing, |(low, high), x| (low.min(x), high.max(x)));
    let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
    let margin = 0.05 * (high - low).max(8.0);
    libm::pow(10.0, low - margin)..libm::pow(10.0, high + margin)
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::{Dot, svg};

    fn dots(csv: &str) -> Vec<Dot> {
        let mut rows = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let head = rows.next().unwrap();
        rows.map(|row| {
            let cell = |name: &str| row[head.iter().position(|cell| *cell == name).unwrap()];
            let number = |name: &str| cell(name).parse::<f64>().unwrap();
            let operations = ["mul", "add", "trig_mul", "trig_add"].map(number);
            Dot {
                kind: usize::from(cell("scalar") == "f32")
                    + 2 * usize::from(cell("sincos_by") == "polynomials"),
                operations: operations.iter().sum(),
                certified: number("certified"),
                observed: cell("observed").parse().ok(),
                dominated: cell("front") != "yes",
            }
        })
        .collect()
    }

    /// The chart that is shown is the chart of the table beside it. A
    /// difference is mended and reported.
    #[test]
    fn the_checked_in_chart_is_that_of_its_table() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../generated/tradeoff");
        let csv = fs::read_to_string(folder.join("puma560.csv")).unwrap();
        let title = "puma560: inverse_dynamics";
        let chart = svg(title, "the actuators' limits", &dots(&csv)).unwrap();
        let file = folder.join("puma560.svg");
        if fs::read_to_string(&file).unwrap() != chart {
            fs::write(&file, chart).unwrap();
            panic!("{file:?} was not the chart of its table; it is now");
        }
    }
}
