//! To the last bit.

use dalembert_codegen::workspace::Operation;
use dalembert_jit::{Arm, Scalar};

use crate::support::{
    OTHERS, STATES, all_outputs_in_both, asking, called, compare, compare_all, drawn, is_same,
    of_fixed_bases, path, robot,
};

fn all_outputs(name: &str, states: usize) {
    let arm = robot(name, &asking(&all_outputs_in_both()));
    assert_eq!(arm.functions().len(), 2 * of_fixed_bases().len());
    compare_all(name, &arm, states);
}

#[test]
fn all_outputs_of_a_small_arm() {
    all_outputs("planar2r", STATES);
}

#[test]
#[ignore = "minutes: the step `campaigns` of .ci/run"]
fn all_outputs_of_five_robots() {
    for name in OTHERS {
        all_outputs(name, 10 * STATES);
    }
}

#[test]
fn outputs_by_default() {
    for name in ["puma560", "stanford"] {
        let load = asking("scalar: f64, f32");
        compare_all(name, &robot(name, &load), STATES);
    }
}

#[test]
fn parameters_are_arguments() {
    let asked =
        "outputs: inverse_dynamics, gravity; scalar: f64, f32; parameters: payload, gravity";
    let arm = robot("planar3r", &asking(asked));
    assert!(arm.function("load", Scalar::F64).is_some());
    compare_all("planar3r with parameters", &arm, STATES);
}

#[test]
fn other_sines_and_fused_products() {
    for (sines, fuses_products) in [
        ("sincos: polynomial", false),
        ("sincos: libm", false),
        ("fma: on", true),
    ] {
        let asked = format!("outputs: inverse_dynamics, jacobian; scalar: f64, f32; {sines}");
        let arm = robot("planar3r", &asking(&asked));
        let fuses = arm.functions().iter().any(|function| {
            let mut operations = function.native().program().dag.operations();
            operations.any(|(_, operation, _)| operation == Operation::Fused)
        });
        assert_eq!(fuses, fuses_products);
        compare_all("planar3r", &arm, STATES);
    }
}

#[test]
fn friction_takes_roots() {
    let load = asking("outputs: inverse_dynamics; scalar: f64, f32");
    let arm = Arm::load(path("crates/model/tests/data/coulomb.toml"), &load).unwrap();
    assert!(arm.functions()[0].counts().sqrt > 0);
    compare_all("coulomb", &arm, STATES);
}

#[test]
fn a_tolerance_is_compiled() {
    let arm = robot("stanford", &asking("scene: swing"));
    assert!(arm.claim().contains("\"tolerated\""));
    compare_all("with a tolerance", &arm, STATES);
}

#[test]
fn threads_change_no_bit() {
    let arm = robot("planar2r", &asking("outputs: inverse_dynamics"));
    let native = arm.functions()[0].native();
    let states = drawn::<f64>(native, 20_001, 3);
    let [one, three] = [1, 3].map(|threads| called(native, &states, true, threads).concat());
    let mut both = one.iter().zip(three);
    assert!(both.all(|(one, three)| is_same(*one, three)));
    compare::<f64>("planar2r", native, 100);
}
