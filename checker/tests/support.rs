//! Files, and audits of them.

use std::fs;

use dalembert_checker::{Claim, Fault, Verdict, audit, read};

/// Returns a file of the repository.
pub fn file(path: &str) -> String {
    let path = format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"));
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Returns the claim of a certificate that has one.
pub fn claim(certificate: &str) -> Claim {
    let mut claims = read(&file(certificate)).unwrap();
    assert_eq!(claims.len(), 1, "{certificate}");
    claims.remove(0)
}

/// Returns the audit of a certificate's claim.
pub fn audited(certificate: &str, robot: &str) -> Result<Verdict, Fault> {
    audit(&claim(certificate), &file(robot), None)
}
