//! `NAME_lanes`: the function of several states at once.
//!
//! ```text
//! pub fn gravity_lanes<const L: usize>(q: &[[f64; L]; 2]) -> [[f64; L]; 2] {
//!     let ([s1], [c1]) = dalembert_sines::sincos_lanes(&[q[0]]);
//!     let mut results = [[0.0; L]; 2];
//!     for l in 0..L {
//!         let result = gravity_with_sincos(&[q[0][l], q[1][l]], &[s1[l], 0.0], &[c1[l], 0.0]);
//!         results[0][l] = result[0];
//!         results[1][l] = result[1];
//!     }
//!     results
//! }
//! ```
//!
//! The loop is over the whole arithmetic of a state: compilers make vectors of
//! all lanes of such a loop. Arrays for every operation, where the same is asked
//! of them a thousand times over, take three times as long (PUMA's torques,
//! AVX-512: 38 ns against 11 to 17).

use std::fmt::Write;

use super::{Around, places};
use crate::backend::place::Place;
use crate::backend::{result, trig};
use crate::program::{Program, Trig};
use crate::sincos::AngleKernel;

/// Prints it, after the struct that it returns, if it does.
pub(super) fn write(
    text: &mut String,
    program: &Program,
    around: &Around<'_>,
    sines: &[AngleKernel],
) {
    let (name, scalar, sizes) = (program.function.name(), around.scalar, program.sizes());
    structure(text, program, around);
    let parameters = program.arguments.iter().map(|argument| {
        let (name, length) = (argument.name(), argument.length(sizes));
        format!("{name}: &[[{scalar}; L]; {length}]")
    });
    let parameters: Vec<String> = parameters.collect();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "/// [`{name}`] of `L` states at once: entry `[i][l]` of an argument is that of joint i in\n\
         /// state l. Each state has the results that it has alone, bit for bit, or a NaN where it\n\
         /// has one. Vectors are as wide as `L` is, where that is what the processor has.\n\
         #[inline(always)]\n#[must_use]\n\
         pub fn {name}_lanes<const L: usize>({}) -> {} {{",
        parameters.join(", "),
        result_type(program, around)
    );
    write_sines(text, program, around, sines);
    let entry = |letter: char, taken: bool, trig: &Trig| {
        taken.then(|| format!("{letter}{}[l]", trig.angle))
    };
    let columns = program.arguments.iter().map(|argument| {
        let (name, length) = (argument.name(), argument.length(sizes));
        let entries: Vec<String> = (0..length).map(|i| format!("{name}[{i}][l]")).collect();
        format!("&[{}], ", entries.join(", "))
    });
    let columns: String = columns.collect();
    let angles = around.angles;
    let sin = angles.array(&program.trig, |trig| entry('s', trig.sin, trig));
    let cos = angles.array(&program.trig, |trig| entry('c', trig.cos, trig));
    zeros(text, program);
    let _ = writeln!(
        text,
        "    for l in 0..L {{\n        \
         let result = {name}_with_sincos({columns}&{sin}, &{cos});"
    );
    for place in places(program) {
        let _ = writeln!(text, "        results{place}[l] = result{place};");
    }
    text.push_str("    }\n    results\n}\n");
}

/// What it returns: arrays with an array of lanes for every number.
pub(super) fn result_type(program: &Program, around: &Around<'_>) -> String {
    let function = program.function;
    let lanes = format!("[{}; L]", around.scalar);
    match function.structure() {
        Some(name) => format!("{name}Lanes<L>"),
        None => result::array_of(&lanes, function.quantities()[0], program.sizes()),
    }
}

fn structure(text: &mut String, program: &Program, around: &Around<'_>) {
    let (function, sizes) = (program.function, program.sizes());
    let Some(name) = function.structure() else {
        return;
    };
    let _ = writeln!(
        text,
        "/// What [`{function}_lanes`] returns: [`{name}`] with the lanes of every number.\n\
         #[derive(Clone, Copy, Debug, PartialEq)]\npub struct {name}Lanes<const L: usize> {{"
    );
    result::fields(text, function, &format!("[{}; L]", around.scalar), sizes);
    text.push_str("}\n\n");
}

/// Sines of all lanes: a loop for what is computed angle by angle, and one call
/// for what is called together.
fn write_sines(text: &mut String, program: &Program, around: &Around<'_>, sines: &[AngleKernel]) {
    let together = |trig: &Trig| trig::is_together(trig, around.math, sines);
    let (mut arrays, mut lines) = (String::new(), String::new());
    let mut array = |name: String| {
        let _ = writeln!(arrays, "    let mut {name} = [0.0; L];");
    };
    let place = Place::LANE;
    for trig in &program.trig {
        let angle = trig.angle;
        let is_sum = angle.additions() > 0;
        if together(trig) {
            if is_sum {
                array(format!("a{angle}"));
                let _ = writeln!(lines, "        a{angle}[l] = {};", place.sum(angle));
            }
            continue;
        }
        if is_sum {
            let _ = writeln!(lines, "        let a{angle} = {};", place.sum(angle));
        }
        for (taken, letter) in [(trig.sin, 's'), (trig.cos, 'c')] {
            if taken {
                array(format!("{letter}{angle}"));
            }
        }
        trig::alone(&mut lines, trig, place, around.scalar, around.math, sines);
    }
    if !lines.is_empty() {
        let _ = writeln!(text, "{arrays}    for l in 0..L {{\n{lines}    }}");
    }
    // The joints' positions are arrays of lanes already.
    let angle = |trig: &Trig| Place::STATE.angle(trig.angle);
    let (scalar, math) = (around.scalar, around.math);
    trig::together(text, program, scalar, math, sines, "_lanes", angle);
}

/// Where the results go.
fn zeros(text: &mut String, program: &Program) {
    let (function, sizes) = (program.function, program.sizes());
    let zeros = |quantity| result::array_of("[0.0; L]", quantity, sizes);
    let value = match function.structure() {
        None => zeros(function.quantities()[0]),
        Some(name) => {
            let fields = function.quantities().iter();
            let fields = fields.map(|&q| format!("{}: {}", q.field(), zeros(q)));
            let fields: Vec<String> = fields.collect();
            format!("{name}Lanes {{ {} }}", fields.join(", "))
        }
    };
    let _ = writeln!(text, "    let mut results = {value};");
}
