//! Functions in CUDA: their text has the bits of the proved program where a processor runs it,
//! and a compiler for the device fuses nothing.

use std::fs;
use std::process::Command;

use dalembert_codegen::{Function, Language, Request, ScalarType, SinCos, generate};

use crate::c99::changes;
use crate::support;
use crate::support::compiled::{folder, same_bits, there};

/// Without qualifiers, threads in turns: functions and kernels of all that changes what is printed.
#[test]
fn functions_and_kernels_have_the_bits_of_the_program() {
    for (what, robot, request) in changes() {
        for batch in [false, true] {
            let request = Request {
                language: Language::Cuda,
                batch,
                ..request.clone()
            };
            same_bits(what, &robot, &request, 100, &[&["-O3", "-march=native"]]);
        }
    }
}

/// The compiler for the device has no warning, and makes one operation of no product and sum.
#[test]
fn the_device_rounds_every_operation() {
    let robot = support::robot("planar2r");
    let folder = folder("device");
    for nvcc in there(&["nvcc"]) {
        let request = Request {
            language: Language::Cuda,
            sincos: SinCos::Polynomial { error: None },
            batch: true,
            ..Request::of(&[Function::InverseDynamics, Function::Inertia])
        };
        let generated = generate(&robot, &request).unwrap();
        let source = folder.join("arm.cu");
        fs::write(folder.join("arm.cuh"), generated.text()).unwrap();
        fs::write(&source, "#include \"arm.cuh\"\n").unwrap();
        let ptx = folder.join("arm.ptx");
        let said = Command::new(nvcc)
            .args(["-arch=sm_90", "-ptx", "-Werror", "all-warnings", "-o"])
            .args([&ptx, &source])
            .output()
            .unwrap();
        let errors = String::from_utf8_lossy(&said.stderr);
        assert!(said.status.success(), "{errors}");
        let ptx = fs::read_to_string(ptx).unwrap();
        for scalar in ScalarType::ALL {
            let bits = if scalar == ScalarType::F32 { 32 } else { 64 };
            assert!(ptx.contains(&format!("mul.rn.f{bits}")), "{scalar}");
            assert!(!ptx.contains(&format!("fma.rn.f{bits}")), "{scalar}");
        }
    }
}
