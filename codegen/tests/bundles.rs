//! Bundles, several outputs as one function: what they are by name, and that they are the same by
//! every way in. `values` has their numbers, `counts` what they save, `kept` their plans.

use dalembert_codegen::{Function, Request, ScalarType, generate};

use crate::support;
use crate::support::case::Case;

fn bundle(text: &str) -> Function {
    Function::parse(text).unwrap_or_else(|error| panic!("{error}"))
}

/// A bundle of the table has the program of a user's bundle with its parts.
#[test]
fn the_manipulator_equation_is_a_bundle() {
    let planar = support::robot("planar3r");
    let own = support::one(&planar, Function::ManipulatorEquation);
    let made = support::one(&planar, bundle("equation=inertia+coriolis+gravity"));
    let [own, made] = [&own, &made].map(|generated| &generated.functions[0].program);
    assert_eq!(own.steps, made.steps);
    assert_eq!(own.outputs, made.outputs);
}

/// The signature has every argument that a part reads, in the table's order.
#[test]
fn one_struct_in_the_written_order() {
    let asked = "outputs: servo_load=jacobian+manipulator_equation; batch: on";
    let text = Case::new("planar2r", "", asked).generated().text();
    for expected in [
        "/// `jacobian`, `manipulator_equation` in one",
        "pub struct ServoLoad {",
        "pub fn servo_load(q: &[f64; 2], qd: &[f64; 2]) -> ServoLoad {",
        "for ServoLoadBatch {",
        "pub fn servo_load_columns(",
    ] {
        let expected = expected.replace("`, `", "` and `");
        assert!(text.contains(&expected), "{expected}\n{text}");
    }
    let fields = ["jacobian: ", "d: ", "h: ", "c: "].map(|field| {
        let field = format!("    pub {field}");
        text.find(&field).unwrap_or_else(|| panic!("{field}"))
    });
    assert!(fields.is_sorted());
}

/// A field that trades its name with another of its type is noticed.
#[test]
fn the_text_is_read_back_field_by_field() {
    use dalembert_codegen::workspace::{Code, Library};
    let loads = bundle("loads=gravity+coriolis");
    let generated = support::one(&support::robot("planar2r"), loads);
    let program = &generated.functions[0].program;
    let read = |text: &str| {
        let read = Code::parse(text, loads, ScalarType::F64).map_err(|e| e.to_string())?;
        read.matches(program, Library::Libm, &[])
            .map_err(|difference| difference.to_string())
    };
    let text = &generated.text();
    assert_eq!(read(text), Ok(()));
    let traded = text.replace("        c: [", "        x: [");
    let traded = traded.replace("        h: [", "        c: [");
    let traded = traded.replace("        x: [", "        h: [");
    assert_ne!(*text, traded);
    assert!(read(&traded).is_err());
}

/// Locked joints, rows and arguments are a bundle's as they are its parts'.
#[test]
fn scenes_cut_bundles() {
    const SCENE: &str = r#"
[scene.reach]
outputs = ["reach = gravity + jacobian", "coriolis"]
lock = { 2 = "pi/2" }
velocity = "zero"
"#;
    let reading = support::reading_with("planar3r", SCENE);
    let scene = &reading.scenes[0];
    let request = Request::default().in_scene(scene);
    let generated = generate(&reading.robot, &request).unwrap();
    let text = &generated.text();
    assert!(
        text.contains("pub fn reach(q: &[f64; 3]) -> Reach {"),
        "{text}"
    );
    assert!(text.contains("pub c: [f64; 2],") && text.contains("pub jacobian: [[f64; 2]; 6],"));
    // The text of the scene, of which its hash is made, has the parts.
    let written = dalembert_model::scene::write(scene);
    assert!(written.contains("\"reach=gravity+jacobian\""), "{written}");
}

/// What is asked for, and words of what is said.
const WRONG: &str = "
servo = gravty + jacobian | unknown output `gravty` | did you mean `gravity`?
servo = gravity + gravity | `gravity` is in it twice | leave one of them out
servo = inertia + manipulator_equation | both return D
servo = gravity | two parts at least | ask for `gravity` by itself
servo = gravity + | expected an output
gravity + jacobian | `gravity+jacobian` has no name | write NAME = gravity+jacobian
Servo = gravity + jacobian | no name of a function | small letters
gravity = inertia + jacobian | is an output by itself
a = gravity + jacobian, a = inertia + jacobian | is given twice
a = gravty + jacobian, b = inertja + gravity | `gravty` | `inertja`
";

/// All errors of a list are said at once.
#[test]
fn bundles_are_read_from_what_is_asked() {
    let read = |outputs: &str| {
        let asked = format!("outputs: {outputs}").parse().unwrap();
        Request::parse(&asked, &[], &[], &[])
    };
    let request = read("gravity, servo = inverse_dynamics + jacobian").unwrap();
    assert_eq!(
        request.functions[1].text(),
        "servo=inverse_dynamics+jacobian"
    );
    for row in WRONG.lines().filter(|row| !row.is_empty()) {
        let mut cells = row.split(" | ");
        let problems = read(cells.next().unwrap()).unwrap_err();
        let said: Vec<String> = problems.iter().map(|problem| problem.to_string()).collect();
        let said = said.join("\n");
        for message in cells {
            assert!(said.contains(message), "{row}: {said}");
        }
    }
}

#[test]
fn one_module_has_each_name_once() {
    let functions = ["servo_2=gravity+inertia", "servo2=jacobian+inertia"].map(bundle);
    let error = generate(&support::robot("planar2r"), &Request::of(&functions)).unwrap_err();
    let said = error.to_string();
    let both = "`servo_2=gravity+inertia` and `servo2=jacobian+inertia`";
    assert!(said.contains(both), "{said}");
}
