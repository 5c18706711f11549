//! The grammar that functions in Rust and in C share: operands, operations, sines and roots.

use std::collections::HashMap;
use std::fmt::Debug;
use std::str::FromStr;

use super::lanes::ArrayValue;
use super::tokens::{self, Token};
use super::{Argument, Head, ReadFunction, SinePair, Source, Symbols};
use crate::Fault;
use crate::program::{Operand, Program, Step};

pub(super) const MOST_STEPS: usize = 1 << 17;
const MOST_OF_ANGLE: usize = 1 << 8;

pub(super) type Read<T> = Result<T, Fault>;

pub(super) struct Reader<'r> {
    pub tokens: &'r [Token<'r>],
    /// The place of the next word, and of the first that was read.
    pub at: usize,
    pub first: usize,
    pub head: &'r Head<'r>,
    pub symbols: Option<&'r Symbols>,
    /// `true` where values are vectors, whose literals are `of.all(0.5)`.
    pub is_vectors: bool,
    names: HashMap<&'r str, Operand<f64>>,
    pub order: Vec<&'r str>,
    pub function: ReadFunction,
    /// A joint, and the operations of the polynomials of its angle so far.
    polynomial: (usize, Vec<Step<f64>>),
    is_angle: bool,
    /// The arrays of values a lane, with the entries that are written.
    pub arrays: HashMap<&'r str, Vec<Vec<ArrayValue>>>,
    /// The entries of arrays that loops write.
    pub entries: usize,
    /// The lane that is read, in a loop over them.
    pub lane: Option<usize>,
}

impl<'r> Reader<'r> {
    pub(super) fn new(
        tokens: &'r [Token<'r>],
        head: &'r Head<'r>,
        symbols: Option<&'r Symbols>,
    ) -> Reader<'r> {
        Reader {
            tokens,
            at: 0,
            first: 0,
            head,
            symbols,
            is_vectors: false,
            names: HashMap::new(),
            order: Vec::new(),
            function: ReadFunction::default(),
            polynomial: (0, Vec::new()),
            is_angle: false,
            arrays: HashMap::new(),
            entries: 0,
            lane: None,
        }
    }

    pub(super) fn peek(&self, ahead: usize) -> &'r str {
        let token = self.tokens.get(self.at + ahead);
        token.map_or("", |token| token.text)
    }

    pub(super) fn next(&mut self) -> &'r str {
        let word = self.peek(0);
        self.at = (self.at + 1).min(self.tokens.len());
        word
    }

    pub(super) fn take(&mut self, word: &str) -> bool {
        let is_next = self.peek(0) == word;
        self.at += usize::from(is_next);
        is_next
    }

    pub(super) fn refuse<T>(&self, why: &str) -> Read<T> {
        let token = self.tokens.get(self.at.saturating_sub(1));
        let (line, word) = token.map_or((1, ""), |token| (token.line, token.text));
        Err(Fault::Text(line, format!("{why}, at `{word}`")))
    }

    pub(super) fn ensure(&self, holds: bool, why: &str) -> Read<()> {
        if holds { Ok(()) } else { self.refuse(why) }
    }

    pub(super) fn expect(&mut self, word: &str) -> Read<()> {
        if self.take(word) {
            return Ok(());
        }
        // Where a line should have ended, it is that line.
        let place = self.at.wrapping_sub(usize::from(word == ";"));
        let token = self.tokens.get(place).or(self.tokens.last());
        let (line, found) = (token.map_or(1, |token| token.line), self.peek(0));
        let why = format!("`{word}` expected, not `{found}`");
        Err(Fault::Text(line, why))
    }

    pub(super) fn expect_all(&mut self, text: &str) -> Read<()> {
        let words = tokens::read(text, self.symbols.is_some())?;
        words.iter().try_for_each(|token| self.expect(token.text))
    }

    pub(super) fn take_all(&mut self, text: &str) -> Read<bool> {
        let (words, next) = (tokens::read(text, self.symbols.is_some())?, self.peek(0));
        let is_next = words.first().is_some_and(|token| token.text == next);
        if is_next {
            self.expect_all(text)?;
        }
        Ok(is_next)
    }

    /// Takes the words of a text, which have to be these, with a result in place of each `?`.
    pub(super) fn results(&mut self, text: &str) -> Read<()> {
        for token in tokens::read(text, self.symbols.is_some())? {
            if token.text == "?" {
                let result = self.signed()?;
                self.function.program.outputs.push(result);
            } else {
                self.expect(token.text)?;
            }
        }
        Ok(())
    }

    pub(super) fn argument(&self, name: &str) -> Option<&'r Argument<'r>> {
        let mut arguments = self.head.arguments.iter();
        arguments.find(|argument| argument.name == name)
    }

    /// In Rust, an argument that nothing reads has an underscore.
    fn is_word(&self, spelling: &str, word: &str) -> bool {
        let is_unread = self.symbols.is_none() && spelling.strip_prefix('_') == Some(word);
        spelling == word || is_unread && self.argument(word).is_some()
    }

    pub(super) fn begin(&mut self, heads: &[String]) -> Read<usize> {
        for (index, head) in (1..).zip(heads) {
            let words = tokens::read(head, self.symbols.is_some())?;
            let count = |place: usize| {
                let both = self.tokens[place..].iter().zip(&words);
                let same = both.take_while(|(token, word)| self.is_word(token.text, word.text));
                same.count()
            };
            let places = (0..self.tokens.len()).rev();
            let first = places.max_by_key(|place| count(*place)).unwrap_or(0);
            let is_whole = |place: usize| count(place) == words.len();
            if (first + 1..self.tokens.len()).any(is_whole) {
                return Err(Fault::Text(1, format!("`{head}` is defined twice")));
            }
            if is_whole(first) || index == heads.len() {
                (self.at, self.first) = (first, first);
                for token in &words {
                    let (spelling, word) = (self.peek(0), token.text);
                    let is_spelled = self.is_word(spelling, word);
                    self.expect(if is_spelled { spelling } else { word })?;
                }
                return Ok(index - 1);
            }
        }
        self.refuse("a head expected")
    }

    fn name(&mut self, name: &'r str, value: Operand<f64>) -> bool {
        self.order.push(name);
        self.names.insert(name, value).is_none()
    }

    pub(super) fn forget_names(&mut self, count: usize, handed_on: &[&'r str]) -> Read<()> {
        let names = self.order.split_off(count).into_iter();
        let entries = names.filter_map(|name| self.names.remove_entry(name));
        let mut inside: HashMap<&str, Operand<f64>> = entries.collect();
        for &name in handed_on {
            let Some(value) = inside.remove(name) else {
                return self.refuse("a part passes on an undefined value");
            };
            self.name(name, value);
        }
        Ok(())
    }

    pub(super) fn suffix(&self) -> &'static str {
        if self.head.is_single { "f" } else { "" }
    }

    pub(super) fn index(&mut self, length: usize) -> Read<usize> {
        self.expect("[")?;
        let word = self.next();
        let index = word.parse::<usize>().ok();
        match index.filter(|k| *k < length && k.to_string() == word) {
            Some(index) => self.expect("]").map(|()| index),
            None => self.refuse("no index"),
        }
    }

    pub(super) fn angle(&mut self) -> Read<usize> {
        self.expect("q")?;
        self.index(self.head.joints)
    }

    pub(super) fn list<T>(
        &mut self,
        close: &str,
        entry: impl Fn(&mut Self) -> Read<T>,
    ) -> Read<Vec<T>> {
        let mut entries = Vec::new();
        while !self.take(close) {
            if !entries.is_empty() {
                self.expect(",")?;
            }
            entries.push(entry(self)?);
        }
        Ok(entries)
    }

    fn is_literal(&self) -> bool {
        let digit = usize::from(self.peek(0) == "-");
        let is_digit = self.peek(digit).starts_with(|c: char| c.is_ascii_digit());
        is_digit || self.is_vectors && self.peek(0) == "of"
    }

    pub(super) fn literal(&mut self) -> Read<f64> {
        if self.is_vectors {
            self.expect_all("of.all(")?;
        }
        let is_negative = self.take("-");
        let is_float = self.symbols.is_some() && self.head.is_single;
        let end = if is_float { "F" } else { "" };
        let digits = self.next().strip_suffix(end).unwrap_or("");
        let Some(value) = number(digits, self.head.is_single) else {
            return self.refuse("no literal of this scalar");
        };
        if self.is_vectors {
            self.expect(")")?;
        }
        Ok(if is_negative { -value } else { value })
    }

    pub(super) fn operand(&mut self) -> Read<Operand<f64>> {
        if self.is_literal() {
            return self.literal().map(Operand::Constant);
        }
        let word = self.next();
        let argument = self.argument(word);
        if self.symbols.is_some() && argument.is_some_and(Argument::is_struct) {
            self.expect_all(&format!("->{word}"))?;
        }
        if self.peek(0) == "["
            && let Some(argument) = argument
        {
            let entry = Operand::Entry(argument.place, self.index(argument.length)?);
            return match self.is_angle {
                false => Ok(entry),
                true if entry == Operand::Entry(0, self.polynomial.0) => Ok(Operand::Entry(0, 0)),
                true => self.refuse("another angle"),
            };
        }
        if self.arrays.contains_key(word) {
            let [row, lane] = self.entry(word)?;
            return match &self.arrays[word][row][lane] {
                Some((false, operand)) if !self.is_angle => Ok(operand.clone()),
                _ => self.refuse("an entry that is not written yet, or negated"),
            };
        }
        let value = self.names.get(word);
        match value.filter(|_| word.starts_with('x') == self.is_angle) {
            Some(operand) => Ok(operand.clone()),
            None if self.is_angle => self.refuse("neither the angle, a value nor a literal"),
            None => self.refuse("neither a value nor a literal"),
        }
    }

    /// Takes an operand that may be negated; a negative literal is a literal.
    pub(super) fn signed(&mut self) -> Read<(bool, Operand<f64>)> {
        let is_negative = !self.is_literal() && self.take("-");
        let word = self.peek(0);
        if self.arrays.contains_key(word) {
            self.next();
            let [row, lane] = self.entry(word)?;
            return match &self.arrays[word][row][lane] {
                Some((negated, operand)) => Ok((is_negative != *negated, operand.clone())),
                None => self.refuse("an entry that is not written yet"),
            };
        }
        Ok((is_negative, self.operand()?))
    }

    fn binary(&mut self) -> Read<Step<f64>> {
        // Products are a macro's in CUDA.
        let is_cuda = self.symbols.is_some_and(|symbols| symbols.is_cuda);
        let product = match self.head.is_single {
            true => "DALEMBERT_MULF(",
            false => "DALEMBERT_MUL(",
        };
        if is_cuda && self.take_all(product)? {
            let left = self.operand()?;
            self.expect(",")?;
            let right = self.operand()?;
            self.expect(")")?;
            return Ok(('*', [left, right]));
        }
        let left = self.operand()?;
        let operation = match self.next() {
            "+" => '+',
            "-" => '-',
            "/" => '/',
            "*" if !is_cuda => '*',
            _ => return self.refuse("no operation"),
        };
        Ok((operation, [left, self.operand()?]))
    }

    pub(super) fn operation(&mut self, name: &'r str) -> Read<()> {
        let is_c = self.symbols.is_some();
        let is_fused = match is_c {
            true => self.peek(0).strip_suffix(self.suffix()) == Some("fma"),
            false => self.calls_mul_add(),
        };
        if is_fused {
            self.fused(is_c)?;
        } else {
            let step = self.binary()?;
            self.function.program.steps.push(step);
        }
        let count = self.function.program.steps.len();
        self.ensure(count <= MOST_STEPS, "fewer operations expected")?;
        let value = Operand::Step(count - 1);
        let number = name.strip_prefix('t').unwrap_or_default();
        let is_name = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
        match is_name && self.name(name, value) {
            true => Ok(()),
            false => self.refuse(&format!("`{name}` is no new name of an operation")),
        }
    }

    fn calls_mul_add(&self) -> bool {
        let rest = self.tokens.get(self.at..).unwrap_or_default();
        let mut words = rest.iter().map(|token| token.text);
        words.find(|word| [";", "mul_add"].contains(word)) == Some("mul_add")
    }

    /// Takes `a.mul_add(b, c)` or `fma(a, b, c)`: a product that is not rounded, and the sum.
    fn fused(&mut self, is_called: bool) -> Read<()> {
        if is_called {
            self.next();
            self.expect("(")?;
        }
        let has_bracket = !is_called && self.take("(");
        self.expect_all(if has_bracket { "-" } else { "" })?;
        let is_negative = has_bracket || is_called && self.take("-");
        let left = self.operand()?;
        self.expect_all(match (is_called, has_bracket) {
            (true, _) => ",",
            (false, true) => ").mul_add(",
            (false, false) => ".mul_add(",
        })?;
        let is_value = !matches!(left, Operand::Constant(_));
        self.ensure(is_value, "a value expected before the factor")?;
        let right = self.operand()?;
        self.expect(",")?;
        // A sign before a literal, too, is the operation's.
        let is_minus = self.take("-");
        let addend = self.operand()?;
        self.expect(")")?;
        let steps = &mut self.function.program.steps;
        steps.push(('×', [left, right]));
        let product = Operand::Step(steps.len() - 1);
        let step = match (is_negative, is_minus) {
            (false, false) => ('+', [product, addend]),
            (false, true) => ('-', [product, addend]),
            (true, false) => ('-', [addend, product]),
            (true, true) => return self.refuse("a product and a sum that are both negated"),
        };
        steps.push(step);
        Ok(())
    }

    /// Roots are correctly rounded by every library.
    pub(super) fn speed(&mut self, name: &'r str, libraries: &[&str]) -> Read<()> {
        let bits = self.literal()?.to_bits();
        self.ensure(bits == 1f64.to_bits(), "1 expected over a root")?;
        self.expect("/")?;
        if !libraries.is_empty() {
            let is_known = libraries.contains(&self.next());
            self.ensure(is_known, "a library of roots expected")?;
            self.expect("::")?;
        }
        self.expect_all(&format!("sqrt{} (", self.suffix()))?;
        let square = self.binary()?;
        self.expect("+")?;
        let width = self.literal()?;
        self.expect(")")?;
        let place = self.argument("qd").map(|argument| argument.place);
        let why = "the square of a velocity expected under a root";
        let ('*', [Operand::Entry(argument, joint), other]) = square else {
            return self.refuse(why);
        };
        let is_square = other == Operand::Entry(argument, joint) && place == Some(argument);
        self.ensure(is_square, why)?;
        let is_behind = (self.function.speeds.last()).is_none_or(|last| last.0 < joint);
        let is_next = is_behind && name == format!("r{}", joint + 1);
        self.ensure(is_next, "another name or order of roots expected")?;
        self.function.speeds.push((joint, width));
        self.name(name, Operand::Speed(joint));
        Ok(())
    }

    pub(super) fn name_sine(
        &mut self,
        name: &'r str,
        joint: usize,
        is_sine: bool,
        source: Source,
    ) -> Read<()> {
        // Values of a lane are out of scope behind it.
        self.ensure(self.lane.is_none(), "sines are taken before lanes")?;
        let letter = if is_sine { 's' } else { 'c' };
        if name != format!("{letter}{}", joint + 1) || joint >= self.head.joints {
            return self.refuse(&format!("`{letter}{}` expected for `{name}`", joint + 1));
        }
        let sines = &mut self.function.sines;
        let is_good = if sines.iter().all(|pair| pair.joint != joint) {
            let needs = [is_sine, !is_sine];
            sines.push(SinePair {
                joint,
                needs,
                source,
            });
            true
        } else if let Some(last) = sines.last_mut()
            && last.joint == joint
            && last.needs == [true, false]
            && !is_sine
        {
            // The cosine stands behind the sine, and is computed in the same way.
            last.needs[1] = true;
            match (&mut last.source, source) {
                (Source::Polynomial(old), Source::Polynomial(new)) => {
                    old.outputs.extend(new.outputs);
                    old.steps == new.steps
                }
                (old, new) => *old == new,
            }
        } else {
            false
        };
        let value = Operand::Sine(joint, is_sine);
        let is_new = is_good && self.name(name, value);
        self.ensure(is_new, "the sine of an angle is defined twice")
    }

    fn polynomial_name(&self, joint: usize, number: usize) -> String {
        match self.symbols {
            Some(_) => format!("x{}_{number}", joint + 1),
            None => format!("x{number}"),
        }
    }

    pub(super) fn polynomial_step(&mut self, name: &'r str, joint: usize) -> Read<()> {
        self.ensure(self.lane.is_none(), "polynomials stand before lanes")?;
        if name == self.polynomial_name(joint, 1) {
            self.begin_polynomial(joint);
        }
        self.is_angle = true;
        let step = self.binary()?;
        self.is_angle = false;
        self.ensure(step.0 != '/', "no operation of a polynomial")?;
        let (known, steps) = &mut self.polynomial;
        steps.push(step);
        let (is_known, count) = (*known == joint, steps.len());
        let why = "more than 256 operations of a polynomial";
        self.ensure(count <= MOST_OF_ANGLE, why)?;
        self.names.insert(name, Operand::Step(count - 1));
        match is_known && name == self.polynomial_name(joint, count) {
            true => Ok(()),
            false => self.refuse(&format!("`{name}` is not the next name")),
        }
    }

    pub(super) fn begin_polynomial(&mut self, joint: usize) {
        let (known, steps) = std::mem::replace(&mut self.polynomial, (joint, Vec::new()));
        for number in 1..=steps.len() {
            let name = self.polynomial_name(known, number);
            self.names.remove(name.as_str());
        }
    }

    pub(super) fn polynomial_result(&mut self, joint: usize) -> Read<Source> {
        if self.polynomial.0 != joint {
            self.begin_polynomial(joint);
        }
        self.is_angle = true;
        let outputs = vec![self.signed()?];
        self.is_angle = false;
        let steps = self.polynomial.1.clone();
        Ok(Source::Polynomial(Program { steps, outputs }))
    }
}

pub(super) fn commas(items: impl Iterator<Item = String>) -> String {
    items.collect::<Vec<String>>().join(", ")
}

/// Returns the joint whose number stands behind a name's first letter: 0 for `s1` and for `x1_3`.
pub(super) fn joint_of(name: &str) -> Option<usize> {
    let number = name.get(1..)?.split('_').next()?;
    number.parse::<usize>().ok()?.checked_sub(1)
}

/// Reads a number of a scalar as it is printed: another text of the same value is refused.
pub(crate) fn number(text: &str, is_single: bool) -> Option<f64> {
    match is_single {
        true => printed::<f32>(text),
        false => printed::<f64>(text),
    }
}

fn printed<T: FromStr + Debug + Into<f64>>(word: &str) -> Option<f64> {
    let value: T = word.parse().ok()?;
    let is_printed = format!("{value:?}") == word;
    Some(value.into()).filter(|value| is_printed && value.is_finite())
}
