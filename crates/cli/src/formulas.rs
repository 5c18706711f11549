//! `dalembert explain --formulas`: the closed forms of D_ik, h_ikm, c_i and more, to read.

use std::path::{Path, PathBuf};

use dalembert_formulas::{Digits, Formulas, Layout, Quantity, Request, Style};
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;
use dalembert_stamp::{Comment, sealed};

use crate::args::values::word_parser;
use crate::files::Target;
use crate::output::{Done, Failure, Outcome};
use crate::report::Report;

const HEADING: &str = "Formulas";

/// Options of formulas.
#[derive(Debug, clap::Args)]
pub struct FormulaArgs {
    /// Write closed forms of these, separated by commas [default: D,h,c]
    #[arg(
        long,
        value_name = "LIST",
        num_args = 0..=1,
        value_delimiter = ',',
        default_missing_value = "D,h,c",
        value_parser = word_parser::<Quantity>(),
        conflicts_with_all = ["outputs", "effort", "coefficients"],
        help_heading = HEADING
    )]
    pub formulas: Option<Vec<Quantity>>,
    /// The symbols: numbers alone; lengths, masses and inertias by name; or constants K1, K2, …
    #[arg(
        long = "with",
        value_name = "WORD",
        default_value = "numbers",
        value_parser = word_parser::<Style>(),
        requires = "formulas",
        help_heading = HEADING
    )]
    pub style: Style,
    /// The format [default: that of the output's ending, or text]
    #[arg(
        long,
        value_name = "WORD",
        value_parser = word_parser::<Layout>(),
        requires = "formulas",
        help_heading = HEADING
    )]
    pub format: Option<Layout>,
    /// All digits of numbers; otherwise six
    #[arg(long, requires = "formulas", help_heading = HEADING)]
    pub all_digits: bool,
    /// Write here: .txt, .md, .tex or .py [default: standard output]
    #[arg(short, long, value_name = "FILE", requires = "formulas", help_heading = HEADING)]
    pub output: Option<PathBuf>,
}

impl FormulaArgs {
    fn layout(&self) -> Layout {
        let ending = self.output.as_ref().and_then(|path| path.extension());
        let meant = match ending.and_then(|ending| ending.to_str()) {
            Some("md" | "markdown") => Layout::Markdown,
            Some("tex") => Layout::Latex,
            Some("py") => Layout::Sympy,
            _ => Layout::Text,
        };
        self.format.unwrap_or(meant)
    }
}

/// Writes the formulas of a robot in a scene.
pub(crate) fn run(
    args: &FormulaArgs,
    quantities: &[Quantity],
    robot: &Robot,
    scene: Option<&Scene>,
    target: Option<Target>,
) -> Outcome {
    let request = Request {
        quantities: quantities.to_vec(),
        style: args.style,
    };
    let formulas = Formulas::new(robot, scene, &request).map_err(Failure::input)?;
    let digits = if args.all_digits {
        Digits::All
    } else {
        Digits::Six
    };
    let layout = args.layout();
    let Some(target) = target else {
        return Ok(json(&formulas, robot, scene, digits).into());
    };
    let text = formulas.write(layout, digits);
    let text = match args
        .output
        .as_deref()
        .filter(|path| *path != Path::new("-"))
    {
        None => text,
        Some(_) => sealed(comment(layout), "dalembert explain", &text),
    };
    Ok(Done {
        files: vec![(target, text)],
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

fn json(formulas: &Formulas, robot: &Robot, scene: Option<&Scene>, digits: Digits) -> Report {
    let mut report = Report::of(robot, scene);
    for (name, text) in formulas.entries(digits) {
        report.value(&format!("formulas/{name}"), text);
    }
    report
}
