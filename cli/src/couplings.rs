use crate::args::CouplingsArgs;
use crate::outcome::Outcome;
pub fn run(_args: &CouplingsArgs) -> Outcome {
    Ok(())
}
