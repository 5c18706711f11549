//! The front as SVG: operations, those of polynomials for sines included, over certified error,
//! both logarithmic.
//!
//! Each variant is a mark at its certified error with a whisker to what was
//! observed. A line joins the front of each kind; dominated variants are grey,
//! below the others. f64 is open, f32 full, smaller and dashed: where both are, both
//! are seen.

use crate::sweep::Point;

use crate::plot::picture::{Picture, Shape};

/// The kinds of variants, as the legend names them.
const KINDS: [(&str, Shape); 4] = [
    ("f64, libm", Shape::Ring),
    ("f32, libm", Shape::Dot),
    ("f64, polynomials", Shape::OpenDiamond),
    ("f32, polynomials", Shape::Diamond),
];

/// One variant, as the chart shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Dot {
    kind: usize,
    cost: f64,
    certified: f64,
    observed: Option<f64>,
    dominated: bool,
}

impl Dot {
    fn of(point: &Point, cost: f64) -> Dot {
        Dot {
            kind: point.kind(),
            cost,
            certified: point.certified,
            observed: point.observed,
            dominated: point.dominated,
        }
    }
}

/// What the chart of operations counts.
const OPERATIONS: &str = "operations, polynomials' included";

/// Returns the chart of operations.
pub fn of_operations(title: &str, relative_to: &str, points: &[Point]) -> String {
    let dots = points.iter().map(|point| {
        let counts = point.counts();
        let operations = counts.operations() + counts.trig_mul + counts.trig_add;
        Dot::of(point, operations as f64)
    });
    let dots: Vec<Dot> = dots.collect();
    front(title, [relative_to, OPERATIONS], &dots)
}

fn front(title: &str, [relative_to, cost]: [&str; 2], dots: &[Dot]) -> String {
    let observed = || dots.iter().filter_map(|dot| dot.observed);
    let certified = dots.iter().map(|dot| dot.certified);
    let x = Picture::across(certified.chain(observed()));
    let y = Picture::upward(dots.iter().map(|dot| dot.cost));
    let whiskers = match observed().next() {
        Some(_) => "; whiskers: observed",
        None => "",
    };
    let below = format!("certified error, relative to {relative_to}{whiskers}");
    let mut picture = Picture::new(title, [&x, &y], [&below, cost]);
    let place = |dot: &Dot| [x.place(dot.certified), y.place(dot.cost)];

    let (dominated, best): (Vec<Dot>, Vec<Dot>) = dots.iter().partition(|dot| dot.dominated);
    // A variant that several tolerances lead to is dominated by itself.
    let covered = |dot: &Dot| {
        let [x, y] = place(dot);
        let mut alike = best
            .iter()
            .filter(|other| other.kind == dot.kind)
            .map(&place);
        alike.any(|[left, top]| (left - x).abs() < 1.0 && (top - y).abs() < 1.0)
    };
    let dominated: Vec<Dot> = dominated.into_iter().filter(|dot| !covered(dot)).collect();

    for (kind, _) in KINDS.iter().enumerate() {
        let mut line: Vec<&Dot> = best.iter().filter(|dot| dot.kind == kind).collect();
        line.sort_by(|a, b| a.certified.total_cmp(&b.certified));
        let line: Vec<[f64; 2]> = line.into_iter().map(place).collect();
        picture.curve(kind, kind % 2, &line);
    }
    let classed = |dot: &Dot| match dot.dominated {
        true => "d".to_owned(),
        false => format!("k{}", dot.kind),
    };
    for group in [&dominated, &best] {
        for (kind, (_, shape)) in KINDS.into_iter().enumerate() {
            for dot in group.iter().filter(|dot| dot.kind == kind) {
                if let Some(observed) = dot.observed.filter(|observed| *observed > 0.0) {
                    picture.whisker(&classed(dot), place(dot), x.place(observed));
                }
                picture.mark(shape, &classed(dot), place(dot));
            }
        }
    }
    for (kind, (name, shape)) in KINDS.into_iter().enumerate() {
        if dots.iter().any(|dot| dot.kind == kind) {
            let [from, to] = picture.legend(name);
            picture.curve(kind, kind % 2, &[from, to]);
            picture.mark(
                shape,
                &format!("k{kind}"),
                [(from[0] + to[0]) / 2.0, from[1]],
            );
        }
    }
    if !dominated.is_empty() {
        let [from, to] = picture.legend("dominated");
        picture.mark(Shape::Ring, "d", [(from[0] + to[0]) / 2.0, from[1]]);
    }
    picture.end()
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::{Dot, OPERATIONS, front};

    /// Returns a ladder as a robot gives it: both scalars, both kinds of sines, and
    /// exact programs that several tolerances lead to.
    fn ladder() -> Vec<Dot> {
        let mut dots = Vec::new();
        for rung in 0..11 {
            let tolerance = 10f64.powi(rung - 12);
            for kind in 0..4 {
                let certified = tolerance * [0.93, 0.94, 0.97, 0.98][kind];
                dots.push(Dot {
                    kind,
                    cost: (260 - 20 * rung) as f64 + if kind > 1 { 60.0 } else { 0.0 },
                    certified,
                    observed: Some(certified * 0.1),
                    dominated: rung == 4,
                });
            }
        }
        let first = dots[0];
        dots.push(Dot {
            dominated: true,
            ..first
        });
        dots
    }

    /// Returns the numbers of an attribute, wherever it stands.
    fn numbers(svg: &str, attribute: &str) -> Vec<f64> {
        let key = format!(" {attribute}=\"");
        let values = svg.split(&key).skip(1);
        let values = values.map(|rest| rest.split('"').next().unwrap_or_default());
        values.map(|value| value.parse().unwrap()).collect()
    }

    /// Every name is on the paper, and no two are in the same place.
    #[test]
    fn a_full_ladder_is_legible() {
        let svg = front(
            "arm: inverse_dynamics",
            ["the actuators' limits", OPERATIONS],
            &ladder(),
        );
        let (xs, ys) = (numbers(&svg, "x"), numbers(&svg, "y"));
        assert_eq!(xs.len(), ys.len());
        // What stands beside the axis is turned, and alone there.
        let level = xs.into_iter().zip(ys).filter(|place| place.0 > 16.0);
        let places: Vec<_> = level.collect();
        for (index, (x, y)) in places.iter().enumerate() {
            assert!((10.0..=700.0).contains(x) && (10.0..=415.0).contains(y));
            for (other_x, other_y) in &places[..index] {
                let apart = (x - other_x).abs() >= 40.0 || (y - other_y).abs() >= 16.0;
                assert!(apart, "{x},{y} {other_x},{other_y}");
            }
        }
        for kind in 0..4 {
            // The line with its place in the legend; ten marks and that one.
            let count = |what: &str| svg.matches(&format!("class=\"k{kind} {what}\"")).count();
            assert_eq!(count("l"), 2);
            assert_eq!(count("o") + count("f"), 11);
        }
        // Four dominated ones and the legend's, but not the first one's repeat.
        assert_eq!(svg.matches("class=\"d o\"").count(), 3);
        assert_eq!(svg.matches("class=\"d f\"").count(), 2);
        let first = |class: &str| svg.find(&format!("<path class=\"{class}\"")).unwrap();
        assert!(first("d o") < first("k0 o"), "dominated ones lie below");
    }

    /// Nothing was left out, or there is nothing at all: still a picture.
    #[test]
    fn one_variant_and_none() {
        for dots in [&ladder()[..1], &[]] {
            let svg = front("arm: gravity", ["the largest torques", OPERATIONS], dots);
            assert!(!svg.contains("NaN") && !svg.contains("inf"));
            assert!(numbers(&svg, "x").len() > 6);
        }
    }

    fn dot(row: &[&str], head: &[&str]) -> Dot {
        let cell = |name: &str| row[head.iter().position(|cell| *cell == name).unwrap()];
        let number = |name: &str| cell(name).parse::<f64>().unwrap();
        let operations = ["mul", "add", "trig_mul", "trig_add"].map(number);
        Dot {
            kind: usize::from(cell("scalar") == "f32")
                + 2 * usize::from(cell("sincos_by") == "polynomials"),
            cost: operations.iter().sum(),
            certified: number("certified"),
            observed: cell("observed").parse().ok(),
            dominated: cell("front") != "yes",
        }
    }

    /// The chart that is shown is the chart of the table beside it. A
    /// difference is mended and reported.
    #[test]
    fn the_checked_in_chart_is_that_of_its_table() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/tradeoff");
        let csv = fs::read_to_string(folder.join("puma560.csv")).unwrap();
        let mut rows = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let head = rows.next().unwrap();
        let dots: Vec<Dot> = rows.map(|row| dot(&row, &head)).collect();
        let svg = front(
            "puma560: inverse_dynamics",
            ["the actuators' limits", OPERATIONS],
            &dots,
        );
        let file = folder.join("puma560.svg");
        if fs::read_to_string(&file).unwrap() != svg {
            fs::write(&file, svg).unwrap();
            panic!(
                "{} was not the chart of its table; it is now",
                file.display()
            );
        }
    }
}
