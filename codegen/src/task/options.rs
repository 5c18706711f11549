//! The options of a request: one table, one parser. All ways in and the first lines of a generated
//! file give the same text (`Asked`), and a mistake names the option and the item.

use dalembert_model::diagnostic::{Diagnostic, Diagnostics, Place};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;
use dalembert_stamp::Asked;

use super::request::{Prefer, Request};
use crate::function::Function;
use crate::limbs::LimbLayout;
use crate::program::ScalarType;
use crate::sincos::SinCos;
use crate::words::{Word, parse};

/// An option of a request.
#[derive(Clone, Copy, Debug)]
pub struct OptionRow {
    /// Its name.
    pub name: &'static str,
    /// Its purpose.
    pub purpose: Purpose,
    /// Its documentation.
    pub doc: &'static str,
    /// Returns the words that an item may be, the default first; none where other items are possible.
    pub words: fn() -> Vec<&'static str>,
    /// `true` if it takes several items.
    pub is_list: bool,
    set: fn(&mut Draft, &str) -> Result<(), Diagnostic>,
}

/// The purpose of an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// It chooses the code that is generated.
    What,
    /// It steers the search for programs.
    Search,
    /// It chooses the form of the printed code.
    Code,
}

#[derive(Default)]
struct Draft {
    outputs: Option<Vec<Function>>,
    scalars: Option<Vec<ScalarType>>,
    scene: Option<String>,
    request: Request,
}

fn add<T>(
    list: &mut Vec<T>,
    item: T,
    is_same: impl Fn(&T, &T) -> bool,
    text: &str,
) -> Result<(), Diagnostic> {
    if list.iter().any(|other| is_same(other, &item)) {
        return Err(Diagnostic::error(format!("`{text}` is given twice")));
    }
    list.push(item);
    Ok(())
}

fn output(draft: &mut Draft, item: &str) -> Result<(), Diagnostic> {
    let outputs = draft.outputs.get_or_insert_default();
    let function = Function::parse_among(item, outputs)?;
    let name = function.name();
    add(outputs, function, |a, b| a.is_namesake(*b), name)
}

fn find<'s>(scenes: &'s [Scene], name: &str) -> Result<&'s Scene, Diagnostic> {
    let scene = scenes.iter().find(|scene| scene.name == name);
    scene.ok_or_else(|| {
        let known: Vec<&str> = scenes.iter().map(|scene| scene.name.as_str()).collect();
        let message = format!("the robot has no scene `{name}`");
        let none = format!("its file has none: add a table [scene.{name}]");
        Diagnostic::unknown(message, name, &known, &none)
    })
}

fn sincos_error(draft: &mut Draft, item: &str) -> Result<(), Diagnostic> {
    let error = item.replace('_', "").parse::<f64>().ok();
    let error = error.filter(|error| *error > 0.0 && *error < 1.0);
    let wrong =
        || Diagnostic::error("expected an error above 0 and below 1").with_help("such as 1e-9");
    draft.request.sincos_error = Some(error.ok_or_else(wrong)?);
    Ok(())
}

fn name(draft: &mut Draft, item: &str) -> Result<(), Diagnostic> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !item.starts_with(|c: char| c.is_ascii_alphabetic()) || !item.chars().all(plain) {
        let help = "letters, digits and `_`, a letter first";
        return Err(Diagnostic::error(format!("`{item}` is not a name")).with_help(help));
    }
    draft.request.module = Some(item.to_owned());
    Ok(())
}

/// The options, in the order in which they are written.
pub static OPTIONS: [OptionRow; 16] = [
    OptionRow {
        name: "outputs",
        purpose: Purpose::What,
        doc: "The functions, separated by commas [default: the robot file's, or the seven that a \
              controller calls]; NAME=A+B is one that returns what A and B do, and shares their work",
        words: Function::known,
        is_list: true,
        set: output,
    },
    OptionRow {
        name: "scalar",
        purpose: Purpose::What,
        doc: "The scalar that functions compute in, or both, separated by a comma",
        words: ScalarType::known,
        is_list: true,
        set: |draft, item| {
            let scalars = draft.scalars.get_or_insert_default();
            add(scalars, parse(item)?, PartialEq::eq, item)
        },
    },
    OptionRow {
        name: "formulation",
        purpose: Purpose::Search,
        doc: "The formulation to start from: `auto`, which is never dearer than another, or one \
              alone, to compare formulations",
        words: crate::Start::known,
        is_list: false,
        set: |draft, item| parse(item).map(|value| draft.request.start = value),
    },
    OptionRow {
        name: "effort",
        purpose: Purpose::Search,
        doc: "How long to search for fewer operations. A `thorough` search saves a few more and \
              takes minutes: better search once with `dalembert generate --effort thorough \
              --save-plan`, whose plan macros, build scripts and the command replay",
        words: crate::Effort::known,
        is_list: false,
        set: |draft, item| parse(item).map(|value| draft.request.effort = value),
    },
    OptionRow {
        name: "prefer",
        purpose: Purpose::Search,
        doc: "What programs are chosen by: `accuracy`, the cheapest whose rounding error is at \
              most four times the textbook form's; `operations`, the cheapest even if it costs digits",
        words: Prefer::known,
        is_list: false,
        set: |draft, item| parse(item).map(|value| draft.request.prefer = value),
    },
    OptionRow {
        name: "fma",
        purpose: Purpose::Code,
        doc: "Whether a product and the sum that alone reads it are one operation, `mul_add`, \
              rounded once. The code needs std, and a build for a processor that has it \
              (-C target-cpu=native): any other calls a slow function for each",
        words: bool::known,
        is_list: false,
        set: |draft, item| parse(item).map(|value| draft.request.fma = value),
    },
    OptionRow {
        name: "limbs",
        purpose: Purpose::Code,
        doc: "How functions compute limbs of one structure, such as legs: `lanes`, by one loop that a \
              compiler makes vectors of; `apart`, each by itself; `auto`, whichever takes fewer \
              operations if a vector has two numbers. Batches have vectors of states: they take \
              limbs apart",
        words: LimbLayout::known,
        is_list: false,
        set: |draft, item| parse(item).map(|value| draft.request.limbs = value),
    },
    OptionRow {
        name: "sincos",
        purpose: Purpose::Code,
        doc: "How sines and cosines are computed: `libm`, one call for each angle; `together`, \
              one call of the crate dalembert-sines for all angles of a function, in a third of \
              libm's time; `polynomial`, polynomials that hold inside the joints' limits only; \
              `auto`, polynomials where a scene's tolerance admits them, else libm",
        words: SinCos::known,
        is_list: false,
        set: |draft, item| parse(item).map(|value| draft.request.sincos = value),
    },
    OptionRow {
        name: "sincos_error",
        purpose: Purpose::Code,
        doc: "The largest error of each sine and cosine by polynomials [default: 1e-6, or the \
              least that the scalar has; what a scene's tolerance admits]",
        words: Vec::new,
        is_list: false,
        set: sincos_error,
    },
    OptionRow {
        name: "batch",
        purpose: Purpose::Code,
        doc: "Whether each function has a second one for any number of states in columns: \
              `NAME_columns` in Rust, by the crate dalembert-batch; `NAME_batch` in C and, as a \
              kernel, in CUDA",
        words: bool::known,
        is_list: false,
        set: |draft, item| parse(item).map(|value| draft.request.batch = value),
    },
    OptionRow {
        name: "parameters",
        purpose: Purpose::Code,
        doc: "Parameters that become arguments of the functions instead of constants: `gravity`; \
              `payload`, a body on the last link; `bodies` of all links, `armature` and `viscous` \
              friction. A function `load` turns all but gravity once into the argument `load` of the \
              others",
        words: RuntimeParameter::known,
        is_list: true,
        set: |draft, item| {
            let parameters = &mut draft.request.parameters;
            add(parameters, parse(item)?, PartialEq::eq, item)
        },
    },
    OptionRow {
        name: "bodies",
        purpose: Purpose::Code,
        doc: "The links whose bodies are arguments, by their numbers; of a base that floats 0 \
              [default: all]. With `parameters: bodies`",
        words: Vec::new,
        is_list: true,
        set: |draft, item| {
            let is_number = item.chars().all(|c| c.is_ascii_digit());
            let link = item.parse::<usize>().ok().filter(|_| is_number);
            let why =
                || Diagnostic::error("expected the number of a link").with_help("bodies: 2, 5");
            let link = link.ok_or_else(why)?;
            add(&mut draft.request.bodies, link, PartialEq::eq, item)
        },
    },
    OptionRow {
        name: "keep_zeros",
        purpose: Purpose::Code,
        doc: "Whether numbers of bodies that are zero in the robot file stay zero: fewer operations, and \
              `with` refuses bodies that have others there. With `parameters: bodies`",
        words: bool::known,
        is_list: false,
        set: |draft, item| parse(item).map(|value| draft.request.keeps_zeros = value),
    },
    OptionRow {
        name: "scene",
        purpose: Purpose::What,
        doc: "Only what this scene of the robot file needs; its outputs and scalar \
              are the defaults",
        words: Vec::new,
        is_list: false,
        set: |draft, item| {
            let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
            if !item.chars().all(is_word) {
                let help = "scene: pick; of the robot file's [scene.pick]";
                return Err(Diagnostic::error("expected the name of a scene").with_help(help));
            }
            draft.scene = Some(item.to_owned());
            Ok(())
        },
    },
    OptionRow {
        name: "plan",
        purpose: Purpose::Search,
        doc: "Whether the programs are replayed that a plan beside the robot file keeps, if there \
              is one",
        words: || vec!["on", "off"],
        is_list: false,
        set: |draft, item| parse::<bool>(item).map(|value| draft.request.has_no_plan = !value),
    },
    OptionRow {
        name: "name",
        purpose: Purpose::Code,
        doc: "The name that functions begin with in C and CUDA [default: the robot's, and the \
              scene's]",
        words: Vec::new,
        is_list: false,
        set: name,
    },
];

impl Request {
    /// Reads what was asked of a robot whose file names these outputs and has these scenes. What
    /// was not asked is as the scene has it, or else the file, or else as by default, in `scalars`;
    /// the plan is the caller's.
    ///
    /// # Errors
    /// Every mistake.
    pub fn parse(
        asked: &Asked,
        scalars: &[ScalarType],
        robot: &Robot,
        outputs: &[Function],
        scenes: &[Scene],
    ) -> Result<Request, Diagnostics> {
        let mut draft = Draft::default();
        draft.request.scalars = scalars.to_vec();
        let mut problems = Vec::new();
        let mut report = |option, item: &str, problem: Diagnostic| {
            problems.push(problem.at(Place::Option(option, item.to_owned())));
        };
        for row in &OPTIONS {
            let items = asked.items(row.name);
            let items = match row.name {
                "outputs" => Function::with_frames(items),
                _ => items.into_iter().map(str::to_owned).collect(),
            };
            for (index, item) in items.iter().enumerate() {
                let wrong = match index > 0 && !row.is_list {
                    true => Err(Diagnostic::error("expected one word only")),
                    false => (row.set)(&mut draft, item),
                };
                if let Err(wrong) = wrong {
                    report(row.name, item, wrong);
                }
            }
        }
        let takes_bodies = draft.request.parameters.contains(&RuntimeParameter::Bodies);
        let of_bodies = [
            ("bodies", !draft.request.bodies.is_empty()),
            ("keep_zeros", draft.request.keeps_zeros),
        ];
        for (option, is_set) in of_bodies {
            if is_set && !takes_bodies {
                let help = "add `parameters: bodies`, or leave this out";
                let message = "it applies to bodies that are arguments, but none are";
                report(option, "", Diagnostic::error(message).with_help(help));
            }
        }
        let scene = draft.scene.as_deref().map(|name| find(scenes, name));
        let scene = scene.transpose().unwrap_or_else(|error| {
            report("scene", draft.scene.as_deref().unwrap_or_default(), error);
            None
        });
        let has_error = draft.request.sincos_error.is_some();
        if has_error && draft.request.sincos != SinCos::Polynomial {
            let message = "only polynomials have an error to choose";
            let help = "add `sincos: polynomial`, or leave this out";
            let problem = Diagnostic::error(message).with_help(help);
            report("sincos_error", "", problem);
        }
        if !problems.is_empty() {
            return Err(Diagnostics(problems));
        }
        let request = draft.request.for_file(robot, outputs);
        Ok(request.choose(draft.outputs, draft.scalars, scene))
    }

    /// Returns the options that ask for this request; outputs and scalars are named.
    pub fn asked(&self) -> Asked {
        let mut asked = Asked::default();
        let texts = self.functions.iter().map(|function| function.text());
        let outputs: Vec<String> = texts.collect();
        let scalars: Vec<&str> = self.scalars.iter().map(|scalar| scalar.name()).collect();
        let names = self.parameters.iter().map(|parameter| parameter.name());
        let parameters: Vec<&str> = names.collect();
        let bodies: Vec<String> = self.bodies.iter().map(usize::to_string).collect();
        let error = self.sincos_error.map(|error| format!("{error:?}"));
        let scene = self.scene.as_ref().map_or("", |scene| &scene.name);
        let word = |is_on: bool| if is_on { "on" } else { "off" };
        for (option, value) in [
            ("outputs", outputs.join(",").as_str()),
            ("scalar", &scalars.join(",")),
            ("formulation", self.start.name()),
            ("effort", self.effort.name()),
            ("prefer", self.prefer.name()),
            ("fma", word(self.fma)),
            ("limbs", self.limbs.name()),
            ("sincos", self.sincos.name()),
            ("sincos_error", &error.unwrap_or_default()),
            ("batch", word(self.batch)),
            ("parameters", &parameters.join(",")),
            ("bodies", &bodies.join(",")),
            ("keep_zeros", word(self.keeps_zeros)),
            ("scene", scene),
            ("plan", word(!self.has_no_plan)),
            ("name", self.module.as_deref().unwrap_or("")),
        ] {
            let _ = asked.set(option, value);
        }
        asked
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(asked: &Asked, scalars: &[ScalarType]) -> Result<Request, Diagnostics> {
        let source = include_str!("../../../generated/robots/planar2r.toml");
        let robot = dalembert_model::read::parse(source).unwrap().robot;
        Request::parse(asked, scalars, &robot, &[], &[])
    }

    fn read(text: &str) -> Result<Request, Diagnostics> {
        parse(&text.parse().unwrap(), &ScalarType::ALL)
    }

    #[test]
    fn every_option_sets_and_refuses() {
        let names = OPTIONS.each_ref().map(|row| row.name);
        assert_eq!(names, dalembert_stamp::OPTIONS.map(|(name, _)| name));
        for (row, (_, default)) in OPTIONS.iter().zip(dalembert_stamp::OPTIONS) {
            let words = (row.words)();
            if !default.is_empty() {
                assert_eq!(words[0], default, "{}", row.name);
            }
            let mut requests = Vec::new();
            for word in &words {
                let needed = match row.name {
                    "keep_zeros" => "parameters: bodies; ",
                    _ => "",
                };
                let request = read(&format!("{needed}{}: {word}", row.name)).unwrap();
                let mut again = parse(&request.asked(), &[]).unwrap();
                again.is_scalar_open = request.is_scalar_open;
                assert_eq!(format!("{again:?}"), format!("{request:?}"), "{word}");
                requests.push(format!("{request:?}"));
            }
            requests.sort();
            requests.dedup();
            assert_eq!(requests.len(), words.len(), "{}", row.name);
            let problems = read(&format!("{}: non?sense", row.name)).unwrap_err();
            assert_eq!(problems.0.len(), 1, "{problems:?}");
            let place = Place::Option(row.name, "non?sense".to_owned());
            assert_eq!(problems.0[0].place, place);
        }
    }

    #[test]
    fn all_mistakes_are_named_with_their_items() {
        let text = "outputs: gravty, gravity, gravity, hold = inertia + gravty; scalar: double; \
                    fma: on, off; sincos_error: 1e-9; parameters: paylod";
        let problems = read(text).unwrap_err();
        let said: Vec<String> = problems.0.iter().map(Diagnostic::to_string).collect();
        assert_eq!(
            said,
            [
                "outputs: unknown output `gravty`: did you mean `gravity`?",
                "outputs: `gravity` is given twice",
                "outputs: unknown output `gravty`: did you mean `gravity`?",
                "scalar: unknown scalar `double`: known: f64, f32",
                "fma: expected one word only",
                "parameters: unknown parameter that can be an argument `paylod`: did you mean `payload`?",
                "sincos_error: only polynomials have an error to choose: add `sincos: polynomial`, or leave this out",
            ]
        );
        let place = Place::Option("outputs", "hold=inertia+gravty".to_owned());
        assert_eq!(problems.0[2].place, place);
        let bundles = "outputs: hold = inertia + gravity, servo = hold + jacobian";
        let nested = read(bundles).unwrap_err().to_string();
        assert!(nested.contains("`hold` is a bundle itself"), "{nested}");
    }
}
