//! The command line.

use std::ffi::OsStr;
use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, StringValueParser, TypedValueParser};
use clap::{ArgGroup, Parser, Subcommand};
use dalembert_codegen::backend::{Entries, MathPath};
use dalembert_codegen::clauses::words::bundle;
use dalembert_codegen::emit::Interface;
use dalembert_codegen::function::Function;
use dalembert_codegen::generate::{Fma, Prefer, Request};
use dalembert_codegen::portfolio::Start;
use dalembert_codegen::program::{Library, ScalarType};
use dalembert_codegen::simplify::Effort;
use dalembert_codegen::sincos::SinCos;
use dalembert_model::number::Rational;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::outputs::RuntimeParameter;
use dalembert_report::processor::target::Target;
use dalembert_report::processor::targets::TARGETS;

/// Verified, flat robot dynamics generated for one arm.
///
/// Exit codes: 0 good, 1 a check failed, 2 bad input.
#[derive(Debug, Parser)]
#[command(name = "dalembert", version)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Generate Rust source for a robot, proved before it is printed
    Generate(GenerateArgs),
    /// Make a crate with an arm: robot file, macro, a test against the runtime
    New(NewArgs),
    /// Make a robot file of a chain of a URDF
    Import(ImportArgs),
    /// Draw the arm in two views, with frames, axes, masses and its table (SVG)
    Show(ShowArgs),
    /// Count the operations of the generated functions
    Count(CountArgs),
    /// Prove the functions and measure what rounding costs
    Verify(VerifyArgs),
    /// Say which coefficients of the dynamics vanish or repeat, and why
    Couplings(CouplingsArgs),
    /// Show how many operations each step of the generator saves, and for what reason
    Explain(ExplainArgs),
    /// Measure rounding errors in extreme cases: huge angles and speeds, odd masses
    Stress(StressArgs),
    /// Check a certificate again: proof, edits, text and every bound
    Certify(CertifyArgs),
    /// Measure what accuracy costs: certified error against operations
    Tradeoff(TradeoffArgs),
    /// Compare with Table 3: the paper's counts, the formulas', the generator's
    Table3(Table3Args),
}

/// Which functions, and from what.
#[derive(Clone, Debug, clap::Args)]
pub struct Choice {
    /// The functions, separated by commas [default: all]; NAME=A+B is one that
    /// returns what A and B do, and shares their work
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = function_parser())]
    pub outputs: Vec<Function>,
    /// The formulation to start from; `auto` takes the cheapest
    #[arg(long, value_name = "NAME", default_value = "auto", value_parser = start_parser())]
    pub formulation: Start,
    /// The scalar [default: both]
    #[arg(long, value_name = "TYPE", value_parser = scalar_parser())]
    pub scalar: Option<ScalarType>,
    /// How long to search for fewer operations. Ctrl-C ends a thorough search
    /// early (not with --check) and takes the best program so far, or the quick
    /// search's if that is cheaper; a second Ctrl-C quits without a result
    #[arg(long, value_name = "EFFORT", default_value = "quick", value_parser = effort_parser())]
    pub effort: Effort,
    /// `operations` takes the cheapest program even if it costs digits; `latency` takes
    /// sums and products in the order in which the longest chain of operations is shortest
    #[arg(long, value_name = "WHAT", default_value = "accuracy", value_parser = prefer_parser())]
    pub prefer: Prefer,
    /// Make one operation, `mul_add`, of a product and the sum that alone reads it:
    /// rounded once. The code needs std, and a build for a processor that has it
    /// (-C target-cpu=native); any other calls a slow function for each
    #[arg(long)]
    pub fma: bool,
    /// Only what this scene of the robot file needs; its outputs and scalar
    /// are the defaults
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// Parameters that become arguments of the functions instead of constants: `gravity`,
    /// and `payload`, which a function `load` turns once into the argument `load` of
    /// the others
    #[arg(long, value_name = "WHICH", value_delimiter = ',', value_parser = parameter_parser())]
    pub parameters: Vec<RuntimeParameter>,
    /// Search anew even if a plan is kept beside the robot file
    #[arg(long)]
    pub no_plan: bool,
    /// How sines and cosines are computed: `libm`, one call for each angle;
    /// `together`, one call of the crate dalembert-sines for all angles of a
    /// function, in a third of libm's time; `polynomial`, polynomials that
    /// hold inside the joints' limits only; `auto`, polynomials where a
    /// scene's tolerance admits them, else libm
    #[arg(long, value_name = "HOW", default_value = "auto", value_parser = sincos_parser())]
    pub sincos: SinCos,
    /// The largest error of each sine and cosine by polynomials [default: 1e-6,
    /// or what a scene's tolerance admits]
    #[arg(long, value_name = "ERROR", value_parser = error_parser(), allow_hyphen_values = true)]
    pub sincos_error: Option<f64>,
}

impl Choice {
    /// The request that it makes.
    pub fn request(&self) -> Request {
        let mut request = Request {
            start: self.formulation,
            effort: self.effort,
            prefer: self.prefer,
            fma: match self.fma {
                true => Fma::On,
                false => Fma::Off,
            },
            parameters: self.parameters.clone(),
            ..Request::default()
        };
        if !self.outputs.is_empty() {
            request.functions.clone_from(&self.outputs);
        }
        if let Some(scalar) = self.scalar {
            request.scalars = vec![scalar];
        }
        request.sincos = match self.sincos {
            SinCos::Polynomial { .. } => SinCos::Polynomial {
                error: self.sincos_error,
            },
            other => other,
        };
        request.math = MathPath::of(self.sincos.library(Library::Libm));
        request
    }
}

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
    /// Print the poses of links and hand as JSON; without -o nothing is drawn
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `generate`.
#[derive(Debug, clap::Args)]
#[command(group(ArgGroup::new("standard output free").multiple(true)))]
pub struct GenerateArgs {
    /// The robot file
    pub robot: PathBuf,
    /// Write the code to this file [default: standard output]; a link is
    /// followed, a device or pipe written into
    #[arg(short, long, value_name = "FILE", group = "standard output free")]
    pub output: Option<PathBuf>,
    /// Write nothing: compare with FILE and exit with 1 if it differs
    #[arg(long, requires = "output")]
    pub check: bool,
    /// With a scene that has a tolerance: write its certificates (JSON) to this
    /// file [default: beside the output, as NAME.certificate.json, unless that
    /// is a device or pipe]
    #[arg(long, value_name = "FILE")]
    pub certificate: Option<PathBuf>,
    /// Search anew and keep the programs in a plan beside the robot file:
    /// every later run, macro and build script replays them. After a search
    /// that was ended early, a kept program stays unless that found a cheaper
    /// one
    #[arg(long, conflicts_with_all = ["check", "no_plan"])]
    pub save_plan: bool,
    /// Write what is inside the module and not the module itself: for a FILE
    /// that is a module of your crate (`mod puma560;`). It has one scalar
    #[arg(long)]
    pub contents: bool,
    /// Which variants of each function to print, each choice with those before it:
    /// `single`; `with_sincos`, which takes sines and cosines as arguments; `lanes`,
    /// for several states at once; `batch`, for slices of states (needs the crate
    /// dalembert-batch)
    #[arg(long, value_name = "WHICH", default_value = "single", value_parser = entries_parser())]
    pub entries: Entries,
    /// What the module has besides functions: `traits` adds a type `Robot` that implements
    /// the traits of `dalembert::interface`, for code that is generic over robots
    #[arg(long, value_name = "HOW", default_value = "functions", value_parser = interface_parser())]
    pub interface: Interface,
    /// Measure errors at this many states inside the robot's limits [default:
    /// 100, fewer above 10 joints; 10000 with --effort thorough]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = states_parser())]
    pub states: Option<usize>,
    /// Print what each function takes of a processor, by the model of the guide's
    /// page on real time: instructions, stack, calls, values alive; the code goes
    /// to -o, without it nowhere
    #[arg(long, group = "standard output free")]
    pub report: bool,
    /// The processors of the report, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', requires = "report", value_parser = target_parser())]
    pub target: Vec<&'static Target>,
    /// Print the reports as JSON; the code goes to -o
    #[arg(long, requires = "standard output free")]
    pub json: bool,
    #[command(flatten)]
    pub choice: Choice,
}

/// Arguments of `count`.
#[derive(Debug, clap::Args)]
pub struct CountArgs {
    /// The robot file
    pub robot: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub choice: Choice,
}

/// Arguments of `verify`.
#[derive(Debug, clap::Args)]
pub struct VerifyArgs {
    /// The robot file
    pub robot: PathBuf,
    /// Compare with these states too: JSON with a list `states` of objects
    /// with q, qd, qdd and any of tau, D, h, c
    #[arg(long, value_name = "FILE.json", conflicts_with = "scene")]
    pub states: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub choice: Choice,
}

/// Arguments of `couplings`.
#[derive(Debug, clap::Args)]
pub struct CouplingsArgs {
    /// The robot file
    pub robot: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `explain`.
#[derive(Debug, clap::Args)]
pub struct ExplainArgs {
    /// The robot file
    pub robot: PathBuf,
    /// The functions, separated by commas [default: the scene's, or
    /// inverse_dynamics]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = function_parser())]
    pub outputs: Vec<Function>,
    /// Only what this scene of the robot file needs
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// States that errors are measured in
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 1000, value_parser = states_parser())]
    pub states: usize,
    /// How long to search for fewer operations
    #[arg(long, value_name = "EFFORT", default_value = "quick", value_parser = effort_parser())]
    pub effort: Effort,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `stress`.
#[derive(Debug, clap::Args)]
pub struct StressArgs {
    /// The robot file
    #[arg(required_unless_present = "growth")]
    pub robot: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Write charts (SVG) to this folder
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// States of each category
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        value_parser = states_parser(),
        default_value_t = 50
    )]
    pub states: usize,
    /// Measure chains of 1 to 60 joints instead of a robot
    #[arg(long, conflicts_with = "robot")]
    pub growth: bool,
}

/// Arguments of `certify`.
#[derive(Debug, clap::Args)]
pub struct CertifyArgs {
    /// The certificate (JSON)
    pub certificate: PathBuf,
    /// The robot file that it is for
    #[arg(long, value_name = "FILE")]
    pub robot: PathBuf,
    /// The scene of the robot file that it is for [default: the one it names]
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// The largest certified error E to accept, instead of the scene's tolerance;
    /// for certificates that `tradeoff` wrote for other tolerances
    #[arg(long, value_name = "E", value_parser = exact_tolerance_parser())]
    pub tolerance: Option<Rational>,
    /// Also write scripts by which Gappa bounds the rounding of each output,
    /// into this folder
    #[arg(long, value_name = "DIR")]
    pub gappa: Option<PathBuf>,
    /// Also run the code at this many states and look for an error above E
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        value_parser = count_parser(),
        default_value_t = 0
    )]
    pub samples: usize,
    /// Local searches for each output, from the worst of these states, for a larger error
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        value_parser = count_parser(),
        default_value_t = 8
    )]
    pub climbs: usize,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `tradeoff`.
#[derive(Debug, clap::Args)]
pub struct TradeoffArgs {
    /// The robot file; the box is its limits of motion, unless a scene has one
    pub robot: PathBuf,
    /// Only what this scene of the robot file needs; its tolerance gives way
    /// to the list of tolerances
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// The function [default: the scene's first, or inverse_dynamics]
    #[arg(long, value_name = "NAME", value_parser = function_parser())]
    pub function: Option<Function>,
    /// What errors are relative to: `actuator`, the joints' torque limits, or `range`,
    /// the largest torque that was found for the model in the box
    /// [default: the scene's, or actuator]
    #[arg(long, value_name = "SCALE", value_parser = ["actuator", "range"])]
    pub relative_to: Option<String>,
    /// Tolerances, separated by commas [default: 1e-12 to 1e-1]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = tolerance_parser(), allow_hyphen_values = true)]
    pub tolerances: Vec<f64>,
    /// Write table, chart and certificates to this folder
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// States at which each variant is run; with 0 nothing is observed
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        value_parser = count_parser(),
        default_value_t = 10_000
    )]
    pub samples: usize,
    /// Climbs from there to the largest error of each output
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        value_parser = count_parser(),
        default_value_t = 4
    )]
    pub climbs: usize,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Compile the variants and measure how long a call takes, as a ratio to
    /// the exact f64 variant in the same run; needs cargo
    #[arg(long)]
    pub measure: bool,
    /// How long to search for fewer operations
    #[arg(long, value_name = "EFFORT", default_value = "quick", value_parser = effort_parser())]
    pub effort: Effort,
}

/// Arguments of `table3`.
#[derive(Debug, clap::Args)]
pub struct Table3Args {
    /// A robot file: show the counts after every stage for it
    pub robot: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

// Clap lists the names and suggests the nearest for a slip. Numbers may begin
// with a hyphen, or clap would take a negative one for an option that it does
// not know: what a number should be is ours to say.

fn lock_parser() -> impl TypedValueParser<Value = (String, String)> {
    clap::builder::StringValueParser::new().try_map(|text| match text.rsplit_once('=') {
        Some((joint, value)) if !joint.is_empty() && !value.is_empty() => {
            Ok((joint.to_owned(), value.to_owned()))
        }
        _ => Err("a joint and its position, such as elbow=0 or elbow=pi/2"),
    })
}

/// An output by its name, of which clap lists all and suggests one, or a bundle
/// of some, which none of its lists can have.
#[derive(Clone)]
struct FunctionParser;

impl TypedValueParser for FunctionParser {
    type Value = Function;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<Function, clap::Error> {
        let is_bundle = value.to_string_lossy().contains(['=', '+']);
        if is_bundle {
            let bundles = StringValueParser::new().try_map(|text| bundle(&text));
            return bundles.parse_ref(command, argument, value);
        }
        let names = PossibleValuesParser::new(Function::ALL.map(Function::name));
        let functions = names.try_map(|name| Function::parse(&name));
        functions.parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let names = Function::ALL.into_iter().map(Function::name);
        Some(Box::new(names.map(PossibleValue::new)))
    }
}

fn function_parser() -> FunctionParser {
    FunctionParser
}

fn start_parser() -> impl TypedValueParser<Value = Start> {
    PossibleValuesParser::new(Start::NAMES)
        .try_map(|name| Start::from_name(&name).ok_or("no such formulation"))
}

fn scalar_parser() -> impl TypedValueParser<Value = ScalarType> {
    let names = PossibleValuesParser::new(ScalarType::ALL.map(ScalarType::name));
    names.try_map(|name| ScalarType::from_name(&name).ok_or("no such scalar"))
}

fn sincos_parser() -> impl TypedValueParser<Value = SinCos> {
    PossibleValuesParser::new(SinCos::NAMES)
        .try_map(|name| SinCos::from_name(&name).ok_or("no such source of sines"))
}

fn error_parser() -> impl TypedValueParser<Value = f64> {
    clap::builder::StringValueParser::new().try_map(|text| match text.parse::<f64>() {
        Ok(error) if error > 0.0 && error < 1.0 => Ok(error),
        _ => Err("an error is a number above 0 and below 1, such as 1e-9"),
    })
}

fn tolerance_parser() -> impl TypedValueParser<Value = f64> {
    clap::builder::StringValueParser::new().try_map(|text| {
        text.parse::<f64>()
            .map_err(|_| "a tolerance is a number above zero, such as 1e-3")
    })
}

fn count_parser() -> impl TypedValueParser<Value = usize> {
    clap::builder::StringValueParser::new().try_map(|text| {
        text.parse::<usize>()
            .map_err(|_| "a whole number, 0 or more")
    })
}

fn exact_tolerance_parser() -> impl TypedValueParser<Value = Rational> {
    clap::builder::StringValueParser::new().try_map(|text| {
        let number = parse_decimal(&text).map_err(|error| error.to_string())?;
        match number > Rational::from_integer(0.into()) {
            true => Ok(number),
            false => Err("a tolerance is a number above zero".to_owned()),
        }
    })
}

fn states_parser() -> impl TypedValueParser<Value = usize> {
    let most = dalembert_report::explain::errors::MAX_STATES as i64;
    clap::value_parser!(i64)
        .range(1..=most)
        .map(|states| states as usize)
}

fn prefer_parser() -> impl TypedValueParser<Value = Prefer> {
    let names = PossibleValuesParser::new(Prefer::ALL.map(Prefer::name));
    names.try_map(|name| {
        let mut all = Prefer::ALL.into_iter();
        all.find(|prefer| prefer.name() == name)
            .ok_or("no such preference")
    })
}

fn parameter_parser() -> impl TypedValueParser<Value = RuntimeParameter> {
    let names = PossibleValuesParser::new(RuntimeParameter::ALL.map(RuntimeParameter::name));
    names.try_map(|name| {
        let mut all = RuntimeParameter::ALL.into_iter();
        all.find(|parameter| parameter.name() == name)
            .ok_or("no such parameter")
    })
}

fn entries_parser() -> impl TypedValueParser<Value = Entries> {
    let names = PossibleValuesParser::new(Entries::ALL.map(Entries::name));
    names.try_map(|name| {
        let mut all = Entries::ALL.into_iter();
        all.find(|entries| entries.name() == name)
            .ok_or("no such entries")
    })
}

fn interface_parser() -> impl TypedValueParser<Value = Interface> {
    let names = PossibleValuesParser::new(Interface::ALL.map(Interface::name));
    names.try_map(|name| {
        let mut all = Interface::ALL.into_iter();
        all.find(|interface| interface.name() == name)
            .ok_or("no such interface")
    })
}

fn target_parser() -> impl TypedValueParser<Value = &'static Target> {
    let names = PossibleValuesParser::new(TARGETS.iter().map(|target| target.name));
    names.try_map(|name| {
        let mut all = TARGETS.iter();
        all.find(|target| target.name == name)
            .ok_or("no such processor")
    })
}

fn effort_parser() -> impl TypedValueParser<Value = Effort> {
    let names = PossibleValuesParser::new(Effort::ALL.map(Effort::name));
    names.try_map(|name| {
        let mut all = Effort::ALL.into_iter();
        all.find(|effort| effort.name() == name)
            .ok_or("no such effort")
    })
}
