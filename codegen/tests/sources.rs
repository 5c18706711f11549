//! Counts what each source of the search earns: operations that its absence costs, over the six
//! robots of `generated`, the arms of the gallery and twenty that nobody chose.

use std::fs;

use dalembert_codegen::workspace::{
    Dag, Folding, Job, Limits, Schedule, cost, search, search_graphs,
};
use dalembert_codegen::{Effort, Function, Request};
use dalembert_model::robot::Robot;

use crate::support::draw::robots;
use crate::support::{path, read_robot};

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
    let drawn = robots(20, 0x5eed).map(|(_, robot, _)| robot);
    let folders = ["../generated/robots", "../gallery/robots"].into_iter();
    let files = folders.flat_map(|folder| fs::read_dir(path(folder)).unwrap());
    let files = files.map(|file| file.unwrap().path());
    let files = files.filter(|file| file.extension().is_some_and(|ending| ending == "toml"));
    let read = files.map(|file| read_robot(&fs::read_to_string(file).unwrap()));
    drawn.chain(read).collect()
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
        let request = Request::new(&[function]);
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
        let part = 100.0 * lost / whole as f64;
        println!("without {name}: {lost:+}, {part:+.2} %");
        assert!(lost > 0.0, "{name}");
    };
    for (name, alter) in SOURCES {
        earns(name, operations(&cases, alter));
    }
    let cheapest = |seeds: &Vec<Dag>| {
        let own = seeds.iter();
        let own = own.min_by_key(|dag| cost(&dag.rebuild(Folding::Semantic)));
        vec![own.unwrap().clone()]
    };
    let alone: Vec<Vec<Dag>> = cases.iter().map(cheapest).collect();
    earns("other forms and axes", operations(&alone, |limits| limits));
}
