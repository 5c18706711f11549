//! Functions of any number of states in columns: entry i of state s stands at `i * n + s`. In C
//! that is `NAME_batch`, in CUDA a kernel; in Rust `NAME_columns`, by the crate `dalembert-batch`,
//! which asks the processor what vectors it has.
//!
//! The type `…Batch` tells that crate about the function, and has its arithmetic over vectors:
//!
//! ```text
//! fn angles<V: dalembert_batch::Floats<f64>>(entries: &[V; 2]) -> [V; 1] {
//!     [entries[0]]
//! }
//!
//! fn vectors<V: dalembert_batch::Vector<f64>>(entries: &[V; 2], &[s1]: &[V; 1], &[c1]: &[V; 1]) -> [V; 2] {
//!     let of = entries[0];
//!     let q = &entries[0..2];
//!     let t1 = c1 * of.all(0.5);
//!     …
//! }
//! ```
//!
//! It is a text of its own, since one that both took would slow down the other: unoptimised, each
//! operator of a generic type is a call.

use super::c99::{
    Names, argument_structure, float, is_bundle, is_number, is_told, largest, structure_name,
};
use super::dialect::{Dialect, Lines};
use super::{Language, function, list, trig};
use crate::function::{Argument, Function};
use crate::program::{Code, Literal, Program};

/// In u; the documentation of `dalembert-sines` proves it.
const FUSED_ERROR: f64 = 0.83;

/// True if a function has a second one for batches. In Rust `load` has none: each row is one call.
pub(crate) fn are_there(function: Function, language: Language) -> bool {
    language != Language::Rust || function != Function::Load
}

pub(crate) fn columns(program: &Program, code: &Code) -> String {
    let name = program.function.name();
    let kind = format!("{}Batch", program.function.camel());
    let scalar = code.scalar;
    let (inputs, results) = (entries(program), code.dag.outputs.len());
    let taken = trig::taken(code).count();
    let sizes = format!("{inputs}, {results}, {taken}");
    let bits = match fuses_sines(code) {
        false => {
            "/// the processor has; bit for bit the results that each has alone, or a NaN for a NaN.".to_owned()
        }
        true => format!(
            "/// the processor has: the same bits on every one, but not those of [`{name}`]. Products are fused\n\
             /// in the sines and cosines as well, which are proved to err by at most {FUSED_ERROR} u, u = {}, up to\n\
             /// {:?} rad; beyond, they are libm's.",
            scalar.of("2⁻⁵³", "2⁻²⁴"),
            largest(scalar)
        ),
    };
    let mut text = format!(
        "/// [`{name}`] as the functions of `dalembert-batch` take it.\n\
         #[derive(Clone, Copy, Debug)]\npub struct {kind};\n\n\
         impl dalembert_batch::Function<{sizes}> for {kind} {{\n    \
         type Scalar = {scalar};\n"
    );
    if fuses_sines(code) {
        text.push_str("    const FUSED: bool = true;\n");
    }
    text.push('\n');
    write_vectors(&mut text, program, code);
    let parameters = program.arguments.iter().map(|&argument| {
        let kind = match function::named_type(argument) {
            Some(kind) => format!("[{kind}]"),
            None => format!("[&[{scalar}]; {}]", argument.length(program.sizes())),
        };
        format!("{}: &{kind}, ", argument.name())
    });
    let (mut passed, mut rows) = (Vec::new(), 0);
    for argument in &program.arguments {
        let name = argument.name();
        passed.push(match function::named_type(*argument) {
            Some(_) => format!("dalembert_batch::Argument::Rows(&{name})"),
            None => format!("dalembert_batch::Argument::Columns({name})"),
        });
        if function::named_type(*argument).is_some() {
            rows += argument.length(program.sizes());
        }
    }
    let of_rows = match rows {
        0 => "",
        _ => "\n/// Slices of `Load` or `Gravity` have one element a state, or one for all states.",
    };
    text += &format!(
        "}}\n\n/// [`{name}`] at any number of states in columns: a slice for every entry of an argument, and of\n\
         /// the result in the order of its text. It is computed with the vectors that\n\
         {bits}{of_rows}\n\
         ///\n/// # Errors\n/// The slices are of different lengths; then nothing is computed.\n\
         pub fn {name}_columns({}results: &mut [&mut [{scalar}]; {results}]) -> Result<(), dalembert_batch::Unequal> {{\n    \
         let arguments = [{}];\n    \
         dalembert_batch::columns::<{kind}, {sizes}, {rows}>(&arguments, results)\n}}\n",
        parameters.collect::<String>(),
        passed.join(", "),
    );
    text
}

fn entries(program: &Program) -> usize {
    let (sizes, arguments) = (program.sizes(), program.arguments.iter());
    arguments.map(|argument| argument.length(sizes)).sum()
}

fn fuses_sines(code: &Code) -> bool {
    code.counts().fma > 0 && trig::taken(code).next().is_some()
}

fn write_vectors(text: &mut String, program: &Program, code: &Code) {
    let dialect = Dialect::vectors(code.scalar);
    let mut body = String::new();
    trig::write_each(&mut body, code, dialect, |function, angle| {
        let method = if function == "sincos" { "both" } else { "each" };
        let suffix = code.scalar.math_suffix();
        format!("{angle}.{method}(libm::{function}{suffix})")
    });
    trig::write_speeds(&mut body, dialect, code, "dalembert_batch");
    function::write_steps(&mut body, code, dialect);
    let results = list(Lines::new(dialect, code).results());
    let (mut slices, mut begin) = (String::new(), 0);
    for argument in &program.arguments {
        let end = begin + argument.length(program.sizes());
        let name = argument.name();
        slices += &format!("        let {name} = &entries[{begin}..{end}];\n");
        begin = end;
    }
    let count = code.dag.outputs.len();
    let ([sin, cos], taken) = (trig::taken_names(code), trig::taken(code).count());
    // Positions are the first entries.
    let angles = list(trig::taken(code).map(|pair| format!("entries[{}]", pair.joint)));
    let (scalar, inputs) = (code.scalar, entries(program));
    *text += &format!(
        "{METHOD} angles<V: dalembert_batch::Floats<{scalar}>>(entries: &[V; {inputs}]) -> [V; {taken}] {{\n        \
         [{angles}]\n    }}\n\n\
         {METHOD} vectors<V: dalembert_batch::Vector<{scalar}>>(entries: &[V; {inputs}], \
         &[{sin}]: &[V; {taken}], &[{cos}]: &[V; {taken}]) -> [V; {count}] {{\n        \
         let of = entries[0];\n{slices}"
    );
    for line in body.lines() {
        *text += &format!("    {line}\n");
    }
    *text += &format!("        [{results}]\n    }}\n");
}

/// A function may read some of the entries only.
const METHOD: &str = "    #[inline(always)]\n    #[allow(unused_variables)]\n    fn";

#[derive(Default)]
struct Columns {
    parameters: Vec<String>,
    gathered: String,
    passed: Vec<String>,
    stored: String,
    /// The declaration of a load, where the function takes one: one for all states, and one a state.
    load: Option<[String; 2]>,
}

impl Columns {
    fn of(program: &Program, names: &Names, restrict: &str) -> Columns {
        let (function, sizes) = (program.function, program.sizes());
        let float = float(names.dialect().scalar);
        let mut columns = Columns::default();
        let parameters = &mut columns.parameters;
        parameters.push("const size_t n".to_owned());
        let at = |index: usize| entry(index, ["n", "s"]);
        // A thread of a kernel may be of another state than its load.
        let of_load = match names.language {
            Language::Cuda => ["loads", "l"],
            Language::C | Language::Rust => ["n", "s"],
        };
        for &argument in &program.arguments {
            let (name, length) = (argument.name(), argument.length(sizes));
            if argument == Argument::Load {
                let kind = argument_structure(argument, names).unwrap_or_default();
                let one = list((0..length).map(|index| format!("load[{index}]")));
                let per_state = (0..length).map(|index| format!("load[{}]", entry(index, of_load)));
                let declared =
                    |entries| format!("        const {kind} load_s[1] = {{{{{{{entries}}}}}}};\n");
                columns.load = Some([one, list(per_state)].map(declared));
                parameters.push("const size_t loads".to_owned());
                parameters.push(format!("const {float} *{restrict} load"));
                columns.passed.push("load_s".to_owned());
                continue;
            }
            parameters.push(format!("const {float} *{restrict} {name}"));
            let entries = list((0..length).map(|index| format!("{name}[{}]", at(index))));
            columns.gathered += &match argument_structure(argument, names) {
                Some(kind) => {
                    format!("        const {kind} {name}_s[1] = {{{{{{{entries}}}}}}};\n")
                }
                None => format!("        const {float} {name}_s[{length}] = {{{entries}}};\n"),
            };
            columns.passed.push(format!("{name}_s"));
        }
        if is_bundle(function) && !is_number(function) {
            let kind = structure_name(function, names);
            columns.gathered += &format!("        {kind} result_s[1];\n");
            columns.passed.push("result_s".to_owned());
        }
        for quantity in function.quantities() {
            let (field, length) = (quantity.field(), quantity.len(sizes));
            parameters.push(format!("{float} *{restrict} {field}"));
            if is_number(function) {
                continue;
            }
            let mut array = format!("result_s->{field}");
            if !is_bundle(function) {
                array = format!("{field}_s");
                columns.gathered += &format!("        {float} {array}[{length}];\n");
                columns.passed.push(array.clone());
            }
            for index in 0..length {
                let place = at(index);
                columns.stored += &format!("        {field}[{place}] = {array}[{index}];\n");
            }
        }
        columns
    }

    fn call(&self, function: Function, names: &Names, is_told: bool) -> String {
        let passed = self.passed.join(", ");
        let mut call = match is_told {
            true => format!("{}(0, {passed})", names.of(&format!("{function}_any"))),
            false => format!("{}({passed})", names.of(function.name())),
        };
        if is_number(function) {
            call = format!("{}[s] = {call}", function.quantities()[0].field());
        }
        format!("        {call};\n{}", self.stored)
    }
}

pub(crate) fn batch(program: &Program, code: &Code, names: &Names) -> String {
    if names.language == Language::Cuda {
        return kernel(program, names);
    }
    let [restrict, simd] = ["RESTRICT", "SIMD"].map(|word| names.constant(word));
    let (is_told, function) = (is_told(code, names), program.function);
    let columns = Columns::of(program, names, &restrict);
    let gathered = &columns.gathered;
    let body = |load: &str, is_told: bool, when: &str| {
        let call = columns.call(function, names, is_told);
        format!("    for (s = 0U; s < n; ++s) {{\n{load}{gathered}{when}{call}    }}\n")
    };
    let mut near_enough = None;
    if is_told {
        let (scalar, joints) = (code.scalar, program.joints);
        let far = largest(scalar) / joints.next_power_of_two() as f64;
        let (far, f) = (names.dialect().literal(Literal(far)), scalar.math_suffix());
        let angles = (0..joints).map(|joint| format!("(fabs{f}(q_s[{joint}]) <= {far})"));
        let near = angles.collect::<Vec<String>>().join(" && ");
        let when = format!("        if ({near}) {{\n            continue;\n        }}\n");
        near_enough = Some(when);
    }
    let loops = |load: &str| {
        let again = near_enough
            .as_ref()
            .map(|skip_near| body(load, false, skip_near));
        let far_states = again.unwrap_or_default();
        format!("    {simd}\n{}{far_states}", body(load, is_told, ""))
    };
    let (loops, of_load) = match &columns.load {
        None => (loops(""), ""),
        Some([one, per_state]) => {
            let (shared, alone) = (loops(""), loops(per_state));
            let head = format!("    if (loads == 1U) {{\n{one}{shared}");
            (format!("{head}    }} else {{\n{alone}    }}\n"), LOADS)
        }
    };
    format!(
        "/* {} at n states, in columns: entry i of state s stands at i * n + s.{of_load} Each state\n \
         * has the results that it has alone, bit for bit. */\n\
         #if defined(__GNUC__)\n__attribute__((flatten))\n#endif\n\
         static inline void {}({})\n{{\n    size_t s;\n{loops}}}\n",
        names.of(function.name()),
        names.of(&format!("{function}_batch")),
        columns.parameters.join(", "),
    )
}

fn entry(index: usize, [count, one]: [&str; 2]) -> String {
    match index {
        0 => one.to_owned(),
        1 => format!("{count} + {one}"),
        more => format!("({more}U * {count}) + {one}"),
    }
}

const LOADS: &str = " There are n\n * loads, or 1 for all states.";

/// Each thread takes its own state, then every state after as many as there are threads.
fn kernel(program: &Program, names: &Names) -> String {
    let function = program.function;
    let columns = Columns::of(program, names, "__restrict__");
    let (load, of_load) = match &columns.load {
        None => (String::new(), ""),
        Some([_, per_state]) => {
            let place = "        const size_t l = (loads == 1U) ? 0U : s;\n";
            (format!("{place}{per_state}"), LOADS)
        }
    };
    format!(
        "/* {} at n states, in columns: entry i of state s stands at i * n + s.{of_load} Any number of\n \
         * threads in one dimension: each takes a state, then the one as many further on as there are\n \
         * threads. Each state has the results that it has alone, bit for bit. */\n\
         static __global__ void {}({})\n{{\n    \
         const size_t threads = (size_t)gridDim.x * blockDim.x;\n    size_t s;\n    \
         for (s = ((size_t)blockIdx.x * blockDim.x) + threadIdx.x; s < n; s += threads) {{\n{load}{}{}    }}\n}}\n",
        names.of(function.name()),
        names.of(&format!("{function}_batch")),
        columns.parameters.join(", "),
        columns.gathered,
        columns.call(function, names, false)
    )
}
