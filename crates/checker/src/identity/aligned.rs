//! Rows that stand for placed joints: generators take rows, and those of a placed joint are rounded.
//! They have to have the axes, the masses and the frames of the robot file at q = 0, to sixteen
//! digits.

use std::ops::{Add, Mul, Neg};

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive};

use super::arm::{Reading, entries};
use super::exact::{Angle, fixed};
use super::robot::{File, Payload, number_of};
use super::screw::{Body, Pose, Ring, cross, scaled};

const BITS: u32 = 256;
/// The digits to which both agree, relative to the largest of what is compared.
const DIGITS: u32 = 16;

/// A number in units of 2⁻²⁵⁶.
#[derive(Clone, PartialEq)]
struct FixedPoint(BigInt);

impl From<i64> for FixedPoint {
    fn from(whole: i64) -> FixedPoint {
        FixedPoint(BigInt::from(whole) << BITS)
    }
}

impl Add for FixedPoint {
    type Output = FixedPoint;
    fn add(self, other: FixedPoint) -> FixedPoint {
        FixedPoint(self.0 + other.0)
    }
}

impl Mul for FixedPoint {
    type Output = FixedPoint;
    fn mul(self, other: FixedPoint) -> FixedPoint {
        FixedPoint((self.0 * other.0) >> BITS)
    }
}

impl Neg for FixedPoint {
    type Output = FixedPoint;
    fn neg(self) -> FixedPoint {
        FixedPoint(-self.0)
    }
}

impl Ring for FixedPoint {}

struct Digits;

impl Reading for Digits {
    type Number = FixedPoint;

    fn entry(&self, text: Option<&String>) -> Result<FixedPoint, String> {
        Ok(FixedPoint(fixed(&number_of(text)?, BITS)))
    }

    fn sines(&self, text: Option<&String>) -> Result<[FixedPoint; 2], String> {
        let text = text.map_or("0", String::as_str);
        let pair = Angle::read(text)
            .and_then(|angle| angle.rounded())
            .ok_or_else(|| format!("`{text}` is not an angle up to 8 rad"))?;
        Ok(pair.map(|sine| FixedPoint(sine >> (320 - BITS))))
    }
}

/// Divides a direction by its length; zero stays.
fn unit(axis: [FixedPoint; 3]) -> [FixedPoint; 3] {
    let square: BigInt = axis.iter().map(|x| &x.0 * &x.0).sum();
    let length = square.sqrt().max(BigInt::from(1));
    axis.map(|x| FixedPoint((x.0 << BITS) / &length))
}

struct Part {
    name: String,
    values: Vec<FixedPoint>,
    /// The size that digits are counted from, if that is not the largest value's.
    scale: BigInt,
}

impl Part {
    fn new(name: impl Into<String>, values: impl Into<Vec<FixedPoint>>) -> Part {
        let (name, values) = (name.into(), values.into());
        let scale = largest(&values);
        Part {
            name,
            values,
            scale,
        }
    }
}

fn largest(values: &[FixedPoint]) -> BigInt {
    let sizes = values.iter().map(|value| value.0.abs());
    sizes.max().unwrap_or_default()
}

fn weighed(
    name: &str,
    (body, centre): (Body<FixedPoint>, Pose<FixedPoint>),
    frame: &Pose<FixedPoint>,
) -> [Part; 3] {
    let mut at = frame.then(&centre);
    let first = scaled(body.mass.clone(), at.origin);
    at.origin = [0i64; 3].map(FixedPoint::from);
    let named = |what: &str| format!("{what} of {name}");
    [
        Part::new(named("mass"), [body.mass.clone()]),
        Part::new(named("first moments"), first),
        // About the centre of mass: about the base's origin, an arm far away would hide it.
        Part::new(named("inertia"), body.moved(&at).tensor.concat()),
    ]
}

/// The frame of a payload is that of the file, unless it is in the last link's.
fn parts(file: &File, payload: Option<&Payload>, has_frame: bool) -> Result<Vec<Part>, String> {
    let gravity = Digits.list(entries(Some(&file.gravity)))?;
    let mut parts = vec![Part::new("gravity", gravity)];
    let mut frame = Digits.placement(file.base.as_ref())?;
    if let Some(root) = &file.floating {
        let body = Digits.body(&root.mass, root.com.as_ref(), root.inertia.as_ref())?;
        parts.extend(weighed("the base", body, &frame));
    }
    // The frames of the base and of each link.
    let mut links = vec![frame.clone()];
    let place = |row: Option<usize>| row.map_or(0, |row| row + 1);
    for (index, row) in file.joint.iter().enumerate() {
        let name = |what: &str| format!("{what} of joint {}", index + 1);
        let [before, behind] = Digits.ways(row, file.convention.as_deref())?;
        let at = links[place(file.carrier(index)?)].then(&before);
        frame = at.then(&behind);
        let along = at.rotate(unit(Digits.axis(row)?));
        if row.turns() {
            // The product of a direction that agrees with a point may differ by twice as much.
            let scale = largest(&at.origin) * 2;
            let place = Part::new(name("place"), cross(at.origin, along.clone()));
            parts.push(Part { scale, ..place });
        }
        parts.push(Part::new(name("axis"), along));
        let drive = [
            &row.viscous,
            &row.coulomb,
            &row.coulomb_width,
            &row.armature,
        ];
        for coefficient in Digits.list(drive.map(Option::as_ref))? {
            parts.push(Part::new(name("drive"), [coefficient]));
        }
        let body = Digits.body(&row.mass, row.com.as_ref(), row.inertia.as_ref())?;
        parts.extend(weighed(&format!("joint {}", index + 1), body, &frame));
        let shown = frame.then(&Digits.placement(row.frame.as_ref())?);
        parts.push(Part::new(name("frame"), shown.rows()));
        links.push(frame.clone());
    }
    let hand = frame.then(&Digits.placement(file.tool.as_ref())?);
    parts.push(Part::new("tool", hand.rows()));
    let held = frame.then(&Digits.placement(file.payload_frame.as_ref())?);
    parts.push(Part::new("payload_frame", held.rows()));
    if let Some(payload) = payload {
        let body = Digits.body(&payload.mass, Some(&payload.com), payload.inertia.as_ref())?;
        let holder = &links[place(file.holder(payload.link.as_ref())?)];
        let frame = match has_frame {
            true => &holder.then(&Digits.placement(file.payload_frame.as_ref())?),
            false => holder,
        };
        parts.extend(weighed("the payload", body, frame));
    }
    for named_frame in &file.frame {
        let link = &links[place(file.frame_row(named_frame)?)];
        let at = link.then(&Digits.placement(Some(&named_frame.placement()))?);
        let name = format!("frame `{}`", named_frame.name);
        parts.push(Part::new(name, at.rows()));
    }
    Ok(parts)
}

fn payload<'f>(file: &'f File, scene: Option<&str>) -> Option<&'f Payload> {
    file.scene.get(scene?)?.payload.as_ref()
}

/// Checks that rows are those of the joints of a robot file, and that a payload in a scene, if they
/// have one, is the file's in the last link's frame.
///
/// # Errors
/// The first axis, mass or frame that is another.
pub fn check(file: &File, aligned: &File, scene: Option<&str>) -> Result<(), String> {
    let kinds = |file: &File| -> Vec<(bool, Option<String>)> {
        let rows = file.joint.iter();
        rows.map(|row| (row.turns(), row.name.clone())).collect()
    };
    let follows = |file: &File| {
        let rows = 0..file.joint.len();
        let followers = rows.map(|row| {
            let follower = file.follows(row)?;
            let mut sum = FixedPoint::from(0);
            for (factor, text) in &follower.offsets {
                let angle = file.joint[row].turns().then(|| Angle::read(text)).flatten();
                let offset = match angle {
                    Some(angle) => FixedPoint(angle.scaled(BITS)),
                    None => Digits.entry(Some(*text))?,
                };
                sum = sum + FixedPoint(fixed(factor, BITS)) * offset;
            }
            Ok((follower.row, follower.times, sum))
        });
        followers.collect::<Result<Vec<_>, String>>()
    };
    let name = |file: &File| (file.floating.as_ref()).map(|base| base.name.clone());
    if name(file) != name(aligned) {
        return Err("the rows have another base than the robot file".into());
    }
    if kinds(file) != kinds(aligned) || follows(file)? != follows(aligned)? {
        return Err("the rows are of other joints than the robot file's".into());
    }
    // At q = 0 alone, a link that another carries is in the same place.
    let carriers = |file: &File| -> Result<Vec<Option<usize>>, String> {
        (0..file.joint.len()).map(|row| file.carrier(row)).collect()
    };
    if carriers(file)? != carriers(aligned)? {
        return Err("the rows are carried by other links than the robot file's".into());
    }
    let links = |file: &File| -> Result<Vec<Option<usize>>, String> {
        let frames = file.frame.iter();
        frames.map(|frame| file.frame_row(frame)).collect()
    };
    if links(file)? != links(aligned)? {
        return Err("the rows have frames on other links than the robot file".into());
    }
    let moved = payload(aligned, scene);
    let scene_payload = payload(file, scene).filter(|_| moved.is_some());
    if moved.is_some() != scene_payload.is_some() {
        return Err("the rows have a payload, and the scene has none".into());
    }
    let holder = |file: &File, payload: Option<&Payload>| {
        let row = payload.map(|payload| file.holder(payload.link.as_ref()));
        row.transpose()
    };
    if holder(file, scene_payload)? != holder(aligned, moved)? {
        return Err("the rows have the payload on another link than the scene".into());
    }
    let file_parts = parts(file, scene_payload, true)?;
    let row_parts = parts(aligned, moved, false)?;
    let double =
        |number: &FixedPoint| (&number.0 >> (BITS - 64)).to_f64().unwrap_or(0.0) / 2f64.powi(64);
    for (file_part, other) in file_parts.iter().zip(&row_parts) {
        // Not of the claim, whose origins may stand anywhere along the axes.
        let slack: BigInt = &file_part.scale / BigInt::from(10).pow(DIGITS) + 1;
        let mut pairs = file_part.values.iter().zip(&other.values);
        let is_near = pairs.all(|(number, other)| (&number.0 - &other.0).abs() <= slack);
        if file_part.name != other.name || !is_near {
            let name = &file_part.name;
            let doubles = |part: &Part| part.values.iter().map(double).collect::<Vec<_>>();
            let (numbers, other) = (doubles(file_part), doubles(other));
            let why = format!("{name}: {numbers:?} in the file, {other:?} claimed");
            return Err(why);
        }
    }
    Ok(())
}
