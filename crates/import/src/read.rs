//! Words and numbers of attributes. A mistake is said once and a default stands in its place, so
//! that reading goes on and finds all of them.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use dalembert_model::number::parse::parse_decimal;
use num_traits::Signed;

use crate::keywords::{Table, Verdict};
use crate::model::{Number, Value};
use crate::problems::{MAX, Message, Problems, Words, instead};
use crate::text::Span;
use crate::xml::{Attribute, Element};

/// No list of numbers that is read has more.
const MANY: usize = 64;

pub(crate) struct Reader<'p, 't> {
    pub(crate) problems: &'p mut Problems<'t>,
    table: &'static Table,
    /// Names that no row has: where the first is, and how often there are more.
    unknown: BTreeMap<(String, String), (Span, usize)>,
}

impl<'p, 't> Reader<'p, 't> {
    pub(crate) fn new(problems: &'p mut Problems<'t>, table: &'static Table) -> Self {
        Reader {
            problems,
            table,
            unknown: BTreeMap::new(),
        }
    }

    pub(crate) fn report(&mut self, id: &str, at: &Span, words: &Words) {
        self.problems.report(id, at, words);
    }

    pub(crate) fn refuse<T>(&mut self, id: &str, at: &Span, words: &Words) -> Option<T> {
        self.problems.refuse(id, at, words)
    }

    /// Reports the names of an element, and of those inside, that are unknown or left out; `of` is
    /// the joint or link that they are part of.
    pub(crate) fn check(&mut self, parent: &str, element: &Element, of: &str) {
        self.check_around(parent, element, of, |_| true);
    }

    /// Reports the same, but goes on inside those elements alone that `enter` accepts.
    pub(crate) fn check_around(
        &mut self,
        parent: &str,
        element: &Element,
        of: &str,
        enter: impl Fn(&Element) -> bool,
    ) {
        self.check_attributes(parent, element, of);
        self.check_inside(parent, element, of, enter);
    }

    /// Reports the elements inside one that are unknown or left out, and goes on inside those that
    /// `enter` accepts.
    pub(crate) fn check_inside(
        &mut self,
        parent: &str,
        element: &Element,
        of: &str,
        enter: impl Fn(&Element) -> bool,
    ) {
        let Some(row) = self.table.row(parent, &element.tag) else {
            return;
        };
        for inside in &element.inside {
            let tag = inside.tag.as_str();
            let listed = row.listed(&format!("<{tag}>"));
            match (listed, self.table.row(&element.tag, tag)) {
                (Some(Verdict::LeftOut), _) => {
                    let content = inside.content();
                    let value = content.map_or("", |content| content.value.as_str());
                    self.leave_out(&element.tag, tag, &inside.at, value, of);
                }
                (None, Some(below)) if below.verdict("*") == Verdict::LeftOut => {
                    self.leave_out(tag, "*", &inside.at, "", of);
                }
                (None, Some(below)) if !below.is_irrelevant() && enter(inside) => {
                    self.check(&element.tag, inside, of);
                }
                (None, None) if row.verdict("*") == Verdict::Unknown => {
                    self.unknown(&element.tag, format!("<{tag}>"), &inside.at);
                }
                _ => {}
            }
        }
    }

    pub(crate) fn check_attributes(&mut self, parent: &str, element: &Element, of: &str) {
        let Some(row) = self.table.row(parent, &element.tag) else {
            return;
        };
        for Attribute { key, value, at } in &element.attributes {
            match row.verdict(key) {
                Verdict::LeftOut => self.leave_out(&element.tag, key, at, value, of),
                Verdict::Unknown if !key.starts_with("xmlns") => {
                    self.unknown(&element.tag, format!("`{key}`"), at);
                }
                _ => {}
            }
        }
    }

    /// Reports the unknown names of a class; names left out are reported at the elements with them.
    pub(crate) fn check_class(&mut self, root: &Element, class: &Element) {
        let scratch = Problems::of(self.problems.text);
        let original = std::mem::replace(self.problems, scratch);
        self.check(&root.tag, class, "a class");
        *self.problems = original;
    }

    /// Reports a name that is left out, unless its value has no effect.
    fn leave_out(&mut self, tag: &str, name: &str, at: &Span, value: &str, of: &str) {
        let message = Message::of(&format!("{tag} {name}"));
        let Some(message) = message.or(Message::of("left out")) else {
            return;
        };
        let number = |word: &str| word.parse::<f64>().ok();
        let is_idle = |word: &str| {
            let mut idle = message.idle.split_ascii_whitespace();
            idle.any(|idle| idle == word || number(idle).is_some_and(|x| number(word) == Some(x)))
        };
        if value.trim().is_empty() || !value.split_ascii_whitespace().all(is_idle) {
            let element = format!("<{tag}>");
            let name = if name == "*" { &element } else { name };
            self.problems
                .report_message(message, at, &[&of, &name, &value]);
        }
    }

    fn unknown(&mut self, tag: &str, name: String, at: &Span) {
        let entry = self.unknown.entry((tag.to_owned(), name));
        entry.or_insert((at.clone(), 0)).1 += 1;
    }

    /// Reports the unknown names, each once.
    pub(crate) fn report_unknown(&mut self) {
        for ((tag, name), (at, count)) in std::mem::take(&mut self.unknown).into_iter().take(MAX) {
            let row = self.table.row_of(&tag).into_iter();
            let known = row.flat_map(|row| &row.names[0]);
            let mut help = instead(name.trim_matches(['<', '>', '`']), known.copied());
            if !help.starts_with("did") {
                help.clear();
            }
            let times = match count {
                ..=1 => String::new(),
                _ => format!(", {count} times"),
            };
            self.report("unknown", &at, &[&name, &tag, &times, &help]);
        }
    }

    /// Returns a reader with another table and the same problems.
    pub(crate) fn with(&mut self, table: &'static Table) -> Reader<'_, 't> {
        Reader::new(self.problems, table)
    }

    /// Returns an attribute that has to be there, empty if it is missing.
    pub(crate) fn required(&mut self, element: &Element, key: &str) -> (String, Span) {
        if let Some(attribute) = element
            .get(key)
            .filter(|attribute| !attribute.value.trim().is_empty())
        {
            return (attribute.value.clone(), attribute.at.clone());
        }
        self.report("no_attribute", &element.at, &[&element.tag, &key]);
        (String::new(), element.at.clone())
    }

    /// Returns the value of one of some words: `None` if there is none, or it is none of them.
    pub(crate) fn word<T: Copy>(
        &mut self,
        element: &Element,
        key: &str,
        words: &[(&str, T)],
    ) -> Option<T> {
        let Attribute { value, at, .. } = element.get(key)?;
        let entry = words.iter().find(|(word, _)| word == value);
        if entry.is_none() {
            let words: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
            let help = match words.len() {
                ..4 => words.join(" or "),
                _ => instead(value, words),
            };
            self.report("not_a_word", at, &[value, &key, &element.tag, &help]);
        }
        entry.map(|(_, value)| *value)
    }

    /// Reads N numbers of an attribute; `None` if there is no such attribute, or a mistake in it.
    pub(crate) fn numbers<const N: usize>(
        &mut self,
        element: &Element,
        key: &str,
    ) -> Option<[Number; N]> {
        let attribute = element.get(key)?;
        let count = attribute.value.split_ascii_whitespace().take(MANY).count();
        if count == N || count == 0 {
            return self.list(attribute)?.try_into().ok();
        }
        let names = ["x", "y", "z", "u", "v", "w"][..N.min(6)].join(" ");
        let count = format!("{count} number{}", if count == 1 { "" } else { "s" });
        self.refuse("not_so_many", &attribute.at, &[&key, &count, &N, &names])
    }

    /// Reads three numbers, which are zero where there are none.
    pub(crate) fn vector(&mut self, element: &Element, key: &str) -> [Number; 3] {
        let numbers = self.numbers(element, key);
        numbers.unwrap_or_else(|| Number::constants(["0", "0", "0"], &element.at))
    }

    /// Reads all numbers of an attribute, each with its place.
    pub(crate) fn list(&mut self, attribute: &Attribute) -> Option<Vec<Number>> {
        let Attribute { value, at, .. } = attribute;
        let mut numbers = Vec::new();
        let (mut from, mut count) = (0, 0);
        if value.split_ascii_whitespace().nth(MANY).is_some() {
            return self.refuse("too_many", at, &[&"numbers", &"", &MANY]);
        }
        for word in value.split_ascii_whitespace() {
            let start = value[from..].find(word).map_or(from, |start| from + start);
            from = start + word.len();
            let place = at.start + start..at.start + from;
            // With entities, use the place of the whole attribute.
            let is_there = self.problems.text.as_str().get(place.clone()) == Some(word);
            numbers.extend(self.parse(word, if is_there { &place } else { at }));
            count += 1;
        }
        (numbers.len() == count).then_some(numbers)
    }

    /// Reads the numbers of an attribute and returns the first.
    pub(crate) fn first(&mut self, element: &Element, key: &str) -> Option<Number> {
        self.list(element.get(key)?)?.into_iter().next()
    }

    pub(crate) fn number(&mut self, element: &Element, key: &str) -> Option<Number> {
        let Attribute { value, at, .. } = element.get(key)?;
        let value = Some(value.trim()).filter(|value| !value.is_empty());
        self.parse(value?, at)
    }

    /// Reads a number that has to be there; zero stands for a missing one.
    pub(crate) fn required_number(&mut self, element: &Element, key: &str) -> Number {
        self.required(element, key);
        let number = self.number(element, key);
        number.unwrap_or_else(|| Number::constant("0", &element.at))
    }

    pub(crate) fn parse(&mut self, text: &str, at: &Span) -> Option<Number> {
        // A robot file takes 1_000; a model does not.
        match parse_decimal(&spelled_out(&text.replace('_', "?"))) {
            Ok(value) => Some(Value::new(value, text, at)),
            Err(error) => self.refuse("not_a_number", at, &[&text, &error, &error.help()]),
        }
    }

    pub(crate) fn not_negative(&mut self, number: Option<&Number>, what: &str, help: &str) {
        if let Some(number) = number.filter(|number| number.value.is_negative()) {
            self.report("negative", &number.at, &[&what, &help]);
        }
    }

    /// Returns limits unless both are equal, as where nobody filled them in; reversed ones are an
    /// error.
    pub(crate) fn range(&mut self, joint: &str, range: Option<[Number; 2]>) -> Option<[Number; 2]> {
        let [lower, upper] = range?;
        match lower.value.cmp(&upper.value) {
            Ordering::Less => Some([lower, upper]),
            Ordering::Equal => self.refuse("equal_limits", &lower.at, &[&joint, &lower.text]),
            Ordering::Greater => {
                self.refuse("reversed", &lower.at, &[&joint, &lower.text, &upper.text])
            }
        }
    }

    pub(crate) fn unique<'n>(
        &mut self,
        what: &str,
        names: impl Iterator<Item = (&'n String, &'n Span)>,
    ) {
        let mut name_set = BTreeSet::new();
        let help = "each needs a name of its own: give it another";
        for (name, at) in names.filter(|(name, _)| !name_set.insert(*name)) {
            self.report("twice", at, &[&what, name, &help]);
        }
    }

    pub(crate) fn are_few(&mut self, at: &Span, what: &str, count: usize, few: usize) -> bool {
        if count > few {
            self.report("too_many", at, &[&count, &what, &few]);
        }
        count <= few
    }
}

/// Returns `.5` and `5.` as 0.5 and 5, which other readers take too.
fn spelled_out(text: &str) -> String {
    let (mantissa, exponent) = text.split_at(text.find(['e', 'E']).unwrap_or(text.len()));
    let mantissa = mantissa.strip_suffix('.').unwrap_or(mantissa);
    let (sign, digits) = match mantissa.strip_prefix(['-', '+']) {
        Some(digits) => (&mantissa[..1], digits),
        None => ("", mantissa),
    };
    let zero = if digits.starts_with('.') { "0" } else { "" };
    format!("{sign}{zero}{digits}{exponent}")
}
