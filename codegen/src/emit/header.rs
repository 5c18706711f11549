//! The header of a robot in C or CUDA: guard, macros, sines, structs and functions of each scalar.

use std::collections::BTreeSet;

use dalembert_model::outputs::RuntimeParameter;

use super::arguments::{bodies_c, meaning, payload_c, places_c};
use super::module::{function_doc, header};
use super::state_box::StateBox;
use super::{GeneratedFunction, c_sines, parameters, said};
use crate::function::Function;
use crate::language::c99::{self, LONGEST, Names};
use crate::language::{self, Language, columns};
use crate::program::{Code, Library, ScalarType};
use crate::task::{Job, Request};

/// gcc, which fuses products and sums by itself where the processor can: in straight lines of
/// alternating sums and differences (`tree-slp-vectorize`) whatever it is told of contraction. It
/// inlines only functions that have the options of those that call them, and makes no vectors
/// without masks where it first computes (`tree-pre`) what follows of an angle that is far.
const GCC: &str = "defined(__GNUC__) && !defined(__clang__)";

const PRODUCTS: &str = "
/* Each operation is rounded, on the device too: no product becomes one with a sum. */
#if defined(__CUDA_ARCH__)
#define DALEMBERT_MUL(a, b) __dmul_rn((a), (b))
#define DALEMBERT_MULF(a, b) __fmul_rn((a), (b))
#else
#define DALEMBERT_MUL(a, b) ((a) * (b))
#define DALEMBERT_MULF(a, b) ((a) * (b))
#endif
";

const NO_PRODUCTS: &str = "
#undef DALEMBERT_MUL
#undef DALEMBERT_MULF
";

pub(crate) fn misnamed(base: &str, functions: &[Function], request: &Request) -> Option<String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !base.starts_with(|c: char| c.is_ascii_alphabetic()) || !base.chars().all(plain) {
        return Some(base.to_owned());
    }
    let mut words: Vec<String> = ["sincos_t", "in_box"].map(String::from).into();
    let takes = |parameter: &RuntimeParameter| request.parameters.contains(parameter);
    let is_loaded = RuntimeParameter::LOADING.iter().any(takes);
    let load = is_loaded.then_some(Function::Load);
    if takes(&RuntimeParameter::Payload) {
        words.extend(["payload", "payload_t"].map(String::from));
    }
    if takes(&RuntimeParameter::Bodies) {
        let of_bodies = ["body", "body_t", "bodies", "bodies_t", "with_body"];
        words.extend(of_bodies.map(String::from));
    }
    for function in functions.iter().chain(&load) {
        words.push(function.name().to_owned());
        if request.batch {
            words.extend(["any", "batch"].map(|word| format!("{function}_{word}")));
        }
        if c99::is_bundle(*function) {
            words.push(format!("{}_t", function.name()));
        }
        let constant = parameters::name(*function).map(str::to_lowercase);
        words.extend(constant.filter(|constant| !words.contains(constant)));
    }
    let scalars = request.scalars.iter();
    let names = scalars.map(|&scalar| Names::new(base, Language::C, scalar));
    let names = names.flat_map(|names| words.iter().map(move |word| names.with_limit(word)));
    let macros = ["RESTRICT", "UNFUSED", "SIMD", "FORGET", "FOUR"].map(|word| {
        let name = Names::new(base, Language::C, ScalarType::F64).constant(word);
        (name, LONGEST)
    });
    let mut unique_names = BTreeSet::new();
    let mut names = names.chain(macros);
    let bad_name =
        names.find(|(name, limit)| name.len() > *limit || !unique_names.insert(name.clone()));
    bad_name.map(|(name, _)| name)
}

/// The macros of functions with lanes, `ARM` being the header's name.
const LANES: &str = "
/* What lanes read and write is in an array, of whose values the compiler forgets what it knows. */
#if defined(__clang__)
#define ARM_FORGET(array) __asm__(\"\" : \"+m\"(array))
#else
#define ARM_FORGET(array)
#endif

/* Four results beside one another are stored at once; some processors align doubles to four bytes. */
#if defined(__GNUC__)
#define ARM_FOUR(real, to, a, b, c, d) do { typedef real ARM_FOUR_T __attribute__((__vector_size__(4 * sizeof(real)), __aligned__(4), __may_alias__)); const ARM_FOUR_T ARM_FOUR_V = {a, b, c, d}; *(ARM_FOUR_T *)(to) = ARM_FOUR_V; } while (0)
#else
#define ARM_FOUR(real, to, a, b, c, d) do { (to)[0] = (a); (to)[1] = (b); (to)[2] = (c); (to)[3] = (d); } while (0)
#endif
";

pub(crate) fn write(
    job: &Job<'_>,
    functions: &[GeneratedFunction],
    codes: &[(ScalarType, Vec<Code>)],
    note: Option<&str>,
) -> String {
    let (robot, setup, request) = (job.robot, job.setup, job.request);
    let name = request.module_name(robot);
    let names = Names::new(&name, request.language, ScalarType::F64);
    let mut text = String::new();
    let guard = names.constant(match request.language {
        Language::Cuda => "CUH",
        Language::C | Language::Rust => "H",
    });
    let (restrict, unfused) = (names.constant("RESTRICT"), names.constant("UNFUSED"));
    let codes_of = || codes.iter().flat_map(|(_, codes)| codes);
    let calls = |code: &&Code| code.pairs.iter().any(|pair| pair.kernel.is_none());
    let is_fused = |code: &&Code| code.counts().fma > 0;
    let needs_math =
        codes_of().any(|code| calls(&code) || is_fused(&code) || !code.speeds.is_empty());
    let includes = [("math", needs_math), ("stddef", request.batch)]
        .map(|(name, is_needed)| match is_needed {
            true => format!("#include <{name}.h>\n"),
            false => String::new(),
        })
        .concat();
    let has_loops = request.batch && request.language == Language::C;
    let options = if has_loops { ", \"no-tree-pre\"" } else { "" };
    text += &format!(
        "#ifndef {guard}\n#define {guard}\n\n\
         #ifdef __FAST_MATH__\n\
         #error \"-ffast-math changes what is computed: compile without it\"\n\
         #endif\n\
         #if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16\n\
         #error \"operations are not rounded to their type: compile with -msse2 -mfpmath=sse\"\n\
         #endif\n\n{includes}\n\
         /* No array overlaps another one that is written. */\n\
         #ifdef __cplusplus\n#define {restrict}\n#else\n#define {restrict} restrict\n#endif\n\n\
         /* Each operation is rounded: no product and sum become one that is not written so. */\n\
         #if defined(__clang__)\n\
         #define {unfused} _Pragma(\"STDC FP_CONTRACT OFF\")\n\
         #else\n#define {unfused}\n#endif\n\
         #if {GCC}\n\
         #pragma GCC push_options\n\
         #pragma GCC optimize (\"fp-contract=off\", \"no-tree-slp-vectorize\"{options})\n\
         #endif\n"
    );
    if request.language == Language::Cuda {
        text.push_str(PRODUCTS);
    } else if has_loops {
        let simd = names.constant("SIMD");
        // It warns where it cannot, of loops that call the C library.
        let calls_libm = codes_of().any(|code| calls(&code) && code.library == Library::Libm);
        let clang = match calls_libm {
            true => String::new(),
            false => format!(
                "#elif defined(__clang__)\n\
                 #define {simd} _Pragma(\"clang loop vectorize(assume_safety)\")\n"
            ),
        };
        text += &format!(
            "\n/* States of a batch are independent of one another. */\n\
             #if {GCC}\n\
             #define {simd} _Pragma(\"GCC ivdep\")\n\
             {clang}#elif defined(_OPENMP)\n\
             #define {simd} _Pragma(\"omp simd\")\n\
             #else\n#define {simd}\n#endif\n"
        );
    }
    if codes_of().any(|code| c99::has_vectors(code, &names)) {
        text += &LANES.replace("ARM", &names.macros());
    }
    text += &places_c(setup.robot(), &names);
    for &(scalar, ref codes) in codes {
        let names = Names::new(&name, request.language, scalar);
        let mut lines = header(robot, setup, functions, scalar);
        if let Some(note) = note {
            lines.extend([String::new(), format!("Note: {note}.")]);
        }
        comment(&mut text, &lines);
        let is_batch = request.batch;
        let joints = functions.iter().map(|function| function.program.joints);
        c_sines::write(&mut text, joints.zip(codes), &names, is_batch);
        if let Some(state_box) = StateBox::of(functions, setup, scalar) {
            state_box.write_c(&mut text, scalar, &names);
        }
        let is_load = |generated: &GeneratedFunction| generated.function == Function::Load;
        if functions.iter().any(is_load) {
            let has_payload = setup.has(RuntimeParameter::Payload);
            let payload = has_payload.then(|| payload_c(setup, &names));
            for (doc, definition) in payload.into_iter().chain(bodies_c(setup, &names)) {
                comment(&mut text, &doc);
                text += &definition;
            }
        }
        for (index, (generated, code)) in functions.iter().zip(codes).enumerate() {
            // One π for all that are over the same columns.
            let (function, mut earlier) = (generated.function, functions[..index].iter());
            if !earlier.any(|other| other.function.columns() == function.columns()) {
                text.push_str(&parameters::write_c(function, setup, &names));
            }
            let (program, sizes) = (&generated.program, generated.program.sizes());
            if let Some(structure) = c99::structure(program, &names) {
                text += &format!("\n{structure}");
            }
            let mut doc = function_doc(job, generated, scalar);
            let of_rust = said::fused(program);
            if !of_rust.is_empty() {
                doc.retain(|line| line.is_empty() || !of_rust.contains(line));
                let of_c = "A product and the sum that alone reads it are one operation, `fma`, rounded \
                            once: slow on a processor that has none.";
                doc.push(of_c.to_owned());
            }
            if let Some(constant) = parameters::name(function) {
                let symbol = names.of(&constant.to_lowercase());
                for line in &mut doc {
                    *line = line.replace(constant, &symbol);
                }
            }
            doc.push(String::new());
            for argument in &program.arguments {
                let (name, meaning) = (argument.name(), meaning(*argument, setup.robot()));
                let length = match c99::argument_structure(*argument, &names) {
                    Some(_) => String::new(),
                    None => format!("[{}]", argument.length(sizes)),
                };
                doc.push(format!("{name}{length}: {meaning}"));
            }
            for quantity in function.quantities() {
                let entries = 0..quantity.len(sizes);
                let (rows, robot) = (setup.rows(), setup.robot());
                let entry_units = entries.map(|i| quantity.unit(i, rows, sizes, robot));
                let units = units_in_order(entry_units, quantity.shape().0.len() > 1);
                doc.push(format!("{}{units}", c99::shaped(*quantity, sizes)));
            }
            comment(&mut text, &doc);
            let is_told = is_batch && c99::is_told(code, &names);
            text.push_str(&c99::write(program, code, &names, is_told));
            if is_told {
                text += &format!("\n{}", c99::single(program, &names));
            }
            if is_batch {
                text += &format!("\n{}", columns::batch(program, code, &names));
            }
        }
    }
    if request.language == Language::Cuda {
        text.push_str(NO_PRODUCTS);
    }
    text += &format!("\n#if {GCC}\n#pragma GCC pop_options\n#endif\n\n#endif\n");
    text
}

/// Says the units of entries in their order; of a matrix each unit once, since its rows have them in turn.
fn units_in_order<'u>(units: impl Iterator<Item = &'u str>, is_matrix: bool) -> String {
    let mut units: Vec<&str> = units.collect();
    if is_matrix {
        let mut unique_units = BTreeSet::new();
        units.retain(|unit| unique_units.insert(*unit));
    } else {
        units.dedup();
        units.truncate(4);
    }
    match units.iter().any(|unit| !unit.is_empty()) {
        true => format!(" Units: {}.", units.join(", ")),
        false => String::new(),
    }
}

fn comment(text: &mut String, lines: &[String]) {
    let lines: Vec<String> = lines.iter().map(|line| plain(line)).collect();
    *text += &format!("\n/*\n{} */\n", language::comment(" *", &lines));
}

/// Returns a line that ends no comment and begins none; without the marks of Rust's documentation.
fn plain(line: &str) -> String {
    let words = line.replace("[`", "`").replace("`]", "`").replace('\\', "");
    let ends = words.replace("*/", "* /").replace("/*", "/ *");
    ends.replace("??", "? ?")
}
