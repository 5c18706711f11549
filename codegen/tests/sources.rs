//! Counts what each source of the search earns: operations that its absence costs, over the six
//! robots of `generated`, the arms of the gallery and twenty that nobody chose.

use std::path::Path;

use crate::support::draw::robots;
use dalembert_codegen::workspace::{Task, WaySource, search};
use dalembert_codegen::{Function, Request};
use dalembert_model::read::{self, Options};
use dalembert_model::robot::Robot;

/// Torques by whole recursions, matrices by composite bodies, poses by no regrouping.
const FUNCTIONS: [Function; 4] = [
    Function::InverseDynamics,
    Function::Inertia,
    Function::Coriolis,
    Function::ForwardKinematics,
];

fn all() -> Vec<Robot> {
    let mut robots: Vec<Robot> = robots(20, 0x5eed).map(|(_, robot, _)| robot).collect();
    for folder in ["generated/robots", "gallery/robots"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("..")
            .join(folder);
        for file in std::fs::read_dir(folder).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_some_and(|ending| ending == "toml") {
                let source = std::fs::read_to_string(path).unwrap();
                let read = read::parse(&source, &Options::default());
                robots.push(read.unwrap_or_else(|why| panic!("{why}")).robot);
            }
        }
    }
    robots
}

/// Returns the operations of all functions of all robots.
fn operations(robots: &[Robot], without: Option<WaySource>) -> usize {
    let cases = robots
        .iter()
        .flat_map(|robot| FUNCTIONS.map(|function| (robot, function)));
    let of = |(robot, function): (&Robot, Function)| {
        let request = Request {
            without,
            ..Request::of(&[function])
        };
        let scene_robot = request.scene_robot(robot).unwrap();
        let task = Task {
            robot,
            scene_robot: &scene_robot,
            request: &request,
        };
        let found = search(&task, function).unwrap();
        found.simplified.graph.counts().operations()
    };
    cases.map(of).sum()
}

#[test]
#[ignore = "minutes in release mode"]
fn every_source_earns() {
    let robots = all();
    let whole = operations(&robots, None);
    println!("all sources: {whole} operations");
    for source in WaySource::ALL {
        let lost = operations(&robots, Some(source)) as f64 - whole as f64;
        let name = source.name();
        println!(
            "without {name}: {lost:+}, {:+.2} %",
            100.0 * lost / whole as f64
        );
        assert!(lost > 0.0, "{name}");
    }
}
