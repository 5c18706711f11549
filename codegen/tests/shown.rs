//! Certificates, shown by the checker that shares nothing with the generator.

use dalembert_codegen::workspace::Certificate;

/// Has `dalembert-checker` show a certificate of a robot's file, by its text alone.
pub fn shown(source: &str, certificate: &Certificate) {
    let claims = dalembert_checker::read(&certificate.to_json()).unwrap();
    let verdict = dalembert_checker::audit(&claims[0], source, None).unwrap();
    assert!(verdict.is_shown(), "{verdict:?}");
}
