//! What the command makes of an arm: its robot file, its picture, its counts.

use std::fs;

use dalembert_cli::drawing;
use dalembert_codegen::{Counts, Function, Request, ScalarType, generate};
use dalembert_import::{Options, import};
use dalembert_model::read;
use dalembert_model::robot::Robot;

use crate::arms::{Arm, Source};
use crate::folder;

/// The functions that are counted.
pub const FUNCTIONS: [Function; 3] = [
    Function::InverseDynamics,
    Function::Gravity,
    Function::Inertia,
];

/// An arm of the gallery.
#[derive(Clone, Debug)]
pub struct Made {
    /// Which.
    pub arm: &'static Arm,
    /// The robot file that is written; `None` where the arm has one elsewhere.
    pub file: Option<String>,
    /// The robot that the file is read as.
    pub robot: Robot,
    /// The drawing, as SVG.
    pub picture: String,
    /// The notes of the import about its URDF.
    pub notes: Vec<String>,
}

impl Made {
    /// Imports or reads the arm, and draws it.
    ///
    /// # Errors
    /// What is wrong with its source, as text.
    pub fn of(arm: &'static Arm) -> Result<Made, String> {
        let name = arm.path().to_owned();
        let source =
            fs::read_to_string(folder().join(&name)).map_err(|error| format!("{name}: {error}"))?;
        let (file, robot, notes) = match &arm.source {
            Source::Urdf(_) => {
                let imported = import(&source, &options(arm))
                    .map_err(|errors| errors.render(&name, &source))?;
                let notes = imported.notes.iter();
                let notes = notes.map(|note| note.render(&name, &source)).collect();
                let file = format!("{}{}", head(arm), imported.text);
                (Some(file), imported.robot, notes)
            }
            Source::RobotFile(_) => {
                let reading = read::parse(&source, &read::Options::default())
                    .map_err(|errors| errors.render(&name, &source))?;
                (None, reading.robot, Vec::new())
            }
        };
        let at: Vec<f64> = match arm.at {
            [] => vec![0.0; robot.joints.len()],
            at => at.to_vec(),
        };
        let picture = drawing::svg(&robot, &at).map_err(|error| format!("{name}: {error}"))?;
        Ok(Made {
            arm,
            file,
            robot,
            picture,
            notes,
        })
    }

    /// Returns the files of the arm, by their names in the gallery.
    pub fn files(&self) -> Vec<(String, String)> {
        let file = self.file.clone();
        let file = file.map(|text| (self.arm.robot_file(), text));
        let picture = (self.arm.picture(), self.picture.clone());
        file.into_iter().chain([picture]).collect()
    }
}

fn options(arm: &Arm) -> Options {
    let Source::Urdf(chain) = &arm.source else {
        return Options::default();
    };
    let name = |link: &str| (!link.is_empty()).then(|| link.to_owned());
    let file = chain.path.rsplit('/').next().unwrap_or_default();
    Options {
        base: name(chain.base),
        tip: name(chain.tip),
        lock: chain
            .lock
            .iter()
            .map(|joint| ((*joint).to_owned(), "0".to_owned()))
            .collect(),
        without: chain.without.iter().map(|link| (*link).into()).collect(),
        snap: true,
        file: file.to_owned(),
        ..Options::default()
    }
}

/// Returns the comment above a robot file: what it is, from where, under which licence.
fn head(arm: &Arm) -> String {
    format!(
        "# {}.\n#\n# Source: {}.\n# Licence: {}.\n#\n",
        arm.title, arm.from, arm.licence
    )
}

/// Returns the operations of every one of [`FUNCTIONS`], by a quick search without a plan.
///
/// # Errors
/// Nothing can be generated for the robot.
pub fn counts(robot: &Robot) -> Result<Vec<Counts>, String> {
    let request = Request {
        scalars: vec![ScalarType::F64],
        ..Request::of(&FUNCTIONS)
    };
    let generated =
        generate(robot, &request).map_err(|error| format!("{}: {error}", robot.name))?;
    let of = |wanted: &Function| {
        let mut functions = generated.functions.iter();
        let found = functions.find(|function| function.function == *wanted);
        found
            .map(|function| function.counts())
            .ok_or_else(|| format!("{}: there is no {wanted}", robot.name))
    };
    FUNCTIONS.iter().map(of).collect()
}
