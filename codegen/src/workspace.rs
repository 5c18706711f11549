//! Items of the generator that the workspace's other crates and the tests use besides those that it
//! shows to everyone, in one list, so that the compiler finds what nobody uses.

pub use crate::dag::{Dag, Edge, Fingerprint, Folding, Id, Leaves, Node, Points};
pub use crate::figures::bound_of;
pub use crate::function::{Argument, Columns, Quantity, RuntimeParameter, Sizes};
pub use crate::generate::{
    MAX_OUTPUTS, ToleranceError,
    contradiction::exact as run_exactly,
    generate_anew,
    keep::{claim, keep},
    search::{SearchResult, replay, search},
    tolerate::admitted,
};
pub use crate::language::{
    function::write as write_function,
    names::Names,
    read::{Signature, TextError},
};
pub use crate::parallel::each;
pub use crate::plan::{Entry, file as plan_file};
pub use crate::program::{
    Code, Input, Library, Literal, Loop, Operand, Operation, Output, Pair, SinCosUse, Step, Steps,
    kernel::{Angle, Kernel},
    machine::Machine,
};
pub use crate::random::Random;
pub use crate::scalar::true_value::TrueValue;
pub use crate::search::{Limits, Pass, Schedule, cost, price, search as search_graphs};
pub use crate::seeds::{Source, skeleton, skeleton_for, trace, trace_chain};
pub use crate::setup::{
    SceneKey, Setup, Task, TaskArm,
    base::{BaseParameters, Parameter},
    input_hash,
};
pub use crate::sincos::interval::Interval;
pub use crate::sincos::{AngleKernel, Sines, choose::Candidates, stated};
pub use crate::states::{JointState, SEED, STATES, State, positions, seeded};
pub use crate::task::Job;
pub use crate::tolerance::{
    attempt::{Attempt, attempt},
    budget::{Budget, Tolerances},
    claim::claim_of,
    input_box::InputBox,
    sample::{climb, draw},
    search::SearchEffort,
    variant::{Variant, VariantSet},
};
pub use crate::verify::{
    exact::{Disproof, Proof, prove, prove_same},
    measure::{ConditionAllowance, LEAST_PART, RunnableCode, Runtime},
    parameters::prove_base,
    rounding::Rounding,
    truth::Reference,
};
pub use crate::watch::{Observer, Part, Progress};
pub use crate::words::{Word, parse};
pub use dalembert_checker::read::Text;
pub use dalembert_stamp::{Comment, refusal, sealed, write_whole};

pub mod scale {
    pub use crate::tolerance::scale::{actuator, range};
}
pub mod tune {
    pub use crate::seeds::tune::{ChainChoice, start};
}
