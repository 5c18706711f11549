//! `dalembert tradeoff`: what accuracy costs, certified and observed.

use std::fs;

use dalembert_codegen::certify::attack::attack;
use dalembert_codegen::certify::certificate::Certificate;
use dalembert_codegen::certify::input_box::InputBox;
use dalembert_codegen::certify::prune::{Pruned, Settings, prune};
use dalembert_codegen::certify::scale;
use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::function::Function;
use dalembert_codegen::generate::{Request, generate};
use dalembert_codegen::plan;
use dalembert_codegen::schedule::Program;
use dalembert_model::robot::Robot;

use crate::args::TradeoffArgs;
use crate::outcome::{Failure, Outcome};
use crate::plot::Chart;
use crate::{input, output};

/// Tolerances unless others are asked for; zero is always there.
const TOLERANCES: [f64; 7] = [1e-1, 5e-2, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// One variant.
struct Point {
    tolerance: f64,
    certificate: Certificate,
    /// The largest E and the largest observed error.
    certified: f64,
    observed: f64,
    /// Whether another one is neither dearer nor worse.
    dominated: bool,
}

/// Runs the subcommand.
pub fn run(args: &TradeoffArgs) -> Outcome {
    let robot = input::robot(&args.robot)?;
    let fail = |why: String| Failure::Input(format!("error: {}: {why}", args.robot.display()));
    let limits = InputBox::of(&robot).map_err(|missing| fail(missing.to_string()))?;
    let program = exact(args, &robot)?;
    let scales = if args.relative_to == "range" {
        scale::range(&program, &limits).map_err(|error| Failure::Check(error.to_string()))?
    } else {
        scale::actuator(&robot, &program).map_err(|missing| fail(missing.to_string()))?
    };
    let tolerances = match args.tolerances.as_slice() {
        [] => TOLERANCES.to_vec(),
        given => given.to_vec(),
    };
    if let Some(bad) = tolerances.iter().find(|t| t.is_nan() || **t <= 0.0) {
        return Err(Failure::Input(format!(
            "error: a tolerance must be above zero, not {bad}"
        )));
    }
    let mut points = Vec::new();
    for tolerance in std::iter::once(0.0).chain(tolerances) {
        let allowances: Vec<f64> = scales.iter().map(|t| t * tolerance).collect();
        let pruned = if tolerance > 0.0 {
            let settings = Settings {
                effort: args.effort,
                ..Settings::default()
            };
            prune(&program, &limits, &allowances, &settings)
        } else {
            Pruned {
                stages: Vec::new(),
                program: program.clone(),
                errors: vec![0.0; scales.len()],
            }
        };
        for scalar in ScalarType::ALL {
            points.push(point(
                &robot, &pruned, tolerance, scalar, &limits, &scales, args,
            )?);
        }
    }
    mark(&mut points);
    output::print(&output::table(&rows(&points), 1))?;
    if let Some(folder) = &args.output {
        fs::create_dir_all(folder)
            .map_err(|error| Failure::Input(format!("error: `{}`: {error}", folder.display())))?;
        let csv: String = rows(&points)
            .iter()
            .map(|row| row.join(",") + "\n")
            .collect();
        output::write_file(&folder.join("tradeoff.csv"), &csv)?;
        output::write_file(&folder.join("tradeoff.svg"), &chart(&robot, &points).svg())?;
        for point in &points {
            let name = format!("{:e}-{}.json", point.tolerance, point.certificate.scalar);
            output::write_file(&folder.join(name), &point.certificate.to_json())?;
        }
        output::note(&format!("wrote {}", folder.display()));
    }
    Ok(())
}

/// The exact program, from the plan if there is one.
fn exact(args: &TradeoffArgs, robot: &Robot) -> Result<Program, Failure> {
    let plan = plan::file::beside(&args.robot)
        .map_err(|message| Failure::Input(format!("error: {message}")))?;
    let request = Request {
        functions: vec![Function::InverseDynamics],
        scalars: vec![ScalarType::F64],
        effort: args.effort,
        plan,
        ..Request::default()
    };
    Ok(generate(robot, &request)?.functions.remove(0).program)
}

fn point(
    robot: &Robot,
    pruned: &Pruned,
    tolerance: f64,
    scalar: ScalarType,
    limits: &InputBox,
    scales: &[f64],
    args: &TradeoffArgs,
) -> Result<Point, Failure> {
    let certificate = Certificate::make(
        robot,
        &pruned.stages,
        &pruned.program,
        scalar,
        limits,
        scales,
    );
    let attack = attack(&certificate, args.samples, 4, 1)
        .map_err(|error| Failure::Check(format!("error: {error}")))?;
    if let Some((index, _)) = attack.violation {
        return Err(Failure::Check(format!(
            "error: {} errs more than its certificate says: a defect of this program",
            certificate.emitted.entry(index)
        )));
    }
    let certified = certificate.bounds.iter().map(|b| b.total());
    Ok(Point {
        tolerance,
        certified: certified.fold(0.0, f64::max),
        observed: attack.observed.into_iter().fold(0.0, f64::max),
        certificate,
        dominated: false,
    })
}

fn cost(point: &Point) -> (usize, usize) {
    let counts = point.certificate.emitted.counts();
    (counts.sincos, counts.operations())
}

/// A point is dominated by one that is no dearer, no worse, and not the same.
fn mark(points: &mut [Point]) {
    let all: Vec<((usize, usize), f64)> = points.iter().map(|p| (cost(p), p.certified)).collect();
    for (index, point) in points.iter_mut().enumerate() {
        let ((sincos, operations), error) = all[index];
        point.dominated = all.iter().enumerate().any(|(other, &((s, o), e))| {
            let no_worse = s <= sincos && o <= operations && e <= error;
            let better = s < sincos || o < operations || e < error;
            no_worse && (better || other < index)
        });
    }
}

fn rows(points: &[Point]) -> Vec<Vec<String>> {
    let head = [
        "tolerance",
        "scalar",
        "mul",
        "add",
        "sincos",
        "edits",
        "certified",
        "observed",
        "front",
    ];
    let mut rows = vec![head.map(String::from).to_vec()];
    for point in points {
        let counts = point.certificate.emitted.counts();
        let edits: usize = point.certificate.stages.iter().map(|s| s.edits.len()).sum();
        rows.push(vec![
            format!("{:e}", point.tolerance),
            point.certificate.scalar.to_string(),
            counts.mul.to_string(),
            counts.add.to_string(),
            counts.sincos.to_string(),
            edits.to_string(),
            format!("{:.2e}", point.certified),
            format!("{:.2e}", point.observed),
            if point.dominated { "" } else { "yes" }.into(),
        ]);
    }
    rows
}

fn chart(robot: &Robot, points: &[Point]) -> Chart {
    let curve = |scalar: ScalarType, value: fn(&Point) -> f64| {
        let mine = points.iter().filter(|p| p.certificate.scalar == scalar);
        let mut curve: Vec<(f64, f64)> = mine
            .map(|p| (value(p), p.certificate.emitted.counts().operations() as f64))
            .collect();
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        curve
    };
    let mut curves = Vec::new();
    for scalar in ScalarType::ALL {
        curves.push((
            format!("{scalar} certified"),
            curve(scalar, |p| p.certified),
        ));
        curves.push((format!("{scalar} observed"), curve(scalar, |p| p.observed)));
    }
    Chart {
        title: format!("{}: inverse dynamics", robot.name),
        x: "largest error relative to the scale".into(),
        y: "multiplications and additions".into(),
        bound: None,
        curves,
    }
}
