//! Calls that are refused, and memory.

use dalembert_jit::{Arm, Error, Native, Place, Scalar, Signature};

use crate::support::{asking, robot};

fn gravity() -> Arm {
    robot("planar2r", &asking("outputs: gravity"))
}

#[test]
fn other_lengths_and_scalars_are_refused() {
    let arm = gravity();
    let native = arm.functions()[0].native();
    let (q, mut c) = ([0.1, 0.2], [0.0; 2]);
    assert_eq!(native.call(&[&q], &mut c), Ok(()));
    assert_ne!(c, [0.0; 2]);
    let wrong = native.call(&[&[0.1f32, 0.2]], &mut [0.0; 2]);
    let expected = Scalar::F64;
    assert_eq!(wrong, Err(Error::Scalar { expected }));
    let wrong = native.call(&[&q, &q], &mut c);
    let (expected, found) = (1, 2);
    assert_eq!(wrong, Err(Error::Count { expected, found }));
    for (q, length, place, found) in [(&q[..1], 2, 0, 1), (&q[..], 3, 1, 3)] {
        let wrong = native.call(&[q], &mut vec![0.0; length]);
        let error = Error::Length {
            place,
            expected: 2,
            found,
        };
        assert_eq!(wrong, Err(error));
    }
}

#[test]
fn places_outside_and_on_each_other_are_refused() {
    let arm = gravity();
    let native = arm.functions()[0].native();
    let q = [0.1; 20];
    let call = |read: Place, written: Place, states| {
        let mut c = [0.0; 20];
        native.call_rows(&[(&q[..], read)], &mut [(&mut c[..], written)], states, 2)
    };
    let place = |state, offsets: [usize; 2]| Place {
        state,
        offsets: offsets.to_vec(),
    };
    assert_eq!(call(Place::rows(2), Place::columns(2, 10), 10), Ok(()));
    assert_eq!(call(place(0, [0, 1]), Place::rows(2), 10), Ok(()));
    assert_eq!(call(Place::rows(2), Place::rows(2), 0), Ok(()));
    let outside = |place| Err(Error::Outside { place });
    assert_eq!(call(Place::rows(2), Place::rows(2), 11), outside(0));
    assert_eq!(call(place(0, [0, 1]), Place::rows(2), 11), outside(1));
    let far = place(usize::MAX, [0, 1]);
    assert_eq!(call(far, Place::rows(2), 10), outside(0));
    let overlap = Err(Error::Overlap { place: 1 });
    for (state, offsets) in [(0, [0, 1]), (1, [0, 1]), (2, [1, 1]), (1, [0, 9])] {
        let written = place(state, offsets);
        assert_eq!(call(Place::rows(2), written, 10), overlap);
    }
    assert_eq!(call(Place::rows(2), place(1, [0, 10]), 10), Ok(()));
}

#[test]
fn a_signature_of_another_function_is_refused() {
    let arm = gravity();
    let native = arm.functions()[0].native();
    let compile = |signature| Native::compile(native.program().clone(), signature).err();
    let none = Signature {
        arguments: Vec::new(),
        results: vec![2],
    };
    assert_eq!(compile(none), Some(Error::Program));
    let three = Signature {
        results: vec![3],
        ..native.signature().clone()
    };
    let (expected, found) = (3, 2);
    let error = Error::Results { expected, found };
    assert_eq!(compile(three), Some(error));
}

#[test]
fn an_arm_is_shared_by_threads() {
    fn is_shared<T: Send + Sync>(_: &T) {}
    let arm = gravity();
    is_shared(&arm);
    let arm = &arm;
    std::thread::scope(|scope| {
        for thread in 0..4 {
            scope.spawn(move || {
                let q = [0.1 * f64::from(thread); 2];
                let mut c = [[0.0; 2]; 2];
                for _ in 0..1000 {
                    arm.functions()[0].native().call(&[&q], &mut c[0]).unwrap();
                    arm.functions()[0].native().call(&[&q], &mut c[1]).unwrap();
                    assert_eq!(c[0], c[1]);
                }
            });
        }
    });
}
