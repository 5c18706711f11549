//! Tells the crate the hash of the generator's sources.

mod sources;

use std::io;
use std::path::Path;

fn main() -> io::Result<()> {
    for source in sources::SOURCES {
        println!("cargo::rerun-if-changed={source}");
    }
    let hash = sources::hash(Path::new("."), &sources::SOURCES)?;
    println!("cargo::rustc-env=DALEMBERT_SOURCES={hash}");
    Ok(())
}
