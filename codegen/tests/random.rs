//! Robots and robot files that nobody chose: the code for them is proved (or `generate` fails) and
//! within the floating bound; a file gives an error or proved code, never a panic; and what was
//! proved is never said to be contradicted.

use std::ops::Range;

use dalembert_codegen::workspace::{Random, Word, testing::seeded};
use dalembert_codegen::{Function, GenerateError, Request, ScalarType, Start, generate};
use dalembert_model::read::parse;
use dalembert_model::robot::write;

use crate::certified::Certified;
use crate::support::draw::{Draw, robots};
use crate::support::{self, Case, daily_and_campaign};
use crate::values::is_whole_robots;

fn function(n: usize, draw: &mut Draw) -> Function {
    let few = match n {
        0..=3 => 6,
        4..=5 => 5,
        _ => 4,
    };
    Function::ALL[draw.0.below(few)]
}

daily_and_campaign! {
    proved_and_accurate: (0..8), (8..24);
    friction_is_proved_and_accurate: (0..4), (4..40);
    accepted_files_give_proved_code: (0..30), (30..60);
    exact_programs_are_not_contradicted: (0..12), (12..40);
    certificates_are_not_contradicted: (0..6), (6..20);
    odd_trees_are_accurate_and_shown: (0..1), (1..10);
}

fn proved_and_accurate(places: Range<usize>) {
    let robots = robots(places.end, 0x5eed);
    for (seed, robot, mut draw) in robots.skip(places.start) {
        let function = function(robot.joints.len(), &mut draw);
        let what = format!("seed {seed}, {function}");
        let case = Case::read(&write(&robot), &format!("outputs: {function}"));
        assert_eq!(case.rounds_well(50, &what).emitted.len(), 2, "{what}");
    }
}

fn friction_is_proved_and_accurate(places: Range<usize>) {
    let asked = "outputs: inverse_dynamics, passivity, forward_dynamics, coriolis";
    let mut draw = Draw(Random::new(0x636f_756c));
    for place in 0..places.end {
        let mut robot = draw.robot(3);
        for joint in &mut robot.joints {
            if !draw.chance(3) {
                joint.coulomb = draw.milli(1, 20_000);
                joint.coulomb_width = draw.milli(1, 100);
            }
        }
        if places.contains(&place) {
            let text = write(&robot);
            Case::read(&text, asked).rounds_well(40, &text);
        }
    }
}

#[test]
fn every_start_leads_to_the_same_function() {
    let small = robots(16, 0xa9ee).filter(|(_, robot, _)| robot.joints.len() <= 3);
    for (seed, robot, mut draw) in small {
        let function = function(robot.joints.len(), &mut draw);
        for (_, start) in Start::all() {
            let mut request = Request::new(&[function]);
            request.start = start;
            let outcome = generate(&robot, &request);
            assert!(outcome.is_ok(), "{seed}, {function}: {:?}", outcome.err());
        }
    }
}

#[test]
fn a_scene_at_rest_is_the_full_model() {
    let still = "\n[scene.test]\nvelocity = \"zero\"\n";
    let asked = "outputs: inverse_dynamics, inertia, gravity; scene: test; scalar: f64";
    for (_, robot, _) in robots(10, 4_000).filter(|(_, robot, _)| robot.joints.len() <= 5) {
        is_whole_robots(&Case::read(&(write(&robot) + still), asked));
    }
}

/// Numbers in a robot file, the usual ones first.
const NUMBERS: &str = "0 1 -1 0.5 0.1 2.25 1e-3 1e3 1e-9 1e9 1e300 1e-300 1e38 \"1/3\" \"22/7\" \
    0.30000000000000004 123456789.123456789 -0.0 1e40 4.9e-324 \"2305843009213693951/2\" \
    \"1/2305843009213693951\"";

const ANGLES: &str = "0 \"pi/2\" \"-pi/2\" \"pi\" \"pi/3\" \"2*pi/5\" \"90deg\" \"30deg\" \
    1.5707963267948966 1.5708 0.3 6283185.307179586 -1e-9 \"1e6*pi\"";

/// Returns one of these words: mostly of the usual ones, or nothing would be accepted.
fn pick<'a>(random: &mut Random, words: &'a str, usual: usize) -> &'a str {
    let choices: Vec<&str> = words.split(' ').collect();
    let is_usual = random.below(8) > 0;
    choices[random.below(if is_usual { usual } else { choices.len() })]
}

fn file(random: &mut Random) -> String {
    let convention = ["standard", "modified"][random.below(2)];
    let mut text = format!("name = \"fuzzed\"\nconvention = \"{convention}\"\n");
    let gravity = [(); 3].map(|()| pick(random, NUMBERS, 8)).join(", ");
    text += &format!("gravity = [{gravity}]\n");
    for _ in 0..1 + random.below(3) {
        let revolute = random.below(3) > 0;
        let (kind, key, constants, offsets) = match revolute {
            true => ("revolute", "d", NUMBERS, ANGLES),
            false => ("prismatic", "theta", ANGLES, NUMBERS),
        };
        let picked = [ANGLES, NUMBERS, constants, offsets].map(|words| pick(random, words, 7));
        let [alpha, a, constant, offset] = picked;
        let mass = ["1", "0.5", "1e9", "1e-9", "17.4"][random.below(5)];
        let com = [(); 3].map(|()| pick(random, NUMBERS, 6)).join(", ");
        const TENSORS: [&str; 4] = [
            "0, 0, 0, 0, 0, 0",
            "1, 1, 1, 0, 0, 0",
            "0.3, 0.4, 0.5, 0.01, -0.02, 0.03",
            "1e-9, 1e-9, 1e-9, 0, 0, 0",
        ];
        let tensor = TENSORS[random.below(TENSORS.len())];
        text += &format!(
            "[[joint]]\nkind = \"{kind}\"\nalpha = {alpha}\na = {a}\n{key} = {constant}\n\
             offset = {offset}\nmass = {mass}\ncom = [{com}]\ninertia = [{tensor}]\n"
        );
        if random.below(3) == 0 {
            text += &format!("viscous = {}\n", pick(random, NUMBERS, 2));
        }
    }
    text
}

/// `FUZZ_TIMES` multiplies the files.
fn accepted_files_give_proved_code(places: Range<usize>) {
    let times: usize = std::env::var("FUZZ_TIMES").map_or(1, |times| times.parse().unwrap_or(1));
    let runs = places.start * times..places.end * times;
    let mut random = Random::new(31);
    let (mut accepted, mut proved) = (0, 0);
    for place in 0..runs.end {
        let source = file(&mut random);
        let Ok(reading) = parse(&source) else {
            continue;
        };
        let functions = [Function::InverseDynamics, Function::Inertia];
        let request = Request {
            scalars: vec![ScalarType::ALL[random.below(2)]],
            ..Request::new(&[functions[random.below(2)]])
        };
        if !runs.contains(&place) {
            continue;
        }
        accepted += 1;
        let robot = reading.robot;
        assert_eq!(support::read_robot(&write(&robot)), robot, "{source}");
        match generate(&robot, &request) {
            Ok(generated) => {
                proved += 1;
                for state in seeded(&robot, 2, 5) {
                    let _ = generated.emitted[0].run(&state);
                }
            }
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
    let runs = runs.len();
    println!("{runs} files, {accepted} accepted, {proved} proved");
    assert!(2 * proved > runs / 2, "{accepted}, {proved}");
}

const ALLOW: &str = "allow = [\"impossible_inertia\", \"unusual_gravity\", \"large_length\", \
                     \"large_mass\", \"large_angle\", \"large_limit\", \"large_velocity\"]\n";

/// Returns a number whose size is a random power of ten up to `span` either way.
fn number(random: &mut Random, span: f64) -> f64 {
    let sign = if random.below(3) == 0 { -1.0 } else { 1.0 };
    let digits = sign * (1.0 + 9.0 * random.unit());
    let power = span * (2.0 * random.unit() - 1.0);
    format!("{digits:.3}e{}", power.round()).parse().unwrap()
}

/// Errors and bounds measured where its code is run overflow and underflow as the code does.
fn arm(seed: usize) -> String {
    let mut random = Random::new(seed as u64);
    let sizes = [3.0, 9.0, 30.0, 60.0, 100.0, 140.0];
    let size = sizes[random.below(sizes.len())];
    let mut span = || if random.below(2) == 0 { size } else { 1.0 };
    let [length, mass, rate, gravity] = [span(), span(), span(), span()];
    let convention = ["standard", "modified"][random.below(2)];
    let [x, z] = [(); 2].map(|()| number(&mut random, gravity));
    let mut text = format!(
        "name = \"extreme\"\nconvention = \"{convention}\"\ngravity = [{x:e}, 0, {z:e}]\n{ALLOW}"
    );
    for _ in 0..1 + random.below(3) {
        let slides = random.below(3) == 0;
        let (kind, other, other_span, reach_span) = match slides {
            true => ("prismatic", "theta", 0.5, length),
            false => ("revolute", "d", length, 2.0),
        };
        let twist = ["0", "\"pi/2\"", "0.3"][random.below(3)];
        let mut draw = |span: f64| number(&mut random, span);
        let moment = draw(mass).abs();
        let (a, other_value, own_mass) = (draw(length), draw(other_span), draw(mass).abs());
        let [x, y, z] = [(); 3].map(|()| draw(length));
        let reach = draw(reach_span).abs();
        let [speed, change, torque] = [rate, rate, mass].map(|span| draw(span).abs());
        text += &format!(
            "[[joint]]\nkind = \"{kind}\"\nalpha = {twist}\na = {a:e}\n{other} = {other_value:e}\n\
             mass = {own_mass:e}\ncom = [{x:e}, {y:e}, {z:e}]\n\
             inertia = [{moment:e}, {moment:e}, {moment:e}, 0, 0, 0]\n\
             limits = {{ position = [-{reach:e}, {reach:e}], velocity = {speed:e}, \
             acceleration = {change:e}, torque = {torque:e} }}\n"
        );
    }
    text
}

fn never_contradicted(seeds: Range<usize>, scene: &str, outputs: &str, options: &str) -> usize {
    let names: Vec<&str> = outputs.split(' ').collect();
    let mut done = 0;
    for seed in seeds {
        let asked = format!("outputs: {}; {options}", names[seed % names.len()]);
        let case = Case::read(&(arm(seed) + scene), &asked);
        match generate(case.robot(), &case.request) {
            Ok(_) => done += 1,
            Err(error @ (GenerateError::Defect(..) | GenerateError::Disproved(..))) => {
                panic!("seed {seed}: {error}\n{}", arm(seed))
            }
            Err(_) => {}
        }
    }
    done
}

fn exact_programs_are_not_contradicted(seeds: Range<usize>) {
    let outputs = "inverse_dynamics gravity inertia coriolis forward_dynamics kinetic_energy \
        jacobian regressor";
    let done = ["f64", "f32"].map(|scalar| {
        let options = format!("scalar: {scalar}");
        never_contradicted(seeds.clone(), "", outputs, &options)
    });
    assert!(done.iter().sum::<usize>() > seeds.len() / 2, "{done:?}");
}

fn certificates_are_not_contradicted(seeds: Range<usize>) {
    let scene = "[scene.t]\ntolerance = { value = 1e-2, relative_to = \"range\" }\n";
    let outputs = "inverse_dynamics gravity inertia coriolis";
    let done = never_contradicted(seeds.clone(), scene, outputs, "scene: t");
    assert!(done > seeds.len() / 4, "{done}");
}

/// Returns a tree as `import` writes it: angles that are no parts of π are points of the circle,
/// some beside a right angle or beside zero, and axes have any direction and length.
fn tree(seed: usize) -> String {
    let mut random = Random::new(0x7ee5 + seed as u64);
    let vector = |random: &mut Random, size: f64| {
        let numbers = [(); 3].map(|()| format!("{:.4}", size * (2.0 * random.unit() - 1.0)));
        format!("[{}]", numbers.join(", "))
    };
    let mut text = "name = \"tree\"\ngravity = [0, 0, -9.81]\n".to_owned();
    for joint in 0..4 + random.below(3) {
        let angles = [(); 3].map(|()| match random.below(6) {
            0 | 1 => "0".to_owned(),
            2 => "\"pi/2\"".to_owned(),
            3 => "\"2*atan(29129927/29129820)\"".to_owned(),
            4 => "\"2*atan(205/154507679)\"".to_owned(),
            _ => format!("\"2*atan({}/134217689)\"", 1 + random.below(1 << 27)),
        });
        let axis = match random.below(3) {
            0 => "[0, 0, 1]".to_owned(),
            1 => "[0, -1, 0]".to_owned(),
            _ => vector(&mut random, 1.0),
        };
        let carrier = match joint - random.below(3).min(joint) {
            0 => "\"base\"".to_owned(),
            carrier => carrier.to_string(),
        };
        let [xyz, com] = [0.3, 0.1].map(|size| vector(&mut random, size));
        let mass = 0.1 + 3.0 * random.unit();
        text += &format!(
            "[[joint]]\nkind = \"revolute\"\nparent = {carrier}\nplacement = {{ xyz = {xyz}, \
             rpy = [{}] }}\naxis = {axis}\nmass = {mass:.3}\ncom = {com}\n\
             inertia = [0.011, 0.012, 0.013, 0.001, 0, 0.002]\n",
            angles.join(", ")
        );
    }
    text
}

fn odd_trees_are_accurate_and_shown(seeds: Range<usize>) {
    let asked = "outputs: gravity, coriolis, inertia; scalar: f64";
    for seed in seeds {
        let text = tree(seed);
        let case = Case::read(&text, asked);
        case.rounds_well(30, &text);
        Certified::from(&case, &text, None)[0].is_shown(3, &text);
    }
}

/// The state that is tried has the largest f32 in place of a rate beyond it.
#[test]
fn limits_beyond_f32_leave_states_finite() {
    let arm = "name = \"fast\"\nconvention = \"standard\"\ngravity = [0, -9.81, 0]\n\
               allow = [\"large_velocity\"]\n[[joint]]\nkind = \"prismatic\"\nmass = 1\n\
               com = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n\
               limits = { position = [-1, 1], velocity = 1e100, acceleration = 1e120, torque = 1 }\n";
    let generated = Case::read(arm, "outputs: regressor").generated();
    assert!(!generated.functions.is_empty());
}
