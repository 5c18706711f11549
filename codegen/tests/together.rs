//! Generated functions that call for all their angles at once have the same certified bounds.

use dalembert_codegen::workspace::Library;
use dalembert_codegen::{Request, SinCos, generate};

use crate::shown::shown;
use crate::support;

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
