//! Items of the generator that the workspace's other crates use besides those that it shows to
//! everyone, in one list, so that the compiler finds unused items.

pub use crate::dag::{Dag, Folding, Node, Points};
pub use crate::figures::bound_of;
pub use crate::function::{Argument, Quantity, RegressorColumns, RuntimeParameter, Sizes};
pub use crate::generate::{
    generate_anew,
    keep::{claim, keep},
    search::{SearchResult, replay, search},
    tolerate::admitted,
};
pub use crate::language::{names::Names, read::Signature};
pub use crate::parallel::each;
pub use crate::plan::{Entry, file as plan_file};
pub use crate::program::{
    Code, Input, Library, Literal, Loop, Operation, Output, Pair, Steps,
    kernel::{Angle, Kernel},
    machine::Machine,
};
pub use crate::random::Random;
pub use crate::scalar::true_value::TrueValue;
pub use crate::search::{Limits, cost, price, search as search_graphs};
pub use crate::seeds::{Source, skeleton, trace, trace_chain};
pub use crate::setup::{
    SceneKey, Setup,
    base::{BaseParameters, Parameter},
    input_hash,
};
pub use crate::states::{JointState, SEED, STATES, State, positions};
pub use crate::task::Job;
pub use crate::tolerance::{
    attempt::attempt,
    budget::Budget,
    claim::claim_of,
    sample::{climb, draw},
    search::SearchEffort,
    variant::{Variant, VariantSet},
};
pub use crate::verify::{
    exact::{Disproof, Proof, prove},
    measure::{ConditionAllowance, LEAST_PART, RunnableCode, Runtime},
    truth::Reference,
};
pub use crate::watch::{Observer, Part, Progress};
pub use crate::words::{Word, parse};
pub use dalembert_checker::Fault;
pub use dalembert_checker::read::Text;
pub use dalembert_stamp::{Comment, refusal, sealed, write_whole};

pub mod scale {
    pub use crate::tolerance::scale::range;
}
pub mod tune {
    pub use crate::seeds::tune::{ChainChoice, start};
}

/// Items that only tests use.
#[cfg(feature = "testing")]
pub mod testing {
    pub use crate::dag::{Edge, Id};
    pub use crate::generate::contradiction::exact as run_exactly;
    pub use crate::language::function::write as write_function;
    pub use crate::program::{Operand, Step};
    pub use crate::search::Schedule;
    pub use crate::sincos::interval::Interval;
    pub use crate::sincos::{AngleKernel, choose::Candidates, stated};
    pub use crate::states::seeded;
    pub use crate::task::Miss;
    pub use crate::tolerance::input_box::InputBox;
    pub use crate::verify::{parameters::prove_base, rounding::Rounding};
}
