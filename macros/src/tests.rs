//! Tokens of `dynamics!` at random: modules or errors, never a panic.

use std::path::PathBuf;
use std::str::FromStr;

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use crate::module::expand;

/// Numbers of a linear congruence, the same on every machine.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn bits(&mut self) -> u64 {
        let next = self.0.wrapping_mul(0x5851_f42d_4c95_7f2d);
        self.0 = next.wrapping_add(0x1405_7b7e_f767_814f);
        self.0 >> 16
    }

    fn below(&mut self, end: usize) -> usize {
        (self.bits() % end as u64) as usize
    }
}

/// Returns a dose for every day; `FUZZ_TIMES` multiplies it.
fn dose(runs: usize) -> usize {
    let times = std::env::var("FUZZ_TIMES").ok();
    let times: Option<usize> = times.and_then(|times| times.parse().ok());
    runs * times.unwrap_or(1)
}

const WHOLE: &str = r#"
    /// An arm.
    pub(crate) mod arm = "
        name = 'arm'
        convention = 'modified'
        gravity = [0, 0, -9_810e-3]
        [[joint]]
        name = 'slide 1'
        kind = 'prismatic'
        theta = '-90deg'
        mass = 2.5
        com = [0, 0.1, 0]
        inertia = [0.1, 0.1, 0.05, 0, 0, 0]
        [[joint]]
        kind = 'revolute'
        alpha = '-pi/2'
        a = 0.3
        mass = 0
        inertia = [0, 0, 0, 0, 0, 0]
    ";
    outputs: gravity;
    scalar: f32, f64;
    formulation: newton_euler;
"#;

const PIECES: [&str; 44] = [
    "mod",
    "pub",
    "arm",
    "joint",
    "outputs",
    "scalar",
    "formulation",
    "gravity",
    "inertia",
    "f64",
    "f32",
    "auto",
    "revolute",
    "prismatic",
    "kind",
    "mass",
    "limits",
    "position",
    "pi",
    "deg",
    "90deg",
    "0",
    "1",
    "-1",
    "0.5",
    "1e400",
    "1e-400",
    "0x1f",
    "1f32",
    "1_0",
    "99999999999999999999",
    "\"pi/2\"",
    "\"robots/none.toml\"",
    "b\"x\"",
    "'c'",
    ":",
    ";",
    ",",
    "=",
    "/",
    "*",
    "-",
    "#",
    "'a",
];

fn piece(random: &mut Random) -> TokenStream {
    TokenStream::from_str(PIECES[random.below(PIECES.len())]).expect("pieces are tokens")
}

/// Returns the tokens with a few cut out, doubled, moved, put in or wrapped.
fn mutate(tokens: TokenStream, random: &mut Random, rate: usize) -> TokenStream {
    let mut out: Vec<TokenTree> = Vec::new();
    for tree in tokens {
        let tree = match tree {
            TokenTree::Group(group) => {
                let inner = mutate(group.stream(), random, rate);
                let delimiter = match random.below(20 * rate) {
                    0 => Delimiter::Parenthesis,
                    1 => Delimiter::None,
                    2 => Delimiter::Bracket,
                    _ => group.delimiter(),
                };
                TokenTree::Group(Group::new(delimiter, inner))
            }
            other => other,
        };
        match random.below(12 * rate) {
            0 => {}
            1 => out.extend([tree.clone(), tree]),
            2 => {
                out.push(tree);
                out.extend(piece(random));
            }
            3 => out.extend(piece(random)),
            4 => {
                let at = random.below(out.len() + 1);
                out.insert(at, tree);
            }
            _ => out.push(tree),
        }
    }
    out.into_iter().collect()
}

/// Asserts that something comes back, and that it is tokens that print and read again.
fn check(tokens: TokenStream) -> bool {
    let said = tokens.to_string();
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let text = expand(tokens, &[folder]).to_string();
    assert!(TokenStream::from_str(&text).is_ok(), "{said}");
    text.contains("compile_error")
}

#[test]
fn mutated_invocations() {
    let whole = TokenStream::from_str(WHOLE).unwrap();
    // Without the search, a robot's text is refused.
    let is_refused = check(whole.clone());
    assert_eq!(is_refused, cfg!(not(feature = "search")));
    let mut random = Random::new(41);
    let (mut wrong, runs) = (0, dose(300));
    for _ in 0..runs {
        let rate = 1 + random.below(40);
        wrong += usize::from(check(mutate(whole.clone(), &mut random, rate)));
    }
    println!("{runs} invocations, {wrong} with errors");
    assert!(
        wrong > 0 && (is_refused || wrong < runs),
        "{wrong} of {runs}"
    );
}

#[test]
fn tokens_in_any_order() {
    let mut random = Random::new(42);
    for _ in 0..dose(2000) {
        let mut tokens = TokenStream::new();
        for _ in 0..random.below(25) {
            let inner = if random.below(5) == 0 {
                let inner: TokenStream = (0..random.below(8)).map(|_| piece(&mut random)).collect();
                let delimiters = [Delimiter::Brace, Delimiter::Bracket, Delimiter::Parenthesis];
                let group = Group::new(delimiters[random.below(3)], inner);
                TokenTree::Group(group).into()
            } else {
                piece(&mut random)
            };
            tokens.extend(inner);
        }
        check(tokens);
    }
}

#[test]
fn text_in_any_order() {
    let mut random = Random::new(43);
    for _ in 0..dose(2000) {
        let mut bytes = WHOLE.as_bytes().to_vec();
        for _ in 0..1 + random.below(4) {
            let at = random.below(bytes.len());
            match random.below(3) {
                0 => bytes[at] = (random.bits() & 0x7f) as u8,
                1 => drop(bytes.drain(at..(at + random.below(30)).min(bytes.len()))),
                _ => {
                    let to = (at + random.below(30)).min(bytes.len());
                    let copy = bytes[at..to].to_vec();
                    let at = random.below(bytes.len());
                    drop(bytes.splice(at..at, copy));
                }
            }
        }
        // What is no Rust never reaches the macro.
        if let Ok(tokens) = TokenStream::from_str(&String::from_utf8_lossy(&bytes)) {
            check(tokens);
        }
    }
}
