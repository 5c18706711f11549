//! Positions and orientations, which MJCF has five ways to write.

use dalembert_model::equations::matrix::Vector;
use dalembert_model::number::recover::rounded;
use dalembert_model::number::{Angle, Rational, Wide};
use dalembert_model::placed::frame::{direction, length, turned};
use dalembert_model::scalar::Scalar;

use super::Mjcf;
use crate::meant;
use crate::model::{Number, Value};
use crate::orientation::{
    Both, Pose, both_identities, composed, of_axes, of_quaternion, of_third_axis,
};
use crate::text::Span;
use crate::xml::{Attribute, Element};

pub(super) const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];

impl Mjcf<'_, '_, '_> {
    pub(super) fn pose(&mut self, element: &Element) -> Pose {
        let xyz = self.reader.vector(element, "pos");
        let (orientation, at) = self.orientation(element);
        Pose::of(xyz, orientation, &at)
    }

    /// Reads an orientation with its place; the identity where there is none or a mistake.
    fn orientation(&mut self, element: &Element) -> (Both, Span) {
        let attributes = ORIENTATIONS.into_iter().filter_map(|key| element.get(key));
        let orientations: Vec<&Attribute> = attributes.collect();
        let Some(Attribute { key, at, .. }) = orientations.first() else {
            return (both_identities(), element.at.clone());
        };
        if let Some(second) = orientations.get(1) {
            let key = |orientation: &&Attribute| orientation.key.clone();
            let keys = Vec::from_iter(orientations.iter().map(key)).join("` and `");
            self.reader.report("two_orientations", &second.at, &[&keys]);
        }
        let reader = &mut *self.reader;
        let rotation = match key.as_str() {
            "quat" => reader.numbers(element, key).map(of_quaternion),
            "xyaxes" => reader.numbers(element, key).map(of_axes),
            "zaxis" => reader.numbers(element, key).map(of_third_axis),
            "euler" => {
                let angles = reader.numbers(element, key);
                angles.map(|angles| Some(self.of_angles(&angles)))
            }
            _ => {
                let numbers = reader.numbers(element, key);
                numbers.map(|[x, y, z, angle]| self.of_axis(&[x, y, z], &angle))
            }
        };
        if let Some(None) = rotation {
            self.reader.report("orientation_of_zero", at, &[key]);
        }
        let rotation = rotation.flatten().unwrap_or_else(both_identities);
        (rotation, at.clone())
    }

    /// Returns the middle between the ends of a `fromto`, with z along it in a direction (1: to
    /// the second end), and half its length.
    pub(super) fn between(&mut self, element: &Element, sign: i64) -> Option<(Pose, Rational)> {
        let ends: [Number; 6] = self.reader.numbers(element, "fromto")?;
        let [two, sign] = [2, sign].map(|number| Rational::from_integer(number.into()));
        let [from, to] = [&ends[..3], &ends[3..]];
        let along = [0, 1, 2].map(|i| (&to[i].value - &from[i].value) * &sign);
        let middle = [0, 1, 2].map(|i| (&from[i].value + &to[i].value) / &two);
        let whole = length(&along.each_ref().map(Wide::from_rational)).to_rational();
        let along = of_third_axis(along.map(|x| Value::new(x, "", &element.at)))?;
        let zeros = Number::constants(["0", "0", "0"], &element.at);
        let turned = Pose::of(zeros, along, &element.at);
        let at = Pose::identity(element.at.clone()).shift(&middle);
        Some((at.then(&turned), rounded(&(whole / two))))
    }

    /// Returns an angle in the units of the file.
    pub(super) fn angle(&self, number: &Number) -> Angle {
        let value = number.value.clone();
        let angle = match self.settings.degrees {
            true => Angle::PiTimes(value / Rational::from_integer(180.into())),
            false => Angle::Radians(value),
        };
        angle.canonical()
    }

    fn angles(&self, number: &Number) -> [Angle; 2] {
        let angle = self.angle(number);
        let meant = meant::meant(&angle, &number.text);
        [angle.clone(), meant.unwrap_or(angle)]
    }

    fn of_axis(&self, axis: &[Number; 3], angle: &Number) -> Option<Both> {
        let axis = direction(&axis.each_ref().map(|x| x.value.clone()))?;
        Some(self.angles(angle).map(|angle| turned(&axis, &angle)))
    }

    fn of_angles(&self, angles: &[Number; 3]) -> Both {
        let turns = self.settings.euler.iter().zip(angles);
        turns.fold(both_identities(), |before, (turn, angle)| {
            let mut axis: Vector<Wide> = [(); 3].map(|()| Wide::zero());
            axis[turn.axis] = Wide::one();
            let next = self.angles(angle).map(|angle| turned(&axis, &angle));
            match turn.stays {
                true => composed(&next, &before),
                false => composed(&before, &next),
            }
        })
    }
}
