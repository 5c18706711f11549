//! A robot that is written in the macro.
//!
//! Its tokens are written out as a robot file, which the reader of robot
//! files reads, and what that says is mapped back to the tokens: so the
//! macro has the reader's numbers, angles, checks and messages, and cannot
//! differ from it. Every piece of the text has a mark with its tokens.

use std::ops::Range;

use proc_macro2::{Delimiter, Group, Ident, TokenStream, TokenTree};
use quote::ToTokens;
use syn::Lit;

use dalembert_model::number::Angle;
use dalembert_model::number::parse::{NumberError, parse_decimal, write_decimal};
use dalembert_model::read::{self, Diagnostic, Options};
use dalembert_model::robot::{Robot, Severity};
use dalembert_model::scene::Scene;

use super::errors::Errors;
use super::messages as m;
use super::statement::{self, Pair, group, pairs, trees};
use super::warnings::Warning;
use crate::function::Function;

/// A robot and what is worth knowing about it; or as much as its callers need
/// to go on after an error.
pub(super) struct Read {
    pub(super) robot: Option<Robot>,
    pub(super) outputs: Vec<Function>,
    pub(super) scenes: Vec<Scene>,
    pub(super) joints: usize,
    pub(super) warnings: Vec<Warning>,
}

/// Reads the block behind the module's name, and the scene of the clause.
pub(super) fn read(
    name: &Ident,
    block: &Group,
    scene: Option<(&Ident, &Group)>,
    errors: &mut Errors,
) -> Read {
    let Blocks {
        keys,
        joints,
        frames,
        scenes,
    } = split(block, errors);
    let mut file = File::default();
    file.name(name);
    for pair in pairs(&keys, ';', errors) {
        match pair.key.to_string().as_str() {
            "name" => errors.push(&pair.key, &m::NAMED),
            "joint" => errors.push(&pair.key, &m::JOINT_BRACES),
            _ => file.line(&pair, errors),
        }
    }
    for (head, body) in joints.iter().chain(&frames) {
        let table = format!("[[{head}]]");
        file.mark(head.to_token_stream(), |file| file.text += &table);
        file.text.push('\n');
        for pair in pairs(&trees(body.stream()), ',', errors) {
            file.line(&pair, errors);
        }
    }
    for (head, body) in &scenes {
        file.scene(head, body, errors);
    }
    if let Some((head, body)) = scene {
        file.scene(head, body, errors);
    }
    let (robot, outputs, scenes, found) = match read::parse(&file.text, &Options::default()) {
        Ok(reading) => (
            Some(reading.robot),
            reading.outputs,
            reading.scenes,
            reading.notes,
        ),
        Err(diagnostics) => (None, Vec::new(), Vec::new(), diagnostics.0),
    };
    let warnings = match robot {
        Some(_) => {
            let odd = found.iter().filter(|d| d.severity == Severity::Warning);
            odd.map(|found| file.warning(found, name)).collect()
        }
        None => {
            for diagnostic in &found {
                file.report(diagnostic, name, errors);
            }
            Vec::new()
        }
    };
    Read {
        robot,
        outputs,
        scenes,
        joints: joints.len(),
        warnings,
    }
}

/// Reads a scene that stands in the macro beside the text of a robot file,
/// which is right by itself. Returns the file's scenes and this one.
pub(super) fn beside(source: &str, name: &Ident, body: &Group, errors: &mut Errors) -> Vec<Scene> {
    let mut file = File {
        text: format!("{source}\n"),
        ..File::default()
    };
    file.scene(name, body, errors);
    match read::parse(&file.text, &Options::default()) {
        Ok(reading) => reading.scenes,
        Err(diagnostics) => {
            for diagnostic in &diagnostics.0 {
                file.report(diagnostic, name, errors);
            }
            Vec::new()
        }
    }
}

/// The parts of a robot's block.
#[derive(Default)]
struct Blocks {
    keys: Vec<TokenTree>,
    joints: Vec<(Ident, Group)>,
    frames: Vec<(Ident, Group)>,
    scenes: Vec<(Ident, Group)>,
}

/// Returns the robot's own keys, its joints, its frames and its scenes. A file has them in this
/// order too.
fn split(block: &Group, errors: &mut Errors) -> Blocks {
    let mut blocks = Blocks::default();
    let all = trees(block.stream());
    let mut rest = all.as_slice();
    while let Some((tree, after)) = rest.split_first() {
        let braces = |tree: &TokenTree| group(tree, Delimiter::Brace).cloned();
        if let (TokenTree::Ident(word), [TokenTree::Ident(name), body, ..]) = (tree, after)
            && word == "scene"
            && let Some(body) = braces(body)
        {
            blocks.scenes.push((name.clone(), body));
            rest = &after[2..];
            continue;
        }
        match (tree, after.first().and_then(braces)) {
            (TokenTree::Ident(word), Some(body)) => {
                match word.to_string().as_str() {
                    "scene" => errors.push(word, &m::SCENE_NAME),
                    "frame" => blocks.frames.push((word.clone(), body)),
                    "joint" => blocks.joints.push((word.clone(), body)),
                    _ => {
                        errors.push(word, &m::NO_ITEM);
                        let joint = Ident::new("joint", word.span());
                        blocks.joints.push((joint, body));
                    }
                }
                rest = &after[1..];
            }
            _ => {
                blocks.keys.push(tree.clone());
                rest = after;
            }
        }
    }
    blocks
}

/// The robot file as it is written.
#[derive(Default)]
struct File {
    text: String,
    /// Which tokens a piece of the text is of.
    marks: Vec<(Range<usize>, TokenStream)>,
    /// Pieces that stand in for tokens which were reported already.
    skipped: Vec<Range<usize>>,
}

impl File {
    fn mark(&mut self, tokens: TokenStream, write: impl FnOnce(&mut Self)) {
        let start = self.text.len();
        write(self);
        self.marks.push((start..self.text.len(), tokens));
    }

    /// Reads the name, with which the file begins: what is wrong with the robot as a whole is
    /// reported there.
    fn name(&mut self, name: &Ident) {
        self.mark(name.to_token_stream(), |file| {
            file.text += "name = ";
            file.quoted(&name.to_string());
        });
        self.text.push('\n');
    }

    /// Writes a scene's table.
    fn scene(&mut self, head: &Ident, body: &Group, errors: &mut Errors) {
        self.text += "[scene.";
        self.mark(head.to_token_stream(), |file| {
            file.text += &head.to_string();
        });
        self.text += "]\n";
        for pair in pairs(&trees(body.stream()), ',', errors) {
            self.line(&pair, errors);
        }
    }

    fn line(&mut self, pair: &Pair, errors: &mut Errors) {
        self.pair(pair, errors);
        self.text.push('\n');
    }

    fn pair(&mut self, pair: &Pair, errors: &mut Errors) {
        let key = pair.key.to_string();
        self.mark(pair.key.to_token_stream(), |file| match key.is_ascii() {
            true => file.text += key.trim_start_matches("r#"),
            false => file.quoted(&key),
        });
        self.text += " = ";
        match pair.value.as_slice() {
            // Its keys are joints, which may be numbers.
            [tree] if key == "lock" && group(tree, Delimiter::Brace).is_some() => {
                self.mark(tree.to_token_stream(), |file| {
                    if let Some(block) = group(tree, Delimiter::Brace) {
                        file.locks(block, errors);
                    }
                });
            }
            value => self.value(value, errors),
        }
    }

    /// Writes `{ 4: 0, elbow: pi/2 }`
    fn locks(&mut self, block: &Group, errors: &mut Errors) {
        self.text += "{ ";
        let mut written = 0;
        for item in statement::items(&trees(block.stream())) {
            let [
                joint @ (TokenTree::Ident(_) | TokenTree::Literal(_)),
                colon,
                value @ ..,
            ] = item
            else {
                errors.push(block, &m::NO_LOCK);
                continue;
            };
            if !statement::is_punct(colon, ':') || value.is_empty() {
                errors.push(joint, &m::NO_LOCK);
                continue;
            }
            if written > 0 {
                self.text += ", ";
            }
            written += 1;
            self.mark(joint.to_token_stream(), |file| {
                file.text += &joint.to_string()
            });
            self.text += " = ";
            self.value(value, errors);
        }
        self.text += " }";
    }

    fn value(&mut self, value: &[TokenTree], errors: &mut Errors) {
        self.mark(value.iter().cloned().collect(), |file| match value {
            [] => file.skip_to_here(),
            [tree] => {
                if let Some(list) = group(tree, Delimiter::Bracket) {
                    file.list(list, errors);
                } else if let Some(block) = group(tree, Delimiter::Brace) {
                    file.block(block, errors);
                } else {
                    file.scalar(value, errors);
                }
            }
            _ => file.scalar(value, errors),
        });
    }

    fn list(&mut self, list: &Group, errors: &mut Errors) {
        self.text.push('[');
        for item in statement::items(&trees(list.stream())) {
            if item.is_empty() {
                errors.push(list, &m::NO_VALUE);
            }
            self.value(item, errors);
            self.text += ", ";
        }
        self.text.push(']');
    }

    fn block(&mut self, block: &Group, errors: &mut Errors) {
        self.text += "{ ";
        for (index, pair) in pairs(&trees(block.stream()), ',', errors)
            .iter()
            .enumerate()
        {
            if index > 0 {
                self.text += ", ";
            }
            self.pair(pair, errors);
        }
        self.text += " }";
    }

    /// Writes a number, an angle or a word, from the source text of its tokens.
    fn scalar(&mut self, value: &[TokenTree], errors: &mut Errors) {
        let literals = value.iter().filter_map(|tree| match tree {
            TokenTree::Literal(literal) => Some(Lit::new(literal.clone())),
            _ => None,
        });
        for literal in literals {
            let suffix = match &literal {
                Lit::Str(text) if value.len() == 1 => return self.quoted(&text.value()),
                Lit::Int(number) => number.suffix(),
                Lit::Float(number) => number.suffix(),
                _ => "",
            };
            if !matches!(suffix, "" | "deg") {
                errors.push(literal, &m::SUFFIX);
                return self.skip_to_here();
            }
        }
        let text = join(value);
        let error = match parse_decimal(&text) {
            Ok(number) => {
                // In the form that a file may have: without `1e400` integers.
                let plain = write_decimal(&number).unwrap_or(text);
                self.text += &plain;
                return;
            }
            Err(error) => error,
        };
        let unsigned = text.trim_start_matches(['-', '+']);
        let number = unsigned.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        if error == NumberError::Malformed && (!number || Angle::parse(&text).is_ok()) {
            return self.quoted(&text);
        }
        let at: TokenStream = value.iter().cloned().collect();
        match error {
            NumberError::Malformed => errors.push(at, &m::NO_NUMBER),
            error => errors.say(at, &format!("`{text}` is {error}"), error.help()),
        }
        self.skip_to_here();
    }

    /// Stands in for a value that cannot be read: whatever the key, the
    /// reader refuses it, and so says nothing that rests on it.
    fn skip_to_here(&mut self) {
        let start = self.text.len();
        self.text += "nan";
        self.skipped.push(start..self.text.len());
    }

    fn quoted(&mut self, text: &str) {
        self.text.push('"');
        for c in text.chars() {
            match c {
                '"' | '\\' => self.text.extend(['\\', c]),
                c if c.is_control() => self.text += &format!("\\U{:08X}", u32::from(c)),
                c => self.text.push(c),
            }
        }
        self.text.push('"');
    }

    /// Reports at the innermost tokens that the message is about.
    fn report(&self, found: &Diagnostic, name: &Ident, errors: &mut Errors) {
        let at = found.span.start;
        if self.skipped.iter().any(|range| range.contains(&at)) {
            return;
        }
        let help = found.help.as_deref().map(reword).unwrap_or_default();
        errors.say(self.tokens(found, name), &reword(&found.message), &help);
    }

    /// Returns what is odd, at the innermost tokens that it is about.
    fn warning(&self, found: &Diagnostic, name: &Ident) -> Warning {
        Warning {
            at: self.tokens(found, name),
            text: reword(&found.message),
            help: found.help.as_deref().map(reword),
        }
    }

    fn tokens(&self, found: &Diagnostic, name: &Ident) -> TokenStream {
        let at = found.span.start;
        let around = self.marks.iter().filter(|(range, _)| range.contains(&at));
        match around.min_by_key(|(range, _)| range.len()) {
            Some((_, tokens)) => tokens.clone(),
            None => name.to_token_stream(),
        }
    }
}

/// Returns the source text of a value; spaces only where two words would become one.
fn join(value: &[TokenTree]) -> String {
    let mut text = String::new();
    let mut word = false;
    for tree in value {
        let next = matches!(tree, TokenTree::Ident(_) | TokenTree::Literal(_));
        if word && next {
            text.push(' ');
        }
        word = next;
        text += &tree.to_string();
    }
    text
}

/// The reader's words about a file, and the macro's for the same.
const DIALECT: [(&str, &str); 8] = [
    ("a [scene.NAME] table", "a `scene NAME { … }` block"),
    ("the robot has: name, ", "the robot has: "),
    ("[[joint]] tables", "`joint { … }` blocks"),
    ("[[joint]] table", "`joint { … }` block"),
    ("[[joint]]", "`joint { … }`"),
    ("the string ", ""),
    (" = ", ": "),
    ("\"", ""),
];

fn reword(text: &str) -> String {
    DIALECT.iter().fold(text.to_owned(), |text, (file, here)| {
        text.replace(file, here)
    })
}
