//! The grammar that functions in Rust and in C share: operands, operations, sines and roots.

use std::collections::HashMap;
use std::fmt::Debug;
use std::str::FromStr;

use super::tokens::{self, Token};
use super::{Function, Head, Sines, Source, Symbols, TextError};
use crate::identity::program::{Operand, Program, Step};

/// The most operations of a function.
const MOST_STEPS: usize = 1 << 17;
/// The most operations of the polynomials of an angle.
const MOST_OF_ANGLE: usize = 1 << 8;

/// An outcome; or the line that is not of generated code.
pub(super) type Read<T> = Result<T, TextError>;

/// A function that is being read.
pub(super) struct Reader<'r> {
    pub tokens: &'r [Token<'r>],
    /// The place of the next word, and of the first that was read.
    pub at: usize,
    pub first: usize,
    pub head: &'r Head<'r>,
    /// The names of a function in C.
    pub symbols: Option<&'r Symbols>,
    /// `true` where values are vectors, whose literals are `of.all(0.5)`.
    pub is_vectors: bool,
    /// `true` once `of` is one of them.
    pub has_of: bool,
    names: HashMap<&'r str, Operand<f64>>,
    /// The names, in the order in which they were given.
    order: Vec<&'r str>,
    pub function: Function,
    /// The operations of the polynomials of an angle, so far, and what their names begin with: of
    /// another angle's, nothing is known.
    polynomial: (String, Vec<Step<f64>>),
}

impl<'r> Reader<'r> {
    /// Begins with a text.
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
            has_of: false,
            names: HashMap::new(),
            order: Vec::new(),
            function: Function {
                sines: Vec::new(),
                speeds: Vec::new(),
                program: Program {
                    steps: Vec::new(),
                    outputs: Vec::new(),
                },
            },
            polynomial: (String::new(), Vec::new()),
        }
    }

    /// Returns whether all words were read.
    pub(super) fn has_all(&self) -> bool {
        self.first == 0 && self.at == self.tokens.len()
    }

    /// Returns the word that is so far ahead; behind the last one nothing.
    pub(super) fn peek(&self, ahead: usize) -> &'r str {
        let token = self.tokens.get(self.at + ahead);
        token.map_or("", |token| token.text)
    }

    /// Takes a word.
    pub(super) fn next(&mut self) -> &'r str {
        let word = self.peek(0);
        self.at = (self.at + 1).min(self.tokens.len());
        word
    }

    /// Takes a word if it is this one.
    pub(super) fn take(&mut self, word: &str) -> bool {
        let is_next = self.peek(0) == word;
        self.at += usize::from(is_next);
        is_next
    }

    /// Refuses the word that was taken last.
    pub(super) fn refuse<T>(&self, why: &str) -> Read<T> {
        let token = self.tokens.get(self.at.saturating_sub(1));
        let (line, word) = token.map_or((1, ""), |token| (token.line, token.text));
        Err(TextError::new(line, format!("{why}, at `{word}`")))
    }

    /// Takes one word, which has to be this.
    pub(super) fn expect(&mut self, word: &str) -> Read<()> {
        if self.take(word) {
            return Ok(());
        }
        // Where a line should have ended, it is that line.
        let place = if word == ";" {
            self.at.wrapping_sub(1)
        } else {
            self.at
        };
        let token = self.tokens.get(place).or(self.tokens.last());
        let (line, found) = (token.map_or(1, |token| token.line), self.peek(0));
        let why = format!("`{word}` expected, not `{found}`");
        Err(TextError::new(line, why))
    }

    /// Takes the words of a text, which have to be these.
    pub(super) fn expect_all(&mut self, text: &str) -> Read<()> {
        let words = tokens::read(text, self.symbols.is_some())?;
        words.iter().try_for_each(|token| self.expect(token.text))
    }

    /// Takes the name of an argument or of a list's entry, which has an underscore if nothing
    /// reads it.
    pub(super) fn expect_name(&mut self, name: &str) -> Read<()> {
        match self.peek(0).strip_prefix('_') == Some(name) {
            true => self.expect(self.peek(0)),
            false => self.expect(name),
        }
    }

    /// Returns the place of the function of a name, behind a word of these; none if there is none.
    ///
    /// # Errors
    /// There are two.
    pub(super) fn find(&self, before: &[&str], name: &str) -> Read<Option<usize>> {
        let words = self.tokens.windows(2).enumerate();
        let is_own = |two: &[Token]| before.contains(&two[0].text) && two[1].text == name;
        let mut places = words.filter(|(_, two)| is_own(two)).map(|(place, _)| place);
        let place = places.next();
        match places.next() {
            None => Ok(place),
            Some(other) => {
                let line = self.tokens[other].line;
                Err(TextError::new(line, format!("`{name}` stands there twice")))
            }
        }
    }

    /// Gives a value a name; returns whether it is new.
    fn name(&mut self, name: &'r str, value: Operand<f64>) -> bool {
        self.order.push(name);
        self.names.insert(name, value).is_none()
    }

    /// Returns how many names there are.
    pub(super) fn count_names(&self) -> usize {
        self.order.len()
    }

    /// Forgets all names that were given after so many.
    pub(super) fn forget_names(&mut self, count: usize) -> HashMap<&'r str, Operand<f64>> {
        let names = self.order.split_off(count).into_iter();
        names
            .filter_map(|name| self.names.remove_entry(name))
            .collect()
    }

    /// Gives names that were forgotten back to their values.
    pub(super) fn hand_on(
        &mut self,
        names: &[&'r str],
        mut inside: HashMap<&'r str, Operand<f64>>,
    ) -> Read<()> {
        for &name in names {
            match inside.remove(name) {
                Some(value) => self.name(name, value),
                None => return self.refuse("a part hands on what is not there"),
            };
        }
        Ok(())
    }

    /// Returns what functions of libraries end with.
    pub(super) fn suffix(&self) -> &'static str {
        if self.head.is_single { "f" } else { "" }
    }

    /// Returns whether products are a macro's.
    fn is_cuda(&self) -> bool {
        self.symbols.is_some_and(|symbols| symbols.is_cuda)
    }

    /// Takes a number in brackets, below a length, as it is printed.
    pub(super) fn index(&mut self, length: usize) -> Read<usize> {
        self.expect("[")?;
        let word = self.next();
        let index = word.parse::<usize>().ok();
        let index = index.filter(|k| *k < length && k.to_string() == word);
        match index {
            Some(index) => self.expect("]").map(|()| index),
            None => self.refuse("no index"),
        }
    }

    /// Takes the position of a joint.
    pub(super) fn angle(&mut self) -> Read<usize> {
        self.expect("q")?;
        self.index(self.head.joints)
    }

    /// Takes positions of joints up to a bracket.
    pub(super) fn angles(&mut self, close: &str) -> Read<Vec<usize>> {
        let mut angles = Vec::new();
        while !self.take(close) {
            if !angles.is_empty() {
                self.expect(",")?;
            }
            angles.push(self.angle()?);
        }
        Ok(angles)
    }

    /// Returns whether a literal follows.
    fn is_literal(&self) -> bool {
        let digit = usize::from(self.peek(0) == "-");
        let is_digit = self.peek(digit).starts_with(|c: char| c.is_ascii_digit());
        is_digit || self.is_vectors && self.peek(0) == "of"
    }

    /// Takes a literal of the scalar, printed as it is: another one of the same value is refused.
    pub(super) fn literal(&mut self) -> Read<f64> {
        if self.is_vectors {
            ["of", ".", "all", "("]
                .iter()
                .try_for_each(|word| self.expect(word))?;
        }
        if self.is_vectors && !self.has_of {
            return self.refuse("`of` is not there");
        }
        let is_negative = self.take("-");
        let word = self.next();
        let end = match (self.symbols.is_some(), self.head.is_single) {
            (true, true) => "F",
            _ => "",
        };
        let digits = word.strip_suffix(end).unwrap_or("");
        let Some(value) = number(digits, self.head.is_single) else {
            return self.refuse("no literal of this scalar");
        };
        if self.is_vectors {
            self.expect(")")?;
        }
        Ok(if is_negative { -value } else { value })
    }

    /// Takes a name, an entry of an argument or a literal.
    pub(super) fn operand(&mut self) -> Read<Operand<f64>> {
        if self.is_literal() {
            return self.literal().map(Operand::Constant);
        }
        let word = self.next();
        let mut arguments = self.head.arguments.iter();
        if self.peek(0) == "["
            && let Some(argument) = arguments.find(|own| own.name == word)
        {
            let index = self.index(argument.length)?;
            return Ok(Operand::Entry(argument.place, index));
        }
        match self.names.get(word) {
            Some(operand) => Ok(operand.clone()),
            None => self.refuse("neither a value nor a literal"),
        }
    }

    /// Takes an operand that may be negated; a negative literal is a literal.
    pub(super) fn signed(&mut self) -> Read<(bool, Operand<f64>)> {
        let is_negative = !self.is_literal() && self.take("-");
        Ok((is_negative, self.operand()?))
    }

    /// Takes an operator between operands.
    fn operator(&mut self) -> Read<char> {
        match self.next() {
            "+" => Ok('+'),
            "-" => Ok('-'),
            "/" => Ok('/'),
            "*" if !self.is_cuda() => Ok('*'),
            _ => self.refuse("no operation"),
        }
    }

    /// Takes one operation on operands that a reader takes.
    fn binary(&mut self, operand: &dyn Fn(&mut Self) -> Read<Operand<f64>>) -> Read<Step<f64>> {
        let product = if self.head.is_single {
            "DALEMBERT_MULF"
        } else {
            "DALEMBERT_MUL"
        };
        if self.is_cuda() && self.take(product) {
            self.expect("(")?;
            let left = operand(self)?;
            self.expect(",")?;
            let right = operand(self)?;
            self.expect(")")?;
            return Ok(('*', [left, right]));
        }
        let left = operand(self)?;
        let operation = self.operator()?;
        Ok((operation, [left, operand(self)?]))
    }

    /// Takes an operation, fused or not, for a name that has been read: `t3`, and new.
    pub(super) fn operation(&mut self, name: &'r str) -> Read<()> {
        let is_c = self.symbols.is_some();
        let is_fused = match is_c {
            true => self.peek(0).strip_suffix(self.suffix()) == Some("fma"),
            false => self.calls_mul_add(),
        };
        match is_fused {
            true => self.fused(is_c)?,
            false => {
                let step = self.binary(&Self::operand)?;
                self.function.program.steps.push(step);
            }
        }
        let count = self.function.program.steps.len();
        if count > MOST_STEPS {
            return self.refuse("fewer operations expected");
        }
        let value = Operand::Step(count - 1);
        let number = name.strip_prefix('t').unwrap_or_default();
        let is_name = !number.is_empty() && number.bytes().all(|own| own.is_ascii_digit());
        match is_name && self.name(name, value) {
            true => Ok(()),
            false => self.refuse(&format!("`{name}` is no new name of an operation")),
        }
    }

    /// Returns whether a statement calls the method of fused products.
    fn calls_mul_add(&self) -> bool {
        let rest = self.tokens.get(self.at..).unwrap_or_default();
        let words = rest.iter().map(|token| token.text);
        words
            .take_while(|word| *word != ";")
            .any(|word| word == "mul_add")
    }

    /// Takes `a.mul_add(b, c)` or `fma(a, b, c)`: a product that is not rounded, and the sum.
    fn fused(&mut self, is_called: bool) -> Read<()> {
        let (is_negative, left) = match is_called {
            true => {
                self.next();
                self.expect("(")?;
                let left = self.signed()?;
                self.expect(",")?;
                left
            }
            false => {
                let is_negative = self.take("(");
                if is_negative {
                    self.expect("-")?;
                }
                let left = self.operand()?;
                if is_negative {
                    self.expect(")")?;
                }
                self.expect_all(". mul_add (")?;
                (is_negative, left)
            }
        };
        if matches!(left, Operand::Constant(_)) {
            return self.refuse("a value expected before the factor");
        }
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

    /// Takes 1/√(q̇² + w²) of a joint, for a name that has been read; the root is a library's of
    /// these, or C's. Roots are correctly rounded, whoever computes them.
    pub(super) fn speed(&mut self, name: &'r str, libraries: &[&str]) -> Read<()> {
        if self.literal()?.to_bits() != 1f64.to_bits() {
            return self.refuse("1 expected over a root");
        }
        self.expect("/")?;
        if !libraries.is_empty() {
            if !libraries.contains(&self.next()) {
                return self.refuse("a library of roots expected");
            }
            self.expect("::")?;
        }
        let (end, velocity) = (self.suffix(), |own: &&super::Argument| own.name == "qd");
        self.expect_all(&format!("sqrt{end} ("))?;
        let square = self.binary(&Self::operand)?;
        self.expect("+")?;
        let width = self.literal()?;
        self.expect(")")?;
        let place = self.head.arguments.iter().find(velocity);
        let joint = match &square {
            ('*', [Operand::Entry(a, i), Operand::Entry(b, k)])
                if (a, i) == (b, k) && place.is_some_and(|own| own.place == *a) =>
            {
                *i
            }
            _ => return self.refuse("the square of a velocity expected under a root"),
        };
        let last = self.function.speeds.last();
        if last.is_some_and(|last| last.0 >= joint) || name != format!("r{}", joint + 1) {
            return self.refuse("another name or order of roots expected");
        }
        self.function.speeds.push((joint, width));
        self.name(name, Operand::Speed(joint));
        Ok(())
    }

    /// Names the sine, or else the cosine, of a joint's angle.
    pub(super) fn name_sine(
        &mut self,
        name: &'r str,
        joint: usize,
        is_sine: bool,
        source: Source,
    ) -> Read<()> {
        let letter = if is_sine { 's' } else { 'c' };
        if name != format!("{letter}{}", joint + 1) || joint >= self.head.joints {
            return self.refuse(&format!("`{letter}{}` expected for `{name}`", joint + 1));
        }
        let all = &mut self.function.sines;
        let is_first = all.iter().all(|own| own.joint != joint);
        if is_first {
            all.push(Sines {
                joint,
                needs: [false; 2],
                source: match &source {
                    Source::Polynomial(own) => Source::Polynomial(Program {
                        steps: own.steps.clone(),
                        outputs: Vec::new(),
                    }),
                    other => other.clone(),
                },
            });
        }
        let mut is_good = false;
        if let Some(own) = all.last_mut().filter(|own| own.joint == joint) {
            is_good = !own.needs[usize::from(!is_sine)] && !own.needs[1];
            own.needs[usize::from(!is_sine)] = true;
            is_good &= match (&mut own.source, source) {
                (Source::Polynomial(all), Source::Polynomial(new)) => {
                    all.outputs.extend(new.outputs);
                    all.steps == new.steps
                }
                (own, new) => *own == new,
            };
        }
        let value = Operand::Sine(vec![(joint, false)], is_sine);
        match is_good && self.name(name, value) {
            true => Ok(()),
            false => self.refuse("the sine of an angle stands there twice"),
        }
    }

    /// Takes an operation of the polynomials of a joint's angle, and its name, which begins with
    /// `before` and ends with its number.
    pub(super) fn polynomial_step(&mut self, name: &str, before: &str, joint: usize) -> Read<()> {
        if name == format!("{before}1") {
            self.begin_polynomial(before);
        }
        let operand = |own: &mut Self| own.polynomial_operand(before, joint);
        let step = self.binary(&operand)?;
        if step.0 == '/' {
            return self.refuse("no operation of a polynomial");
        }
        let (known, steps) = &mut self.polynomial;
        steps.push(step);
        if steps.len() > MOST_OF_ANGLE {
            return self.refuse("more than 256 operations of a polynomial");
        }
        match known == before && name == format!("{before}{}", steps.len()) {
            true => Ok(()),
            false => self.refuse(&format!("`{name}` is not the next name")),
        }
    }

    /// Begins with the polynomials of an angle, whose names begin so.
    pub(super) fn begin_polynomial(&mut self, before: &str) {
        self.polynomial = (before.to_owned(), Vec::new());
    }

    /// Takes an operand of polynomials: the angle, an operation before, or a literal.
    fn polynomial_operand(&mut self, before: &str, joint: usize) -> Read<Operand<f64>> {
        if self.is_literal() {
            return self.literal().map(Operand::Constant);
        }
        if self.peek(0) == "q" {
            return match self.angle()? == joint {
                true => Ok(Operand::Entry(0, 0)),
                false => self.refuse("another angle"),
            };
        }
        let word = self.next();
        let number = word
            .strip_prefix(before)
            .and_then(|n| n.parse::<usize>().ok());
        let (known, steps) = &self.polynomial;
        let is_known = |n: &usize| known == before && (1..=steps.len()).contains(n);
        match number.filter(|n| is_known(n) && word == format!("{before}{n}")) {
            Some(number) => Ok(Operand::Step(number - 1)),
            None => self.refuse("neither the angle, a value nor a literal"),
        }
    }

    /// Takes a result of the polynomials, which may be negated.
    pub(super) fn polynomial_result(&mut self, before: &str, joint: usize) -> Read<Source> {
        let is_negative = !self.is_literal() && self.take("-");
        if self.polynomial.0 != before {
            self.begin_polynomial(before);
        }
        let value = self.polynomial_operand(before, joint)?;
        Ok(Source::Polynomial(Program {
            steps: self.polynomial.1.clone(),
            outputs: vec![(is_negative, value)],
        }))
    }
}

/// Reads a number of a scalar as it is printed: another text of the same value is refused.
pub(crate) fn number(text: &str, is_single: bool) -> Option<f64> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let value = match is_single {
        true => printed::<f32>(digits)?,
        false => printed::<f64>(digits)?,
    };
    Some(if digits.len() < text.len() {
        -value
    } else {
        value
    })
}

/// Returns a number as it is printed.
fn printed<T: FromStr + Debug + Into<f64>>(word: &str) -> Option<f64> {
    let value: T = word.parse().ok()?;
    let is_printed = format!("{value:?}") == word;
    Some(value.into()).filter(|value| is_printed && value.is_finite())
}
