//! The base parameters of a regressor: each as a combination of the robot
//! file's, and the values that they have.

use dalembert_model::number::Exact;
use num_traits::{One, Signed};

use super::say;
use crate::figures::decimal;
use crate::function::{Columns, Function};
use crate::language::c99::{Names, float};
use crate::program::{Literal, ScalarType};
use crate::setup::Setup;
use crate::setup::base::{BaseParameters, Parameter};

/// Returns what the columns of a function's regressor are; nothing of other functions.
pub(super) fn doc(function: Function, setup: &Setup) -> Vec<String> {
    let mut lines = match function.columns() {
        Columns::None => return Vec::new(),
        Columns::Links | Columns::Base(_) => vec![String::new()],
    };
    let named = [
        "m2 is the mass of link 2, mx2, my2 and mz2 its first moments, m x, m y and m z, Ixx2 to",
        "Ixz2 the entries of its tensor, all about the origin and in the axes of its DH frame.",
    ];
    let is_drive = |(own, _): &(Parameter, Exact)| !matches!(own, Parameter::Link(..));
    match over_base(function, setup) {
        Some(((sum, constant), base)) => {
            lines.push(format!(
                "{sum} = Y π, and `{constant}` is this robot's π. No fewer columns give all"
            ));
            let head = [
                "torques; that these do was proved. Each is a combination of parameters:",
                "",
                "| column | base parameter |",
                "|---|---|",
            ];
            say(&mut lines, head);
            for (index, terms) in base.combinations.iter().enumerate() {
                lines.push(format!("| {} | {} |", index + 1, combination(terms)));
            }
            lines.push(String::new());
            say(&mut lines, named);
            if base.combinations.iter().flatten().any(is_drive) {
                let drives = [
                    "armature2 is the rotor's inertia that joint 2 feels, viscous2 its friction; they have",
                    "columns where the robot file has them.",
                ];
                say(&mut lines, drives);
            }
        }
        None => {
            let columns =
                "Columns are m1, mx1, my1, mz1, Ixx1, Iyy1, Izz1, Ixy1, Iyz1, Ixz1, then those of";
            say(&mut lines, [columns]);
            let friction = match setup.has_coulomb() {
                true => "friction, viscous and Coulomb,",
                false => "viscous friction",
            };
            lines.push(format!("link 2. Armature and {friction} have none."));
            say(&mut lines, named);
        }
    }
    lines
}

/// Returns the constant π; nothing of functions that are over no base parameters.
pub(super) fn constant(function: Function, setup: &Setup, scalar: ScalarType) -> String {
    let mut text = String::new();
    let Some((name, values)) = values(function, setup, scalar) else {
        return text;
    };
    text += &format!(
        "/// π of this robot: the values of the base parameters, a column of [`{function}`] each.\n\
         pub const {name}: [{scalar}; {}] = [\n",
        values.len()
    );
    for value in &values {
        text += &format!("    {},\n", value.text(scalar));
    }
    text.push_str("];\n\n");
    text
}

/// Returns the function that writes π in C; nothing of functions that are over no base parameters.
pub(super) fn write_c(function: Function, setup: &Setup, names: &Names) -> String {
    let mut text = String::new();
    let dialect = names.dialect();
    let Some((name, values)) = values(function, setup, dialect.scalar) else {
        return text;
    };
    let (float, restrict) = (float(dialect.scalar), names.constant("RESTRICT"));
    text += &format!(
        "\n/*\n * π of this robot: the values of the base parameters, a column of\n * `{}` each.\n */\n\
         {} void {}({float} pi[{restrict} {}])\n{{\n",
        names.of(function.name()),
        dialect.function,
        names.of(&name.to_lowercase()),
        values.len()
    );
    for (index, value) in values.iter().enumerate() {
        text += &format!("    pi[{index}] = {};\n", dialect.literal(*value));
    }
    text.push_str("}\n");
    text
}

/// Returns π of a function that is over base parameters, and its name.
fn values(
    function: Function,
    setup: &Setup,
    scalar: ScalarType,
) -> Option<(&'static str, Vec<Literal>)> {
    let ((_, name), base) = over_base(function, setup)?;
    let arm = setup.arm(Exact::clone);
    let values = base.values(&arm).into_iter();
    let values = values.map(|value| Literal(scalar.round(&value)));
    Some((name, values.collect()))
}

/// Returns the name of the constant π, if a function is over base parameters.
pub(super) fn name(function: Function) -> Option<&'static str> {
    match function.columns() {
        Columns::Base(quantity) => Some(quantity.facts().linear?.1),
        Columns::Links | Columns::None => None,
    }
}

/// Returns, if a function is over base parameters, what its columns sum up to, the constant for
/// their values, and what they are.
fn over_base(
    function: Function,
    setup: &Setup,
) -> Option<((&'static str, &'static str), &BaseParameters)> {
    let Columns::Base(quantity) = function.columns() else {
        return None;
    };
    Some((quantity.facts().linear?, setup.base(quantity).ok()?))
}

/// Returns a constant without factors of one and signs after signs.
fn plain(constant: &Exact) -> String {
    let mut text = String::new();
    for c in constant.to_string().chars() {
        if c == '*' {
            let rest = text.strip_suffix('1');
            let ends = |c: char| c.is_ascii_digit() || c == '.' || c == '/';
            if let Some(rest) = rest.filter(|rest| !rest.ends_with(ends)) {
                text.truncate(rest.len());
                continue;
            }
        }
        text.push(c);
    }
    text.replace("+-", " - ").replace('+', " + ")
}

/// Returns `Izz2 + 0.25 m3 - mx4`; exact.
fn combination(terms: &[(Parameter, Exact)]) -> String {
    let mut text = String::new();
    for (parameter, factor) in terms {
        let is_negative = factor.as_rational().is_some_and(Signed::is_negative);
        let sign = match (text.is_empty(), is_negative) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        let factor = match factor.as_rational() {
            Some(value) if value.abs().is_one() => String::new(),
            Some(value) => format!("{} ", decimal(&value.abs())),
            None => format!("({}) ", plain(factor)),
        };
        text += &format!("{sign}{factor}{parameter}");
    }
    text
}
