//! The plan with the programs of a run in it, for later runs.

use dalembert_model::robot::Robot;

use super::{Generated, Request};
use crate::function::Function;
use crate::plan::{Edited, Entry, Plan};
use crate::program::{Program, ScalarType};
use crate::search::price;
use crate::setup::{SceneKey, input_hash};

/// A plan with what was generated in it.
#[derive(Clone, Debug)]
pub struct Kept {
    /// The plan.
    pub plan: Plan,
    /// Where the plan keeps its own program: a search that was ended early had
    /// found none that is cheaper.
    pub own: Vec<(Function, ScalarType)>,
}

/// Returns the plan with the programs of a run in it. Those of other requests for the same robot
/// stay, and after a search that was ended early those that are no dearer than what it found.
pub fn keep(robot: &Robot, request: &Request, generated: &Generated, plan: Option<Plan>) -> Kept {
    let input = input_hash(robot);
    let mut plan = plan.filter(|plan| plan.input == input).unwrap_or(Plan {
        robot: robot.name.clone(),
        input,
        entries: Vec::new(),
    });
    let mut own = Vec::new();
    let functions = generated.functions.iter();
    // A load is its definition: nobody searches for that.
    for function in functions.filter(|generated| generated.function != Function::Load) {
        let admitted = function.admitted.as_ref();
        // The proved program: what a tolerance was applied to.
        let found = function.found.as_ref().unwrap_or(&function.program);
        for &scalar in &generated.scalars {
            let entry = Entry {
                start: request.start,
                scalar,
                source: function.source,
                passes: function.passes.clone(),
                scene: request.scene.as_ref().map(SceneKey::new),
                parameters: function.parameters.clone(),
                program: admitted.map_or(found, |admitted| &admitted.exact).clone(),
                edited: admitted.map(|admitted| Edited {
                    program: admitted.program.clone(),
                    left_out: admitted.left_out.clone(),
                }),
            };
            let (name, scene) = (function.function, request.scene.as_ref());
            let parameters = function.parameters.as_ref();
            let other = plan.find(name, request.start, scalar, scene, parameters);
            let as_good = |other: &Entry| {
                other.scene == entry.scene
                    && other.parameters == entry.parameters
                    && price(&emitted(other).counts()) <= price(&emitted(&entry).counts())
            };
            if generated.ended && other.as_ref().is_some_and(as_good) {
                own.push((name, scalar));
            } else if other.as_ref() != Some(&entry) {
                // A bundle may be there by another name.
                plan.insert(entry);
            }
        }
    }
    Kept { plan, own }
}

fn emitted(entry: &Entry) -> &Program {
    let edited = entry.edited.as_ref();
    edited.map_or(&entry.program, |edited| &edited.program)
}

#[cfg(test)]
mod tests {
    use dalembert_model::read;

    use super::*;
    use crate::dag::Node;
    use crate::generate::generate;

    const PENDULUM: &str = "name = \"pendulum\"\nconvention = \"standard\"\ngravity = [0, -9.81, 0]\n\
        [[joint]]\nkind = \"revolute\"\na = 1\nmass = 2\ncom = [-0.5, 0, 0]\n\
        inertia = [0, 0.1, 0.1, 0, 0, 0]\n";

    #[test]
    fn an_early_end_takes_nothing_better_away() {
        let robot = read::parse(PENDULUM);
        let robot = robot.unwrap().robot;
        let request = Request::new(&[Function::Gravity]);
        let good = generate(&robot, &request).unwrap();
        let mut dear = good.clone();
        let dag = &mut dear.functions[0].program.dag;
        let (_, operation, operands) = dag.operations().next().unwrap();
        dag.nodes.push(Node::Apply(operation, operands));
        let prices = |kept, found: &_| {
            let Kept { plan, own } = keep(&robot, &request, found, kept);
            let entries = plan.entries.iter();
            let prices: Vec<u64> = entries.map(|own| price(&emitted(own).counts())).collect();
            assert_eq!(prices.len(), 2, "one a scalar");
            assert_eq!(prices[0], prices[1]);
            (plan, prices[0], own.len())
        };
        let (of_good, low, _) = prices(None, &good);
        let (of_dear, high, _) = prices(None, &dear);
        assert!(low < high);
        assert_eq!(prices(Some(of_good.clone()), &dear).1, high);
        for generated in [&mut dear, &mut good.clone()] {
            generated.ended = true;
            let (_, price, own) = prices(Some(of_good.clone()), generated);
            assert_eq!((price, own), (low, 2));
        }
        let ended = Generated {
            ended: true,
            ..good
        };
        assert_eq!(prices(Some(of_dear), &ended).1, low);
        let mut other = of_good;
        other.input = String::new();
        assert_eq!(prices(Some(other), &dear).1, high);
    }
}
