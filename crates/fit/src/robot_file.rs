//! The robot that has the bodies and drives that were identified.

use std::fs;
use std::io::{Error as IoError, ErrorKind, Result as IoResult};
use std::path::Path;

pub use dalembert_codegen::workspace::write_whole;
use dalembert_codegen::workspace::{Comment, refusal, sealed};
use dalembert_model::number::Rational;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::placed::Body;
use dalembert_model::robot::{Inertia, Robot, write};
use num_traits::Zero;

use crate::consistent::Bodies;
use crate::error::Error;
use crate::model::Model;

/// Returns the model's robot with other bodies and drives, for
/// [`write`](dalembert_model::robot::write()). The sensors' offsets are not part of it.
///
/// Numbers have 13 digits, or 17 where a body at the border of those that exist needs them. One
/// that rounding has put beyond the border gets more inertia about its centre, at most a part in
/// 1e9 of what it has about the origin.
///
/// # Errors
/// [`Error::Value`] for a number beyond the range of robot files, or a body that does not exist.
pub fn identified(model: &Model, bodies: &Bodies) -> Result<Robot, Error> {
    let mut robot = model.robot().clone();
    if let (Some(base), Some(link)) = (&mut robot.floating, bodies.links.first()) {
        let base_body = body(link, 0)?;
        (base.mass, base.com, base.inertia) = (base_body.mass, base_body.com, base_body.inertia);
    }
    for (i, joint) in robot.joints.iter_mut().enumerate() {
        let link = bodies.links.get(model.first_link() + i);
        joint.set_own_body(body(&link.copied().unwrap_or_default(), i)?);
        joint.armature = rounded("armature", i, bodies.armature[i], 12)?;
        joint.viscous = rounded("viscous", i, bodies.viscous[i], 12)?;
        joint.coulomb = rounded("coulomb", i, bodies.coulomb[i], 12)?;
        if joint.has_coulomb() && joint.coulomb_width.is_zero() {
            joint.coulomb_width = rounded("coulomb_width", i, model.width(i), 16)?;
        }
    }
    Ok(robot)
}

/// Refuses the name of a file that [`save`] would not replace.
///
/// # Errors
/// A file that is not empty and that [`save`] did not write, or that was edited since.
pub fn replaceable(path: &Path) -> IoResult<()> {
    if !path.is_file() {
        return Ok(());
    }
    let edited = "the file was edited since it was written";
    let foreign = "the file exists, and no identification wrote it";
    let Some(why) = refusal(&fs::read(path)?, edited, foreign) else {
        return Ok(());
    };
    let why = format!("{why}: delete it, or give another name");
    Err(IoError::new(ErrorKind::AlreadyExists, why))
}

/// Writes a robot file, whole or not at all, below a line with the hash of the rest, which tells
/// files that were edited.
///
/// # Errors
/// Those of [`replaceable`]: the file stays as it was. Those of the system.
pub fn save(path: &Path, robot: &Robot) -> IoResult<()> {
    replaceable(path)?;
    let text = sealed(Comment::Toml, "identified by dalembert", &write(robot));
    write_whole(path, &text)
}

/// Returns mass, centre of mass and the tensor about it, of the ten moments about the origin.
fn body(link: &[f64; 10], index: usize) -> Result<Body, Error> {
    let [mass, x, y, z, xx, yy, zz, xy, yz, xz] = *link;
    let com = [x, y, z].map(|first| first / mass);
    let origin = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let square: f64 = com.iter().map(|x| x * x).sum();
    let about = |i: usize, k: usize| {
        let trace = if i == k { square } else { 0.0 };
        origin[i][k] - mass * (trace - com[i] * com[k])
    };
    let parts = [0.0, 1e-15, 1e-13, 1e-11, 1e-9].map(|part| (16, part));
    for (digits, part) in [(12, 0.0)].into_iter().chain(parts) {
        let number = |value: f64| rounded("link", index, value, digits);
        let diagonal = |i: usize| number(about(i, i) + part * (xx + yy + zz));
        let inertia = Inertia {
            xx: diagonal(0)?,
            yy: diagonal(1)?,
            zz: diagonal(2)?,
            xy: number(about(0, 1))?,
            yz: number(about(1, 2))?,
            xz: number(about(0, 2))?,
        };
        let mass = number(mass)?;
        if inertia.defect(&mass).is_none() {
            let [x, y, z] = com;
            let com = [number(x)?, number(y)?, number(z)?];
            return Ok(Body { mass, com, inertia });
        }
    }
    Err(Error::Value {
        argument: "links",
        index,
        found: mass,
    })
}

fn rounded(name: &'static str, index: usize, value: f64, digits: usize) -> Result<Rational, Error> {
    let number = parse_decimal(&format!("{value:.digits$e}"));
    number.map_err(|_| Error::Value {
        argument: name,
        index,
        found: value,
    })
}
