//! A plan's programs are proved and printed as they were, and are of no other request.

use dalembert_codegen::workspace::{Entry, Node, keep, plan_file, price};
use dalembert_codegen::{GeneratedCode, Plan};

use crate::support::{self, Case, rows, says};

#[track_caller]
fn kept(case: &Case) -> String {
    let first = case.searched();
    let text = case.plan(&first).write();
    let read = Plan::parse(&text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(read.write(), text);
    let again = case.by(&read);
    let mut functions = again.functions.iter();
    assert!(functions.all(|function| function.planned || function.function.name() == "load"));
    assert_eq!(again.text(), first.text());
    text
}

fn planned(case: &Case, plan: &Plan) -> Vec<bool> {
    let functions = case.by(plan).functions;
    functions.iter().map(|function| function.planned).collect()
}

#[track_caller]
fn refused(text: &str, said: &str) {
    says(&Plan::parse(text).unwrap_err().to_string(), said);
}

/// A robot file, the lines of a scene, what is asked, and words of the plan's text.
const ROWS: &str = r#"
FRAMES := jacobian@camera:local, jacobian_rate@elbow:world, momentum_observer, operational_bias@elbow:linear, task=operational_inertia@camera:linear+consistent_inverse@camera:linear
coulomb  | | inverse_dynamics | r1* … r2*
planar2r | | gravity, servo=inverse_dynamics+jacobian; scalar: f64 | "servo=inverse_dynamics+jacobian" … "auto" … "f64"
planar2r | | gravity, jacobian; parameters: payload, gravity | "load" … "g"
planar3r | joints = [2, 1]; lock = { 3 = "pi/2" }; velocity = "zero" | inverse_dynamics | "scene":"test" … "rows":[2,1]
frames/planar2r | | FRAMES; scalar: f64 | "jacobian@camera:local" … "task=operational_inertia@camera:linear+
"#;

#[test]
fn programs_by_their_request() {
    for [file, scene, asked, words] in rows(ROWS) {
        let text = kept(&Case::in_scene(&file, &scene, &asked));
        words.split(" … ").for_each(|words| says(&text, words));
    }
}

#[test]
fn arguments_are_told_apart() {
    let case = |asked: &str| Case::in_scene("planar2r", "", asked);
    let plain = case("gravity, jacobian");
    let plan = plain.plan(&plain.generated());
    let both = case("gravity, jacobian; parameters: payload, gravity");
    let flags = planned(&both, &plan);
    assert_eq!(flags, [false, false, true], "load, gravity, jacobian");
    let generated = both.by(&plan);
    let full_plan = keep(both.robot(), &both.request, &generated, Some(plan.clone())).plan;
    let more = full_plan.entries.len() - plan.entries.len();
    assert_eq!(more, 2, "gravity, a scalar each");
    let last = |asked: &str, plan: &Plan| planned(&case(asked), plan).pop().unwrap();
    let arguments = "gravity; parameters: payload, gravity";
    assert!(last(arguments, &full_plan) && last("gravity", &full_plan));
    assert!(!last("gravity; parameters: payload", &full_plan));
    assert!(!last("gravity; parameters: gravity", &full_plan));
    // Numbers of another load: searched for anew, not refused.
    let text = full_plan.write();
    let (before, rest) = text.split_once("\"load\":[").unwrap();
    let (load, behind) = rest.split_once(']').unwrap();
    let (count, hash) = load.split_once(',').unwrap();
    let with = |load: &str| format!("{before}\"load\":[{load}]{behind}");
    assert_eq!(with(load), text);
    let other = with(&load.replace(hash, "\"0123456789abcdef\""));
    assert!(!last(arguments, &Plan::parse(&other).unwrap()));
    for (load, said) in [
        (count, "expected a tuple of size 2"),
        ("-1, \"0\"", "expected usize"),
        ("99999999999, \"0\"", "expected the load's length"),
        ("4, \"0\"], \"load\":[0, \"0\"", "duplicate field `load`"),
    ] {
        refused(&with(load), said);
    }
    let rows = "\"rows\":[1,2]";
    says(&text, rows);
    let more = text.replace(rows, "\"rows\":[1,1,1]");
    refused(&more, "more rows than joints");
    let list = "[\"q\",\"g\",\"load\"]";
    says(&text, list);
    for (words, said) in [
        ("\"load\", \"load\"", "expected arguments of the function"),
        ("\"load\", \"wind\"", "expected arguments of the function"),
        ("\"q\", \"load\"", "is not valid in a program"),
    ] {
        refused(&text.replace(list, &format!("[{words}]")), said);
    }
}

#[test]
fn bundles_are_what_is_in_them() {
    let asked = "outputs: servo=inverse_dynamics+jacobian; scalar: f64";
    let text = kept(&Case::new("planar2r", "", asked));
    let plan = Plan::parse(&text).unwrap();
    let other = Case::in_scene("planar2r", "", "servo=gravity+jacobian; scalar: f64");
    assert_eq!(planned(&other, &plan), [false]);
    let renamed = kept(&other).replace("servo=gravity+", "servo=inverse_dynamics+");
    let wrong = renamed.replace("[\"q\"]", "[\"q\", \"qd\", \"qdd\"]");
    let mut asked = Case::new("planar2r", "", asked);
    asked.request.plan = Some(Plan::parse(&wrong).unwrap());
    says(&asked.refusal(), "differs from the formula");
    for (name, said) in [
        ("servo=inverse_dynamics", "two parts"),
        ("gravity=jacobian+inertia", "is an output by itself"),
        ("servo=jacobian+inertja", "unknown output `inertja`"),
    ] {
        refused(&text.replace("servo=inverse_dynamics+jacobian", name), said);
    }
}

fn beside(name: &str) -> Plan {
    let file = support::path(&format!("../generated/robots/{name}.toml"));
    plan_file::beside(&file).unwrap().unwrap()
}

#[test]
fn bundles_are_found_by_their_parts() {
    let plan = beside("puma560");
    let is_tool = |entry: &&Entry| entry.program.function.name() == "tool";
    let mut wrong = plan.entries.iter().find(is_tool).unwrap().clone();
    wrong.program.dag.outputs.reverse();
    let mut both = plan.clone();
    both.entries.push(wrong);
    for parts in ["forward_kinematics+jacobian", "jacobian+forward_kinematics"] {
        let asked = format!("outputs: x={parts}; scalar: f64");
        let case = Case::new("puma560", "", &asked);
        let generated = case.by(&plan);
        let (function, counts) = (&generated.functions[0], generated.functions[0].counts());
        assert!(function.planned, "{parts}");
        assert_eq!((counts.mul, counts.add, counts.sincos), (51, 23, 6));
        let again = keep(case.robot(), &case.request, &generated, Some(plan.clone()));
        assert_eq!(again.plan, plan);
        assert_eq!(planned(&case, &both), [true]);
    }
}

/// A box changes no equation: the plan of the whole robot serves; standing still does.
#[test]
fn scenes_are_told_apart() {
    let asked = "inverse_dynamics; scalar: f64";
    let held = "joints = [2, 1]; lock = { 3 = \"pi/2\" }; velocity = \"zero\"";
    let text = kept(&Case::in_scene("planar3r", held, asked));
    let plan = Plan::parse(&text).unwrap();
    let whole = Case::in_scene("planar3r", "", asked);
    assert_eq!(whole.by(&plan).functions[0].program.rows, [0, 1, 2]);
    let mut stale = Case::in_scene("planar3r", &held.replace("pi/2", "pi/3"), asked);
    stale.request.plan = Some(plan);
    says(&stale.refusal(), "the scene `test`");

    let plan = beside("puma560");
    let slow = "box = { velocity = [1, 1, 1, 1, 1, 1] }";
    for (lines, is_planned) in [("", true), ("; velocity = \"zero\"", false)] {
        let case = Case::in_scene("puma560", &format!("{slow}{lines}"), asked);
        assert_eq!(planned(&case, &plan), [is_planned]);
    }
}

#[test]
fn renewed_programs_are_no_dearer() {
    let plan = beside("stanford");
    let mut case = Case::new("stanford", "", "outputs: inertia; scalar: f64");
    let operations = |generated: GeneratedCode| generated.functions[0].counts().operations();
    let (searched, kept) = (operations(case.searched()), operations(case.by(&plan)));
    assert!(kept < searched, "{kept} {searched}: nothing to renew");
    case.request.renewed = Some(plan.clone());
    let renewed = case.searched();
    let again = keep(case.robot(), &case.request, &renewed, Some(plan.clone())).plan;
    let is_cheaper = operations(renewed) < kept;
    assert!(is_cheaper || again == plan, "no byte changes for nothing");
    let mut wrong = plan.clone();
    for entry in &mut wrong.entries {
        entry.program.dag.outputs.reverse();
    }
    let input = "0".repeat(16);
    for other in [wrong, Plan { input, ..plan }] {
        case.request.renewed = Some(other);
        assert_eq!(operations(case.searched()), searched);
    }
}

#[test]
fn an_early_end_takes_nothing_better_away() {
    let case = Case::in_scene("planar2r", "", "gravity");
    let good = case.generated();
    let mut dear = good.clone();
    let dag = &mut dear.functions[0].program.dag;
    let (_, operation, operands) = dag.operations().next().unwrap();
    dag.nodes.push(Node::Apply(operation, operands));
    let prices = |kept, code: &_| {
        let kept = keep(case.robot(), &case.request, code, kept);
        let price_of = |entry: &Entry| price(&entry.program.counts());
        let prices: Vec<u64> = kept.plan.entries.iter().map(price_of).collect();
        assert_eq!(prices.len(), 2, "one a scalar");
        assert_eq!(prices[0], prices[1]);
        (kept.plan, prices[0], kept.functions.len())
    };
    let (of_good, low, _) = prices(None, &good);
    let (of_dear, high, _) = prices(None, &dear);
    assert!(low < high);
    assert_eq!(prices(Some(of_good.clone()), &dear).1, high);
    for generated in [&mut dear, &mut good.clone()] {
        generated.ended = true;
        let (_, price, count) = prices(Some(of_good.clone()), generated);
        assert_eq!((price, count), (low, 2));
    }
    let mut ended = good;
    ended.ended = true;
    assert_eq!(prices(Some(of_dear), &ended).1, low);
    let mut other = of_good;
    other.input = String::new();
    assert_eq!(prices(Some(other), &dear).1, high);
}
