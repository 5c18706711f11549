//! Reads a function in C99: the lines of the arithmetic as in every language, and how C
//! writes sines, unread arguments and results.

use super::block::{Block, by_library, joint_of};
use super::reader::Reader;
use super::{TextError, at, expect, index_of, same};
use crate::language::c99::{FAR, Names, float, head, kernel_prefix, single, targets};
use crate::language::called::Called;
use crate::language::columns::batch;
use crate::language::dialect::holes;
use crate::language::{Printed, angles};
use crate::program::{Code, Library, Need};

impl Code {
    /// Reads a function out of the text of a header. Nothing is taken from the code of
    /// `printed`, which says what the function is.
    ///
    /// # Errors
    /// The first line that is not of such a function.
    pub fn parse_c(
        text: &str,
        printed: &Printed<'_>,
        has_columns: bool,
        names: &Names,
    ) -> Result<Code, TextError> {
        let all: Vec<&str> = text.lines().map(str::trim).collect();
        let heads = [true, false].map(|is_told| head(printed, names, is_told));
        let found = heads
            .each_ref()
            .map(|head| all.iter().position(|line| line == head));
        let (first, is_told) = match found {
            [Some(told), Some(plain)] => {
                same(&all, plain, &single(printed, names))?;
                (told, true)
            }
            [None, Some(plain)] => (plain, false),
            _ => return Err(at(0)(format!("there is no `{}`", heads[1]))),
        };
        let mut lines = all.iter().copied().enumerate().skip(first + 1);
        for expected in ["{", &names.constant("UNFUSED")] {
            let (number, line) = lines.next().unwrap_or((first, ""));
            expect(line, expected).map_err(at(number))?;
        }
        let mut reader = CReader {
            reader: Reader::new(names.dialect()),
            names,
            joints: printed.sizes.joints,
            far: FAR[usize::from(is_told)],
            block: None,
            call: Vec::new(),
            called: None,
        };
        let targets = targets(printed);
        let mut items = Vec::new();
        for (number, line) in lines {
            if line == "}" {
                let read = reader.finish(&items, &targets).map_err(at(number))?;
                if has_columns {
                    let text = batch(
                        &Printed {
                            code: &read,
                            ..*printed
                        },
                        names,
                    );
                    let start = text.find("\nstatic ").map_or(0, |end| end + 1);
                    let head = text[start..].lines().next().unwrap_or_default();
                    let place = all.iter().position(|line| *line == head);
                    let place = place.ok_or_else(|| at(0)(format!("there is no `{head}`")))?;
                    same(&all, place, &text[start..])?;
                }
                return Ok(read);
            }
            if items.is_empty() && reader.call(line).map_err(at(number))? {
                continue;
            }
            let mut unread = printed.arguments.iter();
            if items.is_empty() && unread.any(|a| line == format!("(void){};", a.name())) {
                continue;
            }
            if let Some(declaration) = line.strip_prefix("const ") {
                if !items.is_empty() {
                    return Err(at(number)("a statement after the result".into()));
                }
                reader.declaration(line, declaration).map_err(at(number))?;
                continue;
            }
            let result = match targets.get(items.len()) {
                Some(target) => holes::<2>("{} = {};", line)
                    .filter(|[found, _]| found == target)
                    .map(|[_, value]| value),
                None if targets.is_empty() && items.is_empty() => {
                    holes::<1>("return {};", line).map(|[value]| value)
                }
                None => None,
            };
            let value = result.ok_or_else(|| at(number)(format!("`{line}` is no result")))?;
            items.push(value);
        }
        Err(at(first)(format!("`{}` does not end", all[first])))
    }
}

struct CReader<'n> {
    reader: Reader,
    names: &'n Names,
    /// How long `q` is.
    joints: usize,
    /// The text about angles that are far.
    far: &'static str,
    /// The polynomials of the angle before.
    block: Option<Block>,
    /// Lines of a call that gives all sines, and whose sines it gives once it is read.
    call: Vec<String>,
    called: Option<Called>,
}

impl CReader<'_> {
    /// Takes a line of the call that gives all sines; whether it is one.
    fn call(&mut self, line: &str) -> Result<bool, String> {
        let float = float(self.reader.dialect.scalar);
        let list = holes::<2>(&format!("const {float} angles[{{}}] = {{{{}}}};"), line);
        let called = holes::<2>("{}({}, sines, cosines);", line);
        if list.is_none() && called.is_none() && !line.starts_with(&format!("{float} ")) {
            return Ok(false);
        }
        self.close();
        self.call.push(line.to_owned());
        if self.called.is_some() {
            return Err(format!("`{line}` after the call"));
        }
        let Some([name, given]) = called else {
            return Ok(true);
        };
        let count = name.strip_prefix(&self.names.of("sines_"));
        let count = count.and_then(|count| count.parse::<usize>().ok());
        let first = index_of(given, "&q").zip(count);
        let first = first.filter(|(first, count)| first.saturating_add(*count) <= self.joints);
        let called = match first {
            Some((first, count)) => Called::from(first, count),
            None => Called {
                first: None,
                angles: self.listed()?,
            },
        };
        if self.call != called.lines(self.names) {
            return Err(format!(
                "`{line}` gives no sines of angles that stand there"
            ));
        }
        self.reader.library = Library::Together;
        self.called = Some(called);
        Ok(true)
    }

    /// Reads the joints of the list in the first line of the call.
    fn listed(&self) -> Result<Vec<usize>, String> {
        let list = self.call.first().and_then(|line| line.split_once(" = {"));
        let list = list.and_then(|(_, list)| list.strip_suffix("};"));
        let words = list.unwrap_or_default().split(", ");
        let joints = words.map(|word| {
            let joint = index_of(word, "q").filter(|&joint| joint < self.joints);
            joint.ok_or_else(|| format!("`{word}` is no angle"))
        });
        joints.collect()
    }

    fn declaration(&mut self, line: &str, declaration: &str) -> Result<(), String> {
        let [kind, function] = ["sincos_t", "sincos"].map(|word| self.names.of(word));
        if let Some(rest) = declaration.strip_prefix(&format!("{kind} ")) {
            self.close();
            let [name, called, far, argument] =
                holes("{} = {}({}, {});", rest).ok_or_else(|| format!("`{line}` is no call"))?;
            expect(called, &function)?;
            expect(far, self.far)?;
            let joint = joint(name, 'p')?;
            self.begin(joint, argument)?;
            self.reader.library = Library::Together;
            self.reader.pairs.push(by_library(joint, Need::default()));
            return Ok(());
        }
        let [name, value] = holes(self.reader.dialect.declaration, line)
            .ok_or_else(|| format!("`{line}` gives no value a name"))?;
        match name.chars().next() {
            Some('x') => self.step(name, value),
            Some(letter @ ('s' | 'c')) => self.sine(letter, name, value),
            _ => {
                self.close();
                self.reader.declaration(name, value)
            }
        }
    }

    /// Reads an operation of an angle's polynomials.
    fn step(&mut self, name: &str, value: &str) -> Result<(), String> {
        let word = name.split_once('_').map_or("", |(word, _)| word);
        let joint = joint(word, 'x')?;
        if self.block.as_ref().is_none_or(|block| block.joint != joint) {
            self.close();
            let argument = angles::operand(joint);
            self.begin(joint, &argument)?;
            let prefix = kernel_prefix(joint);
            self.block = Some(Block::new(joint, Need::default(), argument, prefix));
        }
        let dialect = self.reader.dialect;
        match &mut self.block {
            Some(block) => block.step(name, value, dialect),
            None => Ok(()),
        }
    }

    /// Reads a sine or cosine: of polynomials, of a call for both, or a call of its own.
    fn sine(&mut self, letter: char, name: &str, value: &str) -> Result<(), String> {
        let (joint, dialect) = (joint(name, letter)?, self.reader.dialect);
        if let Some(block) = &mut self.block
            && block.joint == joint
        {
            block.result(value, dialect)?;
            return take(&mut block.need, letter, name);
        }
        self.close();
        let function = if letter == 's' { "sin" } else { "cos" };
        let last = self.reader.pairs.last();
        let is_new = last.is_none_or(|last| last.joint != joint || last.kernel.is_some());
        match self.reader.library {
            Library::Together if self.called.is_some() => {
                let called = self.called.as_ref();
                let expected = called.and_then(|called| called.value(joint, letter == 's'));
                let expected = expected.ok_or_else(|| format!("`{value}` is of no call"))?;
                expect(value, &expected)?;
                if is_new {
                    self.once(joint)?;
                    self.reader.pairs.push(by_library(joint, Need::default()));
                }
            }
            Library::Together if is_new => return Err(format!("`{value}` is of no call")),
            Library::Together => expect(value, &format!("p{}.{function}", joint + 1))?,
            Library::Libm => {
                let argument = angles::operand(joint);
                expect(value, &dialect.call("", function, &argument))?;
                if is_new {
                    self.begin(joint, &argument)?;
                    self.reader.pairs.push(by_library(joint, Need::default()));
                }
            }
        }
        match self.reader.pairs.last_mut() {
            Some(last) => take(&mut last.need, letter, name),
            None => Err(format!("`{name}` is of no angle")),
        }
    }

    /// Takes the angle that sines are taken of.
    fn begin(&self, joint: usize, argument: &str) -> Result<(), String> {
        expect(argument, &angles::operand(joint))?;
        self.once(joint)
    }

    /// Refuses sines of an angle that has some.
    fn once(&self, joint: usize) -> Result<(), String> {
        let mut all = self.reader.pairs.iter();
        match all.any(|pair| pair.joint == joint) {
            true => Err(format!("sines of `q[{joint}]` a second time")),
            false => Ok(()),
        }
    }

    fn close(&mut self) {
        if let Some(block) = self.block.take() {
            self.reader.pairs.push(block.done());
        }
    }

    fn finish(mut self, items: &[&str], targets: &[String]) -> Result<Code, String> {
        self.close();
        if self.called.is_none() && !self.call.is_empty() {
            return Err("the call that gives sines is missing".into());
        }
        if items.len() != targets.len().max(1) {
            return Err(format!("{} results expected", targets.len().max(1)));
        }
        self.reader.finish(items)
    }
}

/// Notes that a sine or cosine is taken, in this order, and once.
fn take(need: &mut Need, letter: char, name: &str) -> Result<(), String> {
    let taken = match letter {
        's' if need.cos => return Err(format!("`{name}` after its cosine")),
        's' => &mut need.sin,
        _ => &mut need.cos,
    };
    match std::mem::replace(taken, true) {
        true => Err(format!("`{name}` a second time")),
        false => Ok(()),
    }
}

/// Returns the joint of `s1`.
fn joint(word: &str, letter: char) -> Result<usize, String> {
    let joint = word.strip_prefix(letter).and_then(joint_of);
    joint.ok_or_else(|| format!("`{word}` is of no angle"))
}
