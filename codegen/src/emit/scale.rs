//! What T is, in the words of a function's documentation: a sentence a kind of
//! output, and the unit of each.

use dalembert_model::robot::Robot;
use dalembert_model::scene::Scale;

use super::say;
use crate::function::{ErrorScale, Quantity};
use crate::program::Program;

pub(super) fn sentences(relative_to: Scale, quantities: &[Quantity]) -> Vec<String> {
    match relative_to {
        Scale::Range => [
            "T of an output is a size that it attains in the box, at its largest there or just",
            "below.",
        ]
        .map(String::from)
        .to_vec(),
        Scale::Actuator => actuators(quantities),
    }
}

fn actuators(quantities: &[Quantity]) -> Vec<String> {
    let has = |scale| quantities.iter().any(|q| q.facts().scale == scale);
    let is_load = |q: &&Quantity| q.facts().scale == ErrorScale::Load;
    let loads = quantities.iter().filter(is_load);
    let loads: Vec<&str> = loads.map(|quantity| quantity.symbol()).collect();
    let mut lines = Vec::new();
    if !loads.is_empty() {
        let of = loads.join(" and of ");
        lines.push(format!(
            "T of {of} is T_i, the torque limit of the joint's actuator."
        ));
    }
    if has(ErrorScale::Inertia) {
        let inertia = [
            "T of D_ik is min(T_i/q̈_k, T_k/q̈_i): the inertia that by itself takes the torque",
            "limit T_i of an actuator at the largest acceleration q̈_k of the box.",
        ];
        say(&mut lines, inertia);
    }
    if has(ErrorScale::Coefficient) {
        let coefficient = [
            "T of h_ikm is T_i/(q̇_k q̇_m): the coefficient that by itself takes the torque limit",
            "T_i at the largest velocities of the box.",
        ];
        say(&mut lines, coefficient);
    }
    lines
}

pub(super) fn units(program: &Program, robot: &Robot) -> Vec<&'static str> {
    let (rows, sizes) = (&program.rows, program.sizes());
    let mut units = Vec::new();
    for quantity in program.function.quantities() {
        let entries = 0..quantity.len(sizes);
        units.extend(entries.map(|index| quantity.unit(index, rows, sizes, robot)));
    }
    units
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::Function;
    use dalembert_model::read::parse;

    #[test]
    fn units_of_mixed_joints() {
        let joint = |kind: &str| {
            format!(
                "[[joint]]\nkind = \"{kind}\"\nmass = 1\ncom = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n"
            )
        };
        let head = "name = \"arm\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n";
        let source = [head, &joint("revolute"), &joint("prismatic")].concat();
        let robot = parse(&source).unwrap().robot;
        let of = |function| units(&Program::empty(function, 2), &robot).join(" ");
        assert_eq!(of(Function::InverseDynamics), "N·m N");
        assert_eq!(
            of(Function::ManipulatorEquation),
            "kg·m² kg·m kg·m kg N·m N N·m N"
        );
        let symbols = "kg·m² kg·m kg·m kg kg·m kg kg kg/m";
        let all = of(Function::DynamicCoefficients);
        assert_eq!(all, format!("kg·m² kg·m kg·m kg {symbols} N·m N"));
    }

    #[test]
    fn every_kind_of_output_has_its_t() {
        let said = |function: Function| sentences(Scale::Actuator, function.quantities()).join(" ");
        let torques = said(Function::InverseDynamics);
        assert!(torques.starts_with("T of τ is T_i") && !torques.contains("D_ik"));
        let inertia = said(Function::Inertia);
        assert!(inertia.starts_with("T of D_ik is min(T_i/q̈_k, T_k/q̈_i)"));
        let whole = said(Function::ManipulatorEquation);
        assert!(whole.contains("T of h and of c is") && whole.contains("D_ik"));
        let symbols = said(Function::DynamicCoefficients);
        for kind in ["T of c is", "D_ik", "T of h_ikm is T_i/(q̇_k q̇_m)"] {
            assert!(symbols.contains(kind), "{symbols}");
        }
    }
}
