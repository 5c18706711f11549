//! Generated functions whose sines are polynomials: printed, counted, read
//! back, and as near to libm's as was proved.

use dalembert_codegen::workspace::{
    AngleKernel, BOUND, Candidates, Code, Dag, Edge, ErrorByCause, Input, Interval, Library, Node,
    Printed, Runtime, Setup, Signature, seeded, write_function,
};
use dalembert_codegen::{
    Function, GenerateError, Generated, Program, Request, ScalarType, SinCos, generate,
};
use dalembert_model::read;
use dalembert_model::robot::Robot;

use crate::shown::shown;
use crate::support;

const FUNCTION: Function = Function::InverseDynamics;

fn with(robot: &Robot, error: f64) -> Result<Generated, GenerateError> {
    let request = Request {
        sincos: SinCos::Polynomial { error: Some(error) },
        ..Request::new(&[FUNCTION])
    };
    generate(robot, &request)
}

/// Planar arms add angles, the Stanford arm slides, the UR10 turns twice.
#[test]
fn polynomials_are_printed_counted_read_back_and_near() {
    for name in ["planar3r", "stanford", "ur10"] {
        let robot = support::robot(name);
        let generated = with(&robot, 1e-5).unwrap();
        assert!(!generated.text().contains("libm"), "{name}");
        let states = seeded(&robot, 200, 3);
        let runtime = Runtime::in_scene(Setup::whole(&robot));
        for emitted in &generated.emitted {
            let function = &generated.functions[0];
            let counts = function.counts_in(emitted.scalar);
            assert_eq!(emitted.text.counts(), counts);
            assert!(counts.trig_mul > 0 && counts.trig_add > 0);
            assert_eq!(
                (counts.mul, counts.add),
                (function.counts().mul, function.counts().add)
            );
            let line = format!("{counts}.");
            assert!(line.contains("trig_mul") && generated.text().contains(&line));
            // The rest is as exact as with libm's sines.
            for measure in emitted.against_runtime(&runtime, &states) {
                assert!(measure.in_units() <= BOUND, "{name} {measure:?}");
            }
            let seen = emitted.sines(&states);
            let proved = function.sines(emitted.scalar);
            assert_eq!(seen.len(), proved.len());
            for ((joint, seen), proved) in seen.into_iter().zip(proved) {
                assert_eq!(joint, proved.joint);
                assert!(proved.errors.worst() <= 1e-5);
                assert!(
                    seen > 0.0 && seen <= proved.errors.worst() + f64::EPSILON,
                    "{name}"
                );
            }
        }
    }
}

/// Returns the sine and cosine of one angle, as far as they are wanted: a function of two
/// results.
fn pair(sin: bool, cos: bool) -> Program {
    let wanted = match (sin, cos) {
        (true, false) => vec![Input::Sin(0)],
        (false, true) => vec![Input::Cos(0)],
        _ => vec![Input::Sin(0), Input::Cos(0)],
    };
    let edge = |node| Edge {
        node,
        negative: false,
    };
    let last = wanted.len() as u32 - 1;
    Program {
        dag: Dag {
            nodes: wanted.into_iter().map(Node::Input).collect(),
            outputs: vec![edge(0), edge(last)],
        },
        ..Program::empty(Function::Gravity, 2)
    }
}

/// Over narrow ranges a sine or cosine may be a constant, of either sign, or the
/// angle itself: every kernel there is prints as what is read back.
#[test]
fn kernels_of_narrow_ranges_are_read_back() {
    let mut read = 0;
    let quarter = core::f64::consts::FRAC_PI_2;
    let centres = [0.0, 1.57, 2.0 * quarter, -quarter];
    let halves: &[f64] = if cfg!(debug_assertions) {
        &[5e-4]
    } else {
        &[1e-9, 1e-5, 5e-4, 0.02]
    };
    for scalar in ScalarType::ALL {
        for (centre, half) in centres
            .iter()
            .flat_map(|c| halves.iter().map(move |h| (c, h)))
        {
            let range = Interval::new(centre - half, centre + half).unwrap();
            for (sin, cos) in [(true, true), (true, false), (false, true)] {
                let program = pair(sin, cos);
                let candidates = Candidates::new(program.trig()[0].need, scalar, range);
                for (most, enough) in [(f64::INFINITY, 0.0), (1.0, 1e-2)] {
                    for choice in candidates.front(most, enough) {
                        let sines = [AngleKernel {
                            joint: program.trig()[0].joint,
                            range,
                            form: choice.form.to_string(),
                            kernel: choice.kernel,
                            errors: choice.errors,
                        }];
                        let code = program.code(scalar, Library::Libm, &sines);
                        let text =
                            write_function(&Printed::of(&program, &code), Library::Libm, &[]);
                        let found = Code::parse(&text, &Signature::of(&program, scalar)).unwrap();
                        let same = found.matches(&program, Library::Libm, &sines);
                        assert_eq!(same, Ok(()), "{}\n{text}", sines[0].form);
                        read += 1;
                    }
                }
            }
        }
    }
    assert!(read > 100, "{read}");
}

/// Over such ranges inputs run alike, and sines are nearly constants: what is left out
/// can be written down, and what is printed is read back.
#[test]
fn tolerances_over_narrow_ranges_are_met() {
    for (centre, tolerance) in [(-1.571, 1e-5), (-1.571, 1e-6), (3.1, 1e-6), (0.0, 1e-3)] {
        let range = format!("[{:?}, {:?}]", centre - 5e-4, centre + 5e-4);
        let scene = format!(
            "\n[scene.narrow]\noutputs = [\"gravity\"]\nbox = {{ position = [{}] }}\n\
             tolerance = {{ value = {tolerance:?}, relative_to = \"range\" }}\n",
            [range.as_str(); 6].join(", ")
        );
        let reading = support::reading_with("puma560", &scene);
        for sincos in [SinCos::Auto, SinCos::Polynomial { error: None }] {
            let request = Request {
                sincos,
                ..Request::default().in_scene(&reading.scenes[0])
            };
            let generated = generate(&reading.robot, &request);
            assert!(
                generated.is_ok(),
                "{centre} {tolerance}: {:?}",
                generated.err()
            );
        }
    }
}

/// A text with another coefficient, or with libm's sine where a polynomial
/// should be, is not the function that was proved.
#[test]
fn a_text_with_other_sines_is_not_the_function() {
    let robot = support::robot("planar3r");
    let generated = with(&robot, 1e-5).unwrap();
    let (function, scalar) = (&generated.functions[0], ScalarType::F64);
    let matches = |text: &str| {
        let read = Code::parse(text, &Signature::of(&function.program, scalar))
            .map_err(|e| e.to_string())?;
        read.matches(&function.program, Library::Libm, function.sines(scalar))
            .map_err(|difference| difference.to_string())
    };
    assert_eq!(matches(&generated.texts[0]), Ok(()));
    let block = generated.texts[0].find("let (s1, c1) = {").unwrap();
    let end = block + generated.texts[0][block..].find("};").unwrap() + 2;
    for (from, to, why) in [
        ("x1 = q[0] * q[0]", "x1 = q[0] * q[1]", "another angle"),
        ("let x2", "let x3", "not the next name"),
        ("+ 1.", "- 1.", "differ"),
        ("1.0 -", "1.0 +", "differ"),
        ("};", "", "`}` expected"),
    ] {
        let changed = generated.texts[0][block..end].replacen(from, to, 1);
        assert_ne!(changed, generated.texts[0][block..end], "{from}");
        let text = generated.texts[0][..block].to_owned() + &changed + &generated.texts[0][end..];
        let found = matches(&text).unwrap_err();
        assert!(found.contains(why), "{found}");
    }
    let called = "let (s1, c1) = libm::sincos(q[0]);";
    let text = generated.texts[0][..block].to_owned() + called + &generated.texts[0][end..];
    assert!(matches(&text).is_err());
    // Nor is it one of libm's sines.
    let read = Code::parse(
        &generated.texts[0],
        &Signature::of(&function.program, scalar),
    )
    .unwrap();
    assert!(read.matches(&function.program, Library::Libm, &[]).is_err());
    let called = read.with_libm();
    assert!(
        called
            .matches(&function.program, Library::Libm, &[])
            .is_ok()
    );
}

/// A joint without limits of position may have turned often.
#[test]
fn whole_turns_are_taken_off_where_limits_are_missing() {
    let mut robot = support::robot("planar2r");
    for joint in &mut robot.joints {
        joint.limits.position = None;
    }
    let request = Request {
        scalars: vec![ScalarType::F64],
        sincos: SinCos::Polynomial { error: Some(1e-9) },
        ..Request::new(&[FUNCTION])
    };
    let generated = generate(&robot, &request).unwrap();
    assert!(generated.text().contains("less whole turns"));
    let mut far = seeded(&robot, 200, 1);
    for state in &mut far {
        for q in &mut state.q {
            *q *= 1e5;
        }
    }
    for (_, seen) in generated.emitted[0].sines(&far) {
        assert!(seen > 0.0 && seen < 1e-9, "{seen:e}");
    }
}

#[test]
fn an_error_that_no_polynomial_reaches_is_refused() {
    let why = with(&support::robot("planar2r"), 1e-10)
        .unwrap_err()
        .to_string();
    assert!(
        why.contains("f32") && why.contains("q1") && why.contains("at best"),
        "{why}"
    );
}

/// A point at the end of a stretched arm can hardly be accelerated along it by turning:
/// D is next to singular there, and errors of its cosine may make it indefinite.
#[test]
fn sines_too_rough_for_the_inertia_matrix_are_refused() {
    let joint = |mass: &str| {
        format!(
            "[[joint]]\nkind = \"revolute\"\na = 1\nmass = {mass}\ncom = [0, 0, 0]\n\
             inertia = [0, 0, 0, 0, 0, 0]\n"
        )
    };
    let text = "name = \"points\"\nconvention = \"standard\"\ngravity = [0, -9.81, 0]\n".to_owned()
        + &joint("0.03")
        + &joint("1");
    let robot = read::parse(&text, &read::Options::default()).unwrap().robot;
    let inertia = |error: f64| {
        let request = Request {
            sincos: SinCos::Polynomial { error: Some(error) },
            ..Request::new(&[Function::Inertia])
        };
        generate(&robot, &request)
    };
    assert!(inertia(1e-5).is_ok());
    let why = inertia(3e-2).unwrap_err().to_string();
    assert!(why.contains("positive definite"), "{why}");
}

/// What no sine is taken of comes out as it was: no NaN is swallowed.
#[test]
fn what_is_no_number_stays_none() {
    let robot = support::robot("planar3r");
    let generated = with(&robot, 1e-5).unwrap();
    for emitted in &generated.emitted {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut state = seeded(&robot, 1, 2).remove(0);
            state.q[2] = bad;
            let results = emitted.run(&state);
            assert!(results.iter().all(|x| !x.is_finite()), "{results:?}");
        }
    }
}

const SCENE: &str = r#"
[scene.rough]
outputs = ["inverse_dynamics"]
box = { position = [[-3, 3], [0.2, 2.8]], velocity = [2, 3], acceleration = [10, 20] }
tolerance = { value = 1e-4, relative_to = "range" }
scalar = "f64"
"#;

/// By default polynomials are as exact as the scene's tolerance needs, and
/// are in its certificates.
#[test]
fn a_tolerance_says_how_exact_sines_are() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots");
    let source = std::fs::read_to_string(folder.join("planar2r.toml")).unwrap() + SCENE;
    let reading = dalembert_model::read::parse(&source, &Default::default()).unwrap();
    let scene = &reading.scenes[0];
    let request = Request::default().in_scene(scene);
    let generated = generate(&reading.robot, &request).unwrap();
    let function = &generated.functions[0];
    let certificate = &function.admitted.as_ref().unwrap().certificates[0];
    assert_eq!(certificate.sines, function.sines(ScalarType::F64));
    shown(&source, certificate);
    let most = |of: fn(&ErrorByCause) -> f64| certificate.bounds.iter().map(of).fold(0.0, f64::max);
    let (all, part) = (most(|b| b.total()), most(|b| b.sincos));
    assert!(all <= 1e-4 && part > 1e-7, "{all:e} {part:e}");
    let text = &generated.text();
    assert!(!text.contains("libm") && text.contains("Certified") && text.contains("about pi/2"));
}
