//! Arguments of the commands that make robot files and look at arms.

use std::path::{Path, PathBuf};

use dalembert_import::Options;
use dalembert_model::number::Rational;

use super::values::{acceleration_parser, lock_parser, name_parser};

/// Arguments of `new`.
#[derive(Debug, clap::Args)]
pub struct NewArgs {
    /// The folder of the crate, which is called after it
    pub folder: PathBuf,
    /// A robot file, or a URDF or MJCF with what `import` takes for it [default: two links in a plane]
    #[arg(long, value_name = "FILE")]
    pub from: Option<PathBuf>,
    #[command(flatten)]
    pub chain: ChainArgs,
    /// Take dalembert from this checkout [default: the one that this program was
    /// built from, or crates.io]
    #[arg(long, value_name = "FOLDER")]
    pub path: Option<PathBuf>,
    /// Print what was made as JSON
    #[arg(long)]
    pub json: bool,
}

/// Which chain of a URDF is taken, and how.
#[derive(Debug, clap::Args)]
pub struct ChainArgs {
    /// The link that stands still [default: the root]
    #[arg(long, value_name = "LINK")]
    pub base: Option<String>,
    /// The link whose frame is the hand [default: the palm, or the end of the
    /// longest chain]
    #[arg(long, value_name = "LINK")]
    pub tip: Option<String>,
    /// A joint that stays where it is, by its name or its number among those that move, with its
    /// position: a number of rad or m, pi/2 or 90deg; may be given again, and for all that hangs
    /// on the chain as '*=0'
    #[arg(long, value_name = "JOINT=VALUE", value_parser = lock_parser())]
    pub lock: Vec<(String, String)>,
    /// Hold every other joint that hangs on the chain here, or at its nearest limit
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub lock_others: Option<String>,
    /// A link to leave away, with everything that hangs on it; may be given again
    #[arg(long, value_name = "LINK")]
    pub without: Vec<String>,
    /// Take every digit as it stands
    #[arg(long)]
    pub exact: bool,
    /// Take rounded numbers for the exact ones that they were probably meant to be, even where that
    /// changes a torque by more than 1e-6 of its limit
    #[arg(long, conflicts_with = "exact")]
    pub snap: bool,
    /// Leave out tendons, loops and equalities, which no chain of joints can have
    #[arg(long)]
    pub ignore_ties: bool,
    /// The limit of acceleration of every joint, rad/s² or m/s², which models do not have
    /// [default: 10]
    #[arg(long, value_name = "A", value_parser = acceleration_parser(), allow_hyphen_values = true)]
    pub acceleration: Option<Rational>,
    /// The name of the robot [default: the model's]
    #[arg(long, value_name = "NAME", value_parser = name_parser())]
    pub name: Option<String>,
}

/// The limit of acceleration that is taken where none is given, rad/s² or m/s².
const ACCELERATION: i64 = 10;

impl ChainArgs {
    /// Returns whether one of them is given.
    pub fn is_given(&self) -> bool {
        let names = self.base.is_some() || self.tip.is_some() || self.name.is_some();
        let flags = self.exact || self.snap || self.ignore_ties || self.acceleration.is_some();
        names
            || flags
            || self.lock_others.is_some()
            || !self.lock.is_empty()
            || !self.without.is_empty()
    }

    /// Returns the options for a URDF with this path.
    pub fn options(&self, urdf: &Path) -> Options {
        let all = ("*".to_owned(), self.lock_others.clone().unwrap_or_default());
        let others = self.lock_others.iter().map(|_| all.clone());
        Options {
            base: self.base.clone(),
            tip: self.tip.clone(),
            lock: self.lock.iter().cloned().chain(others).collect(),
            without: self.without.clone(),
            exact: self.exact,
            snap: self.snap,
            ignore_ties: self.ignore_ties,
            acceleration: Some(
                self.acceleration
                    .clone()
                    .unwrap_or_else(|| Rational::from_integer(ACCELERATION.into())),
            ),
            file: urdf
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned(),
            name: self.name.clone(),
        }
    }

    /// Returns the sentence that says which limit of acceleration was taken unasked.
    pub fn assumed(&self) -> Option<String> {
        self.acceleration.is_none().then(|| {
            format!(
                "every joint's limit of acceleration is taken to be {ACCELERATION} rad/s² or m/s², since \
                 models have none: --acceleration gives another"
            )
        })
    }
}

/// Arguments of `import`.
///
/// Links that are fixed to each other become one. Rounded numbers are replaced by the
/// exact ones that were probably meant, 1.57079632679 by pi/2 for example; each is listed
/// with its line, and the change of the torques is bounded. --exact keeps them; --snap takes those, too,
/// that change a torque by more than 1e-6 of its limit.
#[derive(Debug, clap::Args)]
pub struct ImportArgs {
    /// The URDF, the MJCF of MuJoCo, or a xacro, for which the program `xacro` is run
    pub urdf: PathBuf,
    /// Write the robot file here [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Write a robot file of every arm into the folder that -o names, with all other joints
    /// held, and say which arms move each other
    #[arg(long, requires = "output", conflicts_with = "tip")]
    pub all: bool,
    /// Write over a file that this command did not write
    #[arg(long, requires = "output")]
    pub force: bool,
    #[command(flatten)]
    pub chain: ChainArgs,
    /// Print what there is to say of the URDF as JSON; the robot file goes to -o
    #[arg(long, requires = "output")]
    pub json: bool,
    /// Arguments of a xacro, after `--`
    #[arg(last = true, value_name = "NAME:=VALUE")]
    pub xacro: Vec<String>,
}

/// Arguments of `show`.
#[derive(Debug, clap::Args)]
pub struct ShowArgs {
    /// The robot file
    pub robot: PathBuf,
    /// The position of every joint, in rad or m, pi/2 or 90deg, separated by
    /// commas [default: zeros]
    #[arg(
        long,
        value_name = "Q",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub at: Vec<String>,
    /// Write the drawing here [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Write over a file that this command did not write
    #[arg(long, requires = "output")]
    pub force: bool,
    /// Print the poses of links and hand as JSON; without -o nothing is drawn
    #[arg(long)]
    pub json: bool,
}
