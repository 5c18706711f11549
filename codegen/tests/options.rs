//! The table of options, and the clauses of `dynamics!` that come from it.

use std::path::Path;

use dalembert_codegen::expand;
use dalembert_codegen::workspace::task::{Purpose, WordOption};

/// Returns what `dynamics!` says of a clause. Without outputs it generates nothing.
fn said(clause: &str) -> String {
    let text = format!("pub mod arm = \"no.toml\"; {clause}");
    expand(text.parse().unwrap(), Path::new(".")).to_string()
}

#[test]
fn clauses_take_the_words_of_the_table() {
    for option in WordOption::ALL {
        let is_unknown = option.purpose == Purpose::File;
        for word in (option.known)() {
            let clause = format!("{}: {word};", option.word);
            assert_eq!(
                said(&clause).contains("unknown clause"),
                is_unknown,
                "{clause}"
            );
            assert!(!said(&clause).contains("one word only"), "{clause}");
            assert!(!said(&clause).contains(&format!("`{word}`")), "{clause}");
        }
        if !is_unknown {
            let of_nothing = format!("{}: nonsense;", option.word);
            let unknown = format!("unknown {} `nonsense`", option.what);
            assert!(said(&of_nothing).contains(&unknown), "{of_nothing}");
            let [one, other] = [0, 1].map(|index| (option.known)()[index]);
            let of_two = format!("{}: {one}, {other};", option.word);
            assert!(said(&of_two).contains("one word only"), "{of_two}");
        }
    }
}
