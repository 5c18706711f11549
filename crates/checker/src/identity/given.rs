//! Bodies of links, drives and a payload: the arguments of the function `load`.

use num_rational::BigRational as Rational;
use num_traits::{ToPrimitive, Zero};

use super::arm::{Arm, Reading};
use super::exact::{Exact, Point, number};
use super::number::Number;
use super::robot::{Bodies, File, number_of};
use super::screw::{Body, Pose, Vector};
use super::setting::Setting;
use super::state::State;
use crate::payload;
use crate::program::{ARGUMENTS, argument};

/// The arguments that `load` can have.
pub const LOADING: [&str; 4] = ["payload", "bodies", "armature", "viscous"];
/// The largest mass, kg, and radius, m.
const MOST: f64 = 1e9;
/// A number below this is taken for zero.
const NOTHING: f64 = 1e-18;
/// Those in whose place the robot file has numbers.
pub const DEFAULTS: [&str; 3] = ["bodies", "armature", "viscous"];
/// Half the most mass, kg, of a link that has none in the file, and half of its reach, m.
const LIGHT: (f64, f64) = (1.0, 0.3);

impl Setting<'_> {
    /// Takes from a claim the arguments of `load` and the links whose bodies they are. The robot file has
    /// these numbers in the place of bodies; those that are zero stay zero, if they are kept.
    ///
    /// # Errors
    /// Links that the robot has not, or not in order.
    pub fn take(
        &mut self,
        arguments: &[String],
        links: &[usize],
        numbers: &[Exact],
        keeps_zeros: bool,
    ) -> Result<(), String> {
        self.loading = arguments.iter().filter_map(|name| argument(name)).collect();
        self.bodies = links.to_vec();
        let numbers: Vec<f64> = numbers.iter().map(Exact::nearest).collect();
        self.numbers = numbers.as_chunks().0.to_vec();
        let kept = numbers.iter().filter(|_| keeps_zeros);
        self.zeros = kept.map(|x| *x == 0.0).collect();
        let (first, last) = (usize::from(!self.floats), self.links());
        let is_there = |link: &usize| (first..=last).contains(link);
        let are_in_order = self.bodies.is_sorted_by(|one, next| one < next);
        if !are_in_order || !self.bodies.iter().all(is_there) {
            let why = format!("`bodies` are not of links {first} to {last}, in order");
            return Err(why);
        }
        let is_taken = arguments.iter().any(|name| name == "bodies");
        if is_taken == self.bodies.is_empty() {
            return Err("`bodies` of no links, or of links and no argument".into());
        }
        if is_taken && self.scene.payload.is_some() {
            return Err("the scene's payload is part of a link whose body is an argument".into());
        }
        Ok(())
    }

    /// Lists the arguments that bodies are, each with those that there may be: of a payload as the scene's
    /// box or the robot's limits have it.
    ///
    /// # Errors
    /// A range that is empty, a number that is not one.
    pub fn bodies_given(&self) -> Result<Vec<(usize, Vec<payload::BodyRange>)>, String> {
        let mut arguments = Vec::new();
        for &place in &self.loading {
            match ARGUMENTS[place].0 {
                "payload" => arguments.push((place, vec![self.body()?.unwrap_or_default()])),
                "bodies" => arguments.push((place, self.body_ranges()?)),
                _ => {}
            }
        }
        Ok(arguments)
    }

    /// Returns the bodies that each link's may be: those of its limits, or half to twice the mass, twice
    /// as far from its frame.
    fn body_ranges(&self) -> Result<Vec<payload::BodyRange>, String> {
        let of = |(link, numbers): (&usize, &[f64; 10])| {
            let joint = |row: usize| self.file.joint.get(row)?.limits.body.as_ref();
            let base = || self.file.floating.as_ref()?.limits.body.as_ref();
            let range = link.checked_sub(1).map_or_else(base, joint);
            range.map_or_else(|| Ok(around(*numbers)), |range| range.read("body"))
        };
        self.bodies.iter().zip(&self.numbers).map(of).collect()
    }
}

fn around([mass, x, y, z, xx, yy, zz, ..]: [f64; 10]) -> payload::BodyRange {
    let about = match mass > 0.0 {
        true => 0.5 * (xx + yy + zz).abs() / mass,
        false => 0.0,
    };
    let reach = (x * x + y * y + z * z).sqrt() + about.sqrt();
    let or = |x: f64, light: f64| if x > 0.0 { x } else { light };
    payload::BodyRange {
        mass: [0.5 * mass, 2.0 * or(mass, LIGHT.0)],
        radius: 2.0 * or(reach, LIGHT.1),
    }
}

impl Bodies {
    /// Reads the range, unless it is empty; `key` is the one that it stands at.
    pub(super) fn read(&self, key: &str) -> Result<payload::BodyRange, String> {
        let read = |[low, high]: &[String; 2]| {
            let double = |text: &String| number(text)?.to_f64();
            let [low, high, radius] = [low, high, &self.radius].map(double);
            let (mass, radius) = ([low?, high?], radius?);
            let is_range = 0.0 <= mass[0] && mass[0] <= mass[1] && 0.0 <= radius;
            (is_range && mass[1].max(radius) <= MOST).then_some(payload::BodyRange { mass, radius })
        };
        let why = || format!("`{key}`: expected `mass = [low, high]`, kg, and `radius`, m");
        read(&self.mass).ok_or_else(why)
    }
}

impl File {
    /// Returns the ten numbers of a link in its frame, the base's for zero.
    ///
    /// # Errors
    /// One that is not a number.
    pub fn body_of(&self, link: usize) -> Result<Vec<Exact>, String> {
        let body = match link.checked_sub(1) {
            Some(index) => (self.joint.get(index)).map(|row| (&row.mass, &row.com, &row.inertia)),
            None => (self.floating.as_ref()).map(|base| (&base.mass, &base.com, &base.inertia)),
        };
        let (mass, com, inertia) = body.ok_or("the body of a link that is not there")?;
        let mut numbers = vec![Exact::from(Rational::zero()); 10];
        let mass = [(0, mass)].into_iter().filter(|(_, text)| !text.is_empty());
        let centre = (1..).zip(com.iter().flatten());
        let inertia = (4..).zip(inertia.iter().flatten());
        for (place, text) in mass.chain(centre).chain(inertia) {
            let number = number_of(Some(text)).map_err(|why| format!("link {link}: {why}"))?;
            let is_nothing = number.to_f64().is_some_and(|x| x.abs() < NOTHING);
            numbers[place] = Exact::from(if is_nothing { Rational::zero() } else { number });
        }
        Ok(numbers)
    }

    /// Returns this robot's numbers in the place of an argument of `load`: of some links, or of all rows.
    ///
    /// # Errors
    /// One that is not a number.
    pub fn defaults(&self, name: &str, links: &[usize]) -> Result<Vec<Exact>, String> {
        let read = |text: &Option<String>| number_of(text.as_ref()).map(Exact::from);
        match name {
            "bodies" if links.len() > self.joint.len() + 1 => Err("more bodies than links".into()),
            "bodies" => {
                let bodies = links.iter().map(|link| self.body_of(*link));
                Ok(bodies.collect::<Result<Vec<_>, String>>()?.concat())
            }
            "armature" => self.joint.iter().map(|row| read(&row.armature)).collect(),
            _ => self.joint.iter().map(|row| read(&row.viscous)).collect(),
        }
    }
}

fn body(numbers: &[Number]) -> Result<(Body, Pose), String> {
    let numbers: [Number; 10] = numbers.try_into().map_err(|_| "a body is ten numbers")?;
    let mut body = Body::new(numbers);
    let centre = Pose::shift(std::mem::take::<Vector>(&mut body.first));
    Ok((body, centre))
}

impl Arm {
    pub(super) fn with_load(
        mut self,
        setting: &Setting,
        point: &Point,
        state: &State,
    ) -> Result<Arm, String> {
        // A payload is on what its link has.
        let mut places = setting.loading.clone();
        places.sort_by_key(|place| ARGUMENTS[*place].0 == "payload");
        for place in places {
            let entries = &state.arguments[place];
            match ARGUMENTS[place].0 {
                "bodies" => {
                    let stays = |place| setting.zeros.get(place) == Some(&true);
                    let entry = |(k, x): (usize, &Number)| if stays(k) { 0.into() } else { *x };
                    let numbers: Vec<Number> = entries.iter().enumerate().map(entry).collect();
                    for (link, numbers) in setting.bodies.iter().zip(numbers.chunks(10)) {
                        self.take_body(*link, body(numbers)?)?;
                    }
                }
                "armature" => {
                    let rows = self.joints.iter_mut().zip(entries);
                    rows.for_each(|(row, x)| row.armature = *x);
                }
                "viscous" => {
                    let rows = self.joints.iter_mut().zip(entries);
                    rows.for_each(|(row, x)| row.viscous = *x);
                }
                _ => {
                    let frame = point.placement(setting.file.payload_frame.as_ref())?;
                    let row = setting.file.holder(None)?.unwrap_or_default();
                    self.carry(row, body(entries)?, &frame);
                }
            }
        }
        Ok(self)
    }

    /// Puts a body, given in the frame of its link, in the place of that link's.
    fn take_body(&mut self, link: usize, (body, centre): (Body, Pose)) -> Result<(), String> {
        match link.checked_sub(1) {
            None => self.base = Some(body.moved(&centre)),
            Some(row) => {
                let joint = self.joints.get_mut(row).ok_or("a link that is not there")?;
                let at = joint.shown.then(&centre);
                joint.body = body.moved(&at);
                joint.centred = (body, at);
            }
        }
        Ok(())
    }
}
