//! Residuals over time, as SVG.

use std::fmt::Write;

/// Columns of a picture: of each the least and the largest value is kept.
const COLUMNS: usize = 600;
const HEIGHT: f64 = 60.0;
const LEFT: f64 = 70.0;
const TOP: f64 = 24.0;

/// The residuals of a log, as many as a picture can show.
pub struct Curves {
    name: String,
    rows: u64,
    next_row: u64,
    time: [f64; 2],
    /// For each joint: the least and the largest value of each column.
    ranges: Vec<Vec<[f64; 2]>>,
}

impl Curves {
    pub fn new(name: &str, joints: usize, rows: u64) -> Curves {
        Curves {
            name: name.to_owned(),
            rows: rows.max(1),
            next_row: 0,
            time: [f64::NAN; 2],
            ranges: vec![vec![[f64::INFINITY, f64::NEG_INFINITY]; COLUMNS]; joints],
        }
    }

    /// Adds residuals, column by column, in the order of time.
    pub fn add(&mut self, time: &[f64], residuals: &[f64]) {
        let (Some(first), Some(last)) = (time.first(), time.last()) else {
            return;
        };
        if self.time[0].is_nan() {
            self.time[0] = *first;
        }
        self.time[1] = *last;
        let joints = residuals.chunks_exact(time.len());
        for (ranges, column) in self.ranges.iter_mut().zip(joints) {
            for (s, value) in column.iter().enumerate() {
                let place = (self.next_row + s as u64) * COLUMNS as u64 / self.rows;
                let range = &mut ranges[(place as usize).min(COLUMNS - 1)];
                *range = [range[0].min(*value), range[1].max(*value)];
            }
        }
        self.next_row += time.len() as u64;
    }
}

/// Draws logs one below the other, a strip a joint.
pub fn picture(logs: &[&Curves]) -> String {
    let width = LEFT + COLUMNS as f64 + 20.0;
    let strips: usize = logs.iter().map(|log| log.ranges.len()).sum();
    let height = strips as f64 * HEIGHT + logs.len() as f64 * (TOP + 20.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let mut y = 0.0;
    for log in logs {
        y += TOP;
        let title = format!("{}: residuals, N·m or N", log.name);
        text(&mut svg, 4.0, y - 8.0, "start", &title);
        for (i, ranges) in log.ranges.iter().enumerate() {
            strip(&mut svg, y, i, ranges);
            y += HEIGHT;
        }
        let [first, last] = log.time.map(|time| format!("{time:.2} s"));
        text(&mut svg, LEFT, y + 12.0, "start", &first);
        text(&mut svg, LEFT + COLUMNS as f64, y + 12.0, "end", &last);
        y += 20.0;
    }
    svg += "</svg>\n";
    svg
}

fn strip(svg: &mut String, y: f64, joint: usize, ranges: &[[f64; 2]]) {
    let columns = ranges.iter().enumerate();
    let filled = Vec::from_iter(columns.filter(|(_, [least, most])| least <= most));
    let sizes = filled.iter().map(|(_, [least, most])| most.max(-least));
    let largest = sizes.fold(0.0, f64::max);
    let middle = y + 0.5 * HEIGHT;
    let scale = match largest {
        0.0 => 0.0,
        largest => 0.45 * HEIGHT / largest,
    };
    let at = |value: f64| middle - scale * value;
    let mut points = String::new();
    for (k, [_, most]) in &filled {
        let _ = write!(points, "{:.1},{:.1} ", LEFT + *k as f64, at(*most) - 0.3);
    }
    for (k, [least, _]) in filled.iter().rev() {
        let _ = write!(points, "{:.1},{:.1} ", LEFT + *k as f64, at(*least) + 0.3);
    }
    let end = LEFT + COLUMNS as f64;
    let _ = writeln!(
        svg,
        "<path d=\"M{LEFT} {middle}H{end}\" stroke=\"#ccc\"/>\n\
         <polygon points=\"{}\" fill=\"#1b6ca8\"/>",
        points.trim_end()
    );
    let (name, size) = (format!("joint {}", joint + 1), format!("±{largest:.3}"));
    text(svg, LEFT - 6.0, middle - 4.0, "end", &name);
    text(svg, LEFT - 6.0, middle + 10.0, "end", &size);
}

fn text(svg: &mut String, x: f64, y: f64, anchor: &str, text: &str) {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    let at = format!("x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\"");
    let _ = writeln!(svg, "<text {at}>{text}</text>");
}
