//! The base parameters of a regressor: each as a combination of the robot
//! file's, and the values that they have.

use dalembert_model::number::Exact;
use dalembert_model::robot::Joint;

use super::paragraph;
use crate::function::{Function, RegressorColumns};
use crate::language::c99::{Names, float};
use crate::program::{Literal, ScalarType};
use crate::setup::Setup;
use crate::setup::base::{BaseParameters, Parameter};

pub(super) fn doc(function: Function, setup: &Setup) -> Vec<String> {
    if function.columns() == RegressorColumns::None {
        return Vec::new();
    }
    let mut lines = vec![String::new()];
    let is_placed = |joint: &&Joint| joint.frame.is_some();
    let whose = match setup.robot().rows().iter().any(is_placed) {
        false => "its DH frame.",
        true => {
            "its own frame,\nas `link_poses` has it: that of the robot file, a URDF or an MJCF. What is \
             fixed to it is part of it."
        }
    };
    let named = format!(
        "m2 is the mass of link 2, mx2, my2 and mz2 its first moments, m x, m y and m z, Ixx2 to\n\
         Ixz2 the entries of its tensor, all about the origin and in the axes of {whose}"
    );
    let is_drive = |(parameter, _): &(Parameter, Exact)| {
        !matches!(parameter, Parameter::Base(_) | Parameter::Link(..))
    };
    match over_base(function, setup) {
        Some(((sum, constant), base)) => {
            lines.push(format!(
                "{sum} = Y π, and `{constant}` is this robot's π. No fewer columns give all"
            ));
            lines.extend(paragraph([
                "torques; that these do was proved. Each is a combination of parameters:",
                "",
                "| column | base parameter |",
                "|---|---|",
            ]));
            for (index, name) in base.names().iter().enumerate() {
                lines.push(format!("| {} | {name} |", index + 1));
            }
            lines.push(String::new());
            lines.extend(named.lines().map(str::to_owned));
            if base.combinations.iter().flatten().any(is_drive) {
                lines.extend(paragraph([
                    "armature2 is the rotor's inertia that joint 2 feels, viscous2 its friction; they have",
                    "columns where the robot file has them.",
                ]));
            }
        }
        None => {
            let columns =
                "Columns are m1, mx1, my1, mz1, Ixx1, Iyy1, Izz1, Ixy1, Iyz1, Ixz1, then those of";
            lines.push(match setup.robot().floating {
                None => columns.to_owned(),
                // The base's columns first, then those of any other robot.
                Some(_) => columns.replace('1', "0"),
            });
            let friction = match setup.has_coulomb() {
                true => "friction, viscous and Coulomb,",
                false => "viscous friction",
            };
            let next = 2 - usize::from(setup.robot().floating.is_some());
            lines.push(format!("link {next}. Armature and {friction} have none."));
            lines.extend(named.lines().map(str::to_owned));
        }
    }
    lines
}

pub(super) fn constant(function: Function, setup: &Setup, scalar: ScalarType) -> String {
    let Some((name, values)) = values(function, setup, scalar) else {
        return String::new();
    };
    let count = values.len();
    let mut text = format!(
        "/// π of this robot: the values of the base parameters, a column of [`{function}`] each.\n\
         pub const {name}: [{scalar}; {count}] = [\n"
    );
    for value in &values {
        text += &format!("    {},\n", value.text(scalar));
    }
    text.push_str("];\n\n");
    text
}

pub(super) fn write_c(function: Function, setup: &Setup, names: &Names) -> String {
    let dialect = names.dialect();
    let Some((name, values)) = values(function, setup, dialect.scalar) else {
        return String::new();
    };
    let (float, restrict) = (float(dialect.scalar), names.constant("RESTRICT"));
    let mut text = format!(
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

fn values(
    function: Function,
    setup: &Setup,
    scalar: ScalarType,
) -> Option<(&'static str, Vec<Literal>)> {
    let ((_, name), base) = over_base(function, setup)?;
    let arm = setup.arm(Exact::clone);
    let literal = |value: Exact| Literal(scalar.round(&value));
    let values = base.values(&arm).into_iter().map(literal).collect();
    Some((name, values))
}

pub(super) fn name(function: Function) -> Option<&'static str> {
    match function.columns() {
        RegressorColumns::Base(quantity) => Some(quantity.facts().linear?.1),
        RegressorColumns::Links | RegressorColumns::None => None,
    }
}

/// Returns, if a function is over base parameters, what its columns sum up to, the constant for
/// their values, and what they are.
fn over_base(
    function: Function,
    setup: &Setup,
) -> Option<((&'static str, &'static str), &BaseParameters)> {
    let RegressorColumns::Base(quantity) = function.columns() else {
        return None;
    };
    Some((quantity.facts().linear?, setup.base(quantity).ok()?))
}
