//! Several outputs as one function, by a name that the user gives it:
//! `servo = inverse_dynamics + jacobian`.
//!
//! A bundle describes itself as a file of this folder describes its function, so code that asks
//! what a function returns, reads or is called need not know which of the two it is.
//! [`Function::ManipulatorEquation`] is one that is always there.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::function::{Definition, NamedFunction};
use super::{Function, Quantity, RegressorColumns};
use crate::diagnostic::Diagnostic;
use crate::robot::{ENDINGS, WORDS, is_snake};

const PLUS: char = '+';
const IS: char = '=';
const MAX_BYTES: usize = 64;

/// Names that modules use otherwise; with each the struct of the name is taken too.
const OWN: [&str; 7] = [
    "angles",
    "in_box",
    "load",
    "payload",
    "result",
    "robot",
    "state_box",
];

impl Function {
    /// Makes a bundle of functions by a name, in their order; bundles among them are their parts.
    ///
    /// ```
    /// use dalembert_model::outputs::Function;
    ///
    /// let parts = [Function::InverseDynamics, Function::Jacobian];
    /// let servo = Function::bundle("servo", parts).unwrap();
    /// assert_eq!(servo.structure(), Some("Servo"));
    /// assert_eq!(servo.text(), "servo=inverse_dynamics+jacobian");
    /// assert_eq!(Function::parse("servo = inverse_dynamics + jacobian"), Ok(servo));
    /// ```
    ///
    /// # Errors
    /// The name is not valid or taken, or the parts cannot be in one.
    pub fn bundle(
        name: &str,
        parts: impl IntoIterator<Item = Function>,
    ) -> Result<Function, Diagnostic> {
        check_name(name)?;
        let parts: Vec<Function> = parts.into_iter().flat_map(Function::parts).collect();
        let is_unknown = |part: &&Function| {
            !matches!(part, Function::At(_)) && Function::from_name(part.name()) != Some(**part)
        };
        if let Some(part) = parts.iter().find(is_unknown) {
            return Err(unknown_output(part.name()));
        }
        if parts.len() < 2 {
            let message = "a bundle has two parts at least".to_string();
            let help = match parts.first() {
                Some(part) => format!("ask for `{part}` by itself"),
                None => "a bundle is NAME = OUTPUT + OUTPUT".to_string(),
            };
            return Err(Diagnostic::error(message).with_help(help));
        }
        let mut results: Vec<(Quantity, Function)> = Vec::new();
        let quantities_of = |&part: &Function| {
            let quantities = part.quantities().iter();
            quantities.map(move |&quantity| (quantity, part))
        };
        for (quantity, part) in parts.iter().flat_map(quantities_of) {
            let field = quantity.field();
            let same = |(other, _): &&(Quantity, Function)| other.field() == field;
            if let Some(&(other, by)) = results.iter().find(same) {
                let one = "leave one of them out";
                return Err(if other != quantity {
                    let message = format!("`{by}` and `{part}` would both be the field `{field}`");
                    Diagnostic::error(message).with_help("ask for one of them by itself")
                } else if by == part {
                    Diagnostic::error(format!("`{by}` is in it twice")).with_help(one)
                } else {
                    let both = format!("`{by}` and `{part}` both return {}", quantity.symbol());
                    Diagnostic::error(both).with_help(one)
                });
            }
            results.push((quantity, part));
        }
        let results: Vec<Quantity> = results.into_iter().map(|(quantity, _)| quantity).collect();
        let text = joined(name, &parts);
        Ok(Function::Bundle(NamedFunction::once(text, || Definition {
            name: kept(name.to_string()),
            summary: kept(summary(&parts)),
            results: Box::leak(results.into_boxed_slice()),
            structure: Some(kept(camel(name))),
            by_default: false,
            parts: Box::leak(parts.into_boxed_slice()),
        })))
    }

    /// Returns its name as that of a type: `InverseDynamics`.
    pub fn camel(self) -> String {
        camel(self.name())
    }

    /// Returns the functions that it bundles, in their order, or itself if it is no bundle.
    pub fn parts(self) -> Vec<Function> {
        match self {
            Function::Bundle(bundle) => bundle.0.parts.to_vec(),
            other => alloc::vec![other],
        }
    }

    /// Writes the text that [`Function::parse`] reads: `servo=inverse_dynamics+jacobian`.
    pub fn text(self) -> String {
        match self {
            Function::Bundle(bundle) => joined(self.name(), bundle.0.parts),
            other => other.text_at().unwrap_or_else(|| other.name().to_string()),
        }
    }

    /// Returns the function of a text: a name, one at a frame (`jacobian@camera`), or
    /// `NAME = PART + PART`.
    ///
    /// ```
    /// use dalembert_model::outputs::Function;
    ///
    /// let jacobian = Function::parse("jacobian@camera:local:linear").unwrap();
    /// assert_eq!(jacobian.name(), "jacobian_camera_local_linear");
    /// assert_eq!(jacobian.text(), "jacobian@camera:local:linear");
    /// ```
    ///
    /// # Errors
    /// The word that names no output, with the one that was probably meant, or the mistake in a bundle.
    pub fn parse(text: &str) -> Result<Function, Diagnostic> {
        Function::parse_among(text, &[])
    }

    /// Parses a function as [`Function::parse`], beside bundles: these cannot be its parts.
    ///
    /// # Errors
    /// As [`Function::parse`].
    pub fn parse_among(text: &str, functions: &[Function]) -> Result<Function, Diagnostic> {
        let is_bundle = |function: &&Function, word: &str| {
            matches!(function, Function::Bundle(_)) && function.name() == word
        };
        let named = |word: &str| {
            let word = word.trim();
            if Function::is_at(word) {
                return Function::parse_at(word);
            }
            Function::from_name(word).ok_or_else(|| {
                let bundle = functions.iter().find(|function| is_bundle(function, word));
                bundle.map_or_else(|| unknown_output(word), |bundle| nested(*bundle))
            })
        };
        match text.split_once(IS) {
            Some((name, parts)) => {
                let parts: Result<Vec<Function>, _> = parts.split(PLUS).map(named).collect();
                Function::bundle(name.trim(), parts?)
            }
            None if text.contains(PLUS) => {
                let parts = text.trim();
                let message = format!("`{parts}` needs a name");
                Err(Diagnostic::error(message).with_help(format!("write NAME = {parts}")))
            }
            None => named(text),
        }
    }

    /// Returns these functions, each once: in the order of [`Function::ALL`], then as they come.
    pub fn in_order(wanted: &[Function]) -> Vec<Function> {
        let mut ordered: Vec<Function> = Function::ALL.to_vec();
        ordered.retain(|function| wanted.contains(function));
        for &function in wanted {
            if !ordered.contains(&function) {
                ordered.push(function);
            }
        }
        ordered
    }

    /// True if one module cannot have both: a name or a struct would be there twice.
    pub fn is_namesake(self, other: Function) -> bool {
        let same_structure = self.structure().is_some() && self.structure() == other.structure();
        self.name() == other.name() || same_structure
    }
}

pub(super) fn check_name(name: &str) -> Result<(), Diagnostic> {
    let bars = name.ends_with('_') || name.contains("__");
    if !is_snake(name) || bars || name.len() > MAX_BYTES {
        let name: String = name.chars().take(MAX_BYTES).collect();
        let help = "small letters, digits and single `_` between them, such as `servo_2`";
        let message = format!("`{name}` is not the name of a function");
        return Err(Diagnostic::error(message).with_help(help));
    }
    let structure = camel(name);
    let is_taken = |f: Function| f.structure() == Some(structure.as_str());
    let end = |ending: &'static str| Some((name.strip_suffix(ending)?, ending));
    let message = if WORDS.contains(&name) {
        format!("`{name}` is a word of Rust")
    } else if Function::from_name(name).is_some() {
        format!("`{name}` is an output by itself")
    } else if OWN.contains(&name) || Function::ALL.into_iter().any(is_taken) {
        format!("`{name}` has a meaning of its own in generated modules")
    } else if let Some((of, ending)) = ENDINGS.into_iter().find_map(end) {
        format!("`{name}` would end as the other way to call `{of}` does, `{ending}`")
    } else {
        return Ok(());
    };
    Err(Diagnostic::error(message).with_help("call the bundle otherwise"))
}

fn joined(name: &str, parts: &[Function]) -> String {
    let parts: Vec<String> = parts.iter().map(|part| part.text()).collect();
    format!("{name}{IS}{}", parts.join("+"))
}

pub(super) fn camel(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let (first, rest) = word.split_at(word.len().min(1));
        first.to_ascii_uppercase() + rest
    });
    words.collect()
}

fn summary(parts: &[Function]) -> String {
    let names: Vec<String> = parts.iter().map(|part| format!("`{part}`")).collect();
    let is_regressor = |part: &&Function| part.columns() != RegressorColumns::None;
    let over = match parts.iter().find(is_regressor) {
        Some(part) => format!(" Columns are those of `{part}`."),
        None => String::new(),
    };
    let Some((last, others)) = names.split_last() else {
        return String::new();
    };
    let others = others.join(", ");
    format!("{others} and {last} in one function that shares their work.{over}")
}

/// Returns a text for as long as the process runs.
pub(super) fn kept(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}

/// Returns the error of a word that names no output.
pub(super) fn unknown_output(word: &str) -> Diagnostic {
    if word.is_empty() {
        let help = "write its name, such as `gravity`";
        return Diagnostic::error("expected an output").with_help(help);
    }
    let help = match likely(word) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => "a bundle is NAME = OUTPUT + OUTPUT".to_string(),
    };
    Diagnostic::error(format!("unknown output `{word}`")).with_help(help)
}

#[cfg(feature = "std")]
fn likely(word: &str) -> Option<&'static str> {
    crate::diagnostic::closest(word, &Function::ALL.map(Function::name))
}

#[cfg(not(feature = "std"))]
fn likely(_: &str) -> Option<&'static str> {
    None
}

fn nested(bundle: Function) -> Diagnostic {
    let names: Vec<&str> = bundle.parts().iter().map(|part| part.name()).collect();
    let parts = names.join(" + ");
    Diagnostic::error(format!("`{bundle}` is a bundle itself"))
        .with_help(format!("bundles do not nest: write its parts, {parts}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_registrys_bundles_are_like_any_other() {
        let is_bundle = |function: &Function| !function.definition().parts.is_empty();
        let bundles: Vec<Function> = Function::ALL.into_iter().filter(is_bundle).collect();
        assert_eq!(bundles, [Function::ManipulatorEquation]);
        for bundle in bundles {
            let parts = bundle.definition().parts.iter().copied();
            let made = Function::bundle("made", parts).unwrap();
            assert_eq!(bundle.quantities(), made.quantities());
            assert_eq!(bundle.arguments(), made.arguments());
            assert_eq!(bundle.forms(), made.forms());
            assert_eq!(bundle.structure(), Some(bundle.camel().as_str()));
        }
    }

    #[test]
    fn texts_read_back_and_parts_keep_their_order() {
        for function in Function::ALL {
            assert_eq!(Function::parse(function.name()), Ok(function));
            assert_eq!(function.text(), function.name());
        }
        let text = "state_of_2=jacobian+inverse_dynamics_derivatives+gravity";
        let bundle = Function::parse(text).unwrap();
        assert_eq!(bundle.text(), text);
        assert_eq!(bundle.structure(), Some("StateOf2"));
        let fields: Vec<&str> = bundle.quantities().iter().map(|q| q.field()).collect();
        assert_eq!(fields, ["jacobian", "dtau_dq", "dtau_dqd", "d", "c"]);
        let names: Vec<&str> = bundle.arguments().iter().map(|a| a.name()).collect();
        assert_eq!(names, ["q", "qd", "qdd"]);
        let more = Function::bundle("more", [bundle, Function::Coriolis]).unwrap();
        assert!(more.text().ends_with("+gravity+coriolis"));
        let again = Function::parse(text).unwrap();
        assert!(core::ptr::eq(bundle.definition(), again.definition()));
        assert_ne!(Function::parse("x=inertia+gravity"), Ok(bundle));
    }

    /// Texts, and below each what is said of it.
    const REFUSED: &str = "\
a=inertia+manipulator_equation
`inertia` and `manipulator_equation` both return D: leave one of them out
a=gravity+gravity
`gravity` is in it twice: leave one of them out
a=coriolis+dynamic_coefficients
`coriolis` and `dynamic_coefficients` would both be the field `h`: ask for one of them by itself
a=regressor+full_regressor
`regressor` and `full_regressor` would both be the field `y`: ask for one of them by itself
a=gravity
a bundle has two parts at least: ask for `gravity` by itself
a=gravty+jacobian
unknown output `gravty`: did you mean `gravity`?
gravity+jacobian
`gravity+jacobian` needs a name: write NAME = gravity+jacobian
gravity=inertia+jacobian
`gravity` is an output by itself: call the bundle otherwise
angles=inertia+jacobian
`angles` has a meaning of its own in generated modules: call the bundle otherwise
robot=inertia+jacobian
`robot` has a meaning of its own in generated modules: call the bundle otherwise
match=inertia+jacobian
`match` is a word of Rust: call the bundle otherwise
my_columns=inertia+jacobian
`my_columns` would end as the other way to call `my` does, `_columns`: call the bundle otherwise
Servo=inertia+jacobian
`Servo` is not the name of a function: small letters, digits and single `_` between them, such as `servo_2`
=inertia+jacobian
`` is not the name of a function: small letters, digits and single `_` between them, such as `servo_2`
a__b=inertia+jacobian
`a__b` is not the name of a function: small letters, digits and single `_` between them, such as `servo_2`
gravity@camera
`gravity` is of no frame: leave `@` and what follows out
forward_kinematics@camera:local
`forward_kinematics` has no choice of `:local`: it takes a frame alone
jacobian@Camera
`Camera` cannot name a frame: small letters, digits and single `_` between them, such as `camera`
jacobian@
`` cannot name a frame: small letters, digits and single `_` between them, such as `camera_2`
jacobian@camera_batch
`camera_batch` cannot name a frame: small letters, digits and single `_` between them, such as `camera_2`
jacobian@camera:lokal
`lokal` is no choice of axes or components: `mixed`, `local` or `world`; `linear`, `angular`, or some of x, y, z, rx, ry and rz, such as `x_y_rz`
jacobian@camera:local:world
`world` is no choice of axes or components: `mixed`, `local` or `world`; `linear`, `angular`, or some of x, y, z, rx, ry and rz, such as `x_y_rz`
see=jacobian@camera+jacobian@camera
`jacobian_camera` is in it twice: leave one of them out";

    #[test]
    fn what_cannot_be_is_refused_by_name() {
        let lines: Vec<&str> = REFUSED.lines().collect();
        for [text, expected] in lines.as_chunks::<2>().0 {
            let error = Function::parse(text).unwrap_err();
            assert_eq!(error.to_string(), *expected, "{text}");
        }
    }

    #[test]
    fn one_module_has_a_name_once() {
        let of = |text| Function::parse(text).unwrap();
        let [a, b] = [of("servo_2=inertia+gravity"), of("servo2=gravity+inertia")];
        let other = of("servo2=jacobian+gravity");
        assert!(a.is_namesake(b) && b.is_namesake(other) && a.is_namesake(a));
        assert!(!Function::Gravity.is_namesake(Function::Inertia));
        assert!(!a.is_namesake(Function::Gravity));
        let wanted = [a, Function::Gravity, other, Function::InverseDynamics, a];
        assert!(Function::bundle("a", [Function::Load, Function::Gravity]).is_err());
        let [first, second] = [Function::InverseDynamics, Function::Gravity];
        assert_eq!(Function::in_order(&wanted), [first, second, a, other]);
    }
}
