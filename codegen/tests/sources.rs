//! Counts what each source of the search earns: operations that its absence costs, over the six
//! robots of `generated`, the arms of the gallery and twenty that nobody chose.

use std::fs;

use dalembert_codegen::workspace::{
    Dag, Folding, Job, Limits, cost, search, search_graphs, testing::Schedule,
};
use dalembert_codegen::{Effort, Function, Request};
use dalembert_model::robot::Robot;

use crate::support::draw::robots;
use crate::support::{path, read_robot};

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
    let entries = folders.flat_map(|folder| fs::read_dir(path(folder)).unwrap());
    let paths = entries.map(|file| file.unwrap().path());
    let files = paths.filter(|file| file.extension().is_some_and(|ending| ending == "toml"));
    let read = files.map(|file| read_robot(&fs::read_to_string(file).unwrap()));
    drawn.chain(read).collect()
}

type LeaveOut = fn(&mut Limits);

const SOURCES: [(&str, LeaveOut); 4] = [
    ("rules", |limits| limits.rules = 0),
    ("pairs", |limits| limits.pairs = 0),
    ("resubstitution", |limits| limits.substitutes = 0),
    ("annealing", |limits| {
        limits.schedules = [Schedule::cool(0); 2]
    }),
];

fn operations(cases: &[Vec<Dag>], leave_out: LeaveOut) -> usize {
    let limits = |operations| {
        let mut limits = Effort::Quick.limits(operations);
        leave_out(&mut limits);
        limits
    };
    let counts = cases.iter().map(|seeds| {
        let best = search_graphs(seeds, &[], &limits, &|_| true, &|_, _| true);
        best.unwrap().graph.counts().operations()
    });
    counts.sum()
}

#[test]
#[ignore = "a quarter of an hour: by hand"]
fn by_hand_every_source_earns() {
    let robots = all();
    let with_functions = |robot| FUNCTIONS.map(|function| (robot, function));
    let cases = robots.iter().flat_map(with_functions);
    let seeds = |(robot, function): (&Robot, Function)| -> Vec<Dag> {
        let request = Request::new(&[function]);
        let setup = request.prepare(robot).unwrap();
        let job = Job {
            robot,
            setup: &setup,
            request: &request,
        };
        let result = search(&job, function).unwrap();
        result.seeds.into_iter().map(|seed| seed.graph).collect()
    };
    let cases: Vec<Vec<Dag>> = cases.map(seeds).collect();
    let whole = operations(&cases, |_| {});
    println!("all sources: {whole} operations");
    let earns = |name: &str, without: usize| {
        let lost = without as f64 - whole as f64;
        let part = 100.0 * lost / whole as f64;
        println!("without {name}: {lost:+}, {part:+.2} %");
        assert!(lost > 0.0, "{name}");
    };
    for (name, leave_out) in SOURCES {
        earns(name, operations(&cases, leave_out));
    }
    let price = |dag: &&Dag| cost(&dag.rebuild(Folding::Semantic));
    let cheapest = |seeds: &Vec<Dag>| vec![seeds.iter().min_by_key(price).unwrap().clone()];
    let alone: Vec<Vec<Dag>> = cases.iter().map(cheapest).collect();
    earns("other forms and axes", operations(&alone, |_| {}));
}
