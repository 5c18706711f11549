//! LaTeX documents compile, where there is a TeX.

use std::fs;
use std::process::{Command, Stdio};

use dalembert_formulas::{Digits, Formulas, Layout, Quantity, Request, Style};

use crate::values::read;

#[test]
fn documents_compile() {
    let version = Command::new("pdflatex")
        .arg("--version")
        .stdout(Stdio::null())
        .status();
    if !version.is_ok_and(|status| status.success()) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let request = Request {
        quantities: Quantity::ALL.to_vec(),
        style: Style::Names,
    };
    let names = [
        "generated/robots/puma560",
        "codegen/tests/data/rprpr",
        "gallery/robots/panda_gripper",
    ];
    for name in names {
        let (robot, _) = read(&format!("{name}.toml"));
        let formulas = Formulas::new(&robot, None, &request).unwrap();
        let text = formulas.write(Layout::Latex, Digits::Six);
        fs::write(folder.path().join("a.tex"), text).unwrap();
        let output = Command::new("pdflatex")
            .args(["-interaction=nonstopmode", "-halt-on-error", "a.tex"])
            .current_dir(&folder)
            .output()
            .unwrap();
        let log = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{name}: {log}");
        assert!(!log.contains("Overfull"), "{name}: {log}");
    }
}
