//! τ = Y π and D a + C v + c + b∘v = Y π: of every arm, in both scalars, in scenes, with
//! as few columns as there can be; and what a wrong combination is refused with.

use dalembert_codegen::workspace::{
    BaseParameters, Disproof, Parameter, Runtime, Setup, testing::prove_base,
};
use dalembert_codegen::{Function, Language};
use dalembert_model::equations::Arm;
use dalembert_model::number::{Exact, Rational, Rounded};
use dalembert_model::scalar::Scalar;

use crate::support::{self, BOUND, Case, daily_and_campaign, is_close, rows};

/// A regressor, what Y π is, and the constant with π.
type Linear = (Function, Function, &'static str);

const TORQUES: Linear = (
    Function::Regressor,
    Function::InverseDynamics,
    "BASE_PARAMETERS",
);
const PASSIVITY: Linear = (
    Function::PassivityRegressor,
    Function::Passivity,
    "PASSIVITY_PARAMETERS",
);

/// A robot, the lines of a scene, the regressors, how many columns there are, or by how many there
/// are more than the rank of Y over all links' parameters, and the most operations of a quick
/// search, whose sum only ever goes down; words of the text. The second table is a campaign's.
///
/// Known numbers of base parameters are 36 of the PUMA (Gautier, Khalil 1990), 43 of the Panda (Gaz
/// et al. 2019), and 3 a link in the plane. At rest friction and inertias have columns, which
/// torques at rest have not: rates that are zero are those of the arm, not those wished for.
const ROWS: [&str; 2] = [
    r#"
planar2r | | torques passivity | 6 | 22 23 |
planar3r | | torques passivity | 9 | 50 51 |
stanford | | torques | 33 | 526 |
scara    | | torques passivity | +0 | |
driven   | | torques passivity | +3 | | Izz1 + m2 + armature1 … armature2 … viscous1
puma560  | lock = { 1 = 0, 4 = 0, 6 = "pi/6" } | torques | +0 | |
puma560  | joints = [3, 1]; velocity = "zero" | torques | +0 | |
rubbed   | velocity = "zero"; acceleration = "zero" | torques | 4 | |
rubbed   | velocity = "zero"; acceleration = "zero" | passivity | 7 | |
rubbed   | joints = [2] | passivity | +1 | |
payload_frame | | torques passivity | +0 | | in the axes of its own frame
"#,
    r#"
puma560  | | torques passivity | 36 | 599 653 |
puma560  | | torques passivity; parameters: gravity | 38 | |
ur10     | | torques | 36 | 496 |
panda    | | torques | 43 | 977 |
gantry   | | torques passivity | +0 | |
rprpr    | | torques passivity | +0 | |
puma560  | lock = { 5 = "pi/4" }; joints = [5, 2] | torques | +0 | |
puma560  | velocity = "zero"; acceleration = "zero" | torques | +0 | |
"#,
];

daily_and_campaign! {
    columns_times_parameters_are_the_torques: (ROWS[0]), (ROWS[1]);
    headers_have_the_same_parameters: ("planar2r"), ("stanford");
}

fn case((regressor, ..): Linear, robot: &str, scene: &str, options: &str) -> Case {
    let asked = format!("{}; {options}", regressor.name());
    let drives = match robot {
        "driven" => [
            "armature = 0.2\nviscous = \"2/7\"\n",
            "armature = 0.3\nviscous = \"3/7\"\n",
        ],
        "rubbed" => ["", "viscous = \"1/7\"\n"],
        robot => return Case::in_scene(robot, scene, &asked),
    };
    let (source, asked) = support::in_scene("planar2r", scene, &asked);
    let mut parts = source.split("[[joint]]\n");
    let mut source = parts.next().unwrap().to_owned();
    for (part, drive) in parts.zip(drives) {
        source += &format!("[[joint]]\n{drive}{part}");
    }
    Case::read(&source, &asked)
}

fn printed((.., constant): Linear, text: &str) -> Vec<Vec<f64>> {
    let declared = format!("pub const {constant}: [");
    let (start, end) = match text.contains(&declared) {
        true => (declared.as_str(), "];"),
        false => ("pi[0] = ", "}"),
    };
    let tables = text.split(start).skip(1).map(|rest| {
        let (lines, _) = rest.split_once(end).unwrap();
        let values = lines.lines().filter_map(|line| {
            let value = line.rsplit(' ').next()?;
            value.trim_end_matches([',', ';', 'F']).parse().ok()
        });
        values.collect()
    });
    tables.collect()
}

fn headers_have_the_same_parameters(name: &str) {
    for linear @ (.., constant) in [TORQUES, PASSIVITY] {
        let mut case = case(linear, name, "", "");
        let expected = printed(linear, &case.generated().text());
        assert_eq!(expected.len(), 2);
        for language in [Language::C, Language::Cuda] {
            case.request.language = language;
            let text = case.generated().text();
            assert_eq!(printed(linear, &text), expected);
            let said = format!("and `{name}_{}` is", constant.to_lowercase());
            assert!(text.contains(&said) && !text.contains(constant));
        }
    }
}

/// Elimination in f64 with the largest pivot there is, columns brought to one length first.
fn rank(runtime: &Runtime, setup: &Setup) -> usize {
    let columns = 10 * setup.joints();
    let states = setup.states(columns / setup.rows().len() + 10, 0x72616e6b);
    let run = |state| runtime.run(Function::FullRegressor, state);
    let values: Vec<f64> = states.iter().flat_map(run).collect();
    let length = |column: &[f64]| column.iter().map(|x| x * x).sum::<f64>().sqrt();
    let scaled = |column: usize| {
        let entries = values.iter().copied().skip(column).step_by(columns);
        let length = length(&entries.clone().collect::<Vec<_>>()).max(1e-3);
        entries.map(|x| x / length).collect()
    };
    let mut matrix: Vec<Vec<f64>> = (0..columns).map(scaled).collect();
    let mut rank = 0;
    loop {
        let lengths = matrix.iter().map(|column| length(column)).enumerate();
        let longest = lengths.max_by(|(_, a), (_, b)| a.total_cmp(b));
        let Some((pivot, largest)) = longest.filter(|(_, length)| *length >= 1e-9) else {
            return rank;
        };
        let pivot = matrix.swap_remove(pivot);
        for column in &mut matrix {
            let along = column.iter().zip(&pivot).map(|(x, y)| x * y).sum::<f64>();
            let factor = along / (largest * largest);
            let pairs = column.iter_mut().zip(&pivot);
            pairs.for_each(|(x, y)| *x -= factor * y);
        }
        rank += 1;
    }
}

/// Relative to the terms that the sums are made of.
fn columns_times_parameters_are_the_torques(table: &str) {
    for [name, scene, regressors, base, most, words] in rows(table) {
        let mut most = most.split_whitespace().map(|most| most.parse().unwrap());
        let (regressors, options) = regressors.split_once("; ").unwrap_or((&regressors, ""));
        for regressor in regressors.split(' ') {
            let linear = [TORQUES, PASSIVITY][usize::from(regressor == "passivity")];
            let what = format!("{name} {scene} {regressor}");
            let case = case(linear, &name, &scene, options);
            let (generated, (runtime, states)) = (case.generated(), case.runtime(50, 0x7275));
            let setup = case.request.prepare(case.robot()).unwrap();
            let rank = rank(&runtime, &setup);
            let base: usize = match base.strip_prefix('+') {
                Some(drives) => rank + drives.parse::<usize>().unwrap(),
                None => base.parse().unwrap(),
            };
            let is_rank = base == rank || !scene.is_empty() || name == "driven";
            assert!(is_rank, "{what}: {rank}");
            let operations = generated.functions[0].counts().operations();
            let most = most.next().unwrap_or(usize::MAX);
            assert!(operations <= most, "{what}: {operations}");
            let text = generated.text();
            assert!(words.split(" … ").all(|word| text.contains(word)), "{text}");
            let parameters = printed(linear, &text);
            assert_eq!(generated.emitted.len(), 2);
            for (emitted, pi) in generated.emitted.iter().zip(&parameters) {
                assert_eq!([pi.len(), emitted.sizes.base], [base; 2], "{what}");
                let u = emitted.scalar.unit_roundoff();
                for state in &states {
                    let state = state.in_scalar(emitted.scalar);
                    let (y, tau) = (emitted.run(&state), runtime.run(linear.1, &state));
                    assert_eq!(y.len(), tau.len() * base);
                    let (mut sums, mut size) = (Vec::new(), 0.0f64);
                    for row in y.chunks(base.max(1)) {
                        let terms = || row.iter().zip(pi).map(|(y, pi)| y * pi);
                        sums.push(terms().sum::<f64>());
                        size = size.max(terms().map(f64::abs).sum());
                    }
                    let is_close = is_close(&sums, &tau, BOUND * u * size);
                    assert!(is_close, "{what} {}: {sums:?}", emitted.scalar);
                }
            }
        }
    }
}

#[test]
fn wrong_combinations_are_refused() {
    let robot = support::robot("puma560");
    let setup = Setup::whole(&robot);
    let base = setup.base(Function::Regressor.quantities()[0]).unwrap();
    assert_eq!(prove_base(setup.task(Function::Regressor), base), Ok(()));
    let arm = Arm::from_robot(&robot, &mut Exact::clone);
    let text = case(TORQUES, "puma560", "", "").generated().text();
    let values: Vec<f64> = base.values(&arm).iter().map(f64::nearest).collect();
    assert_eq!(printed(TORQUES, &text)[0], values);

    let refused = |wrong: &BaseParameters, parameter: Parameter| {
        let expected = Err(Disproof::Dependence(parameter.to_string()));
        for (regressor, ..) in [TORQUES, PASSIVITY] {
            assert_eq!(prove_base(setup.task(regressor), wrong), expected);
        }
    };
    for column in [0, 8, 20, 35] {
        let mut wrong = base.clone();
        let (parameter, factor) = wrong.combinations[column].last_mut().unwrap();
        let tiny = Rational::new(1.into(), 1_000_000_000.into());
        *factor = factor.add(&Exact::from(tiny));
        let parameter = *parameter;
        refused(&wrong, parameter);
    }
    let mut short = base.clone();
    let (parameter, _) = short.combinations[35].pop().unwrap();
    refused(&short, parameter);
}
