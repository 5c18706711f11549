//! A box cut into equal sub-boxes.

use crate::bound::input_box::InputBox;
use crate::program::Program;

/// Returns equal sub-boxes, at most `boxes`: the angles that a program reads are halved joint
/// after joint.
pub(super) fn sub_boxes(program: &Program, limits: &InputBox, boxes: usize) -> Vec<InputBox> {
    let joints: Vec<usize> = program.trig().iter().map(|trig| trig.joint).collect();
    let mut all = vec![limits.clone()];
    let mut turn = 0;
    while !joints.is_empty() && all.len() * 2 <= boxes {
        let joint = joints[turn % joints.len()];
        turn += 1;
        all = all
            .into_iter()
            .flat_map(|sub| {
                sub.position[joint].split().map(|half| {
                    let mut sub = sub.clone();
                    sub.position[joint] = half;
                    sub
                })
            })
            .collect();
    }
    all
}
