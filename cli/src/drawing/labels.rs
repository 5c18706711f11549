//! The numbers of joints at their axes: those of axes that end at one place, as
//! coaxial ones do, are one text.

use super::page::Page;

/// Texts nearer than this to each other, in pixels, would be written over each other.
const NEAR: [f64; 2] = [14.0, 12.0];

/// Numbers and where they stand.
#[derive(Default)]
pub(super) struct Labels(Vec<([f64; 2], String)>);

impl Labels {
    /// Adds a number at a point, or beside what stands there.
    pub(super) fn add(&mut self, at: [f64; 2], number: usize) {
        let is_near = |other: &[f64; 2]| (0..2).all(|k| (other[k] - at[k]).abs() < NEAR[k]);
        match self.0.iter_mut().find(|(other, _)| is_near(other)) {
            Some((_, text)) => *text += &format!(", {number}"),
            None => self.0.push((at, number.to_string())),
        }
    }

    /// Writes all of them.
    pub(super) fn write(&self, page: &mut Page) {
        for (at, text) in &self.0 {
            page.label(*at, text);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_overlap_is_one_text() {
        let mut labels = Labels::default();
        for (at, number) in [([10.0, 10.0], 1), ([60.0, 10.0], 2), ([12.0, 15.0], 3)] {
            labels.add(at, number);
        }
        let texts: Vec<&str> = labels.0.iter().map(|(_, text)| text.as_str()).collect();
        assert_eq!(texts, ["1, 3", "2"]);
    }
}
