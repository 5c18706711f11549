//! A chart of named curves.

use super::picture::{Picture, Shape};

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

/// Smaller values are drawn as this one.
const FOOT: f64 = 0.1;

impl Chart {
    /// Returns the chart's text.
    pub fn svg(&self) -> String {
        let points = || self.curves.iter().flat_map(|(_, points)| points);
        let x = Picture::across(points().map(|point| point.0));
        let bound = self.bound.iter().map(|(level, _)| *level);
        let y = Picture::upward(points().map(|point| point.1.max(FOOT)).chain(bound));
        let mut picture = Picture::new(&self.title, [&x, &y], [&self.x, &self.y]);
        if let Some((level, name)) = &self.bound {
            picture.level(y.place(*level));
            picture.legend_of_level(name);
        }
        for (kind, (name, points)) in self.curves.iter().enumerate() {
            let sample = picture.legend(name);
            picture.curve(kind, kind, &sample);
            let places = points
                .iter()
                .map(|point| [x.place(point.0), y.place(point.1)]);
            let places: Vec<[f64; 2]> = places.collect();
            picture.curve(kind, kind, &places);
            for place in places {
                picture.mark(Shape::Dot, &format!("k{}", kind % 4), place);
            }
        }
        picture.end()
    }
}
