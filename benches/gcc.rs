//! Compiles the functions in C by `gcc -O3`: a program that runs one when it is told to, so that it
//! takes turns with what is compared with it.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

use dalembert_codegen::{Function, Language, Request, RobotFile, SinCos, generate};

pub struct Gcc {
    child: Child,
    answers: BufReader<ChildStdout>,
}

impl Gcc {
    /// Compiles the functions with these options; `None` where there is no gcc, or it refuses.
    pub fn start(name: &str, functions: &[Function], fma: bool, options: &[&str]) -> Option<Gcc> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let file = RobotFile::read(&root.join("generated/robots/puma560.toml")).ok()?;
        let request = Request {
            sincos: SinCos::Together,
            batch: true,
            language: Language::C,
            plan: file.plan,
            fma,
            ..Request::new(functions)
        };
        let text = generate(&file.robot, &request).ok()?.text();
        // In the order of the functions, f64 and then f32.
        let heads = text
            .lines()
            .filter(|line| line.contains("_any(const int far"));
        let (mut loops, mut cases) = (String::new(), String::new());
        for (index, head) in heads.enumerate() {
            let function = head.split('(').next()?.rsplit(' ').next()?;
            let is_single = head.contains("float");
            let scalar = if is_single { "float" } else { "double" };
            let results = head.split(", ").filter(|part| !part.starts_with("const "));
            let length = |part: &str| {
                part.split(['[', ' ', ']'])
                    .rev()
                    .find_map(|n| n.parse::<usize>().ok())
            };
            let lengths: Vec<usize> = results.filter_map(length).collect();
            let mut at = 0;
            let mut passed = String::new();
            for length in &lengths {
                passed += &format!(", r + {at}");
                at += length;
            }
            loops +=
                &format!("LOOP(loop{index}, {scalar}, {at}, {function}(0, q, qd, last{passed}))\n");
            cases += &format!("case {index}: run_{scalar}(loop{index}); break; ");
        }
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let (header, program) = (folder.join(format!("{name}.h")), folder.join(name));
        let loops = loops.replace('\n', " ");
        let text = format!("{text}\n#define LOOPS {loops}\n#define CASES {cases}\n");
        std::fs::write(&header, text).ok()?;
        let built = Command::new("gcc")
            .arg("-O3")
            .arg(format!("-DHEADER=\"{}\"", header.display()))
            .args(options)
            .arg(root.join("benches/batch.c"))
            .args(["-lm", "-o"])
            .arg(&program)
            .status();
        if !built.ok()?.success() {
            return None;
        }
        let piped = Command::new(&program)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn();
        let mut child = piped.ok()?;
        let answers = BufReader::new(child.stdout.take()?);
        Some(Gcc { child, answers })
    }

    /// Runs a function once and returns its nanoseconds.
    pub fn run(&mut self, function: usize) -> Option<f64> {
        writeln!(self.child.stdin.as_mut()?, "{function}").ok()?;
        let mut answer = String::new();
        self.answers.read_line(&mut answer).ok()?;
        answer.trim().parse().ok()
    }
}

impl Drop for Gcc {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        let _ = self.child.wait();
    }
}
