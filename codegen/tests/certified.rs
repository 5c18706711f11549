//! Generated files and their claims, shown by the checker; and none that says something else.

use dalembert_checker::Fault;
use dalembert_checker::certify::{Demand, Findings, Report, ResultBound, certify};
use dalembert_codegen::workspace::{Setup, Variant, claim, claim_of};
use dalembert_codegen::{GeneratedCode, Plan};
use serde_json::Value;

use crate::support::{
    self, Case, all_but_one_in, changes, every_line_counts, every_output, in_scene, one_in, rows,
    says, source, text,
};

#[derive(Clone)]
pub struct Certified {
    pub text: String,
    pub claim: String,
    pub robot: String,
    pub scene: Option<String>,
}

impl Certified {
    pub fn all(name: &str, lines: &str, asked: &str) -> Vec<Certified> {
        let (robot, asked) = in_scene(name, lines, asked);
        let scene = asked.starts_with("scene: ").then_some("test");
        Certified::of(&robot, scene, &asked)
    }

    pub fn of(robot: &str, scene: Option<&str>, asked: &str) -> Vec<Certified> {
        Certified::from(&Case::read(robot, asked), robot, scene)
    }

    /// Returns the one file of a request; so many functions of it are shown.
    #[track_caller]
    pub fn shown(robot: &str, scene: Option<&str>, asked: &str, count: usize) -> Certified {
        let file = Certified::of(robot, scene, asked).remove(0);
        file.is_shown(count, asked);
        file
    }

    pub fn planar2r(asked: &str) -> Certified {
        let robot = source("planar2r", "");
        Certified::from(&Case::planar2r(asked), &robot, None).remove(0)
    }

    pub fn from(case: &Case, robot: &str, scene: Option<&str>) -> Vec<Certified> {
        Certified::of_generated(case, &case.generated(), robot, scene)
    }

    fn of_generated(
        case: &Case,
        generated: &GeneratedCode,
        robot: &str,
        scene: Option<&str>,
    ) -> Vec<Certified> {
        let claim = claim(case.robot(), robot, &case.request, generated).unwrap();
        let texts = generated.files(&case.request, "robot.toml", robot);
        let files = texts.into_iter().map(|text| Certified {
            text,
            claim: claim.write(),
            robot: robot.to_owned(),
            scene: scene.map(str::to_owned),
        });
        files.collect()
    }

    /// The scene is the only one of the robot file.
    pub fn variant(robot: &str, variant: &Variant) -> Certified {
        let reading = support::read(robot);
        let [scene] = reading.scenes.as_slice() else {
            panic!("several scenes")
        };
        let setup = Setup::in_scene(&reading.robot, Some(scene)).unwrap();
        Certified {
            text: variant.text.clone(),
            claim: claim_of(&reading.robot, robot, &setup, variant).write(),
            robot: robot.to_owned(),
            scene: Some(scene.name.clone()),
        }
    }

    pub fn with(&self, text: &str) -> Certified {
        Certified {
            text: text.to_owned(),
            ..self.clone()
        }
    }

    pub fn with_claim(&self, claim: &impl ToString) -> Certified {
        let mut other = self.clone();
        other.claim = claim.to_string();
        other
    }

    pub fn with_robot(&self, robot: &str) -> Certified {
        let mut other = self.clone();
        other.robot = robot.to_owned();
        other
    }

    pub fn json(&self) -> Value {
        serde_json::from_str(&self.claim).unwrap()
    }

    #[track_caller]
    pub fn is_refused(&self, words: &str) {
        says(&self.refusal().expect("shown"), words);
    }

    /// Each row: what a claim has, what stands there instead, and words of the refusal.
    #[track_caller]
    fn refuses_claims(&self, table: &str) {
        for [from, to, words] in rows(table) {
            says(&self.claim, &from);
            let other = self.with_claim(&self.claim.replacen(&from, &to, 1));
            other.is_refused(&words);
        }
    }

    pub fn report(&self) -> Result<Report, Fault> {
        let demand = Demand {
            scene: self.scene.as_deref(),
            ..Demand::default()
        };
        certify(&self.text, &self.claim, &self.robot, &demand)
    }

    pub fn refusal(&self) -> Option<String> {
        let lines = match self.report() {
            Err(fault) => return Some(fault.to_string()),
            Ok(report) => report.lines,
        };
        if lines.is_empty() {
            return Some("the function is not in the file".into());
        }
        let fault = lines.into_iter().find_map(|line| line.result.err());
        fault.map(|fault| fault.to_string())
    }

    #[track_caller]
    fn findings(&self, what: &str) -> Vec<Findings> {
        let certified = self.report();
        let report = certified.unwrap_or_else(|fault| panic!("{what}: {fault}"));
        let shown = report.lines.into_iter().map(|line| {
            let result = line.result;
            result.unwrap_or_else(|fault| panic!("{what}: `{}`: {fault}", line.name))
        });
        shown.collect()
    }

    #[track_caller]
    pub fn is_shown(&self, count: usize, what: &str) {
        assert_eq!(self.findings(what).len(), count, "{what}");
    }

    #[track_caller]
    fn holds(&self, count: usize, what: &str) {
        let findings = self.findings(what).into_iter();
        let results: Vec<ResultBound> = findings.flat_map(|findings| findings.results).collect();
        assert_eq!(results.len(), count, "{what}");
        let are_shown = results.iter().all(ResultBound::is_shown);
        assert!(are_shown, "{what}: {results:?}");
    }

    #[track_caller]
    pub fn refuses(&self, table: &str) {
        for [from, to] in changes(table) {
            says(&self.text, &from);
            let other = self.with(&self.text.replacen(&from, &to, 1));
            assert!(other.refusal().is_some(), "{from} → {to}");
        }
    }

    #[track_caller]
    pub fn every_line_counts(
        &self,
        is_tried: fn(usize) -> bool,
        table: &str,
        is_code: fn(&str) -> bool,
    ) -> usize {
        let changes = changes(table);
        let others = |_, line: &str| {
            let changed = changes.iter().map(|[from, to]| line.replacen(from, to, 1));
            match is_code(line) {
                true => changed.chain([String::new()]).collect(),
                false => Vec::new(),
            }
        };
        let is_refused = |text: &str| self.with(text).refusal().is_some();
        every_line_counts(&self.text, is_tried, others, is_refused)
    }
}

/// The programs of Rust are not searched for again.
fn in_both(robot: &str, scene: Option<&str>, asked: &str) -> Vec<(Certified, usize)> {
    let (mut plan, mut files) = (None, Vec::new());
    for (language, scalars) in [("rust", 1), ("c", 2)] {
        // Batches in Rust are what the crate of vectors has made of them.
        let asked = match language {
            "rust" => asked.replace("; batch: on", ""),
            _ => asked.to_owned(),
        };
        let asked = format!("{asked}; scalar: f64, f32; language: {language}");
        let mut case = Case::read(robot, &asked);
        case.request.plan = plan.take();
        let generated = case.generated();
        let written = Certified::of_generated(&case, &generated, robot, scene);
        files.extend(written.into_iter().map(|file| (file, scalars)));
        plan = Some(case.plan(&generated));
    }
    assert_eq!(files.len(), 3, "{asked}");
    files
}

/// The second table is a campaign's.
const ROBOTS: [&str; 2] = [
    "planar2r",
    "base_and_tool scara_placed planar3r scara stanford puma560 open_manipulator panda general6r",
];

support::daily_and_campaign! {
    every_function_is_shown_in_both_scalars_and_languages: (ROBOTS[0]), (ROBOTS[1]);
    scenes_frames_friction_arguments_and_ways_of_printing_are_shown: (CASES[0]), (CASES[1]);
    variants_that_a_tolerance_admits_are_shown: (TOLERATED[0]), (TOLERATED[1]);
    variants_of_plans_are_shown: ("stanford 6"), ("panda 7|ur10 6");
    robots_that_are_others: (FEW), (&others_than_few());
    no_line_of_a_function_can_say_something_else: (one_in::<22>), (all_but_one_in::<22>);
}

fn every_function_is_shown_in_both_scalars_and_languages(robots: &str) {
    let asked = format!("outputs: {}", every_output());
    for name in robots.split(' ') {
        for (file, scalars) in in_both(&source(name, ""), None, &asked) {
            file.is_shown(41 * scalars, name);
        }
    }
}

/// A robot, the lines of a scene or of a frame, what is asked, and how many functions there are.
const CASES: [&str; 2] = [
    r#"
planar3r | lock = { 2 = 0.3 }; payload = { mass = 1.5, com = [0.1, 0.2, 0], inertia = [0.1, 0.2, 0.25, 0, 0, 0] }; gravity = [1, 2, -3] | TORQUES | 6
planar3r | lock = { 2 = "pi/6" }; joints = [1, 2] | inverse_dynamics_derivatives, null_space_projector | 2
planar2r | EYE | jacobian@eye:local:linear, jacobian@eye:world, jacobian_rate@eye:local, jacobian_rate@eye:world:x_rz, forward_kinematics@eye, contact_wrench@eye:linear, operational_inertia@eye:x_y, null_space_projector@hand:linear, inverse_dynamics_with_wrench@eye:local | 9
planar2r | | servo=inverse_dynamics+jacobian, kinetic_energy | 2
coulomb  | | inverse_dynamics, passivity | 2
planar2r | | inverse_dynamics, inertia, forward_dynamics; parameters: payload, gravity | 4
planar2r | | TORQUES; sincos: together; batch: on | 6
planar2r | | TORQUES; fma: on | 6
payload_frame | | regressor, full_regressor, passivity_regressor | 3
"#,
    r#"
planar3r | lock = { 2 = "pi/6" }; joints = [1, 2] | TORQUES | 6
planar3r | velocity = "zero"; acceleration = "zero"; joints = [3, 1] | TORQUES, regressor | 7
wafer    | | inverse_dynamics, gravity | 2
planar2r | | TORQUES; sincos: polynomial | 6
scara    | lock = { 3 = 0.1 } | TORQUES, jacobian | 7
coulomb  | | forward_dynamics, inverse_dynamics_derivatives, momentum_observer, forward_dynamics_derivatives | 4
coulomb  | velocity = "zero" | inverse_dynamics, inverse_dynamics_derivatives | 2
coulomb  | | forward_dynamics_second_derivatives | 1
nearpar  | | inverse_dynamics, gravity, forward_dynamics | 3
wafer    | | coriolis_matrix, forward_dynamics | 2
planar3r | | inverse_dynamics, gravity; parameters: gravity | 2
"#,
];

fn scenes_frames_friction_arguments_and_ways_of_printing_are_shown(table: &str) {
    let names = r#"
TORQUES := inverse_dynamics, gravity, inertia, forward_dynamics, dalembert_terms, link_poses
EYE := [[frame]]; name = "eye"; link = 2; xyz = [0.1, 0.2, 0]; rpy = [0, 0.3, 0.5]
"#;
    for [name, lines, asked, count] in rows::<4>(&format!("{names}{table}")) {
        let (robot, asked) = in_scene(&name, &lines, &format!("{asked}; name: p"));
        let scene = asked.starts_with("scene: ").then_some("test");
        let count: usize = count.parse().unwrap();
        for (file, scalars) in in_both(&robot, scene, &asked) {
            file.is_shown(count * scalars, &format!("{name} {lines} {asked}"));
        }
    }
}

/// Scenes, and how many results there are.
const TOLERATED: [&str; 2] = [
    "a1 4|lockp 2",
    "r3 4|a4 4|still 4|narrow 4|lock 2|allfn 48|wide 4|onept 4",
];

fn counted(names: &str) -> impl Iterator<Item = (&str, usize)> {
    let pairs = names.split('|').map(|pair| pair.split_once(' ').unwrap());
    pairs.map(|(name, count)| (name, count.parse().unwrap()))
}

fn variants_that_a_tolerance_admits_are_shown(scenes: &str) {
    let scara = text("../crates/checker/tests/data/attacks/scara.toml");
    for (scene, count) in counted(scenes) {
        for (file, scalars) in in_both(&scara, Some(scene), &format!("scene: {scene}")) {
            file.holds(scalars * count, scene);
        }
    }
}

fn variants_of_plans_are_shown(robots: &str) {
    for (name, count) in counted(robots) {
        let robot = source(name, "");
        let plan = text(&format!("../generated/robots/{name}.plan"));
        let mut case = Case::read(&robot, "scene: swing; scalar: f64");
        case.request.plan = Some(Plan::parse(&plan).unwrap());
        for file in Certified::from(&case, &robot, Some("swing")) {
            file.holds(count, name);
        }
    }
}

const FEW: &str = "inverse_dynamics, gravity, inertia, forward_kinematics, link_poses";

fn others_than_few() -> String {
    let outputs = every_output();
    let is_few = |name: &str| FEW.split(", ").any(|few| few == name);
    let others: Vec<&str> = outputs.split(", ").filter(|name| !is_few(name)).collect();
    others.join(", ")
}

fn robots_that_are_others(outputs: &str) {
    let robot = text("../crates/checker/tests/data/hand.toml");
    let asked = format!("outputs: {outputs}; scalar: f64");
    let file = Certified::shown(&robot, None, &asked, outputs.split(", ").count());
    let table = "
0, 0.107]      | 0, 0.1071]                      | inertia coriolis
[0, 0, -0.2]   | [0, 0, -0.21]                   | forward_kinematics jacobian
0.1, 0.2, 0.8] | 0.1, 0.2, 0.81]                 | inertia coriolis
viscous = 0.4  | viscous = 0.41                  | gravity kinetic_energy
viscous = 0.4  | viscous = 0.4000000000000000001 | gravity kinetic_energy
";
    for [from, to, kept] in rows(table) {
        says(&robot, &from);
        let other = file.with_robot(&robot.replacen(&from, &to, 1));
        let report = other.report().unwrap();
        let mut lines = report.lines.iter();
        let is_one = |name: &str| kept.split(' ').any(|kept| kept == name);
        let is_kept = lines.any(|line| is_one(&line.name) && line.result.is_ok());
        assert!(!report.passes(false) && is_kept, "{to}: {report:?}");
    }
}

#[test]
fn rows_that_are_not_those_of_the_robot_file() {
    let file = &Certified::all("open_manipulator", "", "gravity; scalar: f64")[0];
    file.is_shown(1, "placed");
    let table = r#"
mass = 0.0984       | mass = 0.0985       | mass of joint 1: [0.0984
velocity = 4.8      | viscous = 1         | aligned
name = \"joint2\" | name = \"joint3\" | other joints
"#;
    file.refuses_claims(table);
}

/// Angles between such axes are within an ulp of a right angle. The second passes near the origin.
#[test]
fn axes_that_are_almost_coordinate_axes() {
    let robot = [
        String::from("name = \"almost\"\ngravity = [0, 0, -9.81]\n"),
        turning("xyz = [0, -0.0681, -0.1199]", "[1, 0, 6.12323e-17]"),
        turning("rpy = [-1.5708, -6.2e-33, -6.1e-17]", "[0, 1, 6.12323e-17]"),
        turning("xyz = [0, 0.2, 0]", "[0, 0, -1]"),
    ];
    let asked = "outputs: inverse_dynamics; scalar: f64";
    Certified::shown(&robot.concat(), None, asked, 1);
}

/// The point of the sphere that stands for an axis is nearer to it than what is compared, 1e-16.
#[test]
fn odd_axes_where_links_branch() {
    for [first, second] in [
        ["[-0.0524, 0, 0.2514]", "[0, -0.0481, -0.0001]"],
        [
            "[-1.6945792e-5, -6.8765076e-5, 0.079480258953]",
            "[1, 1, 0]",
        ],
    ] {
        let robot = [
            String::from("name = \"odd\"\ngravity = [0, 0, -9.81]\n"),
            turning("xyz = [0, 0, 0.3], rpy = [0.1, 0, 0]", first),
            turning("xyz = [0.1, 0, 0.3], rpy = [0, 0.3, 0]", second),
            turning("xyz = [0.1, 0, -0.3], rpy = [0, 0.3, 0]", first) + "parent = 1\n",
        ];
        let asked = "outputs: gravity, inertia; scalar: f64";
        Certified::shown(&robot.concat(), None, asked, 2);
    }
}

fn turning(placement: &str, axis: &str) -> String {
    format!(
        "[[joint]]\nkind = \"revolute\"\nplacement = {{ {placement} }}\naxis = {axis}\nmass = 1\ncom = [0.1, 0.2, 0.3]\ninertia = [0.1, 0.1, 0.1, 0, 0, 0]\n"
    )
}

/// A payload that is a point at its frame's origin, or nothing, or given in a tilted frame.
#[test]
fn payloads_that_leave_a_result_zero() {
    let scene = |more: &str| {
        format!("\n[scene.s]\n{more}\ntolerance = {{ value = 1e-2, relative_to = \"range\" }}\n")
    };
    for range in ["mass = [0, 2], radius = 0", "mass = [0, 0], radius = 0.1"] {
        let robot = source("puma560", "");
        let (robot, _) = robot.split_once("\n[scene").unwrap_or((&robot, ""));
        let robot = robot.to_owned() + &scene(&format!("box = {{ payload = {{ {range} }} }}"));
        let asked = "outputs: gravity; scene: s; parameters: payload; scalar: f64";
        Certified::shown(&robot, Some("s"), asked, 2);
    }
    let frame = "payload_frame = { rpy = [0, 0.3, 0] }";
    let robot = source("planar2r", "").replacen("[[joint]]", &format!("{frame}\n[[joint]]"), 1);
    let still = "velocity = \"zero\"\nacceleration = \"zero\"\n\
                 payload = { mass = 1.5, com = [0.01, 0.02, 0.1] }";
    let asked = "outputs: gravity; scene: s; scalar: f64";
    Certified::shown(&(robot + &scene(still)), Some("s"), asked, 1);
}

/// The claim has the payload in the last row's frame, to sixteen digits the scene's.
#[test]
fn payloads_in_tilted_frames() {
    let frame = "payload_frame = { xyz = [0.1, 0, 0.2], rpy = [0, 0.3, \"-pi/4\"] }";
    let robot = source("planar2r", "").replacen("[[joint]]", &format!("{frame}\n[[joint]]"), 1);
    let robot = robot + "\n[scene.s]\npayload = { mass = 1.5, com = [0.01, 0.02, 0.1] }\n";
    let asked = "outputs: inverse_dynamics; scene: s; scalar: f64";
    let file = Certified::shown(&robot, Some("s"), asked, 1);
    let table = "
payload = { mass = 1.5 | payload = { mass = 1.4 | mass of the payload: [1.5] in the file, [1.4] claimed
[scene.s] | [scene.t] | result 1 is not that of the robot
";
    file.refuses_claims(table);
}

/// A function is bounded over the bodies of the range, and T is what one of them reaches.
#[test]
fn payloads_of_a_range() {
    let scene = r#"
[scene.s]
box = { velocity = [1, 1], acceleration = [1, 1], payload = { mass = [0, 2], radius = 0.1 } }
tolerance = { value = 5e-2, relative_to = "range" }
"#;
    let robot = source("planar2r", scene);
    let asked = "outputs: inverse_dynamics; scene: s; parameters: payload; scalar: f64";
    let file = Certified::shown(&robot, Some("s"), asked, 2);
    let report = file.report().unwrap();
    let (body, is_default) = report.payloads.unwrap();
    assert_eq!((body.mass, body.radius), ([0.0, 2.0], 0.1));
    assert!(!is_default);
    let table = "
radius = 0.1 | radius = 0.09 | `reached`: expected a state of the box for each result
mass = [0, 2] | mass = [3, 2] | expected `mass = [low, high]`
mass = [0, 2], radius = 0.1 | mass = [0, 2] | missing field `radius`
";
    for [from, to, words] in rows(table) {
        says(&robot, &from);
        let other = file.with_robot(&robot.replacen(&from, &to, 1));
        other.is_refused(&words);
    }
}

const CHANGES: &str = "
·+· → ·-· … ·-· → ·+· … ·*· → ·+· … ·*· → ·/· … ·/· → ·*· … ; → ·+ 0.0; … ; → ·* 1.0;
t1· → t2· … t1; → t2; … s1 → s2 … c1 → s1 … q[0] → q[1] … qd[0] → qd[1] … qd → q
[t → [-t … , t → , -t … -t → t … (s1, c1) → (c1, s1) … [0] =· → [1] =· … ] → , 0.0]
sincos → cossin … libm → evil … libm::sincos → dalembert_sines::sincos
. → .0 … 5 → 6 … 9 → 8 … 0. → 1. … f64 → f32 … double → float … ; 2] → ; 3]
const· → const volatile· … { → { let x = 0.0;
";

fn no_line_of_a_function_can_say_something_else(is_tried: fn(usize) -> bool) {
    let mut count = 0;
    for name in every_output().split(", ") {
        for language in ["rust", "c"] {
            let asked = format!("{name}; scalar: f64; name: p; language: {language}");
            let file = Certified::planar2r(&asked);
            file.is_shown(1, &asked);
            count += file.every_line_counts(is_tried, CHANGES, is_code);
        }
    }
    let least = (0..17_000).filter(|place| is_tried(*place)).count();
    assert!(count > least, "{count}");
}

fn is_code(line: &str) -> bool {
    let words = line.trim();
    let others = ["//", "/*", "*", "#", "pub const N"];
    let is_other = others.iter().any(|start| words.starts_with(start));
    !is_other && !["", "}"].contains(&words)
}
