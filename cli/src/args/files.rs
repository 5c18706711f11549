//! Arguments of the commands that make robot files and look at arms.

use std::path::PathBuf;

use super::values::lock_parser;

/// Arguments of `new`.
#[derive(Debug, clap::Args)]
pub struct NewArgs {
    /// The folder of the crate, which is called after it
    pub folder: PathBuf,
    /// A robot file, or a URDF with one chain [default: two links in a plane]
    #[arg(long, value_name = "FILE")]
    pub from: Option<PathBuf>,
    /// Take dalembert from this checkout [default: the registry's, of this
    /// version]
    #[arg(long, value_name = "FOLDER")]
    pub path: Option<PathBuf>,
    /// Print what was made as JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `import`.
///
/// Links that are fixed to each other become one. Rounded numbers are replaced by the
/// exact ones that were probably meant, 1.57079632679 by pi/2 for example; each is listed
/// with its line, and the change of the torques is bounded. --exact keeps them.
#[derive(Debug, clap::Args)]
pub struct ImportArgs {
    /// The URDF; of a xacro run `xacro arm.urdf.xacro > arm.urdf` first
    pub urdf: PathBuf,
    /// The link that stands still [default: the root]
    #[arg(long, value_name = "LINK")]
    pub base: Option<String>,
    /// The link whose frame is the hand [default: the only end of the longest
    /// chain]
    #[arg(long, value_name = "LINK")]
    pub tip: Option<String>,
    /// Write the robot file here [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Write over a file that this command did not write
    #[arg(long, requires = "output")]
    pub force: bool,
    /// A joint that stays where it is, with its position: a number of rad or m,
    /// pi/2 or 90deg; may be given again
    #[arg(long, value_name = "JOINT=VALUE", value_parser = lock_parser())]
    pub lock: Vec<(String, String)>,
    /// A link to leave away, with everything that hangs on it; may be given again
    #[arg(long, value_name = "LINK")]
    pub without: Vec<String>,
    /// Take every digit as it stands
    #[arg(long)]
    pub exact: bool,
    /// Print what there is to say of the URDF as JSON; the robot file goes to -o
    #[arg(long, requires = "output")]
    pub json: bool,
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
