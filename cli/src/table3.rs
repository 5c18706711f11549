use crate::args::Table3Args;
use crate::outcome::Outcome;
pub fn run(_args: &Table3Args) -> Outcome {
    Ok(())
}
