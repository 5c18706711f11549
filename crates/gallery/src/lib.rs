//! Arms of many makers as robot files, with pictures and operation counts. One command makes all of
//! it from `arms.toml`, the URDFs in `urdf/` and robot files elsewhere in the workspace:
//!
//! ```sh
//! cargo run --release -p dalembert-gallery
//! ```
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use dalembert_cli::drawing;
use dalembert_codegen::Function::{Gravity, Inertia, InverseDynamics};
use dalembert_codegen::{LimbLayout, Request, ScalarType, generate};
use dalembert_import::{OpenError, Options, open};
use dalembert_model::robot::{JointKind, Robot};
use serde::Deserialize;

/// An arm of `arms.toml`, whose head explains the keys.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arm {
    /// The name of its files.
    pub name: String,
    /// The URDF or robot file that it is made from, relative to the gallery.
    pub file: String,
    /// The licence of that file.
    pub licence: String,
    title: String,
    base: Option<String>,
    tip: Option<String>,
    #[serde(default)]
    tree: bool,
    #[serde(default)]
    floating: bool,
    #[serde(default)]
    lock: BTreeMap<String, String>,
    #[serde(default)]
    without: Vec<String>,
    origin: String,
    at: Vec<f64>,
    peer: Option<[String; 3]>,
}

/// An arm with everything that is made from its source.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The arm.
    pub arm: Arm,
    /// The robot of its source.
    pub robot: Robot,
    /// The warnings and notes about its source.
    pub notes: Vec<String>,
    /// The files that are written.
    pub files: Vec<File>,
}

/// A path in the gallery, and the text of the file there.
pub type File = (String, String);

/// Returns the folder of the gallery in this checkout.
pub fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../gallery"))
}

/// Makes every arm of `arms.toml`, in its order.
///
/// # Errors
/// The table, a source or a pose is wrong.
pub fn entries() -> Result<Vec<Entry>, Box<dyn Error>> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Table {
        arm: Vec<Arm>,
    }
    let table: Table = toml::from_str(include_str!("../../../gallery/arms.toml"))?;
    let made = table.arm.into_iter().map(Arm::make);
    Ok(made.collect::<Result<_, _>>()?)
}

impl Arm {
    /// Returns the path of its robot file, relative to the gallery.
    pub fn robot_file(&self) -> String {
        match self.file.ends_with(".urdf") {
            true => format!("robots/{}.toml", self.name),
            false => self.file.clone(),
        }
    }

    /// Returns the path of its picture, relative to the gallery.
    pub fn picture(&self) -> String {
        format!("pictures/{}.svg", self.name)
    }

    fn make(self) -> Result<Entry, String> {
        let options = Options {
            base: self.base.clone(),
            tips: self.tip.iter().cloned().collect(),
            tree: self.tree,
            floating: self.floating,
            lock: self.lock.clone().into_iter().collect(),
            without: self.without.clone(),
            snap: true,
            file: self.file.rsplit('/').next().unwrap_or_default().into(),
            ..Options::default()
        };
        let opened = open(&folder().join(&self.file), &options).map_err(|why| match why {
            OpenError::System(error) => format!("{}: {error}", self.file),
            OpenError::Wrong(errors) => errors.render(),
        })?;
        let picture = drawing::svg(&opened.reading.robot, &self.at)
            .map_err(|why| format!("{}: {why}", self.name))?;
        let mut files = vec![(self.picture(), picture)];
        if opened.imported.is_some() {
            let [title, origin, licence] = [&self.title, &self.origin, &self.licence];
            let head = format!("# {title}.\n#\n# Source: {origin}.\n# Licence: {licence}.\n#\n");
            files.push((self.robot_file(), head + &opened.robot_file));
        }
        Ok(Entry {
            notes: opened.notes(),
            robot: opened.reading.robot,
            arm: self,
            files,
        })
    }
}

impl Entry {
    /// Returns the table row of the arm: its joints from the base, as `3P 3R`, and the counts of a
    /// quick search beside those of the best other tool.
    ///
    /// # Errors
    /// Nothing can be generated for the robot.
    pub fn row(&self) -> Result<String, String> {
        let (arm, robot) = (&self.arm, &self.robot);
        let mut request = Request::new(&[InverseDynamics, Gravity, Inertia]);
        request.scalars = vec![ScalarType::F64];
        // The counts of other tools have no lanes.
        request.limbs = LimbLayout::Apart;
        let generated = generate(robot, &request).map_err(|why| format!("{}: {why}", arm.name))?;
        let mut row = format!("| [{}](#{}) |", arm.title, arm.name);
        for group in robot.joints.chunk_by(|a, b| a.kind == b.kind) {
            let is_slide = group[0].kind == JointKind::Prismatic;
            row += &format!(" {}{}", group.len(), if is_slide { 'P' } else { 'R' });
        }
        row += " |";
        for (place, function) in generated.functions.iter().enumerate() {
            let peer = arm.peer.as_ref().map_or("–", |peer| &peer[place]);
            let counts = function.counts();
            row += &format!(" {}/{} | {peer} |", counts.mul, counts.add);
        }
        Ok(row + "\n")
    }
}

/// Returns the page of the gallery: the table of all arms, then a picture of each.
///
/// # Errors
/// Nothing can be generated for one of them.
pub fn page(entries: &[Entry]) -> Result<String, String> {
    let mut page = include_str!("../../../gallery/head.md").to_owned();
    for entry in entries {
        page += &entry.row()?;
    }
    for Entry { arm, .. } in entries {
        let [name, title, origin, licence] = [&arm.name, &arm.title, &arm.origin, &arm.licence];
        let (file, picture) = (arm.robot_file(), arm.picture());
        page += &format!("\n## {name}\n\n{title}: [robot file]({file}). From {origin}; ");
        page += &format!("{licence}.\n\n![{title}]({picture})\n");
    }
    Ok(page)
}
