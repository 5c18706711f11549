//! The exact proof that base parameters give every torque: the column of each
//! parameter of the robot file is the combination of the regressor's columns
//! that its base parameters say.
//!
//! Let B be what [`BaseParameters`] holds, π' = B π. Then τ = Y_full π = Y π' for
//! every π exactly if Y_full = Y B, entry by entry, and that is what is evaluated
//! here, as [`exact`](super::exact) evaluates programs: both sides by
//! Lagrange–Euler, modulo primes and at points that follow from the statement.
//! That no fewer columns would do needs no such proof: they were independent
//! modulo a prime, and so they are.
//!
//! [`BaseParameters`]: crate::scene::base::BaseParameters

use std::collections::BTreeMap;

use dalembert_model::equations::Formulation;
use dalembert_model::equations::following::gather;
use dalembert_model::equations::regressor::{Column, of_drives, of_links};
use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::record::Recording;
use dalembert_model::scalar::residue::Residue;

use super::challenge::Transcript;
use super::exact::{Disproof, WRITTEN_LIMIT, bounded, compare};
use super::ratio::Ratio;
use super::size::Denominators;
use crate::function::Function;
use crate::program::Input;
use crate::scene::base::{BaseParameters, Parameter};
use crate::scene::{SceneRobot, Value};

/// Proves the base parameters of a robot in its scene that a function is over.
///
/// # Errors
/// A parameter whose torques they do not give, or too large a chance of a miss.
pub fn prove_base(
    scene_robot: &SceneRobot,
    function: Function,
    base: &BaseParameters,
) -> Result<(), Disproof> {
    let formulation = match scene_robot.robot().rows().len() <= WRITTEN_LIMIT {
        true => Formulation::LagrangeEuler,
        false => Formulation::NewtonEulerLink,
    };
    let statement = Statement {
        scene_robot,
        function,
        base,
        formulation,
    };
    let differences = statement.differences().ok_or(Disproof::Unfit)?;
    let parameters = statement.parameters();
    let length = scene_robot.rows().len() * parameters.len();
    compare(
        statement.transcript(),
        |point| differences.run(|input| point.input(*input), |x| point.constant(x)),
        |_| Ok(Some(vec![Residue::zero(); length])),
        |wrong| Disproof::Dependence {
            parameter: parameters[wrong % parameters.len()].to_string(),
        },
    )?;
    let mut denominators = Denominators::default();
    let constant = |constant: &Exact| Some(Ratio::constant(constant, &mut denominators));
    let degrees = differences.run(|input| Ratio::input(*input), constant);
    let degrees = degrees.unwrap_or_default();
    bounded(&degrees, &vec![Ratio::zero(); length], &denominators).map(drop)
}

struct Statement<'a> {
    scene_robot: &'a SceneRobot,
    function: Function,
    base: &'a BaseParameters,
    formulation: Formulation,
}

impl Statement<'_> {
    fn transcript(&self) -> Transcript {
        let mut transcript = Transcript::new("base parameters");
        transcript.scene_robot(self.scene_robot);
        transcript.text(self.function.name());
        transcript.number(self.base.columns.len());
        for (column, terms) in self.base.columns.iter().zip(&self.base.combinations) {
            let place = match column {
                Column::Body { joint, .. } => format!("body {joint}"),
                Column::Armature(joint) => format!("armature {joint}"),
                Column::Viscous(joint) => format!("viscous {joint}"),
            };
            transcript.text(&place);
            // Nothing of what there is none.
            column.map(|number| transcript.text(&number.to_string()));
            transcript.number(terms.len());
            for (parameter, factor) in terms {
                transcript.text(&parameter.to_string());
                transcript.text(&factor.to_string());
            }
        }
        transcript
    }

    /// Returns all parameters of the robot file, in the order of the full columns.
    fn parameters(&self) -> Vec<Parameter> {
        use dalembert_model::equations::regressor::LinkParameter;
        let rows = 0..self.scene_robot.robot().rows().len();
        let links = rows.flat_map(|joint| {
            let all = LinkParameter::ALL.into_iter();
            all.map(move |own| Parameter::Link(joint, own))
        });
        let drives = of_drives::<Exact>(self.scene_robot.robot()).into_iter();
        let drives = drives.map(|column| match column {
            Column::Viscous(joint) => Parameter::Viscous(joint),
            Column::Armature(joint) | Column::Body { joint, .. } => Parameter::Armature(joint),
        });
        links.chain(drives).collect()
    }

    /// Returns each base parameter's terms: the place of a parameter, and its factor. None if
    /// there is no such parameter.
    fn combinations(&self) -> Option<Vec<Vec<(usize, &Exact)>>> {
        let places: BTreeMap<Parameter, usize> = (self.parameters().into_iter())
            .enumerate()
            .map(|(place, parameter)| (parameter, place))
            .collect();
        let combinations = self.base.combinations.iter().map(|terms| {
            let terms = terms.iter();
            let terms = terms.map(|(own, factor)| Some((*places.get(own)?, factor)));
            terms.collect()
        });
        combinations.collect()
    }

    /// Returns Y_full − Y B over the rows, row by row, as a formula.
    fn differences(&self) -> Option<Recording<Input, Exact>> {
        let combinations = self.combinations()?;
        let scene_robot = self.scene_robot;
        let recording = scene_robot.record(self.function, |posed, recorder| {
            let (arm, motion) = (&posed.arm, &posed.motion);
            let by = |columns: &[Column<Value>]| {
                let mut entries = self
                    .function
                    .evaluate(self.formulation, arm, motion, columns);
                let rows: Vec<usize> = (0..arm.links.len()).collect();
                gather(&arm.following, &rows, columns.len(), &mut entries);
                let rows = entries.chunks(columns.len().max(1));
                rows.map(<[Value]>::to_vec).collect::<Vec<_>>()
            };
            let mut all = of_links(scene_robot.robot().rows().len());
            all.extend(of_drives(scene_robot.robot()));
            let whole = by(&all);
            let constant = |x: &Exact| recorder.constant(x);
            let own: Vec<_> = self.base.columns.iter().map(|c| c.map(constant)).collect();
            let own = by(&own);
            let mut found = Vec::new();
            for &joint in scene_robot.rows() {
                let row = scene_robot.robot().row_of(joint);
                let mut differences = whole[row].clone();
                for (entry, terms) in own[row].iter().zip(&combinations) {
                    for (place, factor) in terms {
                        let part = entry.mul(&constant(factor));
                        differences[*place] = differences[*place].sub(&part);
                    }
                }
                found.extend(differences);
            }
            found
        });
        Some(recording)
    }
}
