//! Functions in C and CUDA: what compilers make of them has the bits of the proved program, and
//! nobody has a word to say of any header. `text` has changed lines, `printed` names.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use dalembert_codegen::RobotFile;

use crate::support::compiled::{folder, run, same_bits, there};
use crate::support::{Case, daily_and_campaign, every_output, path, rows};

fn compare(name: &str, outputs: &str, states: usize) {
    let file = RobotFile::read(&path(&format!("../generated/robots/{name}.toml"))).unwrap();
    for (sines, batch) in [
        ("together", "off"),
        ("together", "on"),
        ("polynomial", "on"),
    ] {
        let asked = format!("{outputs}; sincos: {sines}; batch: {batch}; language: c");
        let mut case = Case::in_scene(name, "", &asked);
        case.request.plan.clone_from(&file.plan);
        let flags = ["-std=c99 -O0", "-O2", "-O3 -march=native"];
        same_bits(&format!("{name}_{sines}"), &case, states, &flags);
    }
}

#[test]
fn compiled_functions_have_the_bits_of_the_program() {
    let outputs = "inverse_dynamics, inertia, coriolis, gravity, manipulator_equation, \
                   dynamic_coefficients";
    compare("planar2r", outputs, 100);
}

#[test]
#[ignore = "more than an hour: with --release, by hand"]
fn by_hand_every_output_of_five_robots_has_the_bits_of_the_program() {
    for name in ["planar2r", "planar3r", "stanford", "puma560", "panda"] {
        compare(name, &every_output(), 100_000);
    }
}

/// A name, a robot file, the lines of a scene, and what is asked in both scalars.
const CHANGES: &str = r#"
outputs | planar2r | | EVERY; sincos: together
frames  | planar2r | [[frame]]; name = "eye"; link = 2; xyz = [0.1, 0.2, 0]; rpy = [0, 0, 0.5] | jacobian@eye:local, contact_wrench@eye:linear, operational_inertia@eye:linear, forward_dynamics_with_wrench, task=operational_inertia@eye:linear+null_space_projector@eye:linear; name: p; sincos: together
scene   | planar2r | tolerance = { value = 1e-2, relative_to = "range" }; box = { velocity = [3, 3], acceleration = [3, 3] } | inverse_dynamics; scalar: f64, f32
coulomb | coulomb  | | inverse_dynamics, forward_dynamics; sincos: together
load    | planar2r | | inverse_dynamics, inertia; parameters: payload, gravity; sincos: together
bundle  | planar2r | | servo=inverse_dynamics+jacobian, kinetic_energy; sincos: together
fused   | planar2r | | inverse_dynamics, servo=inverse_dynamics+jacobian; fma: on; sincos: together
"#;

fn changes(language: &str, batch: &str) -> Vec<(String, Case)> {
    let case = |[what, file, scene, asked]: [String; 4]| {
        let asked = asked.replace("EVERY", &every_output());
        let asked = format!("{asked}; batch: {batch}; language: {language}");
        let case = match (file.as_str(), scene.as_str()) {
            ("planar2r", "") => Case::planar2r(&asked),
            _ => Case::in_scene(&file, &scene, &asked),
        };
        (what, case)
    };
    rows(CHANGES).into_iter().map(case).collect()
}

daily_and_campaign! {
    whatever_is_printed_has_the_bits_of_the_program: ("on", "gnu99"), ("off", "c99");
    functions_and_kernels_have_the_bits_of_the_program: ("on"), ("off");
}

fn whatever_is_printed_has_the_bits_of_the_program(batch: &str, standard: &str) {
    let flags = format!("-std={standard} -O3 -march=native");
    for (what, case) in changes("c", batch) {
        same_bits(&what, &case, 100, &[&flags]);
    }
}

fn functions_and_kernels_have_the_bits_of_the_program(batch: &str) {
    for (what, case) in changes("cuda", batch) {
        same_bits(&what, &case, 100, &["-O1"]);
    }
}

fn headers() -> Vec<String> {
    let sines = ["libm", "together", "polynomial"].map(|sincos| {
        let asked = format!("sincos: {sincos}; batch: on; language: c");
        ("sines".to_owned(), Case::new("planar2r", "", &asked))
    });
    let cases = changes("c", "on").into_iter().chain(sines);
    cases.map(|(_, case)| case.generated().text()).collect()
}

pub fn with_main(name: &str, text: &str, rest: &str) -> PathBuf {
    let folder = folder(name);
    fs::write(folder.join("arm.h"), text).unwrap();
    let main = format!("#include \"arm.h\"\n{rest}");
    fs::write(folder.join("arm.c"), main).unwrap();
    folder
}

/// Compiles a program, and runs it: it should end well.
fn runs(name: &str, text: &str, main: &str) {
    let folder = with_main(name, text, main);
    for compiler in there(&["gcc", "clang"]) {
        run(
            compiler,
            "-std=c99 -O2 arm.c -o program -lm".split(' '),
            &folder,
        );
        run(folder.join("program").to_str().unwrap(), [], &folder);
    }
}

const STRICT: &str = "-Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Werror -O2 \
    -fsyntax-only -x";

#[test]
fn headers_are_compiled_without_a_warning() {
    for text in headers() {
        compiles_without_a_warning("strict", &text);
    }
}

pub fn compiles_without_a_warning(name: &str, header: &str) {
    let folder = with_main(name, header, "int main(void) { return 0; }\n");
    for compiler in there(&["gcc", "clang"]) {
        for language in ["c -std=c99", "c++"] {
            let flags = STRICT.split(' ').chain(language.split(' '));
            run(compiler, flags.chain(["arm.c"]), &folder);
        }
    }
}

#[test]
fn a_payload_is_a_body_and_no_load() {
    let asked = "outputs: gravity; parameters: payload; scalar: f64, f32; sincos: polynomial; \
                 language: c";
    let text = Case::new("planar2r", "", asked).generated().text();
    let bodies = [
        ("0, 0, 0, 0, 0, 0, 0, 0, 0, 0", 1),
        ("2, 1, -1, 3, 0, 1, 1, 0, 0, 0", 1),
        ("2, 0, 0, 0, 0.1, 0.2, 0.3, 0, 0, 0", 1),
        ("-1, 0, 0, 0, 0, 0, 0, 0, 0, 0", 0),
        ("2, 0, 0, 0, 1, 1, 3, 0, 0, 0", 0),
        ("2, 0, 0, 0, 10, 10, 10, 6, 0, 0", 0),
        ("2, 0, 0, 0, -1, 1, 1, 0, 0, 0", 0),
        ("0, 0, 0, 0, 1, 1, 1, 0, 0, 0", 0),
        ("NAN, 0, 0, 0, 0, 0, 0, 0, 0, 0", 0),
        ("2, INFINITY, 0, 0, 0, 0, 0, 0, 0, 0", 0),
    ];
    let tests = bodies.map(|(numbers, is_body)| {
        let test = |real: &str, infix: &str| {
            format!(
                "{{ const {real} numbers[10] = {{{numbers}}}; planar2r_{infix}payload_t payload; \
                 bad += planar2r_{infix}payload(numbers, &payload) != {is_body}; }}\n"
            )
        };
        test("double", "") + &test("float", "f32_")
    });
    let rest = format!(
        "#include <math.h>\nint main(void) {{\nint bad = 0;\n{}return bad;\n}}\n",
        tests.concat()
    );
    runs("payload", &text, &rest);
    let passed = "void f(const planar2r_OTHER_t *other, const double *q, double *c)\n\
        {\n    planar2r_gravity(q, other, c);\n}\n";
    for compiler in there(&["gcc", "clang"]) {
        for (other, is_taken) in [("load", true), ("payload", false)] {
            let main = passed.replace("OTHER", other);
            let folder = with_main(&format!("passed_{other}"), &text, &main);
            let mut command = Command::new(compiler);
            let flags = "-std=c99 -Werror -fsyntax-only arm.c".split(' ');
            let output = command.args(flags).current_dir(folder).output().unwrap();
            assert_eq!(output.status.success(), is_taken, "{compiler}: {other}");
        }
    }
}

#[test]
fn a_batch_has_one_load_or_one_a_state() {
    let asked =
        "outputs: inverse_dynamics; parameters: bodies; batch: on; scalar: f64; language: c";
    let main = r#"#include <string.h>
enum { N = 37 };
int main(void) {
    static double q[2 * N], qd[2 * N], qdd[2 * N], one[2 * N], many[2 * N], alone[2 * N];
    static double loads[sizeof(planar2r_load_t) / sizeof(double) * N];
    enum { L = sizeof(planar2r_load_t) / sizeof(double) };
    const double numbers[10] = {3, 0.1, 0, 0, 0.01, 0.02, 0.02, 0, 0, 0};
    planar2r_bodies_t bodies;
    planar2r_body_t body;
    planar2r_load_t load;
    int i, s, bad = 0;
    for (i = 0; i < 2 * N; ++i) { q[i] = 0.1 * i - 2; qd[i] = 1 - 0.05 * i; qdd[i] = 0.3 * i; }
    planar2r_bodies(&bodies);
    bad += !planar2r_body(numbers, &body);
    bad += planar2r_with_body(&bodies, 2, &body) + planar2r_with_body(&bodies, -1, &body);
    planar2r_load(&bodies, &load);
    planar2r_inverse_dynamics_batch(N, q, qd, qdd, 1, load.load, one);
    for (s = 0; s < N; ++s) {
        body.body[0] = 1 + 0.1 * s;
        bad += !planar2r_with_body(&bodies, 1, &body);
        const double a[2] = {q[s], q[N + s]}, b[2] = {qd[s], qd[N + s]}, c[2] = {qdd[s], qdd[N + s]};
        double tau[2];
        planar2r_inverse_dynamics(a, b, c, &load, tau);
        for (i = 0; i < 2; ++i) bad += memcmp(&tau[i], &one[i * N + s], sizeof *tau) != 0;
        planar2r_load_t other;
        planar2r_load(&bodies, &other);
        for (i = 0; i < L; ++i) loads[i * N + s] = other.load[i];
        planar2r_inverse_dynamics(a, b, c, &other, tau);
        for (i = 0; i < 2; ++i) alone[i * N + s] = tau[i];
    }
    planar2r_inverse_dynamics_batch(N, q, qd, qdd, N, loads, many);
    bad += memcmp(many, alone, sizeof many) != 0;
    bad += memcmp(many, one, sizeof many) == 0;
    return bad;
}
"#;
    let text = Case::new("planar2r", "", asked).generated().text();
    runs("loads", &text, main);
}

#[cfg(target_arch = "x86_64")]
#[test]
fn batches_are_vectors() {
    let call = "void f(size_t n, const double *q, const double *qd, const double *qdd, double *tau)\n\
        {\n    planar2r_inverse_dynamics_batch(n, q, qd, qdd, tau);\n}\n";
    for sincos in ["libm", "together"] {
        let asked = format!("outputs: inverse_dynamics; sincos: {sincos}; batch: on; language: c");
        let text = Case::new("planar2r", "", &asked).generated().text();
        let folder = with_main("vectors", &text, call);
        for compiler in there(&["gcc", "clang"]) {
            // With FMA, and in GNU C too, where gcc fuses products and sums unless it is told.
            for options in ["-mavx2", "-mavx2 -mfma", "-mfma -mavx2 -std=c99"] {
                let flags = "-O3 -Werror -S -o - arm.c".split(' ');
                let assembly = run(compiler, flags.chain(options.split(' ')), &folder);
                let lines = assembly.lines();
                let products = lines.filter(|l| l.contains("vmulpd") && l.contains("%ymm"));
                let is_vector = sincos == "libm" || products.count() > 20;
                assert!(is_vector, "{compiler} {options}");
            }
        }
    }
}

/// x87 computes in 80 bits, where the header's sines are off by two.
#[cfg(target_arch = "x86_64")]
#[test]
fn processors_with_other_digits_are_refused() {
    let asked = "outputs: inverse_dynamics; sincos: together; language: c";
    let text = Case::new("planar2r", "", asked).generated().text();
    let folder = with_main("x87", &text, "");
    for compiler in there(&["gcc"]) {
        for (flags, is_taken) in [("-O2", true), ("-O2 -mfpmath=387", false)] {
            let mut command = Command::new(compiler);
            let flags = flags.split(' ').chain(["-fsyntax-only", "arm.c"]);
            let output = command.args(flags).current_dir(&folder).output().unwrap();
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.success(), is_taken, "{said}");
            let is_said = said.contains("not rounded to their type");
            assert!(is_taken || is_said, "{said}");
        }
    }
}

#[test]
fn misra_is_kept_but_for_what_the_guide_says() {
    for cppcheck in there(&["cppcheck"]) {
        for text in headers() {
            let main = "int main(void);\nint main(void) { return 0; }\n";
            let folder = with_main("misra", &text, main);
            let flags = "--addon=misra --std=c99 --enable=style --quiet arm.c";
            let said = run(cppcheck, flags.split(' '), &folder);
            let rules = said.lines().filter(|line| line.contains("[misra-c2012-"));
            for rule in rules.clone() {
                assert!(rule.ends_with("[misra-c2012-12.1]"), "{rule}");
            }
            // It looked: where roots are, the rule is broken.
            assert_eq!(rules.count() > 0, text.contains(" / sqrt("), "{said}");
        }
    }
}

#[test]
fn the_device_rounds_every_operation() {
    for nvcc in there(&["nvcc"]) {
        let asked = "outputs: inverse_dynamics, inertia; sincos: polynomial; batch: on";
        let case = Case::new("planar2r", "", &format!("{asked}; language: cuda"));
        let folder = folder("device");
        fs::write(folder.join("arm.cuh"), case.generated().text()).unwrap();
        fs::write(folder.join("arm.cu"), "#include \"arm.cuh\"\n").unwrap();
        let flags = "-arch=sm_90 -ptx -Werror all-warnings -o arm.ptx arm.cu";
        run(nvcc, flags.split(' '), &folder);
        let ptx = fs::read_to_string(folder.join("arm.ptx")).unwrap();
        for bits in [32, 64] {
            assert!(ptx.contains(&format!("mul.rn.f{bits}")), "{bits}");
            assert!(!ptx.contains(&format!("fma.rn.f{bits}")), "{bits}");
        }
    }
}
