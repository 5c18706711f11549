//! Planted faults, and the memory that code is in.

use dalembert_codegen::workspace::{Node, Operation};

use super::*;
use crate::{Arm, Cache, Load};

const LAYOUTS: [States; 2] = [States::Apart, States::Adjacent];

fn refused<T: Real>(native: &mut Native, fault: &str, plant: impl FnOnce(&mut Code)) {
    let program = native.program.clone();
    plant(&mut native.program);
    let one = native.check_one::<T>();
    let many = LAYOUTS.map(|states| native.check_many::<T>(states, native.many(states).unwrap()));
    native.program = program;
    let differs = |error: &Error| matches!(error, Error::Differs { .. });
    assert!(one.as_ref().is_err_and(differs), "{fault}: {one:?}");
    for many in many {
        assert!(many.as_ref().is_err_and(differs), "{fault}: {many:?}");
    }
}

fn torques(scalar: ScalarType) -> Native {
    let asked = format!("outputs: inverse_dynamics; scalar: {scalar}");
    let load = Load {
        asked: asked.parse().unwrap(),
        cache: Cache::Off,
        ..Load::default()
    };
    let folder = env!("CARGO_MANIFEST_DIR");
    let robot = format!("{folder}/../../generated/robots/planar3r.toml");
    let arm = Arm::load(robot, &load).unwrap();
    again(arm.functions()[0].native())
}

fn again(native: &Native) -> Native {
    Native::compile(native.program.clone(), native.signature.clone()).unwrap()
}

fn every_fault_is_found<T: Real>() {
    let mut native = torques(T::SCALAR);
    for states in LAYOUTS {
        native.many(states).unwrap();
    }
    let operations: Vec<_> = native.program.dag.operations().collect();
    for (id, operation, operands) in operations {
        for other in [Operation::Add, Operation::Sub, Operation::Mul] {
            if other != operation {
                let fault = format!("{other:?} at node {id}");
                let wrong = Node::Apply(other, operands);
                refused::<T>(&mut native, &fault, |p| p.dag.nodes[id as usize] = wrong);
            }
        }
        // The first operation may have nothing else before it.
        let mut others = (0..id).filter(|other| *other != operands[0]);
        if let Some(other) = others.next_back() {
            let fault = format!("another operand of node {id}");
            let wrong = Node::Apply(operation, [other, operands[1]]);
            refused::<T>(&mut native, &fault, |p| p.dag.nodes[id as usize] = wrong);
        }
    }
    for index in 0..native.program.dag.outputs.len() {
        let fault = format!("sign of result {index}");
        refused::<T>(&mut native, &fault, |p| {
            p.dag.outputs[index].negative ^= true
        });
    }
}

#[test]
fn a_wrong_instruction_is_found() {
    every_fault_is_found::<f64>();
    every_fault_is_found::<f32>();
}

#[cfg(target_os = "linux")]
fn permissions(addresses: &[usize]) -> Vec<Option<String>> {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
    let region = |line: &str| {
        let (range, rest) = line.split_once(' ').unwrap();
        let (begin, end) = range.split_once('-').unwrap();
        let number = |text| usize::from_str_radix(text, 16).unwrap();
        (number(begin)..number(end), rest[..4].to_owned())
    };
    let regions: Vec<_> = maps.lines().map(region).collect();
    let at = |address| {
        let mut regions = regions.iter();
        let (_, permissions) = regions.find(|(range, _)| range.contains(address))?;
        Some(permissions.clone())
    };
    addresses.iter().map(at).collect()
}

#[test]
#[cfg(target_os = "linux")]
fn code_is_never_writable_and_is_unmapped_when_dropped() {
    let native = torques(ScalarType::F64);
    let compiled: Vec<Native> = (0..50).map(|_| again(&native)).collect();
    let entries = |native: &Native| {
        let [apart, adjacent] = LAYOUTS.map(|states| native.many(states).unwrap().entry as usize);
        [native.one.entry as usize, apart, adjacent]
    };
    let addresses: Vec<usize> = compiled.iter().flat_map(entries).collect();
    let executable = Some("r-xp".to_owned());
    assert_eq!(permissions(&addresses), vec![executable.clone(); 150]);
    drop(compiled);
    // Another test may have been given the place of some.
    let mut left = permissions(&addresses);
    left.retain(|permission| *permission == executable);
    assert!(left.len() < 50, "{} of 150 are left", left.len());
}
