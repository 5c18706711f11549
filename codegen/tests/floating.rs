//! Robots whose base floats: every output, shown by the checker; and none in another order.

use dalembert_codegen::{Function, Request, generate};

use crate::certified::Certified;
use crate::support::{read_robot, source};

/// What is refused where the base floats, with a word of the reason.
const REFUSED: [(&str, &str); 4] = [
    ("dynamic_coefficients", "coriolis_matrix"),
    ("dalembert_terms", "coriolis_matrix"),
    ("inverse_dynamics_second_derivatives", "do not commute"),
    ("forward_dynamics_second_derivatives", "do not commute"),
];

fn every_output() -> String {
    let is_there = |function: &Function| REFUSED.iter().all(|own| own.0 != function.name());
    let names = Function::ALL.into_iter().filter(is_there).map(|own| {
        let at = if own.is_of_hand() { "@left_foot" } else { "" };
        format!("{}{at}", own.name())
    });
    names.collect::<Vec<_>>().join(", ")
}

#[test]
fn every_output_is_shown() {
    let robot = source("two_legs", "");
    let asked = format!(
        "outputs: {}; scalar: f64; prefer: operations",
        every_output()
    );
    for language in ["rust", "c"] {
        let asked = format!("{asked}; language: {language}");
        let file = Certified::of(&robot, None, &asked).remove(0);
        file.is_shown(31, language);
    }
}

#[test]
fn what_is_of_a_fixed_base_is_refused_with_the_reason() {
    let robot = read_robot(&source("two_legs", ""));
    for (name, reason) in REFUSED {
        let request = Request {
            functions: vec![Function::from_name(name).unwrap()],
            ..Request::default()
        };
        let error = generate(&robot, &request).unwrap_err().to_string();
        assert!(
            error.contains("the base floats") && error.contains(reason),
            "{error}"
        );
    }
}
