//! Pseudo-inertias: of parameters, and of a robot file's links.

use dalembert_codegen::workspace::Parameter;
use dalembert_model::equations::regressor::LinkParameter;
use dalembert_model::number::{Rational, Rounded};
use dalembert_model::robot::Joint;

use super::{Bodies, Unknown};
use crate::dense::{cholesky, dot};
use crate::fit::Fit;
use crate::model::Model;

/// J = [Σ h; hᵀ m].
pub(super) type Pseudo = [[f64; 4]; 4];

/// The mass of a link of which the file says nothing, kg, and its size, m.
const SOME_BODY: (f64, f64) = (1.0, 0.1);
/// The least part of a link's second moments about its centre that each axis has to have.
const THIN: f64 = 1e-3;

pub(super) fn unit(k: usize) -> Pseudo {
    let mut j = [[0.0; 4]; 4];
    match LinkParameter::ALL[k] {
        LinkParameter::Mass => j[3][3] = 1.0,
        LinkParameter::First(axis) => {
            j[axis][3] = 1.0;
            j[3][axis] = 1.0;
        }
        // Σ = ½ tr(I)·1 − I
        LinkParameter::Tensor(row, column) if row == column => {
            for (axis, entries) in j.iter_mut().enumerate().take(3) {
                entries[axis] = if axis == row { -0.5 } else { 0.5 };
            }
        }
        LinkParameter::Tensor(row, column) => {
            j[row][column] = -1.0;
            j[column][row] = -1.0;
        }
    }
    j
}

pub(super) fn moments(j: &Pseudo) -> [f64; 10] {
    let trace = j[0][0] + j[1][1] + j[2][2];
    LinkParameter::ALL.map(|parameter| match parameter {
        LinkParameter::Mass => j[3][3],
        LinkParameter::First(axis) => j[axis][3],
        LinkParameter::Tensor(row, column) if row == column => trace - j[row][row],
        LinkParameter::Tensor(row, column) => -j[row][column],
    })
}

/// Returns J of a link of a robot file, in the link's own frame, with the factor L of J = L Lᵀ. A
/// link that no body has gets second moments until one has; one without a mass gets some.
pub(super) fn of_joint(joint: &Joint) -> (Pseudo, Pseudo) {
    let number = f64::nearest_rational;
    let body = joint.own_body();
    let (mass, size) = match number(&body.mass) {
        mass if mass > 0.0 => (mass, 0.1 * SOME_BODY.1),
        _ => SOME_BODY,
    };
    let com = body.com.each_ref().map(number);
    let tensor = body.inertia.map(number).rows();
    let half = 0.5 * (tensor[0][0] + tensor[1][1] + tensor[2][2]);
    let mut about: [[f64; 3]; 3] = core::array::from_fn(|i| {
        core::array::from_fn(|k| {
            if i == k {
                half - tensor[i][i]
            } else {
                -tensor[i][k]
            }
        })
    });
    // Thin bodies are at the border, where the distance is infinite.
    let trace = half.max(mass * size * size);
    let least = THIN * trace;
    let mut added = least;
    while cholesky(&shifted(&about, -least)).is_none() {
        about = shifted(&about, added);
        added *= 2.0;
    }
    let entry = |i: usize, k: usize| match (i, k) {
        (3, 3) => mass,
        (3, axis) | (axis, 3) => mass * com[axis],
        _ => about[i][k] + mass * com[i] * com[k],
    };
    let mut j: Pseudo = core::array::from_fn(|i| core::array::from_fn(|k| entry(i, k)));
    loop {
        if let Some(l) = cholesky(&j) {
            return (j, l);
        }
        // Only rounding of a far centre of mass gets here.
        for (i, entries) in j.iter_mut().enumerate().take(3) {
            entries[i] *= 1.0 + 1e-9;
            entries[i] += THIN * trace;
        }
    }
}

pub(super) fn named(unknown: Unknown) -> Option<String> {
    Some(match unknown {
        Unknown::Armature(joint) => Parameter::Armature(joint).to_string(),
        Unknown::Viscous(joint) => Parameter::Viscous(joint).to_string(),
        Unknown::Coulomb(joint) => format!("coulomb{}", joint + 1),
        Unknown::Body(..) | Unknown::Offset(_) => return None,
    })
}

fn shifted(a: &[[f64; 3]; 3], x: f64) -> [[f64; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|k| a[i][k] + if i == k { x } else { 0.0 }))
}

/// Returns the bodies of θ, without how they were found.
pub(super) fn bodies(
    model: &Model,
    fit: &Fit,
    unknowns: &[Unknown],
    map: &[Vec<f64>],
    theta: &[f64],
) -> Bodies {
    let joints = &model.robot().joints;
    let file = |of: fn(&Joint) -> &Rational| -> Vec<f64> {
        joints.iter().map(of).map(f64::nearest_rational).collect()
    };
    let parameters: Vec<f64> = map.iter().map(|row| dot(row, theta)).collect();
    let moved = (parameters.iter().zip(&fit.parameters))
        .zip(&fit.standard_errors)
        .map(|((parameter, free), error)| (parameter - free).abs() / error);
    let mut bodies = Bodies {
        links: vec![[0.0; 10]; model.first_link() + joints.len()],
        armature: file(|joint| &joint.armature),
        viscous: file(|joint| &joint.viscous),
        coulomb: file(|joint| &joint.coulomb),
        offset: vec![0.0; joints.len()],
        distance: 0.0,
        moved: moved.fold(0.0, f64::max),
        stopped: Vec::new(),
        parameters,
        steps: 0,
    };
    for (unknown, value) in unknowns.iter().zip(theta) {
        let place = match *unknown {
            Unknown::Body(body, k) => &mut bodies.links[body][k],
            Unknown::Armature(joint) => &mut bodies.armature[joint],
            Unknown::Viscous(joint) => &mut bodies.viscous[joint],
            Unknown::Coulomb(joint) => &mut bodies.coulomb[joint],
            Unknown::Offset(joint) => &mut bodies.offset[joint],
        };
        *place = *value;
    }
    bodies
}
