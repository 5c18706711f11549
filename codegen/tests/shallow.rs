//! `prefer: latency`: the same function, as many operations, a shorter longest chain.

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::generate;
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_codegen::workspace::program::shallow::Cycles;
use dalembert_codegen::workspace::states::{SEED, STATES, seeded};
use dalembert_codegen::workspace::task::{Fma, Prefer, Request};
use dalembert_codegen::workspace::verify::floating::Runtime;

use crate::shown::shown;
use crate::support;

fn request(functions: &[Function], prefer: Prefer, fma: Fma) -> Request {
    Request {
        scalars: vec![ScalarType::F64],
        prefer,
        fma,
        ..Request::of(functions)
    }
}

/// The doses first: an arm with a slide, one of parallel axes.
const ROBOTS: [&str; 6] = [
    "stanford", "planar3r", "planar2r", "puma560", "ur10", "panda",
];

/// Proved and read back where they are generated; within the bound of rounding; none is
/// deeper than without, and torques of six joints are less deep.
#[test]
fn six_robots_are_right_and_less_deep() {
    for &name in support::dose(&ROBOTS, 2) {
        let robot = support::robot(name);
        let functions = [Function::InverseDynamics, Function::ForwardDynamics];
        let runtime = Runtime::new(&robot);
        let states = seeded(&robot, STATES, SEED);
        for fma in Fma::ALL {
            let plain = generate(&robot, &request(&functions, Prefer::Accuracy, fma)).unwrap();
            let found = generate(&robot, &request(&functions, Prefer::Latency, fma)).unwrap();
            for (own, other) in found.functions.iter().zip(&plain.functions) {
                let (depth, before) = (own.program.depth(), other.program.depth());
                let what = format!("{name} {}: {depth} of {before}", own.function);
                let said = format!("/// The longest chain is of {depth} operations.\n");
                assert!(found.text.contains(&said), "{what}");
                assert!(!plain.text.contains("The longest chain"), "{what}");
                if fma == Fma::Off {
                    assert_eq!(own.counts(), other.counts(), "{what}");
                    assert!(depth <= before, "{what}");
                    let again = own.program.shallow(Cycles::DESKTOP);
                    assert_eq!(again.depth(), depth, "{what}");
                    let six = !name.starts_with("planar");
                    assert!(!six || depth < before, "{what}");
                    assert_eq!(own.found.is_some(), own.program != other.program);
                }
            }
            support::rounds_well(&found.emitted, &runtime, &states, name);
        }
    }
}

/// A certificate is about the order that is emitted.
#[test]
fn certificates_are_of_the_order_that_is_emitted() {
    let scene = "\n[scene.hold]\noutputs = [\"gravity\"]\nscalar = \"f64\"\n\
                 tolerance = { value = 1e-2, relative_to = \"range\" }\n";
    let source = support::source("panda", scene);
    let reading = support::reading_with("panda", scene);
    let scene = reading.scenes.iter().find(|scene| scene.name == "hold");
    let request = Request {
        prefer: Prefer::Latency,
        ..Request::default().in_scene(scene.unwrap())
    };
    let generated = generate(&reading.robot, &request).unwrap();
    let function = &generated.functions[0];
    let admitted = function.admitted.as_ref().unwrap();
    let certificate = &admitted.certificates[0];
    assert_eq!(certificate.emitted, function.program);
    assert_ne!(admitted.program, function.program);
    assert!(function.program.depth() < admitted.program.depth());
    shown(&source, certificate);
}
