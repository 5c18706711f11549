//! Functions in C99 and CUDA.
//!
//! ```text
//! static inline void arm_gravity(const double q[ARM_RESTRICT 2], double c[ARM_RESTRICT 2])
//! {
//!     ARM_UNFUSED
//!     const double s1 = sin(q[0]);
//!     const double t1 = s1 * 0.5;
//!     c[0] = t1;
//!     c[1] = -t1;
//! }
//! ```

use super::Source;
use super::reader::{Read, Reader, commas, joint_of};
use super::tokens::whole;
use crate::program::Operand;

/// The names of a function in a header.
#[derive(Clone, Debug, Default)]
pub struct Symbols {
    /// The beginning of macros.
    pub macros: String,
    /// The beginning of the header's other functions of the scalar.
    pub prefix: String,
    /// The function of one state.
    pub single: String,
    /// The function that is told whether an angle may be far, if there is one.
    pub any: String,
    /// The function of any number of states.
    pub batch: String,
    /// The struct that holds the results, if one does.
    pub structure: Option<String>,
    /// `true` in CUDA.
    pub is_cuda: bool,
}

/// A parameter: its kind, its name and how many numbers it has.
type Parameter = (String, String, usize);

fn count((kind, _, length): &Parameter) -> usize {
    if kind.ends_with("_t") { 1 } else { *length }
}

impl<'r> Reader<'r> {
    pub(super) fn c(&mut self, symbols: &Symbols, has_batch: bool) -> Read<()> {
        let inline = match symbols.is_cuda {
            true => "static __host__ __device__ inline",
            false => "static inline",
        };
        let (returned, back) = match self.is_number() {
            true => (self.head.float(), "return "),
            false => ("void", ""),
        };
        let (parameters, macros) = (self.parameters(symbols), &symbols.macros);
        let list = commas(parameters.iter().map(|parameter| {
            let (kind, name, count) = (&parameter.0, &parameter.1, count(parameter));
            format!("{kind} {name}[{macros}_RESTRICT {count}]")
        }));
        let structure = self.structure(symbols);
        let head = |name: &str, far: &str| {
            format!("{structure} {inline} {returned} {name}({far}{list}) {{ {macros}_UNFUSED")
        };
        let any = &symbols.any;
        let mut heads = vec![head(&symbols.single, "")];
        if !any.is_empty() {
            heads.insert(0, head(any, "const int far, "));
        }
        let is_told = self.begin(&heads)? + 1 < heads.len();
        self.c_statements(symbols, is_told)?;
        let results = self.c_results(symbols);
        self.results(&format!("{results} }}"))?;
        if is_told {
            let passed = commas(parameters.iter().map(|parameter| parameter.1.clone()));
            let single = &symbols.single;
            self.expect_all(&format!(
                "{inline} {returned} {single}({list}) {{ {back}{any}(1, {passed}); }}"
            ))?;
        }
        if has_batch {
            let text = self.batch(symbols, is_told, &parameters);
            self.expect_all(&text)?;
        }
        Ok(())
    }

    fn structure(&self, symbols: &Symbols) -> String {
        let Some(name) = &symbols.structure else {
            return String::new();
        };
        let float = self.head.float();
        let field = |(field, length)| format!("{float} {field}[{length}]; ");
        let fields: String = self.head.lengths().map(field).collect();
        format!("typedef struct {{ {fields} }} {name};")
    }

    fn is_number(&self) -> bool {
        let is_struct = self.symbols.is_some_and(|names| names.structure.is_some());
        !is_struct && self.head.fields.iter().all(|(_, shape)| shape.is_empty())
    }

    fn parameters(&self, symbols: &Symbols) -> Vec<Parameter> {
        let float = self.head.float();
        let arguments = self.head.arguments.iter().map(|argument| {
            let kind = match argument.is_struct() {
                true => format!("const {}_{}_t", symbols.prefix, argument.name),
                false => format!("const {float}"),
            };
            (kind, argument.name.to_owned(), argument.length)
        });
        let result = |(name, length): (&str, usize)| (float.to_owned(), name.to_owned(), length);
        let written = match &symbols.structure {
            Some(kind) => vec![(kind.clone(), "result".to_owned(), 1)],
            None if self.is_number() => Vec::new(),
            None => self.head.lengths().map(result).collect(),
        };
        arguments.chain(written).collect()
    }

    fn c_statements(&mut self, symbols: &Symbols, is_told: bool) -> Read<()> {
        let (float, far) = (self.head.float(), if is_told { "far" } else { "1" });
        // The angles of a list, those of the call that was read, and the one of the last pair.
        let (mut angles, mut called, mut pair) = (Vec::new(), Vec::new(), None);
        let kind = format!("{}_sincos_t", symbols.prefix);
        let forget = format!("{}_FORGET", symbols.macros);
        loop {
            if self.take_all("for (int l = 0; l <")? {
                let lanes = self.next();
                self.expect_all("; ++l) {")?;
                self.lanes(lanes, |reader| reader.c_statements(symbols, is_told))?;
            } else if self.take(&forget) {
                self.expect("(")?;
                let name = self.next();
                // Numbers are not lvalues that change.
                let is_array = !name.starts_with('k') && self.arrays.contains_key(name);
                self.ensure(is_array, "an array of lanes expected")?;
                self.expect_all(");")?;
            } else if self.takes_store()? {
                continue;
            } else if self.peek(0) == float && self.peek(1).starts_with('u') {
                self.c_array()?;
            } else if self.peek(0) == float && self.peek(1).starts_with('w') {
                let [name, rows, lanes] = [1, 3, 6].map(|place| self.peek(place));
                self.expect_all(&format!("{float} {name}[{rows}][{lanes}];"))?;
                self.empty_array(name, [rows, lanes])?;
            } else if self.peek(0) == float {
                let count = self.peek(3);
                self.expect_all(&format!(
                    "{float} sines[{count}]; {float} cosines[{count}]; {}_sines_{count}(",
                    symbols.prefix
                ))?;
                let length = whole(count).unwrap_or(usize::MAX);
                called = if self.take("&") {
                    (self.angle()?..self.head.joints).take(length).collect()
                } else {
                    self.expect("angles")?;
                    std::mem::take(&mut angles)
                };
                self.expect_all(", sines, cosines);")?;
                let why = "a call for as many angles as there are expected";
                self.ensure(called.len() == length, why)?;
            } else if self.peek(0) == "(" {
                self.expect_all("( void )")?;
                let name = self.next();
                self.ensure(self.argument(name).is_some(), "an argument expected")?;
                self.expect(";")?;
            } else if self.peek(0) == "const" && self.peek(1) == kind {
                let joint = joint_of(self.peek(2)).filter(|joint| *joint < self.head.joints);
                let (joint, prefix) = (joint.unwrap_or(0), &symbols.prefix);
                let number = joint + 1;
                self.expect_all(&format!(
                    "const {kind} p{number} = {prefix}_sincos({far}, q[{joint}]);"
                ))?;
                pair = Some(joint);
            } else if self.take_all("static const")? {
                // Once for all calls: numbers alone.
                let name = self.c_array()?;
                let mut values = self.arrays[name].iter().flatten().flatten();
                let are_numbers = values.all(|entry| matches!(entry.1, Operand::Constant(_)));
                let is_good = name.starts_with('k') && are_numbers;
                self.ensure(is_good, "an array of numbers expected")?;
            } else if self.take("const") {
                self.expect(float)?;
                let name = self.next();
                if name == "angles" {
                    angles = self.c_angles()?;
                } else {
                    self.expect("=")?;
                    self.c_value(name, &called, pair)?;
                }
                self.expect(";")?;
            } else {
                return Ok(());
            }
        }
    }

    /// Takes an array of a value a lane, `double u1[1][2] = {…};`, and returns its name.
    fn c_array(&mut self) -> Read<&'r str> {
        let [name, rows, lanes] = [1, 3, 6].map(|place| self.peek(place));
        let float = self.head.float();
        self.expect_all(&format!("{float} {name}[{rows}][{lanes}] = {{"))?;
        self.rows(name, ["{", "}"], Some([rows, lanes]))?;
        self.expect(";").map(|()| name)
    }

    /// Takes the angles of one call: `angles[2] = {q[0], q[2]}`.
    fn c_angles(&mut self) -> Read<Vec<usize>> {
        let count = self.peek(1);
        self.expect_all(&format!("[{count}] = {{"))?;
        let angles = self.list("}", Self::angle)?;
        let is_full = angles.len().to_string() == count;
        self.ensure(is_full, "as many angles as in the array expected")?;
        Ok(angles)
    }

    /// The name was read: its letter says if it is a sine, a cosine, a root or an operation.
    fn c_value(&mut self, name: &'r str, called: &[usize], pair: Option<usize>) -> Read<()> {
        // A name without a number is of no joint.
        let joint = joint_of(name).unwrap_or(self.head.joints);
        let (is_sine, function, array) = match name.chars().next() {
            Some('s') => (true, "sin", "sines"),
            Some('c') => (false, "cos", "cosines"),
            Some('x') => return self.polynomial_step(name, joint),
            Some('r') => return self.speed(name, &[]),
            _ => return self.operation(name),
        };
        let of_pair = format!("p{}.{function}", joint + 1);
        let mut is_called = pair == Some(joint) && self.take_all(&of_pair)?;
        if let Some(place) = called.iter().position(|angle| *angle == joint)
            && !is_called
        {
            is_called = self.take_all(&format!("{array}[{place}]"))?;
        }
        let source = if is_called {
            Source::Together
        } else if self.take_all(&format!("{function}{}(q[{joint}])", self.suffix()))? {
            Source::Libm
        } else {
            self.polynomial_result(joint)?
        };
        self.name_sine(name, joint, is_sine, source)
    }

    /// Returns the results, a `?` each: what is returned, or written entry by entry, with lanes by fours.
    fn c_results(&self, symbols: &Symbols) -> String {
        if self.is_number() {
            return "return ?;".to_owned();
        }
        let before = symbols.structure.as_ref().map_or("", |_| "result->");
        let has_lanes = !self.function.loops.is_empty();
        let macro_head = format!("{}_FOUR({}", symbols.macros, self.head.float());
        let entries = self.head.lengths().flat_map(|(field, length)| {
            let whole = if has_lanes { length / 4 * 4 } else { 0 };
            let fours = (0..whole)
                .step_by(4)
                .map(|index| format!("{macro_head}, &{before}{field}[{index}], ?, ?, ?, ?); "));
            let alone = (whole..length).map(|index| format!("{before}{field}[{index}] = ?; "));
            fours.chain(alone).collect::<Vec<String>>()
        });
        entries.collect()
    }

    /// Returns the function of any number of states: entry i of state s is at `i * n + s`. A function
    /// that is told that no angle is far is called once more where one may be.
    fn batch(&self, symbols: &Symbols, is_told: bool, parameters: &[Parameter]) -> String {
        let (float, macros) = (self.head.float(), &symbols.macros);
        let entry = |index: usize, [count, one]: [&str; 2]| match index {
            0 => one.to_owned(),
            1 => format!("{count} + {one}"),
            _ => format!("({index}U * {count}) + {one}"),
        };
        let place = |index: usize| entry(index, ["n", "s"]);
        let (of_load, restrict) = match symbols.is_cuda {
            true => (["loads", "l"], "__restrict__".to_owned()),
            false => (["n", "s"], format!("{macros}_RESTRICT")),
        };
        let mut columns = "const size_t n".to_owned();
        let (mut state, mut stored, mut to) = (String::new(), String::new(), String::new());
        for argument in &self.head.arguments {
            let loads = match argument.name {
                "load" => ", const size_t loads",
                _ => "",
            };
            columns += &format!("{loads}, const {float} *{restrict} {}", argument.name);
        }
        // One load for all states, and one a state.
        let mut load = None;
        for parameter in parameters {
            let (kind, name, length) = parameter;
            if name == "load" && kind.starts_with("const ") {
                let one = commas((0..*length).map(|index| format!("load[{index}]")));
                let entries = (0..*length).map(|index| format!("load[{}]", entry(index, of_load)));
                let declared = |list| format!("{kind} load_s[1] = {{{{{{{list}}}}}}}; ");
                load = Some([one, commas(entries)].map(declared));
                continue;
            }
            let entries = commas((0..*length).map(|index| format!("{name}[{}]", place(index))));
            let initializer = match (kind.starts_with("const "), kind.ends_with("_t")) {
                (true, true) => format!(" = {{{{{{{entries}}}}}}}"),
                (true, false) => format!(" = {{{entries}}}"),
                (false, _) => String::new(),
            };
            state += &format!("{kind} {name}_s[{}]{initializer}; ", count(parameter));
        }
        for (field, length) in self.head.lengths() {
            columns += &format!(", {float} *{restrict} {field}");
            if self.is_number() {
                to = format!("{field}[s] = ");
                continue;
            }
            let from = match symbols.structure {
                Some(_) => format!("result_s->{field}"),
                None => format!("{field}_s"),
            };
            for index in 0..length {
                stored += &format!("{field}[{}] = {from}[{index}]; ", place(index));
            }
        }
        let passed = commas(parameters.iter().map(|(_, name, _)| format!("{name}_s")));
        let iteration =
            |when: &str, call: &str| format!("{state}{when}{to}{call}{passed}); {stored}");
        let (single, batch) = (format!("{}(", symbols.single), &symbols.batch);
        if symbols.is_cuda {
            let first = "((size_t)blockIdx.x * blockDim.x) + threadIdx.x";
            let of_load = load.map_or_else(String::new, |[_, declaration]| {
                format!("const size_t l = (loads == 1U) ? 0U : s; {declaration}")
            });
            let body = format!("{of_load}{}", iteration("", &single));
            return format!(
                "static __global__ void {batch}({columns}) {{
                const size_t threads = (size_t)gridDim.x * blockDim.x; size_t s;
                for (s = {first}; s < n; s += threads) {{ {body} }} }}"
            );
        }
        let looped = |load: &str, when: &str, call: &str| {
            let body = iteration(when, call);
            format!("for (s = 0U; s < n; ++s) {{ {load}{body} }}")
        };
        let near = || {
            let (f, joints) = (self.suffix(), self.head.joints);
            // Up to here sines need no library.
            let largest = if self.head.is_single { 100.0 } else { 8192.0 };
            let end = if self.head.is_single { "F" } else { "" };
            let most = largest / joints.next_power_of_two() as f64;
            let is_near = |k| format!("(fabs{f}(q_s[{k}]) <= {most:?}{end})");
            let near: Vec<String> = (0..joints).map(is_near).collect();
            format!("if ({}) {{ continue; }} ", near.join(" && "))
        };
        let loops = |load: &str| {
            let any = format!("{}(0, ", symbols.any);
            let statements = match is_told {
                false => looped(load, "", &single),
                true => looped(load, "", &any) + &looped(load, &near(), &single),
            };
            format!("{macros}_SIMD {statements}")
        };
        let loops = match &load {
            None => loops(""),
            Some([one, declaration]) => {
                let (shared, per_state) = (loops(""), loops(declaration));
                format!("if (loads == 1U) {{ {one}{shared} }} else {{ {per_state} }}")
            }
        };
        format!(
            "\n#if defined(__GNUC__)\n__attribute__((flatten))\n#endif\n
            static inline void {batch}({columns}) {{ size_t s; {loops} }}"
        )
    }
}
