//! Bundles: several outputs as one function, which shares their work. What comes
//! out is proved, read back and measured as any function is; it is the same by
//! every way in, and costs no more than its parts.

use dalembert_codegen::workspace::{BOUND, Runtime, SceneRobot, keep, seeded};
use dalembert_codegen::{Function, GenerateError, Generated, Plan, Request, ScalarType, generate};
use dalembert_model::robot::Robot;

use crate::support;

fn bundle(text: &str) -> Function {
    Function::parse(text).unwrap_or_else(|error| panic!("{error}"))
}

fn of(robot: &Robot, functions: &[Function], batch: bool) -> Generated {
    let request = Request {
        batch,
        ..Request::of(functions)
    };
    generate(robot, &request).unwrap_or_else(|error| panic!("{error}"))
}

fn operations(robot: &Robot, function: Function) -> usize {
    let generated = support::one(robot, function);
    generated.functions[0].counts().operations()
}

/// Every quantity against its own runtime, in both scalars;
/// what divides among them, and what is over parameters.
#[test]
fn each_quantity_is_what_its_runtime_says() {
    let planar = support::robot("planar2r");
    let functions = [
        "servo=inverse_dynamics+jacobian+forward_kinematics",
        "task=forward_dynamics+kinetic_energy+jacobian_rate",
        "slopes=inverse_dynamics_derivatives+gravity",
        "adapt=regressor+momentum",
    ]
    .map(bundle);
    let generated = of(&planar, &functions, true);
    let runtime = Runtime::new(&planar);
    let states = seeded(&planar, 100, 7);
    let mut quantities = 0;
    for emitted in &generated.emitted {
        for measure in emitted.against_runtime(&runtime, &states) {
            assert!(measure.in_units() <= BOUND, "{measure:?}");
            quantities += 1;
        }
    }
    let each: usize = functions.iter().map(|f| f.quantities().len()).sum();
    assert_eq!(quantities, 2 * each);
    // π is the module's, whoever needs it.
    let both = [functions[3], Function::Regressor];
    let text = of(&planar, &both, false).text();
    assert_eq!(text.matches("pub const BASE_PARAMETERS").count(), 2);
}

/// Less than its parts by themselves, where they have more in common than sines.
#[test]
fn work_is_shared() {
    let robot = support::robot("planar3r");
    for (text, most) in [
        ("motion=forward_kinematics+jacobian", 16),
        ("model=inertia+coriolis_matrix+gravity", 44),
        ("servo=inverse_dynamics+jacobian+forward_kinematics", 62),
    ] {
        let whole = bundle(text);
        let parts = whole.parts().into_iter();
        let parts: Vec<usize> = parts.map(|part| operations(&robot, part)).collect();
        let found = operations(&robot, whole);
        let sum: usize = parts.iter().sum();
        assert!(found < sum, "{text}: {found}, {parts:?}");
        assert!(found <= most, "{text}: {found}");
    }
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
    let planar = support::robot("planar2r");
    let load = bundle("servo_load=jacobian+manipulator_equation");
    let text = of(&planar, &[load], true).text();
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
    use dalembert_codegen::workspace::{Library, Lowered};
    let planar = support::robot("planar2r");
    let loads = bundle("loads=gravity+coriolis");
    let generated = of(&planar, &[loads], false);
    let program = &generated.functions[0].program;
    let read = |text: &str| {
        let read = Lowered::parse(text, loads, ScalarType::F64).map_err(|e| e.to_string())?;
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

#[test]
fn plans_keep_bundles_by_what_is_in_them() {
    let planar = support::robot("planar2r");
    let servo = bundle("servo=inverse_dynamics+jacobian");
    let request = Request {
        scalars: vec![ScalarType::F64],
        ..Request::of(&[Function::Gravity, servo])
    };
    let generated = generate(&planar, &request).unwrap();
    let text = keep(&planar, &request, &generated, None).plan.write();
    assert!(text.contains("\nprogram servo=inverse_dynamics+jacobian auto f64 "));
    let plan = Plan::parse(&text).unwrap();
    assert_eq!(plan.write(), text);
    let planned = |functions: Vec<Function>| {
        let request = Request {
            functions,
            plan: Some(plan.clone()),
            ..request.clone()
        };
        let generated = generate(&planar, &request).unwrap();
        let planned = generated.functions.iter().map(|f| f.planned);
        planned.collect::<Vec<bool>>()
    };
    assert_eq!(planned(request.functions.clone()), [true, true]);
    // Another bundle by the same name is another function.
    assert_eq!(planned(vec![bundle("servo=gravity+jacobian")]), [false]);
    // What the text says is proved, and names are looked at.
    let wrong = text.replace("program servo=inverse_dynamics+", "program servo=gravity+");
    let wrong = Request {
        functions: vec![bundle("servo=gravity+jacobian")],
        plan: Some(Plan::parse(&wrong).unwrap()),
        ..request.clone()
    };
    assert!(matches!(
        generate(&planar, &wrong),
        Err(GenerateError::Disproved(..))
    ));
    for (name, said) in [
        ("servo=inverse_dynamics", "two parts"),
        ("gravity=jacobian+inertia", "is an output by itself"),
        ("servo=jacobian+inertja", "`inertja` is no function"),
    ] {
        let text = text.replace("servo=inverse_dynamics+jacobian", name);
        let error = Plan::parse(&text).unwrap_err();
        assert!(error.to_string().contains(said), "{error}");
    }
}

#[test]
fn one_module_has_each_name_once() {
    let planar = support::robot("planar2r");
    let functions = ["servo_2=gravity+inertia", "servo2=jacobian+inertia"].map(bundle);
    let request = Request::of(&functions);
    let error = generate(&planar, &request).unwrap_err();
    let said = error.to_string();
    assert!(
        said.contains("`servo_2=gravity+inertia` and `servo2=jacobian+inertia`"),
        "{said}"
    );
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
    let scene_robot = SceneRobot::new(&reading.robot, scene).unwrap();
    let runtime = Runtime::in_scene(scene_robot);
    let states = seeded(&reading.robot, 50, 3);
    support::rounds_well(&generated.emitted, &runtime, &states, "");
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
