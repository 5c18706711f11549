//! Functions in Rust.
//!
//! ```text
//! #[must_use]
//! pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2]) -> [f64; 2] {
//!     let (s1, c1) = libm::sincos(q[0]);
//!     let t1 = qd[0] * 0.5;
//!     [-t1, 0.0]
//! }
//! ```

use super::reader::{Read, Reader, commas, joint_of};
use super::{Argument, ReadFunction, Source};

fn type_of(argument: &Argument) -> Option<&'static str> {
    Some(match argument.name {
        "g" => "Gravity",
        "load" => "Load",
        "payload" => "Payload",
        "bodies" => "Bodies",
        _ => return None,
    })
}

impl<'r> Reader<'r> {
    pub(super) fn rust(&mut self, has_columns: bool) -> Read<()> {
        self.begin(&[self.rust_head()])?;
        self.statements(false)?;
        let [_, value] = self.returned();
        self.results(&format!("{value} }}"))?;
        if has_columns { self.columns() } else { Ok(()) }
    }

    fn rust_head(&self) -> String {
        let (head, scalar) = (self.head, self.head.scalar());
        let arguments = head.arguments.iter().map(|argument| {
            let array = || format!("[{scalar}; {}]", argument.length);
            let kind = type_of(argument).map_or_else(array, str::to_owned);
            format!("{}: &{kind}", argument.name)
        });
        let (name, arguments) = (head.name, commas(arguments));
        let [returned, _] = self.returned();
        format!("pub fn {name}({arguments}) -> {returned} {{")
    }

    fn returned(&self) -> [String; 2] {
        let fields = self.head.fields.as_slice();
        if let Some(name) = self.head.structure() {
            let part = |(field, shape): &(&str, Vec<usize>)| format!("{field}: {}, ", array(shape));
            let values: String = fields.iter().map(part).collect();
            let value = format!("{name} {{ {values} }}");
            return [name, value];
        }
        match fields {
            [("load", shape)] => ["Load".to_owned(), format!("Load({})", array(shape))],
            [(_, shape)] => [self.head.kind(shape), array(shape)],
            _ => Default::default(),
        }
    }

    fn statements(&mut self, is_part: bool) -> Read<()> {
        loop {
            if self.take_all("for l in")? {
                let lanes = self.next().strip_prefix("0..").unwrap_or_default();
                self.expect("{")?;
                self.lanes(lanes, |reader| reader.statements(false))?;
                continue;
            }
            if self.takes_store()? {
                continue;
            }
            if !self.take("let") {
                return Ok(());
            }
            match (self.peek(0), self.peek(1)) {
                ("mut", name) => {
                    self.next();
                    self.next();
                    let [lanes, rows] = [self.peek(5), self.peek(8)];
                    self.expect_all(&format!("= [[0.0; {lanes}]; {rows}]"))?;
                    self.empty_array(name, [rows, lanes])?;
                }
                (name, "=") if self.peek(2) == "[" => {
                    self.at += 3;
                    self.rows(name, ["[", "]"], None)?;
                }
                ("(", "[") => self.together()?,
                ("(", name) if name.starts_with('t') && !is_part => self.part()?,
                ("(", _) => {
                    self.next();
                    let sine = self.next();
                    self.expect(",")?;
                    let cosine = self.next();
                    self.expect_all(") =")?;
                    self.sines(&[(sine, true), (cosine, false)])?;
                }
                _ => {
                    let name = self.next();
                    self.expect("=")?;
                    match name.chars().next() {
                        Some('s') => self.sines(&[(name, true)])?,
                        Some('c') => self.sines(&[(name, false)])?,
                        Some('r') if self.is_vectors => self.speed(name, &["dalembert_batch"])?,
                        Some('r') => self.speed(name, &["libm", "dalembert_sines"])?,
                        _ => self.operation(name)?,
                    }
                }
            }
            self.expect(";")?;
        }
    }

    fn sines(&mut self, names: &[(&'r str, bool)]) -> Read<()> {
        // A name without a number is of no joint.
        let joint = joint_of(names[0].0).unwrap_or(self.head.joints);
        if self.take("{") {
            return self.polynomials(joint, names);
        }
        let called = match names {
            [(_, true)] => "sin",
            [(_, false)] => "cos",
            _ => "sincos",
        };
        let library = format!("libm::{called}{}", self.suffix());
        self.expect_all(&match (self.is_vectors, names.len()) {
            (false, _) => format!("{library}(q[{joint}])"),
            (true, 1) => format!("q[{joint}].each({library})"),
            (true, _) => format!("q[{joint}].both({library})"),
        })?;
        let mut names = names.iter();
        names.try_for_each(|(name, is_sine)| self.name_sine(name, joint, *is_sine, Source::Libm))
    }

    fn polynomials(&mut self, joint: usize, names: &[(&'r str, bool)]) -> Read<()> {
        self.begin_polynomial(joint);
        while self.take("let") {
            let name = self.next();
            self.expect("=")?;
            self.polynomial_step(name, joint)?;
            self.expect(";")?;
        }
        for (index, (name, is_sine)) in names.iter().enumerate() {
            if names.len() > 1 {
                self.expect(if index == 0 { "(" } else { "," })?;
            }
            let source = self.polynomial_result(joint)?;
            self.name_sine(name, joint, *is_sine, source)?;
        }
        self.expect_all(if names.len() > 1 { ") }" } else { "}" })
    }

    /// Reads one call for all angles: `([s1, _], [c1, c2]) = …::sincos(&[q[0], q[1]])`.
    fn together(&mut self) -> Read<()> {
        self.expect("(")?;
        let sines = self.listed()?;
        self.expect(",")?;
        let cosines = self.listed()?;
        let end = self.suffix();
        self.expect_all(&format!(") = dalembert_sines :: sincos{end} (& ["))?;
        let angles = self.list("]", Self::angle)?;
        self.expect(")")?;
        self.name_together(&angles, [&sines, &cosines])
    }

    fn listed(&mut self) -> Read<Vec<&'r str>> {
        self.expect("[")?;
        self.list("]", |reader| Ok(reader.next()))
    }

    fn name_together(&mut self, angles: &[usize], names: [&[&'r str]; 2]) -> Read<()> {
        let are_alike = names.iter().all(|list| list.len() == angles.len());
        self.ensure(are_alike, "as many sines, cosines and angles are expected")?;
        for (place, &joint) in angles.iter().enumerate() {
            let pair = names.map(|names| names[place]);
            let why = "neither sine nor cosine of an angle is taken";
            self.ensure(pair != ["_"; 2], why)?;
            for (name, is_sine) in pair.into_iter().zip([true, false]) {
                if name != "_" {
                    self.name_sine(name, joint, is_sine, Source::Together)?;
                }
            }
        }
        Ok(())
    }

    /// A part of a long function, `(t1, t2,) = { … (t1, t2,) }`, hands on these names alone.
    fn part(&mut self) -> Read<()> {
        let names = self.part_names()?;
        self.expect_all("= {")?;
        let before = self.order.len();
        self.statements(true)?;
        let is_same = self.part_names()? == names;
        self.ensure(is_same, "other names than those before the part")?;
        self.expect("}")?;
        self.forget_names(before, &names)
    }

    fn part_names(&mut self) -> Read<Vec<&'r str>> {
        self.expect("(")?;
        let mut names = Vec::new();
        while !self.take(")") {
            names.push(self.next());
            self.expect(",")?;
        }
        Ok(names)
    }

    fn columns(&mut self) -> Read<()> {
        let (head, scalar) = (self.head, self.head.scalar());
        let single = std::mem::take(&mut self.function);
        let sines = single.sines.iter();
        let together = sines.filter(|pair| pair.source == Source::Together);
        let taken: Vec<usize> = together.map(|pair| pair.joint).collect();
        let (results, k) = (single.program.outputs.len(), taken.len());
        let kind = format!("{}Batch", camel(head.name));
        let is_fused = k > 0 && single.program.steps.iter().any(|step| step.0 == '×');
        let fused = ["", "const FUSED: bool = true;"][usize::from(is_fused)];
        let angles = commas(taken.iter().map(|joint| format!("entries[{joint}]")));
        let (mut slices, mut begin) = (String::new(), 0);
        for argument in &head.arguments {
            let end = begin + argument.length;
            slices += &format!("let {} = &entries[{begin}..{end}]; ", argument.name);
            begin = end;
        }
        let (inputs, sizes) = (begin, format!("{begin}, {results}, {k}"));
        let method = "#[inline(always)] #[allow(unused_variables)] fn";
        self.expect_all(&format!(
            "#[derive(Clone, Copy, Debug)] pub struct {kind};
            impl dalembert_batch::Function<{sizes}> for {kind} {{
            type Scalar = {scalar}; {fused}
            {method} angles<V: dalembert_batch::Floats<{scalar}>>(entries: &[V; {inputs}])
            -> [V; {k}] {{ [{angles}] }}
            {method} vectors<V: dalembert_batch::Vector<{scalar}>>(entries: &[V; {inputs}], &"
        ))?;
        self.forget_names(0, &[])?;
        let sines = self.listed()?;
        self.expect_all(&format!(": &[V; {k}], &"))?;
        let cosines = self.listed()?;
        self.expect_all(&format!(
            ": &[V; {k}]) -> [V; {results}] {{ let of = entries[0]; {slices}"
        ))?;
        self.name_together(&taken, [&sines, &cosines])?;
        self.is_vectors = true;
        self.statements(false)?;
        self.results(&array(&[results]))?;
        self.is_vectors = false;
        let sorted = |mut function: ReadFunction| {
            function.sines.sort_by_key(|sines| sines.joint);
            // Zeros are told apart by their signs.
            format!("{function:?}")
        };
        let vectors = std::mem::replace(&mut self.function, single.clone());
        let why = "other operations over vectors than of one state";
        self.ensure(sorted(vectors) == sorted(single), why)?;
        let (mut parameters, mut passed, mut rows) = (String::new(), Vec::new(), 0);
        for argument in &head.arguments {
            let (name, length) = (argument.name, argument.length);
            if let Some(kind) = type_of(argument) {
                parameters += &format!("{name}: &[{kind}], ");
                passed.push(format!("dalembert_batch::Argument::Rows(&{name})"));
                rows += length;
            } else {
                parameters += &format!("{name}: &[&[{scalar}]; {length}], ");
                passed.push(format!("dalembert_batch::Argument::Columns({name})"));
            }
        }
        let (name, passed) = (head.name, passed.join(", "));
        self.expect_all(&format!(
            "}} }} pub fn {name}_columns({parameters}results: &mut [&mut [{scalar}]; {results}])
            -> Result<(), dalembert_batch::Unequal> {{ let arguments = [{passed}];
            dalembert_batch::columns::<{kind}, {sizes}, {rows}>(&arguments, results) }}"
        ))
    }
}

/// Returns an array whose axes have these lengths, a `?` for each number.
fn array(shape: &[usize]) -> String {
    match shape {
        [] => "?".to_owned(),
        [length] => format!("[{}]", vec!["?"; *length].join(", ")),
        [length, inner @ ..] => format!("[{}]", (array(inner) + ", ").repeat(*length)),
    }
}

pub(super) fn camel(name: &str) -> String {
    let words = name.split('_').filter_map(|word| word.split_at_checked(1));
    let capital = |(first, rest): (&str, &str)| first.to_ascii_uppercase() + rest;
    words.map(capital).collect()
}
