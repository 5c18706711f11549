//! Robot files drawn at random: an error, or verified code; never a panic.
//!
//! The reader's own fuzzing, of arbitrary bytes, is in the model's tests; here
//! the files are close enough to right that many are accepted.

use dalembert_codegen::workspace::{Random, seeded};
use dalembert_codegen::{Function, Request, ScalarType, generate};
use dalembert_model::read::{Options, parse};
use dalembert_model::robot::write;

/// Returns a dose for every day; `FUZZ_TIMES` multiplies it.
fn dose(runs: usize) -> usize {
    let times = std::env::var("FUZZ_TIMES").ok();
    let times: Option<usize> = times.and_then(|times| times.parse().ok());
    runs * times.unwrap_or(1)
}

const NUMBERS: [&str; 22] = [
    "0",
    "1",
    "-1",
    "0.5",
    "0.1",
    "2.25",
    "1e-3",
    "1e3",
    "1e-9",
    "1e9",
    "1e300",
    "1e-300",
    "1e38",
    "\"1/3\"",
    "\"22/7\"",
    "0.30000000000000004",
    "123456789.123456789",
    "-0.0",
    "1e40",
    "4.9e-324",
    "\"2305843009213693951/2\"",
    "\"1/2305843009213693951\"",
];
const ANGLES: [&str; 14] = [
    "0",
    "\"pi/2\"",
    "\"-pi/2\"",
    "\"pi\"",
    "\"pi/3\"",
    "\"2*pi/5\"",
    "\"90deg\"",
    "\"30deg\"",
    "1.5707963267948966",
    "1.5708",
    "0.3",
    "6283185.307179586",
    "-1e-9",
    "\"1e6*pi\"",
];

fn pick<'a>(random: &mut Random, from: &[&'a str], usual: usize) -> &'a str {
    // Mostly from the ordinary ones, or nothing would be accepted.
    let among = if random.below(8) > 0 {
        usual
    } else {
        from.len()
    };
    from[random.below(among)]
}

fn file(random: &mut Random) -> String {
    let convention = ["standard", "modified"][random.below(2)];
    let mut text = format!("name = \"fuzzed\"\nconvention = \"{convention}\"\n");
    let gravity: Vec<&str> = (0..3).map(|_| pick(random, &NUMBERS, 8)).collect();
    text += &format!("gravity = [{}]\n", gravity.join(", "));
    for _ in 0..1 + random.below(3) {
        let revolute = random.below(3) > 0;
        let kind = if revolute { "revolute" } else { "prismatic" };
        text += &format!("[[joint]]\nkind = \"{kind}\"\n");
        text += &format!("alpha = {}\n", pick(random, &ANGLES, 7));
        text += &format!("a = {}\n", pick(random, &NUMBERS, 7));
        let (constant, offset) = if revolute {
            (pick(random, &NUMBERS, 7), pick(random, &ANGLES, 7))
        } else {
            (pick(random, &ANGLES, 7), pick(random, &NUMBERS, 7))
        };
        let constant_key = if revolute { "d" } else { "theta" };
        text += &format!("{constant_key} = {constant}\noffset = {offset}\n");
        text += &format!(
            "mass = {}\n",
            ["1", "0.5", "1e9", "1e-9", "17.4"][random.below(5)]
        );
        let com: Vec<&str> = (0..3).map(|_| pick(random, &NUMBERS, 6)).collect();
        text += &format!("com = [{}]\n", com.join(", "));
        let tensor = [
            "[0, 0, 0, 0, 0, 0]",
            "[1, 1, 1, 0, 0, 0]",
            "[0.3, 0.4, 0.5, 0.01, -0.02, 0.03]",
            "[1e-9, 1e-9, 1e-9, 0, 0, 0]",
        ][random.below(4)];
        text += &format!("inertia = {tensor}\n");
        if random.below(3) == 0 {
            text += &format!("viscous = {}\n", pick(random, &NUMBERS, 2));
        }
    }
    text
}

#[test]
fn accepted_robots_give_verified_code() {
    let mut random = Random::new(31);
    let (mut accepted, mut verified) = (0, 0);
    let runs = dose(60);
    for _ in 0..runs {
        let source = file(&mut random);
        let Ok(reading) = parse(&source, &Options::default()) else {
            continue;
        };
        accepted += 1;
        let robot = reading.robot;
        let again = parse(&write(&robot), &Options::default()).unwrap().robot;
        assert_eq!(again, robot, "{source}");
        let functions = [Function::InverseDynamics, Function::Inertia];
        let request = Request {
            scalars: vec![ScalarType::ALL[random.below(2)]],
            ..Request::of(&[functions[random.below(2)]])
        };
        // Generated means proved and read back; all else is an error that
        // says why, such as a constant beyond f32.
        match generate(&robot, &request) {
            Ok(generated) => {
                verified += 1;
                for state in seeded(&robot, 2, 5) {
                    for emitted in &generated.emitted {
                        let _ = emitted.run(&state);
                    }
                }
            }
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
    println!("{runs} files, {accepted} accepted, {verified} verified");
    assert!(
        2 * verified > runs / 2,
        "{accepted} accepted, {verified} verified"
    );
}
