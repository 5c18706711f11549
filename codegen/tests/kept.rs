//! What a plan keeps is proved and printed as it was; a program of another request is not taken for
//! it.

use dalembert_codegen::workspace::{keep, plan_file};
use dalembert_codegen::{Generated, Plan};

use crate::support::case::Case;

/// Generates a request, and returns its code and the text of its plan, which is read again and
/// gives the same code.
#[track_caller]
fn kept(case: &Case) -> (Generated, String) {
    let first = case.generated();
    let text = keep(case.robot(), &case.request, &first, None).plan.write();
    let read = Plan::parse(&text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(read.write(), text);
    let again = case.by(&read);
    assert!(
        again
            .functions
            .iter()
            .all(|own| own.planned || own.function.name() == "load")
    );
    assert_eq!(again.text(), first.text());
    (first, text)
}

/// Returns which functions of a request are of a plan.
fn planned(case: &Case, plan: &Plan) -> Vec<bool> {
    let functions = case.by(plan).functions;
    functions.iter().map(|own| own.planned).collect()
}

const HELD: &str =
    "\n[scene.held]\njoints = [2, 1]\nlock = { 3 = \"pi/2\" }\nvelocity = \"zero\"\n";

#[test]
fn programs_by_their_request() {
    for (file, more, asked, lines) in [
        (
            "coulomb",
            "",
            "outputs: inverse_dynamics",
            &["r1", "r2"][..],
        ),
        (
            "frames/planar2r",
            "",
            "outputs: jacobian@camera:local, jacobian_rate@elbow:world, momentum_observer, \
             operational_bias@elbow:linear, \
             task=operational_inertia@camera:linear+consistent_inverse@camera:linear; scalar: f64",
            &[
                "\nprogram jacobian@camera:local auto f64 ",
                "\nprogram task=operational_inertia@camera:linear+",
            ],
        ),
        (
            "planar2r",
            "",
            "outputs: gravity, servo=inverse_dynamics+jacobian; scalar: f64",
            &["\nprogram servo=inverse_dynamics+jacobian auto f64 "],
        ),
        (
            "planar2r",
            "",
            "outputs: gravity, jacobian; parameters: payload, gravity",
            &["\nparameters payload,gravity "],
        ),
        (
            "planar3r",
            HELD,
            "outputs: inverse_dynamics; scene: held",
            &[],
        ),
    ] {
        let (_, text) = kept(&Case::new(file, more, asked));
        let is_word = |line: &str| text.split_whitespace().any(|word| word == line);
        let has = |line: &&str| is_word(line) || line.contains(' ') && text.contains(line);
        assert!(lines.iter().all(has), "{text}");
    }
}

/// Programs of constants and of arguments stand side by side: neither is taken for the other, nor
/// for one with other parameters or another load.
#[test]
fn arguments_are_told_apart() {
    let case = |asked: &str| Case::new("planar2r", "", asked);
    let plain = case("outputs: gravity, jacobian");
    let plan = keep(plain.robot(), &plain.request, &plain.generated(), None).plan;
    let both = case("outputs: gravity, jacobian; parameters: payload, gravity");
    assert_eq!(
        planned(&both, &plan),
        [false, false, true],
        "load, gravity, jacobian"
    );
    let generated = both.by(&plan);
    let all = keep(both.robot(), &both.request, &generated, Some(plan.clone())).plan;
    assert_eq!(
        all.entries.len(),
        plan.entries.len() + 2,
        "gravity, a scalar each"
    );
    let gravity = |parameters: &str| case(&format!("outputs: gravity; parameters: {parameters}"));
    let last = |case: &Case, plan: &Plan| planned(case, plan).pop();
    assert_eq!(last(&gravity("payload, gravity"), &all), Some(true));
    assert_eq!(last(&case("outputs: gravity"), &all), Some(true));
    assert_eq!(last(&gravity("payload"), &all), Some(false));
    assert_eq!(last(&gravity("gravity"), &all), Some(false));
    // Numbers of another load: searched for anew, not refused.
    let text = all.write();
    let mut lines = text.lines();
    let line = lines.find(|line| line.starts_with("parameters ")).unwrap();
    let (rest, _) = line.rsplit_once(' ').unwrap();
    let other = text.replace(line, &format!("{rest} 0123456789abcdef"));
    let other = Plan::parse(&other).unwrap();
    assert_eq!(last(&gravity("payload, gravity"), &other), Some(false));
    for (words, said) in [
        ("payload,gravity", "expected `payload`"),
        ("payload,wind 4 0", "expected `payload`"),
        ("payload,payload 4 0", "expected `payload`"),
        ("payload -1 0", "expected `payload`"),
        ("payload 99999999999 0", "expected `payload`"),
        ("payload 4 0\nparameters gravity 0 0", "once"),
    ] {
        let error = Plan::parse(&text.replace(line, &format!("parameters {words}")));
        let error = error.unwrap_err().to_string();
        assert!(error.contains(said), "{words}: {error}");
    }
}

/// Another bundle by the same name is another function; what the text says is proved, and names
/// are looked at.
#[test]
fn bundles_are_what_is_in_them() {
    let asked = "outputs: servo=inverse_dynamics+jacobian; scalar: f64";
    let (_, text) = kept(&Case::new("planar2r", "", asked));
    let plan = Plan::parse(&text).unwrap();
    let other = Case::new(
        "planar2r",
        "",
        "outputs: servo=gravity+jacobian; scalar: f64",
    );
    assert_eq!(planned(&other, &plan), [false]);
    let wrong = text.replace("program servo=inverse_dynamics+", "program servo=gravity+");
    let mut wrongly = other;
    wrongly.request.plan = Some(Plan::parse(&wrong).unwrap());
    assert!(
        wrongly.refusal().contains("differs from the formula"),
        "{}",
        wrongly.refusal()
    );
    for (name, said) in [
        ("servo=inverse_dynamics", "two parts"),
        ("gravity=jacobian+inertia", "is an output by itself"),
        ("servo=jacobian+inertja", "`inertja` is no function"),
    ] {
        let error = Plan::parse(&text.replace("servo=inverse_dynamics+jacobian", name));
        let error = error.unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
}

/// A scene's program is not the whole robot's, nor that of the scene as it is now. A box changes no
/// equation: the plan of the whole robot serves; standing still does.
#[test]
fn scenes_are_told_apart() {
    let asked = "outputs: inverse_dynamics; scene: held; scalar: f64";
    let (_, text) = kept(&Case::new("planar3r", HELD, asked));
    let plan = Plan::parse(&text).unwrap();
    let whole = Case::new("planar3r", HELD, "outputs: inverse_dynamics; scalar: f64");
    assert_eq!(whole.by(&plan).functions[0].program.rows, [0, 1, 2]);
    let mut stale = Case::new("planar3r", &HELD.replace("pi/2", "pi/3"), asked);
    stale.request.plan = Some(plan);
    assert!(
        stale.refusal().contains("the scene `held`"),
        "{}",
        stale.refusal()
    );

    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../generated/robots/puma560.toml"
    );
    let plan = plan_file::beside(std::path::Path::new(file))
        .unwrap()
        .unwrap();
    let scene = "\n[scene.slow]\nbox = { velocity = [1, 1, 1, 1, 1, 1] }\n";
    let asked = "outputs: inverse_dynamics; scene: slow; scalar: f64";
    let of = |more: &str| Case::new("puma560", &(scene.to_owned() + more), asked);
    assert_eq!(planned(&of(""), &plan), [true]);
    assert_eq!(planned(&of("velocity = \"zero\"\n"), &plan), [false]);
}

/// Who renews a plan goes on from its programs, and never comes out dearer; from what is not the
/// function's nobody goes on.
#[test]
fn renewed_programs_are_no_dearer() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../generated/robots/stanford.toml"
    );
    let plan = plan_file::beside(std::path::Path::new(file));
    let plan = plan.unwrap().unwrap();
    let mut case = Case::new("stanford", "", "outputs: inertia; scalar: f64");
    let operations = |generated: Generated| generated.functions[0].counts().operations();
    let (searched, kept) = (operations(case.generated()), operations(case.by(&plan)));
    assert!(kept < searched, "{kept} {searched}: nothing to renew");
    case.request.renewed = Some(plan.clone());
    let renewed = case.generated();
    let again = keep(case.robot(), &case.request, &renewed, Some(plan.clone())).plan;
    let is_cheaper = operations(renewed) < kept;
    assert!(is_cheaper || again == plan, "no byte changes for nothing");
    let mut wrong = plan.clone();
    for entry in &mut wrong.entries {
        entry.program.outputs.reverse();
    }
    case.request.renewed = Some(wrong);
    assert_eq!(operations(case.generated()), searched);
    case.request.renewed = Some(Plan {
        input: "0".repeat(16),
        ..plan
    });
    assert_eq!(operations(case.generated()), searched);
}
