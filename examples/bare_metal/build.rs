//! Links the C library, whose entry calls `main`: without std nothing else links it.

fn main() {
    println!("cargo::rustc-link-arg=-lc");
}
