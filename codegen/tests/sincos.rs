//! Generated functions whose sines are polynomials, as near to libm's as was proved.

use core::f64::consts::{FRAC_PI_2, PI};
use core::ops::Range;

use dalembert_checker::certify::Bound;
use dalembert_codegen::workspace::{
    Code, Dag, Input, Library, Node, Signature,
    testing::{AngleKernel, Candidates, Edge, Interval, write_function},
};
use dalembert_codegen::{Function, Program, ScalarType};
use dalembert_model::outputs::Sizes;

use crate::certified::Certified;
use crate::support::{Case, daily_and_campaign, in_scene, rounds_well, says, variants};

const ASKED: &str = "inverse_dynamics; sincos: polynomial; sincos_error: 1e-5";

/// Planar arms add angles, the Stanford arm slides, the UR10 turns twice.
#[test]
fn polynomials_are_printed_counted_read_back_and_near() {
    for name in ["planar3r", "stanford", "ur10"] {
        let case = Case::in_scene(name, "", ASKED);
        let (generated, (runtime, states)) = (case.generated(), case.runtime(200, 3));
        assert!(!generated.text().contains("libm"), "{name}");
        rounds_well(&generated, &runtime, &states, name);
        let function = &generated.functions[0];
        let plain = function.counts();
        for emitted in &generated.emitted {
            let counts = function.counts_in(emitted.scalar);
            assert_eq!(emitted.text.counts(), counts);
            assert!(counts.trig_mul > 0 && counts.trig_add > 0);
            assert_eq!((counts.mul, counts.add), (plain.mul, plain.add));
            let line = format!("{counts}.");
            assert!(line.contains("trig_mul") && generated.text().contains(&line));
            let called = function.program.code(emitted.scalar, Library::Libm, &[]);
            assert!(emitted.text.difference(&called).is_some());
            assert_eq!(emitted.with_libm().text.difference(&called), None);
            let errors = emitted.sines(&states);
            let proved = function.sines(emitted.scalar);
            assert_eq!(errors.len(), proved.len());
            for ((joint, error), proved) in errors.into_iter().zip(proved) {
                let worst = proved.errors.worst();
                assert!(joint == proved.joint && worst <= 1e-5);
                assert!(error > 0.0 && error <= worst + f64::EPSILON, "{name}");
            }
        }
    }
}

fn of(wanted: &[Input]) -> Program {
    let last = wanted.len() as u32 - 1;
    Program {
        dag: Dag {
            nodes: wanted.iter().map(|input| Node::Input(*input)).collect(),
            outputs: vec![Edge::from(0), Edge::from(last)],
        },
        ..Program::empty(Function::Gravity, Sizes::whole(2))
    }
}

static PAIR: [Input; 2] = [Input::Sin(0), Input::Cos(0)];

daily_and_campaign! {
    kernels_of_narrow_ranges_are_read_back: (0..2), (2..16);
    tolerances_over_narrow_ranges_are_met: ([(-1.571, 1e-5), (0.0, 1e-3)]), ([(-1.571, 1e-6), (3.1, 1e-6)]);
}

/// Over narrow ranges a sine or cosine may be a constant, of either sign, or the angle itself.
fn kernels_of_narrow_ranges_are_read_back(places: Range<usize>) {
    const CENTRES: [f64; 4] = [0.0, -FRAC_PI_2, 1.57, PI];
    const HALVES: [f64; 4] = [5e-4, 1e-9, 1e-5, 0.02];
    let mut choices = Vec::new();
    for place in places.clone() {
        let (centre, half) = (CENTRES[place % 4], HALVES[place / 4]);
        let range = Interval::new(centre - half, centre + half).unwrap();
        for scalar in ScalarType::ALL {
            for wanted in [&PAIR[..], &PAIR[..1], &PAIR[1..]] {
                let candidates = Candidates::new(of(wanted).trig()[0].need, scalar, range);
                for (most, enough) in [(f64::INFINITY, 0.0), (1.0, 1e-2)] {
                    let front = candidates.front(most, enough).into_iter();
                    choices.extend(front.map(|choice| (scalar, range, wanted, choice)));
                }
            }
        }
    }
    assert!(choices.len() > 12 * places.len(), "{}", choices.len());
    for (scalar, range, wanted, choice) in choices {
        let program = of(wanted);
        let sines = [AngleKernel {
            joint: 0,
            range,
            form: choice.form.to_string(),
            kernel: choice.kernel,
            errors: choice.errors,
        }];
        let code = program.code(scalar, Library::Libm, &sines);
        let text = write_function(&program, &code, Library::Libm, &[]);
        let readback = Code::parse(&text, &Signature::of(&program, scalar)).unwrap();
        let difference = readback.difference(&code);
        assert_eq!(difference, None, "{}\n{text}", sines[0].form);
    }
}

fn tolerances_over_narrow_ranges_are_met(cases: [(f64, f64); 2]) {
    for (centre, tolerance) in cases {
        let range = format!("[{:?}, {:?}]", centre - 5e-4, centre + 5e-4);
        let ranges = [range.as_str(); 6].join(", ");
        let tolerance = format!("{{ value = {tolerance:?}, relative_to = \"range\" }}");
        let scene = format!("box = {{ position = [{ranges}] }}; tolerance = {tolerance}");
        for sincos in ["auto", "polynomial"] {
            let asked = format!("gravity; sincos: {sincos}");
            let _ = Case::in_scene("puma560", &scene, &asked).generated();
        }
    }
}

#[test]
fn the_default_can_be_had() {
    let case = |options: &str| {
        let asked = format!("gravity; sincos: polynomial{options}");
        Case::in_scene("ur5", "", &asked)
    };
    let generated = case("").generated();
    let worst = |scalar| {
        let sines = generated.functions[0].sines(scalar).iter();
        let errors = sines.map(|kernel| kernel.errors.worst());
        errors.fold(0.0, f64::max)
    };
    let (double, single) = (worst(ScalarType::F64), worst(ScalarType::F32));
    assert!(double <= 1e-6 && single > 1e-6 && single < 2e-6);
    let said = case("; sincos_error: 1e-6").refusal();
    says(&said, " in [-2π, 2π], not 1e-6: use ");
    says(&said, "`scalar: f64` or `sincos: libm`, or limit q");
    let (_, error) = said.split_once("`sincos_error: ").unwrap();
    let (error, _) = error.split_once('`').unwrap();
    let again = case(&format!("; scalar: f32; sincos_error: {error}")).generated();
    assert_eq!(again.texts[0], generated.texts[1]);
}

#[test]
fn whole_turns_are_taken_off_where_limits_are_missing() {
    let asked = "inverse_dynamics; scalar: f64; sincos: polynomial; sincos_error: 1e-9";
    let mut case = Case::in_scene("planar2r", "", asked);
    for joint in &mut case.reading.robot.joints {
        joint.limits.position = None;
    }
    let (generated, (_, mut far)) = (case.generated(), case.runtime(200, 1));
    assert!(generated.text().contains("less whole turns"));
    for q in far.iter_mut().flat_map(|state| &mut state.q) {
        *q *= 1e5;
    }
    for (_, error) in generated.emitted[0].sines(&far) {
        assert!(error > 0.0 && error < 1e-9, "{error:e}");
    }
}

/// D of a mass at the end of a stretched arm is nearly singular: sines may make it indefinite.
#[test]
fn sines_too_rough_for_the_inertia_matrix_are_refused() {
    let joint = "[[joint]]\nkind = \"revolute\"\na = 1\ncom = [0, 0, 0]\n\
                 inertia = [0, 0, 0, 0, 0, 0]\n";
    let head = "name = \"points\"\nconvention = \"standard\"\ngravity = [0, -9.81, 0]\n";
    let points = format!("{head}{joint}mass = 0.03\n{joint}mass = 1\n");
    let inertia = |error: &str| {
        let asked = format!("outputs: inertia; sincos: polynomial; sincos_error: {error}");
        Case::read(&points, &asked)
    };
    let _ = inertia("1e-5").generated();
    says(&inertia("3e-2").refusal(), "positive definite");
}

#[test]
fn what_is_no_number_stays_none() {
    let case = Case::in_scene("planar3r", "", ASKED);
    let mut state = case.runtime(1, 2).1.remove(0);
    for emitted in case.generated().emitted {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            state.q[2] = bad;
            let results = emitted.run(&state);
            assert!(results.iter().all(|x| !x.is_finite()), "{results:?}");
        }
    }
}

#[test]
fn a_tolerance_says_how_exact_sines_are() {
    let rough = "box = { position = [[-3, 3], [0.2, 2.8]], velocity = [2, 3], \
        acceleration = [10, 20] }; tolerance = { value = 1e-4, relative_to = \"range\" }";
    let (source, asked) = in_scene("planar2r", rough, "inverse_dynamics; scalar: f64");
    let generated = Case::read(&source, &asked).generated();
    let variant = &variants(&generated)[0];
    assert_eq!(variant.sines, generated.functions[0].sines(ScalarType::F64));
    Certified::variant(&source, variant).is_shown(1, "rough");
    let most = |of: fn(&Bound) -> f64| variant.bounds.iter().map(of).fold(0.0, f64::max);
    let (total, real) = (most(|b| b.total()), most(|b| b.real));
    assert!(total <= 1e-4 && real > 1e-7, "{total:e} {real:e}");
    let text = &generated.text();
    assert!(!text.contains("libm"));
    assert!(text.contains("Shown: inside the box") && text.contains("about pi/2"));
}
