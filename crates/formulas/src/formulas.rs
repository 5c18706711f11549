//! Requests for formulas, and the formulas of a robot.

use dalembert_codegen::Diagnostic;
use dalembert_codegen::workspace::{Setup, Word};
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;

use crate::arm::Variable;
use crate::builder::Builder;
use crate::legend::Legend;
use crate::line::Section;
use crate::quantity::Quantity;

/// The symbols that formulas are written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Numbers alone.
    #[default]
    Numbers,
    /// Lengths and base parameters; of a small arm masses, centres of mass and inertias.
    Names,
    /// Constants K1, K2, … that coefficients share.
    Constants,
    /// Lengths, masses, centres of mass and inertias, whatever the size of the arm.
    File,
}

impl Word for Style {
    const WHAT: &'static str = "style of formulas";

    fn all() -> Vec<(&'static str, Style)> {
        vec![
            ("numbers", Style::Numbers),
            ("names", Style::Names),
            ("constants", Style::Constants),
            ("file", Style::File),
        ]
    }
}

/// The formulas that are asked for.
#[derive(Clone, Debug)]
pub struct Request {
    /// The quantities, in the order in which they are written.
    pub quantities: Vec<Quantity>,
    /// The symbols.
    pub style: Style,
}

/// The closed forms of a robot's dynamics.
#[derive(Clone, Debug)]
pub struct Formulas {
    /// The robot's name.
    pub robot: String,
    /// The variables of the joints that move.
    pub variables: Vec<Variable>,
    /// The formulas of each quantity.
    pub sections: Vec<Section>,
    /// The symbols that occur.
    pub legend: Legend,
    /// The number of joints of the robot.
    pub joints: usize,
    /// The number of its rows: joints that follow others have rows too.
    pub rows: usize,
    /// The joints of the results, counted from zero.
    pub results: Vec<usize>,
}

impl Formulas {
    /// Writes the formulas of a robot, whole or in a scene.
    ///
    /// # Errors
    /// The robot has none.
    pub fn new(
        robot: &Robot,
        scene: Option<&Scene>,
        request: &Request,
    ) -> Result<Formulas, Diagnostic> {
        let setup = Setup::in_scene(robot, scene)?;
        let request = Request {
            quantities: with_needed(&request.quantities),
            style: request.style,
        };
        Builder::new(&setup, &request)?.build()
    }
}

/// Puts the coefficients that torques and energies name before them, and each quantity once.
fn with_needed(asked: &[Quantity]) -> Vec<Quantity> {
    let needed = match () {
        () if asked.contains(&Quantity::Torque) => {
            &[Quantity::Inertia, Quantity::Christoffel, Quantity::Gravity][..]
        }
        () if asked.contains(&Quantity::KineticEnergy) => &[Quantity::Inertia],
        () => &[],
    };
    let mut quantities: Vec<Quantity> = Vec::new();
    for quantity in needed.iter().chain(asked) {
        if !quantities.contains(quantity) {
            quantities.push(*quantity);
        }
    }
    quantities
}
