//! `dalembert pose`: writes the helpers for the pose of a base that floats.

use std::path::PathBuf;

use dalembert_pose::{C_HEADER, RUST_MODULE};
use dalembert_stamp::{Comment, sealed};

use crate::files::Files;
use crate::output::{Context, Done, Failure, Outcome};

/// Arguments of `pose`.
#[derive(Debug, clap::Args)]
pub struct PoseArgs {
    /// Write the text here, a `.h`, `.cuh` or `.rs` file [default: a header to standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(crate) fn run(args: &PoseArgs, context: &Context) -> Outcome {
    let path = args.output.as_deref();
    let ending = path.and_then(|path| path.extension());
    let ending = ending.map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    let (comment, text) = match ending.as_deref() {
        None | Some("h" | "cuh") => (Comment::Block, C_HEADER),
        Some("rs") => (Comment::Line, RUST_MODULE),
        Some(other) => {
            return Err(Failure::Input(format!(
                "error: the helpers are C, CUDA or Rust, but the file ends in .{other}\n  = help: name \
                 it pose.h, pose.cuh or pose.rs"
            )));
        }
    };
    let target = Files::new(context, &[]).output(path)?;
    Ok(Done {
        files: vec![(target, sealed(comment, "dalembert pose", text))],
        ..Done::default()
    })
}
