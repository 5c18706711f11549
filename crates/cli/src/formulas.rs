//! `dalembert explain --formulas`: the closed forms of D_ik, h_ikm, c_i and more, to read.

use std::path::{Path, PathBuf};

use clap::builder::{StringValueParser, TypedValueParser};
use dalembert_codegen::workspace::Word;
use dalembert_formulas::{Digits, Formulas, Layout, Quantity, Request, Style};
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;
use dalembert_stamp::{Comment, sealed};
use serde_json::json;

use crate::args::values::word_parser;
use crate::files::Target;
use crate::output::{Done, Failure, Outcome};
use crate::report::Report;

const HEADING: &str = "Formulas";

/// Options of formulas.
#[derive(Debug, clap::Args)]
pub struct FormulaArgs {
    /// Write closed forms of these, separated by commas: D, h, c, tau, D_rot, D_tran, h_rot, h_tran, T, U,
    /// pose, jacobian [default: D,h,c]
    #[arg(
        long,
        value_name = "LIST",
        num_args = 0..=1,
        value_delimiter = ',',
        default_missing_value = "D,h,c",
        value_parser = quantity_parser(),
        conflicts_with_all = ["outputs", "effort", "couplings"],
        help_heading = HEADING
    )]
    pub formulas: Option<Vec<Quantity>>,
    /// The symbols: numbers alone; names of lengths and base parameters (of a small arm those of the file);
    /// constants K1, K2, …; or the file's masses, centres and inertias
    #[arg(
        long = "with",
        value_name = "WORD",
        default_value = "numbers",
        value_parser = word_parser::<Style>(),
        requires = "formulas",
        conflicts_with = "couplings",
        help_heading = HEADING
    )]
    pub style: Style,
    /// The format [default: that of the output's ending, or text]
    #[arg(
        long,
        value_name = "WORD",
        value_parser = word_parser::<Layout>(),
        requires = "formulas",
        conflicts_with = "couplings",
        help_heading = HEADING
    )]
    pub format: Option<Layout>,
    /// All digits of numbers; otherwise six
    #[arg(long, requires = "formulas", conflicts_with = "couplings", help_heading = HEADING)]
    pub all_digits: bool,
    /// Write here: .txt, .md, .tex or .py [default: standard output]. Without --formulas, a page (.md)
    /// about all of the robot's equations, and its drawing beside it
    #[arg(short, long, value_name = "FILE", conflicts_with = "couplings", help_heading = HEADING)]
    pub output: Option<PathBuf>,
}

/// Each ending with its format.
const ENDINGS: [(&str, Layout); 5] = [
    ("txt", Layout::Text),
    ("md", Layout::Markdown),
    ("markdown", Layout::Markdown),
    ("tex", Layout::Latex),
    ("py", Layout::Sympy),
];

impl FormulaArgs {
    /// Returns the format; refuses an ending of the output that means another, or none.
    fn layout(&self) -> Result<Layout, Failure> {
        let Some(path) = self.output.as_deref().filter(|path| is_regular(path)) else {
            return Ok(self.format.unwrap_or_default());
        };
        let ending = path.extension().unwrap_or_default();
        let mut endings = ENDINGS.iter();
        let is_other = |layout: Layout| self.format.is_some_and(|format| format != layout);
        match endings.find(|(known, _)| ending.eq_ignore_ascii_case(known)) {
            Some((_, layout)) if !is_other(*layout) => Ok(*layout),
            _ => Err(Failure::Input(format!(
                "error: `{}` has not the ending of {}\n  = help: .txt is text, .md Markdown, .tex LaTeX and .py a \
                 module for SymPy; `-o -` writes to standard output",
                path.display(),
                self.format.map_or("a format", |format| word_of(&format)),
            ))),
        }
    }
}

fn word_of(layout: &Layout) -> &'static str {
    let mut layouts = Layout::all().into_iter();
    let entry = layouts.find(|(_, other)| other == layout);
    entry.map_or("", |(word, _)| word)
}

/// True for a file that is written anew: not for standard output, a device or a pipe, which have no
/// ending.
fn is_regular(path: &Path) -> bool {
    let metadata = path.metadata();
    let is_other = metadata.is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir());
    path != Path::new("-") && !is_other
}

/// Parses a quantity; a robot file in its place is told where it belongs.
fn quantity_parser() -> impl TypedValueParser<Value = Quantity> {
    StringValueParser::new().try_map(|word| {
        Quantity::from_name(word.trim()).ok_or_else(|| {
            let known = Quantity::known().join(", ");
            match word.contains('.') {
                true => format!("the robot file comes before --formulas, whose values are {known}"),
                false => format!("expected {known}"),
            }
        })
    })
}

/// Writes the formulas of a robot in a scene.
pub(crate) fn run(
    args: &FormulaArgs,
    quantities: &[Quantity],
    robot: &Robot,
    scene: Option<&Scene>,
    target: Option<Target>,
    is_json: bool,
) -> Outcome {
    let layout = args.layout()?;
    let request = Request {
        quantities: quantities.to_vec(),
        style: args.style,
    };
    let formulas = Formulas::new(robot, scene, &request)?;
    let digits = match args.all_digits {
        true => Digits::All,
        false => Digits::Six,
    };
    let Some(target) = target else {
        return Ok(in_json(&formulas, robot, scene, digits).into());
    };
    let text = formulas.write(layout, digits);
    let text = match args.output.as_deref().filter(|path| is_regular(path)) {
        None => text,
        Some(_) => sealed(comment(layout), "dalembert explain", &text),
    };
    let report = is_json.then(|| in_json(&formulas, robot, scene, digits));
    Ok(Done {
        files: vec![(target, text)],
        report: report.unwrap_or_default(),
        ..Done::default()
    })
}

fn comment(layout: Layout) -> Comment {
    match layout {
        Layout::Text | Layout::Sympy => Comment::Toml,
        Layout::Markdown => Comment::Xml,
        Layout::Latex => Comment::Tex,
    }
}

fn in_json(formulas: &Formulas, robot: &Robot, scene: Option<&Scene>, digits: Digits) -> Report {
    let mut report = Report::of(robot, scene);
    for (name, text) in formulas.shifted_variables() {
        report.value(&format!("variables/{name}"), text);
    }
    for (name, text) in formulas.entries(digits) {
        report.value(&format!("formulas/{name}"), text);
    }
    for (name, sum, value) in formulas.symbols() {
        let symbol = json!({ "sum": sum, "value": value });
        report.value(&format!("symbols/{name}"), symbol);
    }
    report
}
