//! Counts what each source of the search earns: operations that its absence costs, over the six
//! robots of `generated`, the arms of the gallery and twenty that nobody chose.

use std::path::Path;

use crate::support::draw::robots;
use dalembert_codegen::workspace::{
    Dag, Folding, Job, Limits, Schedule, cost, search, search_graphs,
};
use dalembert_codegen::{Effort, Function, Request};
use dalembert_model::read::{self, Options};
use dalembert_model::robot::Robot;

/// Torques by whole recursions, matrices by composite bodies, poses by no regrouping, and what has
/// most in common.
const FUNCTIONS: [Function; 5] = [
    Function::InverseDynamics,
    Function::Inertia,
    Function::Coriolis,
    Function::ForwardKinematics,
    Function::InverseDynamicsDerivatives,
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

/// A source that is left out, and the limits that leave it out.
type Row = (&'static str, fn(Limits) -> Limits);

const SOURCES: [Row; 4] = [
    ("rules", |limits| Limits { rules: 0, ..limits }),
    ("pairs", |limits| Limits { pairs: 0, ..limits }),
    ("resubstitution", |limits| Limits {
        substitutes: 0,
        ..limits
    }),
    ("annealing", |limits| Limits {
        schedules: [Schedule::cool(0); 2],
        ..limits
    }),
];

/// Returns the cheapest program's operations over a search from each list of graphs.
fn operations(cases: &[Vec<Dag>], alter: impl Fn(Limits) -> Limits) -> usize {
    let limits = |operations| alter(Effort::Quick.limits(operations));
    let found = cases.iter().map(|seeds| {
        let found = search_graphs(seeds, &[], &limits, &|_| true, &|_, _| true);
        found.unwrap().graph.counts().operations()
    });
    found.sum()
}

#[test]
#[ignore = "minutes in release mode"]
fn every_source_earns() {
    let robots = all();
    let cases = robots
        .iter()
        .flat_map(|robot| FUNCTIONS.map(|function| (robot, function)));
    let seeds = |(robot, function): (&Robot, Function)| -> Vec<Dag> {
        let request = Request::of(&[function]);
        let setup = request.setup(robot).unwrap();
        let job = Job {
            robot,
            setup: &setup,
            request: &request,
        };
        let found = search(&job, function).unwrap();
        found.seeds.into_iter().map(|seed| seed.graph).collect()
    };
    let cases: Vec<Vec<Dag>> = cases.map(seeds).collect();
    let whole = operations(&cases, |limits| limits);
    println!("all sources: {whole} operations");
    let earns = |name: &str, without: usize| {
        let lost = without as f64 - whole as f64;
        println!(
            "without {name}: {lost:+}, {:+.2} %",
            100.0 * lost / whole as f64
        );
        assert!(lost > 0.0, "{name}");
    };
    for (name, alter) in SOURCES {
        earns(name, operations(&cases, alter));
    }
    let cheapest = |seeds: &Vec<Dag>| {
        let own = seeds
            .iter()
            .min_by_key(|dag| cost(&dag.rebuild(Folding::Semantic)));
        vec![own.unwrap().clone()]
    };
    let alone: Vec<Vec<Dag>> = cases.iter().map(cheapest).collect();
    earns("other forms and axes", operations(&alone, |limits| limits));
}
