//! The grammar of `dynamics!`: a module with its robot, then clauses.

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::ext::IdentExt;
use syn::parse::{ParseStream, Parser};
use syn::{Attribute, LitStr, Token, Visibility};

use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::read::closest;

use super::errors::Errors;
use super::list;
use super::messages as m;
use super::statement::{self, Pair, pairs, trees};
use crate::function::Function;
use crate::program::ScalarType;
use crate::sincos::SinCos;
use crate::task::Request;
use crate::task::options::{Purpose, WordOption};
use crate::words::Word;

/// The content of an invocation.
pub(super) struct Invocation {
    /// Its documentation and other attributes, for each module.
    pub(super) attributes: Vec<Attribute>,
    pub(super) visibility: Visibility,
    pub(super) name: Ident,
    /// The path of a robot file, or the text of one.
    pub(super) robot: LitStr,
    /// With the tokens that asked for them. The scene's or the robot file's if none were chosen.
    pub(super) outputs: Option<Vec<(Function, TokenStream)>>,
    pub(super) scalars: Option<Vec<ScalarType>>,
    /// What options of one word say.
    pub(super) request: Request,
    /// The word that asked for batches.
    pub(super) batch_at: TokenStream,
    /// With the tokens that asked for them.
    pub(super) parameters: Vec<(RuntimeParameter, TokenStream)>,
    /// The scene's name.
    pub(super) scene: Option<Ident>,
    /// The path of the facade crate.
    pub(super) facade: TokenStream,
}

/// Returns the options of one word that have a clause.
fn options() -> impl Iterator<Item = &'static WordOption> {
    let all = WordOption::ALL.iter();
    all.filter(|option| option.purpose != Purpose::File)
}

/// Returns the names of the clauses, in the order of the documentation.
fn names() -> Vec<&'static str> {
    let mut names = vec!["outputs", "scalar"];
    names.extend(options().map(|option| option.word));
    names.extend(["sincos_error", "parameters", "scene", "crate"]);
    names
}

/// Reads an invocation; `None` if not even the module is there.
pub(super) fn read(input: TokenStream, errors: &mut Errors) -> Option<Invocation> {
    let mut head = None;
    let parsed = |input: ParseStream<'_>| {
        head = Some(self::head(input, errors)?);
        input.parse::<TokenStream>()
    };
    let rest = match parsed.parse2(input) {
        Ok(rest) => rest,
        Err(error) => {
            errors.syntax(error);
            return None;
        }
    };
    let (attributes, visibility, name, robot) = head?;
    let mut invocation = Invocation {
        attributes,
        visibility,
        name,
        robot,
        outputs: None,
        scalars: None,
        request: Request::default(),
        batch_at: TokenStream::new(),
        parameters: Vec::new(),
        scene: None,
        facade: quote!(::dalembert),
    };
    let mut error = None;
    for pair in clauses(rest, errors) {
        let key = clause_name(&pair.key, errors);
        if key == Some("sincos_error") && !pair.value.is_empty() {
            error = sincos_error(&pair.value, errors).map(|value| (pair.key.clone(), value));
        }
        invocation.clause(key, &pair.value, errors);
    }
    match (&mut invocation.request.sincos, error) {
        (SinCos::Polynomial { error }, Some((_, value))) => *error = Some(value),
        (_, Some((key, _))) => errors.push(key, &m::NO_POLYNOMIALS),
        (_, None) => {}
    }
    Some(invocation)
}

type Head = (Vec<Attribute>, Visibility, Ident, LitStr);

/// Reads `/// … pub mod name = "file";`.
fn head(input: ParseStream<'_>, errors: &mut Errors) -> syn::Result<Head> {
    let attributes = input.call(Attribute::parse_outer)?;
    let visibility = input.parse()?;
    let wanted = |message: &m::Message| input.error(message.with_help());
    if !input.peek(Token![mod]) {
        return Err(wanted(&m::NO_MODULE));
    }
    input.parse::<Token![mod]>()?;
    if !input.peek(Ident::peek_any) {
        return Err(wanted(&m::NO_MODULE));
    }
    let name: Ident = input.parse()?;
    if !input.peek(Token![=]) {
        return Err(wanted(&m::NO_ROBOT));
    }
    input.parse::<Token![=]>()?;
    if !input.peek(LitStr) {
        return Err(wanted(&m::NO_ROBOT));
    }
    let robot: LitStr = input.parse()?;
    if input.peek(Token![;]) {
        input.parse::<Token![;]>()?;
    } else if !input.is_empty() {
        errors.syntax(wanted(&m::NO_SEMICOLON));
    }
    Ok((attributes, visibility, name, robot))
}

fn clauses(rest: TokenStream, errors: &mut Errors) -> Vec<Pair> {
    let trees = trees(rest);
    let second = |tree: &TokenTree| matches!(tree, TokenTree::Ident(i) if *i == "mod");
    let end = match trees.iter().position(second) {
        Some(place) => {
            errors.push(&trees[place], &m::TWO_ROBOTS);
            // What comes before it may be its documentation.
            let clause = |tree: &TokenTree| statement::is_punct(tree, ';');
            trees[..place].iter().rposition(clause).unwrap_or(0)
        }
        None => trees.len(),
    };
    pairs(&trees[..end], may_stand, errors)
}

/// Returns what may stand behind a clause's name, for who wrote nothing there.
fn may_stand(clause: &str) -> String {
    match clause {
        "outputs" => list::known(&Function::known()),
        "scalar" => list::known(&ScalarType::known()),
        "parameters" => list::known(&RuntimeParameter::known()),
        "sincos_error" => m::SINCOS_ERROR.help.to_owned(),
        "scene" => m::SCENE_CLAUSE.help.to_owned(),
        "crate" => m::CRATE_PATH.help.to_owned(),
        _ => match options().find(|option| option.word == clause) {
            Some(option) => list::known(&(option.known)()),
            None => String::new(),
        },
    }
}

impl Invocation {
    /// Returns whether the literal is the text of a robot file: it has more lines than a path.
    pub(super) fn has_text(&self) -> bool {
        self.robot.value().contains('\n')
    }

    /// Returns the name of the robot file in messages: its path, or the module's name.
    pub(super) fn shown(&self) -> String {
        match self.has_text() {
            true => self.name.to_string(),
            false => self.robot.value(),
        }
    }

    fn clause(&mut self, key: Option<&str>, value: &[TokenTree], errors: &mut Errors) {
        match key {
            Some("outputs") => {
                let chosen = self.outputs.get_or_insert_default();
                for (output, at) in list::outputs(value, errors) {
                    if chosen
                        .iter()
                        .any(|(earlier, _)| output.is_namesake(*earlier))
                    {
                        errors.twice(&at);
                    } else {
                        chosen.push((output, at));
                    }
                }
            }
            Some("scalar") => {
                let chosen = self.scalars.get_or_insert_default();
                for (scalar, at) in list::words::<ScalarType>(value, errors) {
                    if chosen.contains(&scalar) {
                        errors.twice(&at);
                    } else {
                        chosen.push(scalar);
                    }
                }
            }
            Some("parameters") => {
                for (parameter, at) in list::words::<RuntimeParameter>(value, errors) {
                    if self.parameters.iter().any(|(known, _)| *known == parameter) {
                        errors.twice(&at);
                    } else {
                        self.parameters.push((parameter, at));
                    }
                }
            }
            Some("scene") => match value {
                [TokenTree::Ident(name)] => self.scene = Some(name.clone()),
                [] => {}
                [other, ..] => errors.push(other, &m::SCENE_CLAUSE),
            },
            Some("crate") => {
                if let Some(path) = facade(value, errors) {
                    self.facade = path;
                }
            }
            Some(word) => {
                if let Some(option) = options().find(|option| option.word == word) {
                    list::set(option, &mut self.request, value, errors);
                }
                if word == "batch" {
                    self.batch_at = value.iter().cloned().collect();
                }
            }
            None => {}
        }
    }
}

/// Returns the name of a clause; an unknown one counts as the one that was probably
/// meant, so that it is not missing as well.
fn clause_name(key: &Ident, errors: &mut Errors) -> Option<&'static str> {
    let (word, names) = (key.to_string(), names());
    if let Some(known) = names.iter().find(|known| **known == word) {
        return Some(known);
    }
    let meant = closest(&word, &names);
    let help = match meant {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("known: {}", names.join(", ")),
    };
    errors.say(key, &format!("unknown clause `{word}`"), &help);
    meant
}

/// Returns an error of sines, as a float literal.
fn sincos_error(value: &[TokenTree], errors: &mut Errors) -> Option<f64> {
    let tokens: TokenStream = value.iter().cloned().collect();
    let number = match value {
        [TokenTree::Literal(literal)] => literal.to_string().replace('_', "").parse().ok(),
        _ => None,
    };
    let number = number.filter(|error: &f64| *error > 0.0 && *error < 1.0);
    if number.is_none() {
        errors.push(tokens, &m::SINCOS_ERROR);
    }
    number
}

/// Returns the path of the facade crate, as an import inside the module can take it.
fn facade(value: &[TokenTree], errors: &mut Errors) -> Option<TokenStream> {
    let tokens: TokenStream = value.iter().cloned().collect();
    if value.is_empty() {
        return None;
    }
    let parser = syn::Path::parse_mod_style;
    let Ok(path) = parser.parse2(tokens.clone()) else {
        errors.push(tokens, &m::CRATE_PATH);
        return None;
    };
    let start = path.segments.first().map(|s| s.ident.clone());
    if let Some(start) = start.filter(|s| s == "self" || s == "super") {
        errors.push(start, &m::CRATE_RELATIVE);
        return None;
    }
    Some(path.into_token_stream())
}
