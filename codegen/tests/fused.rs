//! Products that are fused with sums: which they are, that the text is the program, and
//! certificates of them. `values` and `golden` have their numbers.

use dalembert_codegen::workspace::{Certificate, Code, JointState, Rounding, Setup, keep};
use dalembert_codegen::{Fma, Function, Generated, Request, ScalarType, generate};
use dalembert_model::read::Reading;
use dalembert_model::robot::Robot;

use crate::shown::shown;
use crate::support;

fn generated(robot: &Robot, request: &Request) -> Generated {
    generate(robot, request).unwrap_or_else(|error| panic!("{error}"))
}

fn fused(request: &Request) -> Request {
    Request {
        fma: Fma::On,
        ..request.clone()
    }
}

/// Every sum with a product that nobody else reads takes one: so many operations
/// less, and the estimate of their roundings is no larger. Without the option
/// there are none, and what is fused is the same program.
#[test]
fn a_fused_product_saves_an_operation_and_a_rounding() {
    for name in ["stanford", "puma560", "panda"] {
        let robot = support::robot(name);
        let plain = support::one(&robot, Function::InverseDynamics)
            .functions
            .remove(0);
        let setup = Setup::whole(&robot);
        let program = plain.program.fused();
        let (before, after) = (plain.counts(), program.counts());
        assert_eq!(before.fma, 0);
        assert_eq!(after.mul + after.fma, before.mul);
        assert_eq!(after.add + after.fma, before.add);
        assert!(4 * after.fma > before.mul, "{name}: {after}");
        assert_eq!(program.fused(), program);
        let [before, after] =
            [&plain.program, &program].map(|program| Rounding::estimate(&setup, program));
        assert!(after.worst() < before.worst(), "{name}");
        let pairs = after.per_output.iter().zip(&before.per_output);
        assert!(
            pairs.clone().all(|(after, before)| after <= before),
            "{name}"
        );
    }
}

/// A line is one rounding, that of `mul_add`; many states at once have the bits of
/// each; both scalars.
#[test]
fn a_line_is_rounded_once() {
    const TEXT: &str = "\
pub fn gravity(q: &[f64; 2]) -> [f64; 2] {
    let (s1, c1) = libm::sincos(q[0]);
    let t2 = s1.mul_add(0.1, c1);
    let t4 = (-t2).mul_add(c1, s1);
    let t6 = t4.mul_add(0.3, -0.7);
    let t7 = t6 * t4;
    [t7, -t6]
}
";
    let read = |scalar: ScalarType| {
        let text = match scalar {
            ScalarType::F64 => TEXT.to_owned(),
            ScalarType::F32 => TEXT
                .replace("f64", "f32")
                .replace("libm::sincos", "libm::sincosf"),
        };
        Code::parse(&text, Function::Gravity, scalar).unwrap()
    };
    let text = read(ScalarType::F64);
    assert_eq!(text.counts().to_string(), "1 mul, 0 add, 3 fma, 1 sincos");
    let once = |q: f64| {
        let (s1, c1) = libm::sincos(q);
        let t2 = s1.mul_add(0.1, c1);
        let t4 = (-t2).mul_add(c1, s1);
        let t6 = t4.mul_add(0.3, -0.7);
        [t6 * t4, -t6]
    };
    let single = |q: f32| {
        let (s1, c1) = libm::sincosf(q);
        let t2 = s1.mul_add(0.1, c1);
        let t4 = (-t2).mul_add(c1, s1);
        let t6 = t4.mul_add(0.3, -0.7);
        [t6 * t4, -t6]
    };
    let states: Vec<JointState> = (0..200)
        .map(|k| JointState {
            q: vec![f64::from(k as f32 * 0.03 - 3.0), 0.0],
            ..JointState::default()
        })
        .collect();
    let columns = text.run_at_many(&states);
    let mut twice = 0;
    for (k, state) in states.iter().enumerate() {
        let q = state.q[0];
        let own = text.run_at(state);
        assert_eq!(own, once(q));
        assert_eq!([columns[0][k], columns[1][k]], once(q));
        let found = read(ScalarType::F32).run_at(state);
        assert_eq!(found, single(q as f32).map(f64::from));
        let (s1, c1) = libm::sincos(q);
        twice += usize::from(s1.mul_add(0.1, c1) != s1 * 0.1 + c1);
    }
    // Two roundings would be seen.
    assert!(twice > 5, "{twice}");
}

/// What a slip of the printer could look like is not read as the program, or at all.
#[test]
fn every_slip_is_noticed() {
    let robot = support::robot("puma560");
    let request = Request {
        functions: vec![Function::InverseDynamics],
        scalars: vec![ScalarType::F64],
        ..fused(&Request::default())
    };
    let generated = generated(&robot, &request);
    let (text, program) = (&generated.text(), &generated.functions[0].program);
    let is_program = |text: &str| {
        let read = Code::parse(text, Function::InverseDynamics, ScalarType::F64);
        read.is_ok_and(|read| read.matches(program, request.library(), &[]).is_ok())
    };
    assert!(is_program(text));
    let mut tried = 0;
    for line in text.lines().filter(|line| line.contains(".mul_add(")) {
        let (name, value) = line.split_once(" = ").unwrap();
        let (left, rest) = value.split_once(".mul_add(").unwrap();
        let (right, addend) = rest.strip_suffix(");").unwrap().split_once(", ").unwrap();
        let minus = addend.strip_prefix('-');
        let bare = left.trim_start_matches("(-").trim_end_matches(')');
        let slips = [
            format!("{name} = {left}.mul_add({addend}, {right});"),
            format!("{name} = {bare} * {right};"),
            match minus {
                Some(addend) => format!("{name} = {left}.mul_add({right}, {addend});"),
                None => format!("{name} = {left}.mul_add({right}, -{addend});"),
            },
            match left == bare {
                true => format!("{name} = (-{left}).mul_add({right}, {addend});"),
                false => format!("{name} = {bare}.mul_add({right}, {addend});"),
            },
            format!("{name} = {left}.mul_add({right}, {addend}) + 0.0;"),
        ];
        for slip in slips {
            assert!(
                !is_program(&text.replacen(line, &slip, 1)),
                "{line} -> {slip}"
            );
            tried += 1;
        }
    }
    assert!(tried > 200, "{tried}");
    // Nor is it the text without the option, or the other way round.
    let plain = Request {
        fma: Fma::Off,
        ..request.clone()
    };
    let plain = self::generated(&robot, &plain);
    assert!(!is_program(&plain.text()) && !plain.text().contains("mul_add"));
    assert_eq!(
        generated.functions[0].found.as_ref(),
        Some(&plain.functions[0].program)
    );
}

/// A function that is cut into blocks has no cut between a product and its sum.
#[test]
fn no_cut_between_a_product_and_its_sum() {
    let robot = support::robot("panda");
    let request = Request {
        functions: vec![Function::DynamicCoefficients],
        ..fused(&Request::default())
    };
    // It is read back where it is generated.
    let generated = generated(&robot, &request);
    assert!(generated.text().contains("let (t") && generated.text().contains(".mul_add("));
}

const SCENE: &str = "\n[scene.hold]\noutputs = [\"gravity\"]\n\
     tolerance = { value = 1e-2, relative_to = \"range\" }\n";

fn certificates(request: &Request, robot: &Robot) -> Vec<Certificate> {
    let mut functions = generated(robot, request).functions;
    functions.remove(0).admitted.unwrap().certificates
}

fn held() -> (Reading, Request) {
    let reading = support::reading_with("puma560", SCENE);
    let scene = reading.scenes.iter().find(|scene| scene.name == "hold");
    let request = Request::default().in_scene(scene.unwrap());
    (reading, request)
}

/// A certificate's bounds of rounding are those of one rounding: no larger, and smaller
/// somewhere. A plan keeps the program with
/// every product rounded.
#[test]
fn certificates_bound_one_rounding() {
    let (reading, request) = held();
    let robot = &reading.robot;
    let plain = certificates(&request, robot);
    let found = generated(robot, &fused(&request));
    let certificates = &found.functions[0].admitted.as_ref().unwrap().certificates;
    assert_eq!(certificates.len(), plain.len());
    for (certificate, plain) in certificates.iter().zip(&plain) {
        assert!(certificate.emitted.fuses() && certificate.text.contains(".mul_add("));
        assert_eq!(certificate.emitted, plain.emitted.fused());
        assert_eq!(certificate.emitted, found.functions[0].program);
        let mut smaller = 0;
        for (own, other) in certificate.bounds.iter().zip(&plain.bounds) {
            assert!(own.rounding <= other.rounding && own.model == other.model);
            smaller += usize::from(own.rounding < other.rounding);
        }
        assert!(smaller > 0);
        shown(&support::source("puma560", SCENE), certificate);
    }
    let kept =
        |request: &Request, found: &Generated| keep(robot, request, found, None).plan.write();
    let off = generated(robot, &request);
    assert_eq!(kept(&fused(&request), &found), kept(&request, &off));
}
