//! Robots, programs and base parameters that the identity refuses: none of them is compared as
//! another one, and none of them panics.

use dalembert_checker::identity::arm::Arm;
use dalembert_checker::identity::exact::{Exact, Point};
use dalembert_checker::identity::state::State;
use dalembert_checker::identity::table::Function;
use dalembert_checker::identity::{Base, Combination, Points, Statement, aligned, check, robot};
use dalembert_checker::program::{Operand, Program, argument};

use crate::support::{changed, file};

const ROBOT: &str = "generated/robots/planar2r.toml";

const ROBOTS: &str = r#"
mass = 1 | mass = nan | `nan` is not a number
"revolute" | "continuous" | joint 1: expected `kind`
a = 1 | &; coulomb = 0.3 | joint 1: `coulomb` without a `coulomb_width`
a = 1 | &; mimic = { joint = "elbow", multiplier = 0.5 } | of an angle is not an integer
a = 1 | &; mimic = { joint = "wrist" } | there is no joint `wrist`
a = 1 | &; mimic = { joint = 1 } | joint 1: joints follow each other in a cycle
a = 1 | &; coulomb = 1; mimic = { joint = 2 } | joint 1: `coulomb` of a joint that follows another
a = 1 | &; mimic = { joint = 2, factor = 1 } | unknown field `factor`
a = 1 | &; theta = 0.1 | joint 1: `theta` of a revolute joint
a = 1 | &; axis = [0, 0, 1] | joint 1: expected `placement` and `axis`
a = 1 | &; placement = {}; axis = [0, 0, 1] | joint 1: a placement beside a row
convention = "standard" | # & | expected `convention` and rows, or placements
com = | frame = {}; # & | joint 1: expected `com` and `inertia`
a = 1 | &; length = 1 | unknown field `length`
"#;

#[test]
fn joints_that_the_equations_lack_are_refused() {
    let source = file(ROBOT);
    let read = |source: &str| {
        let file = robot::read(source)?;
        let setting = file.setting(None)?;
        let point = Point::new(&[source]);
        Arm::read(&setting, &point)?;
        State::draw(&point, &setting).map(|_| ())
    };
    assert_eq!(read(&source), Ok(()));
    for (robot, words) in changed(&source, ROBOTS) {
        let why = read(&robot).expect_err(words);
        assert!(why.contains(words), "{words}: {why}");
    }
    let modified = source.replace("\"standard\"", "\"modified\"");
    let tilted = modified.replacen("a = 1", "a = 1\nbeta = 0.1", 1);
    let why = read(&tilted).unwrap_err();
    assert!(why.contains("`beta` is of standard rows alone"), "{why}");
    let placed = file("crates/model/tests/data/puma560_placed.toml");
    let why = read(&placed.replacen("axis = [0, 0, 1]", "axis = [0, 0, 2]", 1)).unwrap_err();
    let expected = "joint 1: `axis` is not a unit vector";
    assert!(why.contains(expected), "{why}");
    assert_eq!(read(&placed), Ok(()));
}

fn exact(text: &str) -> Operand<Exact> {
    Operand::Constant(Exact::read(text).unwrap())
}

fn words(text: &str) -> Vec<String> {
    text.split(' ').map(str::to_owned).collect()
}

/// The program has no steps and one of these results; base parameters add up these columns.
fn refused(
    [scene, arguments, results]: [&str; 3],
    outputs: Vec<Operand<Exact>>,
    base: &[&[usize]],
) -> String {
    let source = file(ROBOT) + "\n[scene.all]\n[scene.none]\njoints = []\n";
    let file = robot::read(&source).unwrap();
    let one = || Exact::read("1").unwrap();
    let combination = |columns: &&[usize]| -> Combination {
        columns.iter().map(|column| (*column, one())).collect()
    };
    let setting = file.setting(Some(scene)).unwrap();
    let statement = Statement {
        function: &Function::named("x", &words(arguments), &words(results)).unwrap(),
        program: &Program {
            steps: Vec::new(),
            outputs: outputs.into_iter().map(|output| (false, output)).collect(),
        },
        base: &Base {
            combinations: base.iter().map(combination).collect(),
            values: Vec::new(),
        },
        load: None,
    };
    check(statement, &mut Points::new(&setting, &["no program"])).unwrap_err()
}

/// Each of these is refused, and none is a panic.
#[test]
fn programs_that_do_not_fit_are_refused() {
    let gravity = ["all", "q", "gravity.c"];
    for operand in [
        Operand::Entry(99, 0),
        Operand::Entry(0, 2),
        Operand::Step(0),
        Operand::Sine(2, true),
    ] {
        let why = refused(gravity, vec![operand.clone(), operand], &[]);
        assert_eq!(why, "the program reads what is not there");
    }
    assert_eq!(refused(gravity, Vec::new(), &[]), "0 results, not 2");
    let regressor = ["all", "q qd qdd", "regressor.y"];
    let bases: [&[&[usize]]; 2] = [&[&[500]], &[&[0], &[0]]];
    for base in bases {
        let why = refused(regressor, vec![exact("1"); 2], base);
        assert_eq!(why, "the base parameters do not fit the results");
    }
    let bases: [&[&[usize]]; 2] = [&[&[0], &[0]], &[&[0], &[]]];
    for base in bases {
        let why = refused(regressor, vec![exact("1"); 4], base);
        assert_eq!(why, "the base parameters do not stand for themselves");
    }
    let name = "forward_dynamics_with_wrench.qdd@nowhere";
    let nowhere = ["all", "q qd tau wrench", name];
    let why = refused(nowhere, vec![exact("0"); 2], &[]);
    assert_eq!(why, "no such result");
    let none = ["none", "q qd qdd", "regressor.y kinetic_energy.kinetic"];
    let why = refused(none, vec![exact("0")], &[&[0]]);
    assert_eq!(why, "0 results, not 1");
}

/// A divisor whose degree is beyond a double hides no degree of a result that it does not divide.
#[test]
fn no_degree_hides_behind_another() {
    let rate = Operand::Entry(argument("qd").unwrap(), 0);
    let mut steps = vec![('*', [rate.clone(), rate.clone()])];
    for step in 0..1100 {
        steps.push(('*', [Operand::Step(step), Operand::Step(step)]));
    }
    steps.push(('/', [exact("1"), Operand::Step(1100)]));
    // A degree of 2⁴⁰, and one of one.
    let mut outputs = vec![(false, Operand::Step(39)), (false, rate)];
    let degree = |outputs: &[_]| {
        let (steps, outputs) = (steps.clone(), outputs.to_vec());
        Program { steps, outputs }.degree()
    };
    assert_eq!(degree(&outputs), 2f64.powi(40));
    outputs.reverse();
    assert_eq!(degree(&outputs), 2f64.powi(40));
    outputs.push((false, Operand::Step(1101)));
    assert_eq!(degree(&outputs), f64::INFINITY);
}

/// At q = 0 another link may be in the same place.
#[test]
fn rows_have_frames_on_their_links() {
    let source = file("crates/model/tests/data/puma560_placed.toml");
    let (before, _) = source.split_once("[[joint]]").unwrap();
    let joint = "[[joint]]\nplacement = {}\naxis = [0, 0, 1]\nkind = \"revolute\"\nmass = 1\n";
    let on = |link: usize| {
        let frame = format!("[[frame]]\nname = \"eye\"\nlink = {link}\nxyz = [1, 0, 0]\n");
        robot::read(&format!("{before}{joint}{joint}{frame}")).unwrap()
    };
    assert_eq!(aligned::check(&on(1), &on(1), None), Ok(()));
    let why = aligned::check(&on(1), &on(2), None).unwrap_err();
    assert!(why.contains("frames on other links"), "{why}");
}

/// At q = 0 a joint that another link carries, or a payload on another link, may be in the same place.
#[test]
fn rows_are_carried_by_the_links_of_the_file() {
    let source = file("crates/model/tests/data/puma560_placed.toml");
    let (before, _) = source.split_once("[[joint]]").unwrap();
    let joint = |parent: &str| {
        format!(
            "[[joint]]\n{parent}placement = {{}}\naxis = [0, 0, 1]\nkind = \"revolute\"\nmass = 1\ncom = [1, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n"
        )
    };
    let tree = |parent: &str, holder: usize| {
        let joints = [joint(""), joint(""), joint(parent)].concat();
        let payload = format!("{{ mass = 1, com = [0, 0, 0], link = {holder} }}");
        let text = format!("{before}{joints}[scene.hold]\npayload = {payload}\n");
        robot::read(&text).unwrap()
    };
    let on_base = "parent = \"base\"\n";
    let file = tree(on_base, 2);
    let check = |rows, scene| aligned::check(&file, &rows, scene);
    assert_eq!(check(tree(on_base, 2), Some("hold")), Ok(()));
    for parent in ["", "parent = 1\n"] {
        let why = check(tree(parent, 3), None).unwrap_err();
        assert!(why.contains("carried by other links"), "{why}");
    }
    let why = check(tree(on_base, 3), Some("hold")).unwrap_err();
    assert!(why.contains("payload on another link"), "{why}");
}
