//! Runs the commands of the README and on the pages of `docs/` and `tests/pages`, page by page in a
//! folder, and compares their output with what the page shows.
//!
//! A `console` block has commands after `$`, their output on a terminal, and `? N` for an exit code
//! other than 0; `console result` has standard output only. A line `...` stands for any lines. A
//! `toml file=NAME` (or `sh`) block is written to that file; `toml append=NAME` is appended to it.
//! Output that differs is written into the page before the test fails: after a change of a message,
//! run the test once more and read the difference.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use dalembert_cli::drawing;
use dalembert_cli::table3::comparisons;
use dalembert_codegen::Function;

use crate::robots::robot;

/// A fenced block: the text after the fence, and the range of its lines.
type Block = (String, std::ops::Range<usize>);

fn root() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    fs::canonicalize(root).unwrap()
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{path:?}: {error}"))
}

fn guide() -> Vec<PathBuf> {
    let folder = root().join("docs/src");
    let summary = read(&folder.join("SUMMARY.md"));
    let links = summary.lines().filter_map(|line| line.split_once("]("));
    let paths = links.map(|(_, rest)| folder.join(rest.trim_end().trim_end_matches(')')));
    paths.collect()
}

fn blocks(lines: &[String]) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<(String, usize)> = None;
    for (at, line) in lines.iter().enumerate() {
        let Some(info) = line.strip_prefix("```") else {
            continue;
        };
        match open.take() {
            None => open = Some((info.to_owned(), at + 1)),
            Some((info, start)) => blocks.push((info, start..at)),
        }
    }
    assert!(open.is_none(), "a block has no end");
    blocks
}

fn shows(shown: &[&str], lines: &[&str]) -> bool {
    match shown {
        [] => lines.is_empty(),
        ["...", rest @ ..] => (0..=lines.len()).any(|n| shows(rest, &lines[n..])),
        [first, rest @ ..] => lines.first() == Some(first) && shows(rest, &lines[1..]),
    }
}

fn ran(command: &str, inside: &Path, result_alone: bool) -> Vec<String> {
    let bin = Path::new(env!("CARGO_BIN_EXE_dalembert")).parent().unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let output = Command::new("sh")
        .args(["-c", command])
        .current_dir(inside)
        .env("PATH", path)
        .env("ROOT", root())
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
    let text = if result_alone { out } else { err + &out };
    // Replaces the paths of this machine.
    let text = text
        .replace(&inside.display().to_string(), "$HERE")
        .replace(&root().display().to_string(), "$ROOT");
    let mut lines = vec![format!("$ {command}")];
    lines.extend(text.lines().map(|line| line.trim_end().to_owned()));
    match output.status.code() {
        Some(0) => {}
        code => lines.push(format!("? {}", code.unwrap_or(-1))),
    }
    lines
}

fn checked(body: &[String], inside: &Path, result_alone: bool) -> Option<Vec<String>> {
    let mut fixed = Vec::new();
    let mut differs = false;
    let mut rest = body;
    while let Some((first, more)) = rest.split_first() {
        let command = first.strip_prefix("$ ").expect("a command");
        let results = more.iter().take_while(|line| !line.starts_with("$ "));
        let length = results.count();
        let transcript = ran(command, inside, result_alone);
        let shown: Vec<&str> = more[..length].iter().map(|line| line.trim_end()).collect();
        let printed: Vec<&str> = transcript[1..].iter().map(String::as_str).collect();
        match shows(&shown, &printed) {
            true => fixed.extend_from_slice(&rest[..=length]),
            false => {
                differs = true;
                fixed.extend(transcript);
            }
        }
        rest = &more[length..];
    }
    differs.then_some(fixed)
}

fn run_pages(pages: &[PathBuf], inside: &Path) {
    let mut differing = Vec::new();
    for page in pages {
        let mut lines: Vec<String> = read(page).lines().map(str::to_owned).collect();
        let mut changes = Vec::new();
        for (info, range) in blocks(&lines) {
            let body = &lines[range.clone()];
            match info.split_once(' ').unwrap_or((&info, "")) {
                ("toml" | "sh" | "c", file) if !file.is_empty() => {
                    let (how, name) = file.split_once('=').unwrap();
                    let path = inside.join(name);
                    let before = match how {
                        "file" => String::new(),
                        "append" => read(&path) + "\n",
                        _ => panic!("{page:?}: {file}"),
                    };
                    fs::write(path, before + &body.join("\n") + "\n").unwrap();
                }
                ("console", what) => {
                    let replacement = checked(body, inside, what == "result");
                    changes.extend(replacement.map(|replacement| (range, replacement)));
                }
                _ => {}
            }
        }
        if !changes.is_empty() {
            differing.push(format!("{} was changed: see what", page.display()));
        }
        for (range, replacement) in changes.into_iter().rev() {
            lines.splice(range, replacement);
            fs::write(page, lines.join("\n") + "\n").unwrap();
        }
    }
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}

fn folder_with(name: &str, files: &[&str]) -> PathBuf {
    let inside = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&inside);
    fs::create_dir_all(&inside).unwrap();
    let inside = fs::canonicalize(inside).unwrap();
    for file in files {
        let from = root().join(file);
        fs::copy(&from, inside.join(from.file_name().unwrap())).unwrap();
    }
    inside
}

#[test]
fn the_guide_shows_what_commands_print() {
    let inside = folder_with(
        "guide",
        &[
            "crates/import/tests/data/ur5.urdf",
            "generated/robots/puma560.toml",
            "generated/robots/puma560.plan",
            "generated/robots/stanford.toml",
            "crates/import/tests/data/mjcf/xarm7.xml",
            "crates/import/tests/data/so101.urdf",
            "gallery/urdf/baxter.urdf",
            "gallery/urdf/go2.urdf",
        ],
    );
    run_pages(&guide(), &inside);
    // The guide's code is compiled with the robot file that the pages make.
    let compiled = root().join("examples/guide/robots/arm.toml");
    assert_eq!(read(&inside.join("arm.toml")), read(&compiled));
}

#[test]
fn the_readme_shows_what_commands_print() {
    let inside = folder_with("readme", &[]);
    let paths = ["planar2r.toml", "planar2r.plan"].map(|name| format!("generated/robots/{name}"));
    let files = paths.each_ref().map(String::as_str);
    folder_with("readme/generated/robots", &files);
    run_pages(&[root().join("README.md")], &inside);
}

macro_rules! pages {
    ($($(#[$ignored:meta])? $name:ident),* $(,)?) => { $(
        #[test]
        $(#[$ignored])?
        fn $name() {
            let inside = folder_with(concat!("page_", stringify!($name)), &[
                "generated/robots/planar2r.toml",
                "generated/robots/planar2r.rs",
                "generated/robots/planar3r.toml",
                "generated/robots/puma560.toml",
            ]);
            let page = concat!("crates/cli/tests/pages/", stringify!($name), ".md");
            run_pages(&[root().join(page)], &inside);
        }
    )* };
}

#[cfg(unix)]
pages!(
    bad_input,
    certify,
    explain,
    files,
    forged,
    formulas,
    generate,
    import,
    import_messages,
    new,
    outputs,
    renew,
    scenes,
    show,
    trees,
    verify
);
#[cfg(unix)]
pages!(
    #[ignore = "minutes: the step `campaigns` of .ci/run"]
    outputs_of_large_arms,
    #[ignore = "minutes: the step `campaigns` of .ci/run"]
    tradeoff,
);
#[cfg(target_os = "linux")]
pages!(terminal);

/// A picture without the fonts and colours of the charts gets them before the test fails.
#[test]
fn pictures_have_one_style() {
    let folder = root().join("docs/src");
    let drawn = drawing::svg(&robot("planar2r"), &[0.6, 0.7]).unwrap();
    assert!(
        read(&folder.join("planar2r.svg")).ends_with(&drawn),
        "dalembert show generated/robots/planar2r.toml --at 0.6,0.7 -o docs/src/planar2r.svg"
    );
    let generated = read(&root().join("generated/robots/planar2r.rs"));
    let (_, proof) = generated.split_once("at random points modulo ").unwrap();
    let modulus = proof.split(',').next().unwrap();
    assert!(
        read(&folder.join("pipeline.svg")).contains(modulus),
        "{modulus}"
    );
    let chart = read(&folder.join("tradeoff.svg"));
    let style = |text: &str| text.find("<style>").unwrap()..text.find("</style>").unwrap();
    for picture in ["docs/src/pipeline.svg", "benches/peers/results.svg"] {
        let picture = root().join(picture);
        let mut text = read(&picture);
        let (from, to) = (style(&chart), style(&text));
        if text[to.clone()] != chart[from.clone()] {
            text.replace_range(to, &chart[from]);
            fs::write(&picture, text).unwrap();
            panic!("{picture:?} had another style than the charts; it has theirs now");
        }
    }
}

fn guide_and_readmes() -> Vec<PathBuf> {
    let crates = fs::read_dir(root().join("crates")).unwrap();
    let readmes = crates.map(|folder| folder.unwrap().path().join("README.md"));
    let mut pages = guide();
    pages.extend(readmes.filter(|page| page.exists()));
    pages.push(root().join("README.md"));
    pages
}

#[test]
fn figures_in_the_prose_are_right() {
    let page = |name: &str| read(&root().join(name));
    let functions = format!("{} functions", Function::ALL.len());
    let rust = format!("Rust {} or later", env!("CARGO_PKG_RUST_VERSION"));
    for (name, figure) in [
        ("README.md", &functions),
        ("docs/src/outputs.md", &functions),
        ("README.md", &rust),
        ("docs/src/introduction.md", &rust),
    ] {
        assert!(page(name).contains(figure), "{name}: {figure}");
    }
    for path in guide_and_readmes() {
        let text = read(&path);
        for (at, _) in text.match_indices(" functions") {
            let before = text[..at].rsplit(|c: char| !c.is_ascii_digit()).next();
            let count = before.filter(|digits| !digits.is_empty());
            let is_right = count.is_none_or(|count| functions.starts_with(&format!("{count} ")));
            assert!(is_right, "{path:?}: {functions}");
        }
    }
    // One of these marks explains the others.
    let marks = page("docs/src/outputs.md").matches('●').count();
    assert_eq!(marks - 1, Function::by_default().len());
    let guide = page("docs/src/how-it-works.md");
    let readme = page("README.md");
    for row in readme.lines().filter(|line| line.starts_with('|')) {
        assert!(guide.lines().any(|line| line == row), "README.md: {row}");
    }
    let names = [
        "planar2r", "planar3r", "puma560", "stanford", "ur10", "panda",
    ];
    let labels = ["Lagrange–Euler", "Newton–Euler", "D'Alembert"];
    for (row, label) in labels.iter().enumerate() {
        let cells = names.map(|name| {
            let [mul, add, ..] = comparisons(&robot(name))[row].1;
            format!("{mul}/{add}")
        });
        let line = format!("| Table 3, {label} | {} |", cells.join(" | "));
        assert!(guide.contains(&line), "{line}");
    }
    let results = ["RESULTS_C", "RESULTS_LEGGED"]
        .map(|name| page(&format!("benches/peers/{name}.md")))
        .concat();
    let cells = results.split('|');
    let measured = cells.filter_map(|cell| cell.split_whitespace().next());
    let times: Vec<&str> = measured.collect();
    for path in guide_and_readmes() {
        let text = read(&path);
        let words: Vec<&str> = text.split_whitespace().collect();
        for pair in words.windows(2) {
            let is_time = pair[1].trim_end_matches([',', '.', ':']) == "ns";
            if is_time && pair[0].parse::<f64>().is_ok() {
                assert!(times.contains(&pair[0]), "{path:?}: {} ns", pair[0]);
            }
        }
    }
}

#[test]
fn links_lead_somewhere() {
    let mut pages = guide_and_readmes();
    assert!(pages.len() > 15, "{pages:?}");
    let others = [
        "CONTRIBUTING.md",
        "docs/architecture.md",
        "benches/RESULTS.md",
        "benches/peers/RESULTS.md",
        "gallery/README.md",
        "docs/src/SUMMARY.md",
    ];
    pages.extend(others.map(|page| root().join(page)));
    for page in pages {
        let text = read(&page);
        // Leaves out code: it has brackets, too.
        let prose: Vec<&str> = text.split("```").step_by(2).collect();
        let links = prose.iter().flat_map(|part| part.split("](").skip(1));
        for link in links.filter_map(|rest| rest.split(')').next()) {
            let target = link.split('#').next().unwrap();
            if !target.is_empty() && !target.starts_with("http") {
                let path = page.parent().unwrap().join(target);
                assert!(path.exists(), "{page:?} links to {link}");
            }
        }
        if page.ends_with("architecture.md") {
            let parts = prose.iter();
            let words = parts.flat_map(|part| part.split('`').skip(1).step_by(2));
            for name in words.filter(|word| word.ends_with(".rs")) {
                assert!(root().join(name).exists(), "{page:?} names {name}");
            }
        }
    }
}
