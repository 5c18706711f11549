//! The grammar of `dynamics!`: a module with its robot, then clauses.

use dalembert_stamp::Asked;
use proc_macro2::{Delimiter, Ident, Spacing, Span, TokenStream, TokenTree};
use quote::ToTokens;
use syn::ext::IdentExt;
use syn::parse::{ParseStream, Parser};
use syn::{Attribute, Error, LitStr, Path, Token, Visibility};

pub(crate) struct Invocation {
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) visibility: Visibility,
    pub(crate) name: Ident,
    pub(crate) robot: LitStr,
    pub(crate) clauses: Vec<Clause>,
    pub(crate) asked: Asked,
    pub(crate) facade: Path,
}

/// `name: item, item;`
pub(crate) struct Clause {
    pub(crate) key: Ident,
    pub(crate) items: Vec<TokenStream>,
}

/// Errors, each at the tokens that it is about, so that all of them are reported at once.
#[derive(Default)]
pub(crate) struct Errors(Vec<Error>);

impl Errors {
    pub(crate) fn say(&mut self, at: impl ToTokens, text: &str, help: &str) {
        self.0.push(Error::new_spanned(at, with_help(text, help)));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn tokens(&self) -> TokenStream {
        self.0.iter().map(Error::to_compile_error).collect()
    }
}

fn with_help(text: &str, help: &str) -> String {
    match help {
        "" => text.to_owned(),
        help => format!("{text}\n  = help: {help}"),
    }
}

/// Returns the text of an item, as requests have it: without spaces.
pub(crate) fn text(item: &TokenStream) -> String {
    let trees = item.clone().into_iter().map(|tree| match tree {
        TokenTree::Ident(word) => word.unraw().to_string(),
        tree => tree.to_string(),
    });
    let text: String = trees.collect();
    text.chars().filter(|c| !c.is_whitespace()).collect()
}

impl Invocation {
    /// Reads an invocation; `None` if not even the module is there.
    pub(crate) fn read(input: TokenStream, errors: &mut Errors) -> Option<Invocation> {
        let mut head = None;
        let mut late = Vec::new();
        let parsed = |input: ParseStream<'_>| {
            head = Some(self::head(input, &mut late)?);
            input.parse::<TokenStream>()
        };
        let outcome = parsed.parse2(input);
        let rest = outcome.map_err(|error| errors.0.push(error)).ok()?;
        errors.0.extend(late);
        let mut invocation = head?;
        invocation.read_clauses(&trees(rest), errors);
        Some(invocation)
    }

    /// Returns `true` if the literal is the text of a robot file: it has more lines than a path.
    pub(crate) fn has_text(&self) -> bool {
        self.robot.value().contains('\n')
    }

    #[cfg(feature = "search")]
    pub(crate) fn shown(&self) -> String {
        match self.has_text() {
            true => self.name.to_string(),
            false => self.robot.value(),
        }
    }

    pub(crate) fn clause(&self, option: &str) -> Option<&Clause> {
        self.clauses.iter().find(|clause| clause.key == option)
    }

    /// Returns the item's token that a message quotes first, else the item.
    #[cfg(feature = "search")]
    pub(crate) fn word(&self, option: &str, item: &str, message: &str) -> TokenStream {
        let place = self.place(option, item);
        let quoted = message.split('`').nth(1).unwrap_or_default();
        let words = place.clone().into_iter();
        let idents = words.filter(|tree| matches!(tree, TokenTree::Ident(word) if word == quoted));
        idents.last().map_or(place, |word| word.to_token_stream())
    }

    pub(crate) fn place(&self, option: &str, item: &str) -> TokenStream {
        let Some(clause) = self.clause(option) else {
            return self.name.to_token_stream();
        };
        let mut items = clause.items.iter();
        let tokens = items.rfind(|tokens| text(tokens) == item).cloned();
        tokens.unwrap_or_else(|| clause.key.to_token_stream())
    }

    fn read_clauses(&mut self, trees: &[TokenTree], errors: &mut Errors) {
        let mut rest = trees;
        while let Some((first, after)) = rest.split_first() {
            if is_punct(first, ';') {
                rest = after;
                continue;
            }
            let (clause, next) = rest.split_at(length(rest));
            rest = next;
            match clause {
                [first, ..] if is_punct(first, '#') || begins_module(first) => {
                    let module = clause.iter().find(|tree| begins_module(tree));
                    let help = "write a second `dynamics!` for the next";
                    let at = module.unwrap_or(first);
                    errors.say(at, "an invocation takes only one robot", help);
                    return;
                }
                [TokenTree::Ident(key), colon, value @ ..]
                    if is_punct(colon, ':') || key == "crate" && is_punct(colon, '=') =>
                {
                    self.read_clause(key, value, errors);
                }
                [TokenTree::Ident(_), ..] => {
                    let at = clause.get(1).unwrap_or(&clause[0]);
                    errors.say(at, "expected `:` after the clause's name", CLAUSE);
                }
                [first, ..] => errors.say(first, "expected the name of a clause", CLAUSE),
                [] => {}
            }
            if let Some(next) = rest.first()
                && !is_punct(next, ';')
            {
                errors.say(next, "expected `;` before the next clause", "");
            }
        }
    }

    fn read_clause(&mut self, key: &Ident, value: &[TokenTree], errors: &mut Errors) {
        let tokens = |trees: &[TokenTree]| trees.iter().cloned().collect::<TokenStream>();
        let option = key.unraw().to_string();
        if key == "crate" {
            self.read_facade(key, tokens(value), errors);
            return;
        }
        if self.clause(&option).is_some() {
            errors.say(key, &format!("`{key}` is given twice"), "");
            return;
        }
        let value = match value {
            [TokenTree::Group(list)] if list.delimiter() == Delimiter::Bracket => {
                self::trees(list.stream())
            }
            value => value.to_vec(),
        };
        if value.is_empty() {
            let help = format!("write `{key}: word;`, or leave the clause out");
            errors.say(key, "expected a value", &help);
            return;
        }
        let mut items: Vec<TokenStream> = Vec::new();
        let mut parts = value.split(|tree| is_punct(tree, ',')).peekable();
        while let Some(part) = parts.next() {
            // A comma at the end is fine.
            if part.is_empty() && parts.peek().is_some() {
                errors.say(key, "expected a word between two commas", "");
            }
            if let [.., TokenTree::Ident(_), second @ TokenTree::Ident(_)] = part {
                errors.say(second, "expected `,` or `;` before it", "");
            }
            if !part.is_empty() {
                items.push(tokens(part));
            }
        }
        let text = items.iter().map(text).collect::<Vec<String>>().join(",");
        if let Err(error) = self.asked.set(&option, &text) {
            errors.say(key, &format!("unknown clause `{option}`"), &error.help());
        }
        let key = key.clone();
        self.clauses.push(Clause { key, items });
    }

    fn read_facade(&mut self, key: &Ident, value: TokenStream, errors: &mut Errors) {
        let Ok(path) = Path::parse_mod_style.parse2(value.clone()) else {
            let help = "crate = ::my_library::dalembert;";
            let key_tokens = key.to_token_stream();
            let at = if value.is_empty() { key_tokens } else { value };
            errors.say(at, "expected the path of the crate `dalembert`", help);
            return;
        };
        let start = path.segments.first().map(|segment| &segment.ident);
        if let Some(start) = start.filter(|start| *start == "self" || *start == "super") {
            let text = "the path would be taken from inside the generated module";
            let help = "start with `crate::` or with the name of a crate";
            errors.say(start, text, help);
            return;
        }
        self.facade = path;
    }
}

const CLAUSE: &str = "a clause is `name: value;`, such as `outputs: inverse_dynamics, gravity;`";

/// Reads `/// … pub mod name = "file";`, an invocation without clauses.
fn head(input: ParseStream<'_>, late: &mut Vec<Error>) -> syn::Result<Invocation> {
    let attributes = input.call(Attribute::parse_outer)?;
    let visibility = input.parse()?;
    let wanted = |text: &str, help: &str| input.error(with_help(text, help));
    let no_module = || {
        let help = "pub mod puma560 = \"robots/puma560.toml\";";
        wanted("expected `mod` and the name of the module", help)
    };
    let no_robot = || {
        wanted(
            "expected the path of a robot file in quotes, or its text",
            "pub mod puma560 = \"robots/puma560.toml\"; or pub mod arm = r#\"name = …\"#; with line breaks",
        )
    };
    input.parse::<Token![mod]>().map_err(|_| no_module())?;
    let name: Ident = input.parse().map_err(|_| no_module())?;
    input.parse::<Token![=]>().map_err(|_| no_robot())?;
    let robot: LitStr = input.parse().map_err(|_| no_robot())?;
    if input.parse::<Option<Token![;]>>()?.is_none() && !input.is_empty() {
        late.push(wanted("expected `;` after the path", ""));
    }
    Ok(Invocation {
        attributes,
        visibility,
        name,
        robot,
        clauses: Vec::new(),
        asked: Asked::default(),
        facade: syn::parse_quote!(::dalembert),
    })
}

/// Counts up to a semicolon, or to the next key where the semicolon was forgotten.
fn length(trees: &[TokenTree]) -> usize {
    let is_colon = |tree: &TokenTree| match tree {
        TokenTree::Punct(punct) => punct.as_char() == ':' && punct.spacing() == Spacing::Alone,
        _ => false,
    };
    let mut has_frame = false;
    for (index, tree) in trees.iter().enumerate() {
        // Behind an `@` stands a frame, whose axes have colons.
        has_frame |= is_punct(tree, '@');
        has_frame &= !is_punct(tree, ',');
        let is_key = index > 1
            && !has_frame
            && matches!(tree, TokenTree::Ident(_))
            && trees.get(index + 1).is_some_and(is_colon)
            && !is_punct(&trees[index - 1], ':')
            && !is_punct(&trees[index - 1], ',');
        if is_punct(tree, ';') || is_key {
            return index;
        }
    }
    trees.len()
}

fn begins_module(tree: &TokenTree) -> bool {
    matches!(tree, TokenTree::Ident(word) if word == "mod" || word == "pub")
}

fn is_punct(tree: &TokenTree, c: char) -> bool {
    matches!(tree, TokenTree::Punct(punct) if punct.as_char() == c)
}

/// Returns the trees without the invisible groups around what another macro put in.
fn trees(tokens: TokenStream) -> Vec<TokenTree> {
    let mut trees = Vec::new();
    for tree in tokens {
        match tree {
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => {
                trees.extend(self::trees(group.stream()));
            }
            tree => trees.push(tree),
        }
    }
    trees
}

pub(crate) fn named(name: &str, span: Span) -> Ident {
    match name.strip_prefix("r#") {
        Some(raw) => Ident::new_raw(raw, span),
        None => Ident::new(name, span),
    }
}
