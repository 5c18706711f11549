//! `NAME_with_sincos`: all of the function but its sines, which callers bring.
//!
//! ```text
//! pub fn gravity_with_sincos(_q: &[f64; 2], sin: &[f64; 2], cos: &[f64; 2]) -> [f64; 2] {
//!     let (s1, c1) = (sin[0], cos[0]);
//!     let t1 = c1 * 0.5;
//!     …
//! }
//! ```

use std::fmt::Write;

use super::Around;
use super::angles::list;
use crate::language::scope::Scope;
use crate::language::{Printed, function};
use crate::program::LoweredTrig;

/// Prints it.
pub(super) fn write(text: &mut String, printed: &Printed<'_>, around: &Around<'_>) {
    let name = printed.function.name();
    doc(text, printed);
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "#[inline(always)]\n#[must_use]\npub fn {name}_with_sincos({}) -> {} {{",
        parameters(printed, around).join(", "),
        function::result_type(printed.function, printed.sizes, printed.code.scalar)
    );
    for trig in &printed.code.trig {
        let Some(at) = around.angles.place(trig.angle) else {
            continue;
        };
        let value = match (trig.sin, trig.cos) {
            (true, false) => format!("sin[{at}]"),
            (false, true) => format!("cos[{at}]"),
            _ => format!("(sin[{at}], cos[{at}])"),
        };
        let _ = writeln!(text, "    let {} = {value};", Scope::STATE.pair(trig));
    }
    function::write_body(text, printed, around.path);
    text.push_str("}\n");
}

fn doc(text: &mut String, printed: &Printed<'_>) {
    let name = printed.function.name();
    let read = |what: &str, taken: fn(&LoweredTrig) -> bool| {
        let trigs = printed.code.trig.iter().filter(|trig| taken(trig));
        let angles = list(trigs.map(|trig| trig.angle));
        match angles.is_empty() {
            true => format!("no {what}"),
            false => format!("the {what} of {angles}"),
        }
    };
    let (sines, cosines) = (read("sines", |t| t.sin), read("cosines", |t| t.cos));
    let _ = writeln!(
        text,
        "/// [`{name}`] for a caller who has the sines and cosines of [`angles`], an entry each: it\n\
         /// reads {sines} and {cosines}. From sines\n\
         /// as [`{name}`] takes them come its results, bit for bit."
    );
}

/// Returns the arguments and the two arrays; what is not read has a `_` before its name.
fn parameters(printed: &Printed<'_>, around: &Around<'_>) -> Vec<String> {
    let (scalar, count) = (printed.code.scalar, around.angles.count());
    let mark = |read: bool| if read { "" } else { "_" };
    let arguments = printed.arguments.iter().map(|&argument| {
        let mark = mark(function::reads_entry(printed.code, argument));
        let kind = function::argument_type(argument, printed.sizes, scalar);
        format!("{mark}{}: &{kind}", argument.name())
    });
    let (sin, cos) = (
        printed.code.trig.iter().any(|trig| trig.sin),
        printed.code.trig.iter().any(|trig| trig.cos),
    );
    let pair = [("sin", sin), ("cos", cos)]
        .map(|(name, read)| format!("{}{name}: &[{scalar}; {count}]", mark(read)));
    arguments.chain(pair).collect()
}
