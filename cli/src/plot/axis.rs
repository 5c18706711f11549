//! A logarithmic axis, and what is written beside it.

/// A logarithmic axis.
pub struct Axis {
    /// Decimal logarithms of the ends.
    ends: [f64; 2],
    /// Where the ends are in the picture.
    places: [f64; 2],
    /// The least distance of two names.
    least: f64,
}

/// A line of the grid.
pub struct Tick {
    /// Where it is in the picture.
    pub place: f64,
    /// The text beside it, if there is room.
    pub name: Option<String>,
}

/// The share left free at each end, so that no mark lies on the frame.
const MARGIN: f64 = 0.03;
/// At least so much of a decade is shown: equal values have no scale.
const SPAN: f64 = 0.1;
/// Powers of ten are enough from so many decades on.
const DECADES: f64 = 3.0;
/// The fewest names of an axis.
const NAMES: usize = 5;
/// Round numbers within a decade, from sparse to dense.
const ROUND: [&[f64]; 2] = [&[1.0, 2.0, 5.0], &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0]];
/// Steps of round numbers as parts of a power of ten, from far to near.
const EVEN: [f64; 5] = [2.0, 1.0, 0.5, 0.2, 0.1];

impl Axis {
    /// Makes an axis over values above zero, which others are drawn below, from one place of the
    /// picture to another; names are at least so far apart.
    pub fn over(values: impl Iterator<Item = f64>, places: [f64; 2], least: f64) -> Axis {
        let logs = values.filter(|v| *v > 0.0 && v.is_finite()).map(f64::log10);
        let nothing = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = logs.fold(nothing, |[low, high], v| [low.min(v), high.max(v)]);
        let [low, high] = if low <= high { [low, high] } else { [0.0, 1.0] };
        let more = (SPAN - (high - low)).max(0.0) / 2.0;
        let margin = MARGIN * (high - low).max(SPAN) + more;
        Axis {
            ends: [low - margin, high + margin],
            places,
            least,
        }
    }

    /// Returns where a value is.
    pub fn place(&self, value: f64) -> f64 {
        let [low, high] = self.ends;
        let log = if value > 0.0 { value.log10() } else { low };
        let [from, to] = self.places;
        from + ((log - low) / (high - low)).clamp(0.0, 1.0) * (to - from)
    }

    /// Powers of ten, or round numbers where those are too few.
    pub fn ticks(&self) -> Vec<Tick> {
        let [low, high] = self.ends;
        if high - low >= DECADES {
            return self.decades();
        }
        let round = ROUND.iter().map(|mantissas| self.round(mantissas));
        let even = EVEN.iter().map(|part| self.even(*part));
        let roomy = round.chain(even).filter(|values| self.is_roomy(values));
        let mut best = Vec::new();
        for values in roomy {
            if best.len() < NAMES.min(values.len()) {
                best = values;
            }
        }
        let tick = |value: f64| Tick {
            place: self.place(value),
            name: Some(number(value)),
        };
        best.into_iter().map(tick).collect()
    }

    /// Returns every power of ten; as many are named as there is room for.
    fn decades(&self) -> Vec<Tick> {
        let [low, high] = self.ends;
        let [from, to] = self.places;
        let decade = (to - from).abs() / (high - low);
        let every = (self.least / decade).ceil().max(1.0) as i32;
        let all = low.ceil() as i32..=high.floor() as i32;
        let tick = |power: i32| Tick {
            place: self.place(10f64.powi(power)),
            name: (power % every == 0).then(|| format!("1e{power}")),
        };
        all.map(tick).collect()
    }

    fn round(&self, mantissas: &[f64]) -> Vec<f64> {
        let [low, high] = self.ends;
        let powers = low.floor() as i32..=high.floor() as i32;
        let all = powers.flat_map(|power| mantissas.iter().map(move |m| m * 10f64.powi(power)));
        let inside = |value: &f64| (low..=high).contains(&value.log10());
        all.filter(inside).collect()
    }

    /// Returns round numbers, equally far apart, by a part of a power of ten: for less than a
    /// decade.
    fn even(&self, part: f64) -> Vec<f64> {
        let [low, high] = self.ends.map(|end| 10f64.powf(end));
        let step = part * 10f64.powi((high - low).log10().floor() as i32);
        let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
        (first..=last).map(|k| k as f64 * step).collect()
    }

    /// Returns whether the names of these values are apart.
    fn is_roomy(&self, values: &[f64]) -> bool {
        let gaps = values.windows(2);
        let mut gaps = gaps.map(|pair| (self.place(pair[1]) - self.place(pair[0])).abs());
        gaps.all(|gap| gap >= self.least)
    }
}

/// Writes a number in few digits: what a person would write.
fn number(value: f64) -> String {
    match value {
        0.001..100_000.0 => format!("{}", (value * 1e6).round() / 1e6),
        _ => {
            let text = format!("{value:.3e}");
            let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
            let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
            format!("{mantissa}e{power}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Axis;

    fn names(low: f64, high: f64) -> Vec<String> {
        let axis = Axis::over([low, high].into_iter(), [58.0, 568.0], 48.0);
        let ticks = axis.ticks().into_iter();
        ticks.filter_map(|tick| tick.name).collect()
    }

    /// Whatever is shown, there are enough numbers to read values off, and
    /// none of them is written over another.
    #[test]
    fn every_range_has_names_and_room_for_them() {
        for low in [1e-15, 3.7e-8, 0.2, 1.0, 26.0, 46.0, 350.0] {
            for factor in [1.0, 1.05, 1.3, 2.0, 3.0, 9.0, 40.0, 300.0, 1e6, 1e14] {
                let high = low * factor;
                let axis = Axis::over([low, high].into_iter(), [58.0, 568.0], 48.0);
                let ticks = axis.ticks();
                let named: Vec<_> = ticks.iter().filter(|tick| tick.name.is_some()).collect();
                assert!(named.len() >= 3, "{low} to {high}: {}", named.len());
                for pair in named.windows(2) {
                    assert!(pair[1].place - pair[0].place >= 47.0, "{low} to {high}");
                    assert_ne!(pair[0].name, pair[1].name, "{low} to {high}");
                }
                let inside = |value| (58.0..=568.0).contains(&axis.place(value));
                assert!([low, high, 0.0, high * 10.0].into_iter().all(inside));
            }
        }
    }

    #[test]
    fn names_are_round() {
        assert_eq!(names(1.7, 100.0), ["2", "5", "10", "20", "50", "100"]);
        assert_eq!(names(5e-15, 0.097)[..3], ["1e-14", "1e-12", "1e-10"]);
        assert_eq!(names(1e-7, 4e-7), ["1e-7", "1.5e-7", "2e-7", "3e-7"]);
        // Nothing at all still has axes.
        let axis = Axis::over(std::iter::empty(), [0.0, 100.0], 10.0);
        assert!(!axis.ticks().is_empty());
    }
}
