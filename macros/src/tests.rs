//! Tokens of `dynamics!` at random: modules or errors, never a panic.

use std::path::PathBuf;
use std::str::FromStr;

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use crate::module::expand;

/// Numbers of a linear congruence, the same on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        let next = self.0.wrapping_mul(0x5851_f42d_4c95_7f2d);
        self.0 = next.wrapping_add(0x1405_7b7e_f767_814f);
        ((self.0 >> 16) % end as u64) as usize
    }
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
    ";
    outputs: gravity, jacobian @ eye : local, hold = inertia + gravity;
    scalar: f32, f64;
    formulation: newton_euler;
    crate = ::my::dalembert;
"#;

const PIECES: &str = "mod pub arm joint outputs scalar formulation gravity inertia f64 f32 auto pi \
    kind limits crate self 90deg 0 -1 0.5 1e400 0x1f 1f32 99999999999999999999 \"pi/2\" \
    \"robots/none.toml\" b\"x\" 'c' : :: ; , = / * - # @ 'a r#mod [] [gravity] {} (a) #[doc]";

fn mutate(tokens: TokenStream, random: &mut Random, rate: usize) -> TokenStream {
    let pieces: Vec<&str> = PIECES.split_whitespace().collect();
    let piece = |random: &mut Random| {
        TokenStream::from_str(pieces[random.below(pieces.len())]).expect("pieces are tokens")
    };
    let mut out: Vec<TokenTree> = Vec::new();
    for tree in tokens {
        let tree = match (tree, random.below(20 * rate)) {
            (TokenTree::Group(group), case) => {
                let inner = mutate(group.stream(), random, rate);
                let delimiters = [Delimiter::Parenthesis, Delimiter::None, Delimiter::Bracket];
                let delimiter = delimiters.get(case).copied().unwrap_or(group.delimiter());
                Group::new(delimiter, inner).into()
            }
            // Tokens that another macro puts in stand in an invisible group.
            (tree, 0) => Group::new(Delimiter::None, tree.into()).into(),
            (tree, _) => tree,
        };
        match random.below(12 * rate) {
            0 => {}
            1 => out.extend([tree.clone(), tree]),
            2 => {
                out.push(tree);
                out.extend(piece(random));
            }
            3 => out.extend(piece(random)),
            4 => out.insert(random.below(out.len() + 1), tree),
            _ => out.push(tree),
        }
    }
    out.into_iter().collect()
}

fn check(tokens: TokenStream) -> bool {
    let said = tokens.to_string();
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let text = expand(tokens, &[folder]).to_string();
    assert!(TokenStream::from_str(&text).is_ok(), "{said}");
    text.contains("compile_error")
}

/// `FUZZ_TIMES` multiplies the runs.
#[test]
fn mutated_invocations() {
    let whole = TokenStream::from_str(WHOLE).unwrap();
    // The robot has no such frame: nothing is generated, which would take long.
    assert!(check(whole.clone()));
    let wanted = std::env::var("FUZZ_TIMES").ok();
    let times: usize = wanted.and_then(|times| times.parse().ok()).unwrap_or(1);
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for _ in 0..3000 * times {
        let rate = 1 + random.below(40);
        check(mutate(whole.clone(), &mut random, rate));
    }
}
