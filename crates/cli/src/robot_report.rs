//! `dalembert explain ROBOT -o FILE.md`: all about a robot's equations on one page: its table and its
//! drawing, the formulas, why coefficients vanish, and the paper's counts beside the generated ones.

use std::path::Path;

use dalembert_codegen::Counts;
use dalembert_formulas::couplings::Couplings;
use dalembert_formulas::{Digits, Formulas, Quantity, Request, Style, escaped};
use dalembert_model::robot::Robot;

use crate::couplings;
use crate::drawing;
use crate::output::Failure;
use crate::table3::comparisons;

/// Writes the page and the drawing that it shows, if the robot has formulas.
pub(crate) fn page(
    robot: &Robot,
    generated: &[Counts],
    picture: &Path,
) -> Result<[String; 2], Failure> {
    let zeros = vec![0.0; robot.joints.len()];
    let svg = drawing::svg(robot, &zeros).map_err(Failure::input)?;
    let table = drawing::lines(robot, &zeros).join("\n");
    let name = picture.file_name().unwrap_or_default().to_string_lossy();
    let title = escaped(&robot.name);
    let mut page = format!(
        "# {title}\n\nThe equations of motion of {title}, τ_i = Σ_k D_ik q̈_k + Σ_k Σ_m h_ikm q̇_k q̇_m + c_i, as \
         `dalembert explain` writes them.\n\n## The robot\n\n![{title}]({name})\n\n```text\n{table}\n```\n"
    );
    page += &section(robot, "With numbers", Style::Numbers)?;
    page += &section(robot, "With constants", Style::Constants)?;
    let couplings = Couplings::new(robot)?;
    page += &format!(
        "\n## Why coefficients vanish\n\n{} of {} vanish. Link i\\* is link i with what the base parameters of later \
         links add to it.\n\n",
        couplings.zeros.len(),
        couplings.total
    );
    let lines = couplings::lines(&couplings);
    for line in lines.iter().filter(|line| !line.is_empty()) {
        page += &format!("- {}\n", escaped(line));
    }
    page += &counts(robot, generated);
    Ok([page, svg])
}

fn section(robot: &Robot, title: &str, style: Style) -> Result<String, Failure> {
    let quantities = vec![Quantity::Inertia, Quantity::Christoffel, Quantity::Gravity];
    let request = Request { quantities, style };
    let formulas = Formulas::new(robot, None, &request).map_err(Failure::input)?;
    let text = formulas.in_markdown(3, Digits::Six);
    Ok(format!("\n## {title}\n\n{text}"))
}

/// Writes Table 3 beside the counts of what is generated.
fn counts(robot: &Robot, generated: &[Counts]) -> String {
    let mut text = String::from(
        "\n## Operations of the torques\n\nTable 3 is that of C. S. G. Lee, B. H. Lee and R. Nigam, *Development of the \
         generalized d'Alembert equations of motion for mechanical manipulators*, 1983, for this number of \
         general joints.\n\n| | multiplications | additions |\n|---|---|---|\n",
    );
    for (name, [paper_mul, paper_add, mul, add]) in comparisons(robot) {
        text += &format!("| {name}, Table 3 of the paper | {paper_mul} | {paper_add} |\n");
        text += &format!("| {name}, with this robot's numbers | {mul} | {add} |\n");
    }
    for Counts { mul, add, .. } in generated {
        text += &format!("| generated | {mul} | {add} |\n");
    }
    text
}
