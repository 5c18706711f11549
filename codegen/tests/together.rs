//! Generated functions that call for all their angles at once: the same
//! program, one line of text apart, with the same certified bounds.

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::{Generated, generate};
use dalembert_codegen::workspace::program::Library;
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_codegen::workspace::states::seeded;
use dalembert_codegen::workspace::task::Request;
use dalembert_model::robot::Robot;

use crate::shown::shown;
use crate::support;

fn with(robot: &Robot, sincos: SinCos) -> Generated {
    let request = Request {
        sincos,
        ..Request::of(&[Function::InverseDynamics, Function::Inertia])
    };
    generate(robot, &request).unwrap()
}

/// Lines that are in one text only.
fn different<'a>(text: &'a str, other: &str) -> Vec<&'a str> {
    let others: Vec<&str> = other.lines().collect();
    let lines = text.lines();
    lines.filter(|line| !others.contains(line)).collect()
}

/// Planar arms add angles, the Stanford arm slides. But for the lines that
/// call, the text is the same; results differ by what an ulp of a sine brings.
#[test]
fn only_the_calls_differ() {
    for name in ["planar3r", "stanford"] {
        let robot = support::robot(name);
        let alone = with(&robot, SinCos::Libm);
        let together = with(&robot, SinCos::Together);
        assert!(!together.text().contains("libm"));
        let [own, other] = [together.text(), alone.text()];
        let calls = different(&own, &other);
        assert!(
            calls
                .iter()
                .all(|line| line.contains(") = dalembert_sines::sincos"))
        );
        // Two functions in two scalars.
        assert_eq!(
            together.text().matches("dalembert_sines::sincos").count(),
            4
        );
        let others = different(&other, &own);
        assert!(others.iter().all(|line| line.contains(" = libm::")));
        for (text, other) in alone.emitted.iter().zip(&together.emitted) {
            assert_eq!(text.text.counts(), other.text.counts());
            assert_eq!(other.text.library, Library::Together);
            for state in seeded(&robot, 50, 5) {
                let (a, b) = (text.run(&state), other.run(&state));
                let size = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                let u = text.scalar.unit_roundoff();
                let off = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
                assert!(off.fold(0.0, f64::max) <= 200.0 * u * size, "{name}");
            }
        }
    }
}

/// A certificate says whose sines it is about, and the file of one is not that
/// of the other.
#[test]
fn certificates_name_the_library() {
    let scene = "\n[scene.slow]\noutputs = [\"gravity\"]\n\
                 tolerance = { value = 1e-9, relative_to = \"range\" }\nscalar = \"f64\"\n";
    let reading = support::reading_with("planar2r", scene);
    let request = Request {
        sincos: SinCos::Together,
        ..Request::default().in_scene(&reading.scenes[0])
    };
    let generated = generate(&reading.robot, &request).unwrap();
    assert!(generated.text().contains("dalembert_sines::sincos(&["));
    let admitted = generated.functions[0].admitted.as_ref().unwrap();
    let certificate = &admitted.certificates[0];
    assert_eq!(certificate.library, Library::Together);
    shown(&support::source("planar2r", scene), certificate);
    let json = certificate.to_json();
    assert!(json.contains("dalembert-sines") && !json.contains("libm's, within"));

    let alone = certificate.calling(Library::Libm);
    assert!(alone.to_json().contains("libm's, within"));
    assert_eq!(alone.bounds, certificate.bounds);
}
