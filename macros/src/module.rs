//! The module of an invocation: the file beside the robot file, if its stamp is current.

use std::fs;
use std::path::{Path, PathBuf};

use dalembert_stamp::{Asked, Stale, Stamp};
use proc_macro2::{Ident, TokenStream};
#[cfg(not(feature = "search"))]
use quote::ToTokens;
use quote::quote;
use syn::Attribute;

use crate::invocation::{Errors, Invocation, named};

/// Paths of robot files are relative to the first of these folders that has the file.
pub(crate) fn expand(input: TokenStream, folders: &[PathBuf]) -> TokenStream {
    let mut errors = Errors::default();
    let Some(invocation) = Invocation::read(input, &mut errors) else {
        return errors.tokens();
    };
    let (watch, modules) = match errors.is_empty() {
        true => modules(&invocation, folders, &mut errors),
        false => Default::default(),
    };
    let errors = errors.tokens();
    quote!(#watch #errors #modules)
}

type Wanted = (Ident, Asked);

type Refusal = (PathBuf, Stale);

fn modules(
    invocation: &Invocation,
    folders: &[PathBuf],
    errors: &mut Errors,
) -> (TokenStream, TokenStream) {
    let wanted = wanted(invocation);
    if invocation.has_text() {
        let modules = generated(invocation, None, &wanted, &[], errors);
        return (TokenStream::new(), modules);
    }
    let (robot, text) = match robot(invocation, folders) {
        Ok(pair) => pair,
        Err((message, help)) => {
            errors.say(&invocation.robot, &message, &help);
            return Default::default();
        }
    };
    let mut watch = watched(&robot);
    let (mut modules, mut refused) = (TokenStream::new(), Vec::new());
    for (name, asked) in &wanted {
        let file = robot.with_file_name(format!("{name}.rs"));
        let source = fs::read_to_string(&file).ok();
        watch.extend(source.as_ref().map(|_| watched(&file)));
        match Stamp::check(source.as_deref(), env!("CARGO_PKG_VERSION"), &text, asked) {
            Ok(()) => {
                let code = source.unwrap_or_default();
                modules.extend(module(invocation, name, &code, TokenStream::new(), errors));
            }
            Err(stale) => refused.push((file, stale)),
        }
    }
    if !refused.is_empty() {
        watch.extend(watched(&robot.with_extension("plan")));
        modules = generated(invocation, Some(&robot), &wanted, &refused, errors);
    }
    (watch, modules)
}

fn wanted(invocation: &Invocation) -> Vec<Wanted> {
    let name = &invocation.name;
    let module =
        |(suffix, asked): (&str, Asked)| (named(&format!("{name}{suffix}"), name.span()), asked);
    let files = invocation.asked.by_scalar().into_iter();
    files.map(module).collect()
}

fn robot(
    invocation: &Invocation,
    folders: &[PathBuf],
) -> Result<(PathBuf, String), (String, String)> {
    let shown = invocation.robot.value();
    let mut places = folders.iter().map(|folder| folder.join(&shown));
    // A file that is nowhere is missed where it is looked for first.
    let first = places.next().unwrap_or_else(|| PathBuf::from(&shown));
    let path = match first.is_file() {
        true => first,
        false => places.find(|path| path.is_file()).unwrap_or(first),
    };
    match fs::read(&path) {
        Ok(bytes) => Ok((path, String::from_utf8_lossy(&bytes).into_owned())),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let meant =
                meant(&path).map(|file| format!("did you mean `{}`?", beside(&shown, &file)));
            let help = meant.unwrap_or_else(|| RELATIVE.to_owned());
            Err((format!("`{shown}` does not exist"), help))
        }
        Err(error) => Err((format!("cannot read `{shown}`: {error}"), String::new())),
    }
}

fn meant(path: &Path) -> Option<String> {
    let stem = path.file_stem()?.to_str()?.to_owned();
    let names = fs::read_dir(path.parent()?).ok()?.filter_map(|entry| {
        let name = entry.ok()?.file_name().into_string().ok()?;
        let same = stem.chars().zip(name.chars()).take_while(|(a, b)| a == b);
        let is_alike = same.count() * 2 >= stem.len();
        (is_alike && name.ends_with(".toml")).then_some(name)
    });
    // The order of a folder differs between machines.
    names.min()
}

fn beside(shown: &str, file: &str) -> String {
    match shown.rsplit_once('/') {
        Some((folder, _)) => format!("{folder}/{file}"),
        None => file.to_owned(),
    }
}

const RELATIVE: &str =
    "the path is relative to the folder of Cargo.toml or of the file with the macro";

/// Returns an item that makes an edit of a file expand the macro again; none where there is no file.
fn watched(path: &Path) -> TokenStream {
    match path.to_str() {
        Some(path) if Path::new(path).is_file() => {
            quote!(
                const _: &[::core::primitive::u8] = ::core::include_bytes!(#path);
            )
        }
        _ => TokenStream::new(),
    }
}

fn module(
    invocation: &Invocation,
    name: &Ident,
    text: &str,
    further: TokenStream,
    errors: &mut Errors,
) -> TokenStream {
    let body = match with_attributes(text).parse::<TokenStream>() {
        Ok(body) => body,
        Err(error) => {
            let text = format!("the generated text has no tokens: {error}");
            errors.say(&invocation.name, &text, "");
            return TokenStream::new();
        }
    };
    let (attributes, visibility) = (&invocation.attributes, &invocation.visibility);
    let facade = &invocation.facade;
    let is_doc = |attribute: &Attribute| attribute.path().is_ident("doc");
    let gap = attributes.iter().any(is_doc).then(|| quote!(#![doc = ""]));
    // The functions that it calls are found in the facade, wherever that is.
    let import = |is_called: bool, import: TokenStream| is_called.then(|| quote!(use #import;));
    let libm = import(text.contains("libm::"), quote!(#facade::__private::libm));
    let sines = text.contains("dalembert_sines::");
    let sines = import(sines, quote!(#facade::__private::dalembert_sines));
    let batch = text.contains("dalembert_batch::");
    let batch = import(batch, quote!(#facade::batch as dalembert_batch));
    quote! {
        #(#attributes)*
        #visibility mod #name {
            #gap
            #body
            #libm #sines #batch
            #further
        }
    }
}

/// An editor that reads tokens itself takes a third slash for a part of the comment.
fn with_attributes(text: &str) -> String {
    let mut attributes = String::with_capacity(text.len());
    for line in text.lines() {
        let words = line.trim_start();
        match (words.strip_prefix("///"), words.strip_prefix("//!")) {
            (Some(said), _) => attributes += &format!("#[doc = {said:?}]"),
            (_, Some(said)) => attributes += &format!("#![doc = {said:?}]"),
            _ => attributes += line,
        }
        attributes.push('\n');
    }
    attributes
}

#[cfg(feature = "search")]
fn generated(
    invocation: &Invocation,
    robot: Option<&Path>,
    wanted: &[Wanted],
    refused: &[Refusal],
    errors: &mut Errors,
) -> TokenStream {
    let shown = invocation.robot.value();
    for (file, stale) in refused {
        // A request for something else may have no use for the file.
        if matches!(stale, Stale::Robot | Stale::Text | Stale::Version(_)) {
            let file = shown_file(&shown, file);
            let is_text = *stale == Stale::Text;
            let force = if is_text { " --force" } else { "" };
            eprintln!(
                "note: {}: the module is generated while compiling; `dalembert renew {file}{force}` updates the file",
                stale.message(&file, &shown)
            );
        }
    }
    let (texts, mut warnings) = crate::search::texts(invocation, robot, errors);
    let pairs = wanted.iter().zip(&texts);
    let modules = pairs.map(|((name, _), text)| {
        let warnings = std::mem::take(&mut warnings);
        module(invocation, name, text, warnings, errors)
    });
    modules.collect()
}

#[cfg(not(feature = "search"))]
fn generated(
    invocation: &Invocation,
    robot: Option<&Path>,
    _: &[Wanted],
    refused: &[Refusal],
    errors: &mut Errors,
) -> TokenStream {
    let shown = invocation.robot.value();
    if robot.is_none() {
        errors.say(
            &invocation.robot,
            "a robot's text is generated while compiling, which needs the feature `search` of dalembert",
            "write the text to a file, and its path here",
        );
    }
    let outputs = invocation.asked.get("outputs").is_some();
    let generate = || {
        let mut asked = invocation.asked.clone();
        if asked.get("scalar") == Some("f64") && asked.get("scene").is_none() {
            // It is the default, but of a scene that has its own.
            let _ = asked.set("scalar", "");
        }
        let file = beside(&shown, &format!("{}.rs", invocation.name));
        format!("dalembert generate {shown}{} -o {file}", asked.arguments())
    };
    for (file, stale) in refused {
        let name = shown_file(&shown, file);
        let renew = format!("dalembert renew {name}");
        let robot = invocation.robot.to_token_stream();
        let (at, help) = match stale {
            Stale::Option(option, _) => (invocation.place(option, ""), generate()),
            Stale::Outputs(missing) if outputs => {
                let first = missing.first().map_or("", String::as_str);
                (invocation.place("outputs", first), generate())
            }
            Stale::Foreign => (robot, generate() + " --force"),
            Stale::Missing => {
                let search = "or let the compiler generate it, in minutes: cargo add dalembert \
                              --features search";
                (robot, format!("{}\n  = help: {search}", generate()))
            }
            Stale::Text => (robot, renew + " --force"),
            _ => (robot, renew),
        };
        errors.say(at, &stale.message(&name, &shown), &help);
        match stale {
            // One command makes all files that are missing.
            Stale::Missing => break,
            Stale::Outputs(missing) => {
                for output in missing.iter().skip(1) {
                    let at = invocation.place("outputs", output);
                    errors.say(at, &format!("nor `{output}`"), "");
                }
            }
            _ => {}
        }
    }
    TokenStream::new()
}

fn shown_file(shown: &str, file: &Path) -> String {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    beside(shown, &name)
}
