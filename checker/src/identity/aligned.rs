//! Rows that stand for placed joints: generators take rows, and those of a placed joint are rounded.
//! They have to have the axes, the masses and the frames of the robot file at q = 0, to sixteen
//! digits.

use std::array::from_fn;

use num_bigint::BigInt;
use num_traits::{Signed, Zero};

use super::exact::{Angle, fixed};
use super::robot::{File, Placement, Row, number_of};

/// Bits behind the point.
const BITS: u32 = 256;
/// The digits to which both agree, relative to the largest of what is compared.
const DIGITS: u32 = 16;

/// A number in units of 2⁻²⁵⁶.
type Fixed = BigInt;
type Vector = [Fixed; 3];

fn times(a: &Fixed, b: &Fixed) -> Fixed {
    (a * b) >> BITS
}

fn dot(a: &Vector, b: &Vector) -> Fixed {
    (0..3).map(|k| times(&a[k], &b[k])).sum()
}

fn sum(a: &Vector, b: &Vector) -> Vector {
    from_fn(|k| &a[k] + &b[k])
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        times(&a[i], &b[j]) - times(&a[j], &b[i])
    })
}

fn read(text: Option<&String>) -> Result<Fixed, String> {
    Ok(fixed(&number_of(text)?, BITS))
}

fn list<const K: usize>(list: Option<&[String; K]>) -> Result<[Fixed; K], String> {
    let all = (0..K).map(|k| read(list.map(|list| &list[k])));
    let all = all.collect::<Result<Vec<Fixed>, String>>()?;
    Ok(from_fn(|k| all[k].clone()))
}

/// A turn by its columns, and a shift.
#[derive(Clone)]
struct Pose {
    axes: [Vector; 3],
    origin: Vector,
}

impl Pose {
    fn shift(origin: Vector) -> Pose {
        let one = BigInt::from(1) << BITS;
        let axes = from_fn(|k| from_fn(|i| if i == k { one.clone() } else { Fixed::zero() }));
        Pose { axes, origin }
    }

    fn turn(axis: usize, text: Option<&String>) -> Result<Pose, String> {
        let text = text.map_or("0", String::as_str);
        let angle = Angle::read(text).and_then(|angle| angle.rounded());
        let [sin, cos] = angle.ok_or_else(|| format!("`{text}` is no angle up to 8 rad"))?;
        let (sin, cos) = (sin >> (320 - BITS), cos >> (320 - BITS));
        let mut pose = Pose::shift(Default::default());
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        (pose.axes[next][next], pose.axes[last][last]) = (cos.clone(), cos);
        (pose.axes[next][last], pose.axes[last][next]) = (sin.clone(), -sin);
        Ok(pose)
    }

    fn rotate(&self, v: &Vector) -> Vector {
        from_fn(|i| (0..3).map(|k| times(&self.axes[k][i], &v[k])).sum())
    }

    fn then(&self, next: &Pose) -> Pose {
        Pose {
            axes: from_fn(|k| self.rotate(&next.axes[k])),
            origin: sum(&self.rotate(&next.origin), &self.origin),
        }
    }

    fn placed(own: Option<&Placement>) -> Result<Pose, String> {
        let mut pose = Pose::shift(list(own.and_then(|own| own.xyz.as_ref()))?);
        let rpy = own.and_then(|own| own.rpy.as_ref());
        for axis in [2, 1, 0] {
            pose = pose.then(&Pose::turn(axis, rpy.map(|rpy| &rpy[axis]))?);
        }
        Ok(pose)
    }

    fn numbers(self) -> Vec<Fixed> {
        [self.axes.concat(), self.origin.to_vec()].concat()
    }
}

impl Row {
    /// Returns the ways before and behind the joint's axis.
    fn fixed_ways(&self, convention: Option<&str>) -> Result<[Pose; 2], String> {
        let (theta, d) = match self.turns() {
            true => (&self.offset, &self.d),
            false => (&self.theta, &self.offset),
        };
        let zero = Fixed::zero;
        let along = Pose::shift([zero(), zero(), read(d.as_ref())?]);
        let along = Pose::turn(2, theta.as_ref())?.then(&along);
        let across = Pose::shift([read(self.a.as_ref())?, zero(), zero()]);
        let across = across.then(&Pose::turn(0, self.alpha.as_ref())?);
        let none = Pose::shift(Default::default());
        match (convention, &self.placement) {
            (_, Some(placement)) => Ok([Pose::placed(Some(placement))?, none]),
            (Some("modified"), None) => Ok([across, along]),
            _ => {
                let tilted = across.then(&Pose::turn(1, self.beta.as_ref())?);
                Ok([none, along.then(&tilted)])
            }
        }
    }

    /// Returns mass, first moment and tensor about the base's origin, in base axes.
    fn fixed_body(&self, frame: &Pose) -> Result<Vec<Fixed>, String> {
        let mass = read(Some(&self.mass))?;
        let centre = sum(&frame.rotate(&list(self.com.as_ref())?), &frame.origin);
        let [xx, yy, zz, xy, yz, xz] = list(self.inertia.as_ref())?;
        let rows = [
            [xx, xy.clone(), xz.clone()],
            [xy, yy, yz.clone()],
            [xz, yz, zz],
        ];
        let half: [Vector; 3] = rows.each_ref().map(|row| frame.rotate(row));
        let turned: [Vector; 3] = from_fn(|k| frame.rotate(&from_fn(|j| half[j][k].clone())));
        let square = dot(&centre, &centre);
        let mut all = vec![mass.clone()];
        all.extend(centre.iter().map(|own| times(&mass, own)));
        for i in 0..3 {
            for k in i..3 {
                let steiner = times(&centre[i], &centre[k]);
                let steiner = if i == k { &square - steiner } else { -steiner };
                all.push(&turned[k][i] + times(&mass, &steiner));
            }
        }
        Ok(all)
    }
}

/// The parts that are compared, each by its name.
type Parts = Vec<(String, Vec<Fixed>)>;

/// Returns axes, masses and frames of a robot file.
fn parts(file: &File) -> Result<Parts, String> {
    let mut all = vec![("gravity".to_owned(), list(Some(&file.gravity))?.to_vec())];
    let mut frame = Pose::placed(file.base.as_ref())?;
    let mut links = Vec::new();
    for (index, row) in file.joint.iter().enumerate() {
        let name = |what: &str| format!("{what} of joint {}", index + 1);
        let [before, behind] = row.fixed_ways(file.convention.as_deref())?;
        let at = frame.then(&before);
        frame = at.then(&behind);
        let along = match &row.axis {
            Some(axis) => at.rotate(&list(Some(axis))?),
            None => at.axes[2].clone(),
        };
        let moment = cross(&at.origin, &along);
        all.push((name("axis"), along.to_vec()));
        if row.turns() {
            all.push((name("place"), moment.to_vec()));
        }
        let [drive, offset] = [&row.viscous, &row.coulomb].map(|own| read(own.as_ref()));
        let [width, armature] = [&row.coulomb_width, &row.armature].map(|own| read(own.as_ref()));
        all.push((name("drive"), vec![drive?, offset?, width?, armature?]));
        let body = row.fixed_body(&frame)?;
        all.push((name("mass"), body[..1].to_vec()));
        all.push((name("first moments"), body[1..4].to_vec()));
        all.push((name("inertia"), body[4..].to_vec()));
        let shown = frame.then(&Pose::placed(row.frame.as_ref())?);
        all.push((name("frame"), shown.numbers()));
        links.push(frame.clone());
    }
    let hand = frame.then(&Pose::placed(file.tool.as_ref())?);
    all.push(("tool".to_owned(), hand.numbers()));
    let payload = frame.then(&Pose::placed(file.payload_frame.as_ref())?);
    all.push(("payload_frame".to_owned(), payload.numbers()));
    for own in &file.frame {
        let link = &links[file.row(&own.link)?];
        let at = link.then(&Pose::placed(Some(&own.placement()))?);
        all.push((format!("frame `{}`", own.name), at.numbers()));
    }
    Ok(all)
}

/// Checks that rows are those of the joints of a robot file.
///
/// # Errors
/// The first axis, mass or frame that is another.
pub fn check(file: &File, aligned: &File) -> Result<(), String> {
    let kinds = |file: &File| -> Vec<(bool, Option<String>)> {
        let rows = file.joint.iter();
        rows.map(|row| (row.turns(), row.name.clone())).collect()
    };
    let follows = |file: &File| {
        let rows = 0..file.joint.len();
        let own = rows.map(|row| {
            let own = file.follows(row)?;
            let mut sum = Fixed::zero();
            for (factor, text) in &own.offsets {
                let angle = file.joint[row].turns().then(|| Angle::read(text)).flatten();
                let offset = match angle {
                    Some(angle) => angle.scaled(BITS),
                    None => read(Some(*text))?,
                };
                sum += times(&fixed(factor, BITS), &offset);
            }
            Ok((own.row, own.times, sum))
        });
        own.collect::<Result<Vec<_>, String>>()
    };
    if kinds(file) != kinds(aligned) || follows(file)? != follows(aligned)? {
        return Err("the rows are of other joints than the robot file's".into());
    }
    let (own, other) = (parts(file)?, parts(aligned)?);
    for ((name, own), (same, other)) in own.iter().zip(&other) {
        let sizes = own.iter().chain(other).map(Signed::abs);
        let most = sizes.max().unwrap_or_default();
        let slack = most / BigInt::from(10).pow(DIGITS) + 1;
        let mut pairs = own.iter().zip(other);
        if name != same || pairs.any(|(own, other)| (own - other).abs() > slack) {
            return Err(format!("{name}: the rows have another than the robot file"));
        }
    }
    match own.len() == other.len() {
        true => Ok(()),
        false => Err("the rows have other frames than the robot file".into()),
    }
}
