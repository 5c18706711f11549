//! NaN and ±inf reach the outputs that depend on them: exactly those in
//! emitted code, at least those in the generic runtime.

use dalembert_codegen::workspace::{Input, JointState, Node, Runtime, testing::seeded};
use dalembert_codegen::{Function, Program, Request, ScalarType, generate};

use crate::robots::robot;

/// An entry of the state: 0, 1 or 2 for q, q̇ or q̈, and the joint.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry(usize, usize);

fn reads(input: Input, place: Entry) -> bool {
    match input {
        Input::Sin(joint) | Input::Cos(joint) => place == Entry(0, joint),
        Input::PerSpeed(joint) => place == Entry(1, joint),
        Input::Entry(argument, joint) => place == Entry(argument.index(), joint),
    }
}

fn dependent(program: &Program, place: Entry) -> Vec<bool> {
    let mut depends: Vec<bool> = Vec::new();
    for node in &program.dag.nodes {
        depends.push(match node {
            Node::Input(input) => reads(*input, place),
            Node::Constant(_) => false,
            Node::Apply(_, operands) => operands.iter().any(|id| depends[*id as usize]),
        });
    }
    let outputs = program.dag.outputs.iter();
    outputs.map(|output| depends[output.index()]).collect()
}

fn with(state: &JointState, place: Entry, value: f64) -> JointState {
    let mut state = state.clone();
    let values = [&mut state.q, &mut state.qd, &mut state.qdd];
    values.into_iter().nth(place.0).unwrap()[place.1] = value;
    state
}

fn sensitive(
    run: impl Fn(&JointState) -> Vec<f64>,
    states: &[JointState],
    place: Entry,
) -> Vec<bool> {
    let mut sensitive = Vec::new();
    for state in states {
        let rows = [&state.q, &state.qd, &state.qdd];
        let moved = with(state, place, rows[place.0][place.1] + 0.7);
        let [a, b] = [state, &moved].map(&run);
        let size = a.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        sensitive.resize(a.len(), false);
        for (sensitive, (a, b)) in sensitive.iter_mut().zip(a.iter().zip(&b)) {
            *sensitive |= (a - b).abs() > 1e-9 * size;
        }
    }
    sensitive
}

#[test]
fn what_is_not_finite_reaches_what_depends_on_it() {
    for name in ["planar2r", "planar3r", "stanford", "puma560"] {
        let robot = robot(name);
        let made = generate(&robot, &Request::new(&Function::ALL[..6])).unwrap();
        let states = seeded(&robot, 4, 11);
        let runtime = Runtime::new(&robot);
        let doubles = made.emitted.iter().filter(|e| e.scalar == ScalarType::F64);
        for (generated, emitted) in made.functions.iter().zip(doubles) {
            let function = generated.function;
            assert_eq!(emitted.function, function);
            let run = |state: &JointState| runtime.run(function, state);
            let joints = 0..robot.joints.len();
            let places = (0..3).flat_map(|row| joints.clone().map(move |j| Entry(row, j)));
            for place in places {
                let dependent = dependent(&generated.program, place);
                let sensitive = sensitive(run, &states, place);
                for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let state = with(&states[0], place, bad);
                    let results = emitted.run(&state);
                    let of_runtime = run(&state);
                    for index in 0..results.len() {
                        let at = || format!("{name} {function} {index} {place:?} {bad}");
                        let finite = results[index].is_finite();
                        // +, − and × may turn an infinity into a NaN, but never
                        // into a finite number.
                        assert_eq!(finite, !dependent[index], "{}", at());
                        // The program uses every input that matters.
                        if sensitive[index] {
                            assert!(dependent[index], "{}", at());
                            assert!(!of_runtime[index].is_finite(), "runtime {}", at());
                        }
                    }
                }
            }
        }
    }
}
