//! What a person wants to know about generated code: counts, errors, what a
//! tolerance admitted, proofs.

use crate::explained::errors::{Errors, of_program};
use dalembert_codegen::workspace::{
    Admitted, Certificate, Library, Proof, Reference, bound_of, omissions,
};
use dalembert_codegen::{Counts, Function, Generated, GeneratedFunction, Request};
use dalembert_model::robot::Robot;

use crate::output;

/// The counts of the code and that it was proved, with what a tolerance bounds.
pub fn brief(robot: &Robot, request: &Request, generated: &Generated) -> String {
    let mut text = head(robot, request);
    text += &counts(generated, false);
    text += &sines(generated);
    for function in &generated.functions {
        if let Some(admitted) = &function.admitted {
            text += &tolerance(admitted, generated.ended);
        }
    }
    text += &format!("\n{}; the text was read back\n", proved(generated));
    text + &warnings(generated)
}

/// Returns the sentence that the functions were proved.
pub fn proved(generated: &Generated) -> &'static str {
    match generated.functions.iter().any(|f| f.admitted.is_some()) {
        true => "proved before anything was left out, and certified to stay within the tolerance",
        false => "proved equal to the equations of motion",
    }
}

/// Writes robot and scene.
pub fn head(robot: &Robot, request: &Request) -> String {
    let joints = match robot.joints.len() {
        1 => "1 joint".to_owned(),
        more => format!("{more} joints"),
    };
    format!(
        "robot {}, {joints}, input {}{}\n\n",
        robot.name,
        robot.short_hash(),
        scene(request)
    )
}

/// Returns what a user should know.
pub fn warnings(generated: &Generated) -> String {
    let warnings = generated.warnings.iter();
    warnings
        .map(|warning| format!("warning: {warning}\n"))
        .collect()
}

/// Returns all that there is to say about the code.
pub fn text(robot: &Robot, request: &Request, generated: &Generated, states: usize) -> String {
    let mut text = head(robot, request);
    text += &counts(generated, true);
    text += &sines(generated);
    text += &limits(generated);
    text += &errors(robot, request, generated, states);
    text += "\nmul add sincos after each stage\n";
    text += &stages(generated);
    for function in &generated.functions {
        if let Some(admitted) = &function.admitted {
            text += &tolerance(admitted, generated.ended);
        }
    }
    text += "\nproved: with exact constants, every function\n";
    for function in &generated.functions {
        text += &format!("  {}: {}\n", function.function, function.proof);
    }
    text += match generated.functions.iter().any(|f| f.admitted.is_some()) {
        true => "the text was read back: it is the certified program, each constant rounded once\n",
        false => "the text was read back: it is the proved program, each constant rounded once\n",
    };
    text + &warnings(generated)
}

/// Returns what the limit on rounding errors cost each function.
pub fn limits(generated: &Generated) -> String {
    let mut text = String::new();
    for function in &generated.functions {
        let Some(refused) = function.refused.filter(|_| function.admitted.is_none()) else {
            continue;
        };
        let fewer = function
            .counts()
            .operations()
            .saturating_sub(refused.counts.operations());
        let [error, taken] = [refused.error, refused.taken].map(|u| format!("{u:.0}"));
        // The limit holds for every result; the largest error may be another's.
        let price = match error == taken {
            true => format!("one result less accurate; the worst stays at about {taken} u"),
            false => format!("a rounding error of about {error} u instead of {taken}"),
        };
        text += &format!(
            "\n{}: `--prefer operations` would save {fewer} operations, with {price}\n",
            function.function
        );
    }
    text
}

/// Returns what rounding costs each program in each scalar; what a tolerance admits has
/// its certificates.
pub fn measured(
    robot: &Robot,
    request: &Request,
    generated: &Generated,
    states: usize,
) -> Option<Vec<Vec<Errors>>> {
    let scene = request.scene.as_ref();
    if scene.is_some_and(|scene| scene.tolerance.is_some()) {
        return None;
    }
    let scene_robot = request.scene_robot(robot).ok()?;
    let reference = Reference::new(&scene_robot);
    let functions = generated.functions.iter();
    let errors =
        |f: &GeneratedFunction| of_program(&reference, &f.program, &request.scalars, states);
    Some(functions.map(errors).collect())
}

/// Returns the table of them.
fn errors(robot: &Robot, request: &Request, generated: &Generated, states: usize) -> String {
    let Some(measured) = measured(robot, request, generated, states) else {
        return String::new();
    };
    let mut head = vec!["function".to_owned()];
    for scalar in &request.scalars {
        head.extend(["normwise", "per joint"].map(|what| format!("{scalar} {what}")));
    }
    let mut rows = vec![head];
    for (function, errors) in generated.functions.iter().zip(measured) {
        let mut row = vec![function.function.to_string()];
        for errors in errors {
            row.extend([errors.normwise, errors.per_joint].map(|error| format!("{error:.1}")));
        }
        rows.push(row);
    }
    let over = match states {
        1 => "1 random state".to_owned(),
        _ => format!("{states} random states"),
    };
    format!(
        "\nworst rounding errors over {over} inside the limits, in u (f64 2^-53, f32 2^-24)\n{}",
        output::table(&rows, 0)
    )
}

/// Returns what a tolerance admitted: E by cause, and what was left out.
fn tolerance(admitted: &Admitted, ended: bool) -> String {
    let mut text = String::new();
    for certificate in &admitted.certificates {
        let function = certificate.emitted.function;
        text += &format!("\n{function} in {}, certified\n", certificate.scalar);
        text += &output::table(&bounds(certificate), 0);
    }
    let left_out = omissions(&admitted.stages);
    if left_out.is_empty() {
        text += match ended {
            false => "nothing was left out: no omission was found within the tolerance\n",
            true => {
                "nothing was left out: the search was ended early, and the quick one found no omission within the tolerance\n"
            }
        };
        return text;
    }
    text += "\nleft out, and what putting it back costs\n";
    let mut rows = Vec::new();
    for omission in &left_out {
        let pairs = match omission.sincos {
            0 => String::new(),
            pairs => format!("+ {pairs} sincos"),
        };
        rows.push(vec![
            omission.words.clone(),
            omission.operations.to_string(),
            pairs,
        ]);
    }
    text + &output::table(&rows, 1)
}

/// Returns the bounds of a certificate, output by output.
pub fn bounds(certificate: &Certificate) -> Vec<Vec<String>> {
    let head = ["output", "T", "model", "sincos", "rounding", "E"];
    let mut rows = vec![head.map(String::from).to_vec()];
    let pairs = certificate.bounds.iter().zip(&certificate.scales);
    for (index, (bound, scale)) in pairs.enumerate() {
        let mut row = vec![certificate.emitted.entry(index), bound_of(*scale, 5)];
        let parts = [bound.model, bound.sincos, bound.rounding, bound.total()];
        row.extend(parts.map(|x| bound_of(x, 4)));
        rows.push(row);
    }
    rows
}

/// Returns `, scene pick`, if there is one.
pub fn scene(request: &Request) -> String {
    let scene = request.scene.as_ref();
    scene.map_or_else(String::new, |scene| format!(", scene {}", scene.name))
}

/// Returns the table of operation counts; `whole` adds the longest chain of operations, the
/// calls, the formulation that each was found from, and how sure its proof is.
pub fn counts(generated: &Generated, whole: bool) -> String {
    let any = |of: fn(&Counts) -> usize| generated.functions.iter().any(|f| of(&f.counts()) > 0);
    let (fuses, roots) = (any(|counts| counts.fma), any(|counts| counts.sqrt));
    let fma = |cell: String| fuses.then_some(cell);
    let root = |cell: String| roots.then_some(cell);
    let mut head = ["function", "mul", "add"].map(String::from).to_vec();
    head.extend(fma("fma".to_owned()));
    head.push("div".to_owned());
    let tail: &[&str] = match whole {
        true => &["sincos", "depth", "calls", "from", "proof"],
        false => &["sincos"],
    };
    let tail = tail.iter().map(|name| (*name).to_owned());
    let sqrt = root("sqrt".to_owned());
    let mut rows: Vec<Vec<String>> = vec![head.into_iter().chain(sqrt).chain(tail).collect()];
    for function in &generated.functions {
        let counts = function.counts();
        let mut row = vec![
            function.function.to_string(),
            counts.mul.to_string(),
            counts.add.to_string(),
        ];
        row.extend(fma(counts.fma.to_string()));
        row.push(counts.div.to_string());
        row.extend(root(counts.sqrt.to_string()));
        row.push(counts.sincos.to_string());
        if !whole {
            rows.push(row);
            continue;
        }
        row.extend([
            function.program.depth().to_string(),
            calls(generated, function.function).to_string(),
            match function.planned {
                true => format!("{}, plan", function.source.name()),
                false => function.source.name().to_owned(),
            },
            format!("proved, p(wrong) < 1e{}", Proof::FAILURE_EXPONENT),
        ]);
        rows.push(row);
    }
    output::table(&rows, if whole { 2 } else { 0 })
}

/// Returns the number of library calls of a function's code, in its first scalar: one for each
/// angle and each root by libm, one for all angles together, none for polynomials.
fn calls(generated: &Generated, function: Function) -> usize {
    let mut emitted = generated.emitted.iter();
    let Some(emitted) = emitted.find(|emitted| emitted.function == function) else {
        return 0;
    };
    let text = &emitted.text;
    let angles = text
        .trig
        .iter()
        .filter(|trig| trig.kernel.is_none())
        .count();
    let angles = match text.library {
        Library::Libm => angles,
        Library::Together => angles.min(1),
    };
    angles + text.speeds.len()
}

/// Returns the table of the polynomials that give sines, if any do.
pub fn sines(generated: &Generated) -> String {
    let head = [
        "function", "scalar", "trig_mul", "trig_add", "angles", "error",
    ];
    let mut rows = vec![head.map(String::from).to_vec()];
    for function in &generated.functions {
        for (scalar, sines) in &function.sines {
            let counts = function.counts_in(*scalar);
            let worst = sines.iter().map(|sine| sine.errors.worst());
            rows.push(vec![
                function.function.to_string(),
                scalar.to_string(),
                counts.trig_mul.to_string(),
                counts.trig_add.to_string(),
                sines.len().to_string(),
                format!("{:.1e}", worst.fold(0.0, f64::max)),
            ]);
        }
    }
    match rows.len() {
        1 => String::new(),
        _ => format!(
            "\nsines and cosines by polynomials, errors proved\n{}",
            output::table(&rows, 2)
        ),
    }
}

fn stages(generated: &Generated) -> String {
    let admitted = generated.functions.iter().any(|f| f.admitted.is_some());
    let cell = |counts: &Counts| format!("{} {} {}", counts.mul, counts.add, counts.sincos);
    let mut rows = Vec::new();
    for function in &generated.functions {
        if rows.is_empty() {
            let mut head = vec![String::new()];
            head.extend(function.passes.iter().map(|s| s.name.to_owned()));
            head.extend(admitted.then(|| "tolerance".to_owned()));
            rows.push(head);
        }
        let mut row = vec![function.function.to_string()];
        row.extend(function.passes.iter().map(|stage| cell(&stage.counts)));
        // What the tolerance left of it: what is emitted.
        row.extend(admitted.then(|| cell(&function.counts())));
        rows.push(row);
    }
    output::table(&rows, 0)
}
