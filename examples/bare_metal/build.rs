//! Without std nobody links the C library, whose entry calls `main`.

fn main() {
    println!("cargo::rustc-link-arg=-lc");
}
