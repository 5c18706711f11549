//! Functions of any number of states in C and CUDA, in columns: entry i of state s stands at
//! `i * n + s`.

use crate::function::Function;
use crate::language::c99::{
    Names, argument_structure, float, is_bundle, is_number, is_told, largest, structure_name,
};
use crate::language::{Language, list};
use crate::program::{Code, Literal, Program};

struct Columns {
    parameters: Vec<String>,
    gathered: String,
    passed: Vec<String>,
    stored: String,
}

impl Columns {
    /// Returns columns in which entry i of state s is at `i * n + s`.
    fn of(program: &Program, names: &Names, restrict: &str) -> Columns {
        let (function, sizes) = (program.function, program.sizes());
        let float = float(names.dialect().scalar);
        let (mut parameters, mut passed) = (vec!["const size_t n".to_owned()], Vec::new());
        let (mut gathered, mut stored) = (String::new(), String::new());
        let at = |index: usize| match index {
            0 => "s".to_owned(),
            1 => "n + s".to_owned(),
            more => format!("({more}U * n) + s"),
        };
        for &argument in &program.arguments {
            let (name, length) = (argument.name(), argument.length(sizes));
            parameters.push(format!("const {float} *{restrict} {name}"));
            let entries = list((0..length).map(|index| format!("{name}[{}]", at(index))));
            gathered += &match argument_structure(argument, names) {
                Some(kind) => {
                    format!("        const {kind} {name}_s[1] = {{{{{{{entries}}}}}}};\n")
                }
                None => format!("        const {float} {name}_s[{length}] = {{{entries}}};\n"),
            };
            passed.push(format!("{name}_s"));
        }
        if is_bundle(function) && !is_number(function) {
            let kind = structure_name(function, names);
            gathered += &format!("        {kind} result_s[1];\n");
            passed.push("result_s".to_owned());
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
                gathered += &format!("        {float} {array}[{length}];\n");
                passed.push(array.clone());
            }
            for index in 0..length {
                let place = at(index);
                stored += &format!("        {field}[{place}] = {array}[{index}];\n");
            }
        }
        Columns {
            parameters,
            gathered,
            passed,
            stored,
        }
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
    if names.language() == Language::Cuda {
        return kernel(program, names);
    }
    let [restrict, simd] = ["RESTRICT", "SIMD"].map(|word| names.constant(word));
    let (is_told, function) = (is_told(code, names), program.function);
    let columns = Columns::of(program, names, &restrict);
    let gathered = &columns.gathered;
    let body = |is_told: bool, when: &str| {
        let call = columns.call(function, names, is_told);
        format!("    for (s = 0U; s < n; ++s) {{\n{gathered}{when}{call}    }}\n")
    };
    let mut again = String::new();
    if is_told {
        let (scalar, joints) = (code.scalar, program.joints);
        let far = largest(scalar) / joints.next_power_of_two() as f64;
        let (far, f) = (names.dialect().literal(Literal(far)), scalar.math_suffix());
        let near = (0..joints).map(|joint| format!("(fabs{f}(q_s[{joint}]) <= {far})"));
        let near = near.collect::<Vec<String>>().join(" && ");
        let when = format!("        if ({near}) {{\n            continue;\n        }}\n");
        again = body(false, &when);
    }
    format!(
        "/* {} at n states, in columns: entry i of state s stands at i * n + s. Each state\n \
         * has the results that it has alone, bit for bit. */\n\
         #if defined(__GNUC__)\n__attribute__((flatten))\n#endif\n\
         static inline void {}({})\n{{\n    size_t s;\n    {simd}\n{}{again}}}\n",
        names.of(function.name()),
        names.of(&format!("{function}_batch")),
        columns.parameters.join(", "),
        body(is_told, "")
    )
}

/// Each thread takes its own state, then every state after as many as there are threads.
fn kernel(program: &Program, names: &Names) -> String {
    let function = program.function;
    let columns = Columns::of(program, names, "__restrict__");
    format!(
        "/* {} at n states, in columns: entry i of state s stands at i * n + s. Any number of\n \
         * threads in one dimension: each takes a state, then the one as many further on as there are\n \
         * threads. Each state has the results that it has alone, bit for bit. */\n\
         static __global__ void {}({})\n{{\n    \
         const size_t threads = (size_t)gridDim.x * blockDim.x;\n    size_t s;\n    \
         for (s = ((size_t)blockIdx.x * blockDim.x) + threadIdx.x; s < n; s += threads) {{\n{}{}    }}\n}}\n",
        names.of(function.name()),
        names.of(&format!("{function}_batch")),
        columns.parameters.join(", "),
        columns.gathered,
        columns.call(function, names, false)
    )
}
