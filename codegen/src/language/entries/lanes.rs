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
use crate::function::{Argument, Function, Sizes};
use crate::language::function::{LOAD, own_type};
use crate::language::scope::Scope;
use crate::language::{Printed, result, trig};
use crate::program::LoweredTrig;

/// Prints it, after the struct that it returns, if it does.
pub(super) fn write(text: &mut String, printed: &Printed<'_>, around: &Around<'_>) {
    let (code, sizes) = (printed.code, printed.sizes);
    let (name, scalar) = (printed.function.name(), code.scalar);
    structure(text, printed);
    let parameters = printed.arguments.iter().map(|&argument| {
        let name = argument.name();
        match own_type(argument) {
            Some(kind) => format!("{name}: &{kind}<[{scalar}; L]>"),
            None => format!("{name}: &[[{scalar}; L]; {}]", argument.length(sizes)),
        }
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
        result_type(printed)
    );
    write_sines(text, printed, around);
    let entry = |letter: char, taken: bool, trig: &LoweredTrig| {
        taken.then(|| format!("{letter}{}[l]", trig.angle))
    };
    let columns = printed.arguments.iter();
    let columns: String = columns
        .map(|&argument| format!("{}, ", in_lane(argument, sizes)))
        .collect();
    let angles = around.angles;
    let sin = angles.array(&code.trig, |trig| entry('s', trig.sin, trig));
    let cos = angles.array(&code.trig, |trig| entry('c', trig.cos, trig));
    zeros(text, printed);
    let _ = writeln!(
        text,
        "    for l in 0..L {{\n        \
         let result = {name}_with_sincos({columns}&{sin}, &{cos});"
    );
    for place in places(printed.function, printed.sizes) {
        let _ = writeln!(text, "        results{place}[l] = result{place};");
    }
    text.push_str("    }\n    results\n}\n");
}

/// Returns one lane of an argument.
fn in_lane(argument: Argument, sizes: Sizes) -> String {
    let (name, length) = (argument.name(), argument.length(sizes));
    let entries: Vec<String> = (0..length).map(|i| format!("{name}[{i}][l]")).collect();
    let entries = entries.join(", ");
    match own_type(argument) {
        Some(kind) => format!("&{kind}([{entries}])"),
        None => format!("&[{entries}]"),
    }
}

/// Returns what it returns: arrays with an array of lanes for every number.
pub(super) fn result_type(printed: &Printed<'_>) -> String {
    let function = printed.function;
    let lanes = format!("[{}; L]", printed.code.scalar);
    match function.structure() {
        Some(name) => format!("{name}Lanes<L>"),
        None if function == Function::Load => format!("{LOAD}<{lanes}>"),
        None => result::array_of(&lanes, function.quantities()[0], printed.sizes),
    }
}

fn structure(text: &mut String, printed: &Printed<'_>) {
    let (function, sizes) = (printed.function, printed.sizes);
    let Some(name) = function.structure() else {
        return;
    };
    let _ = writeln!(
        text,
        "/// What [`{function}_lanes`] returns: [`{name}`] with the lanes of every number.\n\
         #[derive(Clone, Copy, Debug, PartialEq)]\npub struct {name}Lanes<const L: usize> {{"
    );
    result::fields(
        text,
        function,
        &format!("[{}; L]", printed.code.scalar),
        sizes,
    );
    text.push_str("}\n\n");
}

/// Sines of all lanes: a loop for what is computed angle by angle, and one call
/// for what is called together.
fn write_sines(text: &mut String, printed: &Printed<'_>, around: &Around<'_>) {
    let code = printed.code;
    let together = |trig: &LoweredTrig| trig::is_together(trig, code);
    let (mut arrays, mut lines) = (String::new(), String::new());
    let mut array = |name: String| {
        let _ = writeln!(arrays, "    let mut {name} = [0.0; L];");
    };
    let scope = Scope::LANE;
    for trig in &code.trig {
        let angle = trig.angle;
        let is_sum = angle.additions() > 0;
        if together(trig) {
            if is_sum {
                array(format!("a{angle}"));
                let _ = writeln!(lines, "        a{angle}[l] = {};", scope.sum(angle));
            }
            continue;
        }
        if is_sum {
            let _ = writeln!(lines, "        let a{angle} = {};", scope.sum(angle));
        }
        for (taken, letter) in [(trig.sin, 's'), (trig.cos, 'c')] {
            if taken {
                array(format!("{letter}{angle}"));
            }
        }
        trig::alone(&mut lines, trig, scope, code, around.path);
    }
    if !lines.is_empty() {
        let _ = writeln!(text, "{arrays}    for l in 0..L {{\n{lines}    }}");
    }
    // The joints' positions are arrays of lanes already.
    let angle = |trig: &LoweredTrig| Scope::STATE.angle(trig.angle);
    trig::together(text, code, around.path, "_lanes", angle);
}

/// Declares where the results go.
fn zeros(text: &mut String, printed: &Printed<'_>) {
    let (function, sizes) = (printed.function, printed.sizes);
    let zeros = |quantity| result::array_of("[0.0; L]", quantity, sizes);
    let value = match function.structure() {
        None if function == Function::Load => {
            format!("{LOAD}({})", zeros(function.quantities()[0]))
        }
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
