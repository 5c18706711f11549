//! Round numbers along an axis.

/// The scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// In equal steps.
    Linear,
    /// In powers of ten; what is not positive is at the lower end.
    Logarithmic,
}

/// An axis with its ends at ticks.
#[derive(Clone, Debug)]
pub struct Axis {
    scale: Scale,
    /// In steps: where the first tick is, and how many follow.
    first: f64,
    steps: usize,
    /// The value of a step; of a logarithmic axis the logarithm.
    step: f64,
    /// On paper.
    from: f64,
    to: f64,
}

/// The most steps of an axis.
const STEPS: f64 = 6.0;

impl Axis {
    /// Returns an axis with room for these values; of those that are no finite numbers, or that
    /// the scale does not have, it takes no notice.
    pub fn new(scale: Scale, values: impl Iterator<Item = f64>) -> Axis {
        let values = values.map(|value| along(scale, value));
        let (low, high) = values
            .filter(|value| value.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            });
        let (low, high) = if low < high {
            (low, high)
        } else if low == high {
            (low - 0.5, high + 0.5)
        } else {
            (0.0, 1.0)
        };
        let step = match scale {
            Scale::Linear => round((high - low) / STEPS),
            Scale::Logarithmic => libm::ceil((high - low) / STEPS).max(1.0),
        };
        let first = libm::floor(low / step);
        Axis {
            scale,
            first,
            steps: (libm::ceil(high / step) - first) as usize,
            step,
            from: 0.0,
            to: 1.0,
        }
    }

    /// Returns the axis between two places on paper.
    pub fn between(self, from: f64, to: f64) -> Axis {
        Axis { from, to, ..self }
    }

    /// Returns the place of a value on paper; values beyond the ends are at the ends.
    pub fn place(&self, value: f64) -> f64 {
        let at = (along(self.scale, value) / self.step - self.first) / self.steps as f64;
        self.from + (self.to - self.from) * at.clamp(0.0, 1.0)
    }

    /// Returns the ticks, and what is written at them.
    pub fn ticks(&self) -> impl Iterator<Item = (f64, String)> {
        (0..=self.steps).map(|step| {
            let value = (self.first + step as f64) * self.step;
            match self.scale {
                Scale::Linear => {
                    let digits = -libm::floor(libm::log10(self.step) + 1e-9);
                    (value, format!("{value:.*}", digits.max(0.0) as usize))
                }
                Scale::Logarithmic => (libm::pow(10.0, value), format!("1e{value:.0}")),
            }
        })
    }
}

fn along(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear => value,
        // Of zero it is −∞, of less no number: both are left out.
        Scale::Logarithmic => libm::log10(value),
    }
}

/// Returns the next larger of 1, 2 and 5 times a power of ten.
fn round(step: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(step)));
    let steps = [1.0, 2.0, 5.0].map(|factor| factor * power);
    let fits = |candidate: &f64| *candidate >= step * (1.0 - 1e-9);
    steps.into_iter().find(fits).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(scale: Scale, values: &[f64]) -> Vec<String> {
        let axis = Axis::new(scale, values.iter().copied());
        axis.ticks().map(|(_, text)| text).collect()
    }

    #[test]
    fn ticks_are_round() {
        use Scale::{Linear, Logarithmic};
        assert_eq!(written(Linear, &[0.0, 4.0]), ["0", "1", "2", "3", "4"]);
        assert_eq!(
            written(Linear, &[-0.03, 0.06]),
            ["-0.04", "-0.02", "0.00", "0.02", "0.04", "0.06"]
        );
        let powers = ["1e-5", "1e-4", "1e-3"];
        assert_eq!(written(Logarithmic, &[2e-5, 0.0, 5e-4]), powers);
        // Nothing, one value, no numbers.
        for values in [&[][..], &[3.0], &[f64::NAN, f64::INFINITY]] {
            assert!(written(Linear, values).len() > 1);
        }
    }

    #[test]
    fn what_is_beyond_is_at_the_end() {
        let axis = Axis::new(Scale::Logarithmic, [1e-4, 1.0].into_iter()).between(100.0, 0.0);
        assert_eq!(
            [1.0, 1e-2, 1e-4, 0.0].map(|x| axis.place(x)),
            [0.0, 50.0, 100.0, 100.0]
        );
    }
}
