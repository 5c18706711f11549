//! Every arm of a robot, each as a chain of its own.

use std::collections::BTreeSet;

use dalembert_model::read::Diagnostics;
use dalembert_model::robot::suggested_name;

use crate::model::Model;
use crate::problems::Problems;
use crate::select::{OTHERS, Select};
use crate::{Import, Options, Text, import_model, read_model};

/// Two arms that hang on joints which both have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SharedJoints {
    /// The names of the two.
    pub arms: [String; 2],
    /// The joints of both, from the base on.
    pub joints: Vec<String>,
}

/// Makes a robot file of every arm of a model: from the base to each palm, or end of a chain
/// of three joints or more, with all other joints held. Returns the arms, each with a name of its
/// own, in the order of the file, and the pairs of them that move each other.
///
/// # Errors
/// Everything that is wrong with the model or with one of its arms.
pub fn arms(
    text: &Text,
    options: &Options,
) -> Result<(Vec<Import>, Vec<SharedJoints>), Diagnostics> {
    let mut read = Problems::of(text);
    let model = read_model(text, options, &mut read);
    let mut problems = read.clone();
    let known = model.as_ref();
    let tips = known.and_then(|model| tips(model, options, &mut problems));
    problems.settle(|_| tips.is_none());
    let notes = problems.finish()?;
    let (Some(model), Some(tips)) = (model, tips) else {
        return Err(Diagnostics(notes));
    };
    let mut lock = options.lock.clone();
    if !lock.iter().any(|(name, _)| name == OTHERS) {
        lock.push((OTHERS.to_owned(), "0".to_owned()));
    }
    let mut names = BTreeSet::new();
    let mut arms = Vec::new();
    let mut errors: Vec<_> = Vec::new();
    for tip in tips {
        let robot = options.name.as_ref().unwrap_or(&model.name);
        let wish = suggested_name(&format!("{robot}_{tip}")).unwrap_or_else(|| "arm".to_owned());
        let mut name = wish.clone();
        while !names.insert(name.clone()) {
            name = format!("{wish}_{}", names.len());
        }
        let of_arm = Options {
            tips: vec![tip],
            tree: false,
            lock: lock.clone(),
            name: Some(name.clone()),
            ..options.clone()
        };
        match import_model(Some(&model), &of_arm, read.clone()) {
            Ok(imported) => arms.push((name, imported)),
            Err(Diagnostics(diagnostics)) => {
                for error in diagnostics {
                    if !errors.contains(&error) {
                        errors.push(error);
                    }
                }
            }
        }
    }
    if !errors.is_empty() {
        return Err(Diagnostics(errors));
    }
    let shared = shared(&arms);
    Ok((arms.into_iter().map(|(_, arm)| arm).collect(), shared))
}

fn tips(model: &Model, options: &Options, problems: &mut Problems) -> Option<Vec<String>> {
    let mut select = Select::new(model, options, problems)?;
    let base = select.base(options)?;
    let tips = select.tips(base)?.into_iter();
    Some(tips.map(|tip| model.links[tip].name.clone()).collect())
}

fn shared(arms: &[(String, Import)]) -> Vec<SharedJoints> {
    let names = |arm: &Import| -> Vec<String> {
        let joints = arm.robot.joints.iter();
        joints.filter_map(|joint| joint.name.clone()).collect()
    };
    let mut pairs = Vec::new();
    for (index, (one, arm)) in arms.iter().enumerate() {
        for (other, beside) in &arms[index + 1..] {
            let (mut joints, theirs) = (names(arm), names(beside));
            joints.retain(|name| theirs.contains(name));
            if !joints.is_empty() {
                let arms = [one.clone(), other.clone()];
                pairs.push(SharedJoints { arms, joints });
            }
        }
    }
    pairs
}
