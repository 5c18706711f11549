//! Sines and cosines of sums of angles.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::SinCosPair;
use dalembert_model::equations::chain::{Chain, Displacement, Regrouping};
use dalembert_model::scalar::Scalar;

use super::chain::skeleton;
use crate::graph::symbol::Symbol;
use crate::graph::{Builder, Folding, Graph};
use crate::program::{AngleSum, Input};
use crate::scene::SceneRobot;
use crate::trace::symbols;

/// How the sine and cosine of a sum of angles come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sums {
    /// From those of the angles, so that large angles lose nothing.
    Products,
    /// Also as inputs: one evaluation for four products, of an angle that is
    /// rounded, which costs |q| u.
    Inputs,
}

/// Values that no recursion forms but that shorten it: the sines and cosines
/// of the angle sums of parallel joints.
pub(crate) fn angle_sums(scene_robot: &SceneRobot, sums: Sums) -> Graph {
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    let arm = skeleton(scene_robot);
    let chain = Chain::new(&arm, &Regrouping::base(&arm));
    let groups = chain.parallel();
    let chain = chain.map(|constant| Symbol::from(constant.clone()));
    let rows = scene_robot.chained_rows();
    let motion = symbols(scene_robot, &[], &builder).of_joints(&rows);
    let (_, at) = chain.posed(&motion.q);
    let mut outputs = Vec::new();
    for group in &groups {
        // Angles of joints that follow are no inputs.
        let follows = |link: usize| {
            let mut all = scene_robot.robot().followers.iter();
            all.any(|own| own.row == rows[link])
        };
        let sums = match group.iter().any(|(link, _)| follows(*link)) {
            true => Sums::Products,
            false => sums,
        };
        for first in 0..group.len() {
            let mut product: Option<SinCosPair<Symbol>> = None;
            let mut input: Option<AngleSum> = None;
            for &(link, opposite) in &group[first..] {
                let Displacement::Turn(pair) = &at[link] else {
                    continue;
                };
                // About the axis of the group's first link.
                let turn = SinCosPair {
                    sin: if opposite {
                        pair.sin.neg()
                    } else {
                        pair.sin.clone()
                    },
                    cos: pair.cos.clone(),
                };
                let joint = scene_robot.robot().mover_of(rows[link]);
                input = match input {
                    None => Some(AngleSum::joint(joint)),
                    Some(sum) => sum.with(joint, opposite != group[first].1),
                };
                product = Some(match product {
                    None => turn,
                    Some(before) => {
                        let both = before.compose(&turn);
                        let mut shared = builder.borrow_mut();
                        outputs.extend([&both.sin, &both.cos].map(|x| x.value(&mut shared)));
                        drop(shared);
                        if let (Sums::Inputs, Some(sum)) = (sums, input) {
                            for input in [Input::Sin(sum), Input::Cos(sum)] {
                                let symbol = Symbol::input(&builder, input);
                                outputs.push(symbol.value(&mut builder.borrow_mut()));
                            }
                        }
                        both
                    }
                });
            }
        }
    }
    std::mem::replace(&mut *builder.borrow_mut(), Builder::new(Folding::Syntactic)).finish(&outputs)
}
