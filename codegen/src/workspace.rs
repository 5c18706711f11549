//! What the workspace's other crates and the tests use of the generator besides what it
//! shows to everyone: under the names that it has inside, and nothing else. It changes as
//! they need.

pub mod approximate {
    pub mod admitted {
        pub use crate::approximate::admitted::{Admitted, Claim};
    }
    pub mod choose {
        pub use crate::approximate::choose::ErrorBudget;
    }
    pub mod prune {
        pub use crate::approximate::prune::{PruneSettings, Pruned, omissions, prune};
    }
    pub mod sines {
        pub use crate::approximate::sines::within;
    }
}

pub mod language {
    pub use crate::language::{Language, Printed};
    pub mod c99 {
        pub use crate::language::names::Names;
    }
    pub mod function {
        pub use crate::language::function::write;
    }
    pub mod read {
        pub use crate::language::read::TextError;
    }
    pub mod result {
        pub use crate::language::result::structure;
    }
}

pub mod bound {
    pub mod definite {
        pub use crate::bound::definite::{Indefinite, least_eigenvalue};
    }
    pub mod input_box {
        pub use crate::bound::input_box::InputBox;
    }
    pub mod magnitude {
        pub use crate::bound::magnitude::{BoxEffort, magnitudes};
    }
    pub mod ranges {
        pub use crate::bound::ranges::{Finding, ranges};
    }
    pub mod sample {
        pub use crate::bound::sample::{climb, draw};
    }
    pub mod scale {
        pub use crate::bound::scale::{actuator, range};
    }
    pub mod sensitivity {
        pub use crate::bound::sensitivity::{BoundEffort, Sensitivity, rounding};
    }
}

pub mod certificate {
    pub use crate::certificate::{Certificate, Refuted};
    #[cfg(feature = "certificates")]
    pub mod format {
        pub use crate::certificate::format::{text_hash, write};
    }
}

pub mod edits {
    pub use crate::edits::{Edit, EditSite, Stage, difference};
    pub mod text {
        pub use crate::edits::text::{read_edit, write_edit};
    }
}

pub mod emit {
    pub mod figures {
        pub use crate::emit::figures::{bound_of, inside};
    }
}

pub mod falsify {
    pub use crate::falsify::{Falsification, falsify};
}

pub mod function {
    pub use crate::function::{
        Argument, BundleError, Columns, Function, Quantity, RuntimeParameter, Sizes,
    };
}

pub mod generate {
    pub use crate::generate::{
        GenerateError, Generated, GeneratedFunction, MAX_OUTPUTS, ToleranceError, Unbounded,
        generate, generate_anew,
    };
    pub mod early {
        pub use crate::generate::early::price;
    }
    pub mod keep {
        pub use crate::generate::keep::keep;
    }
    pub mod search {
        pub use crate::generate::search::{Found, replay, search};
    }
    pub mod tolerate {
        pub use crate::generate::tolerate::admitted;
    }
}

pub mod graph {
    pub use crate::graph::{Edge, Fingerprint, Folding, Graph, Node, NodeId, Points};
}

pub mod interval {
    pub use crate::interval::Interval;
}

pub mod parallel {
    pub use crate::parallel::each;
}

pub mod plan {
    pub use crate::plan::{Edited, Entry, Plan, file};
}

pub mod portfolio {
    pub use crate::portfolio::{Source, Start, skeleton, skeleton_for, trace_chain};
    pub mod tune {
        pub use crate::portfolio::tune::{Tuned, start};
    }
}

pub mod program {
    pub use crate::program::{
        AngleSum, Counts, Difference, Input, Library, Literal, Lowered, LoweredTrig, Operand,
        Operation, Output, Program, ScalarType, Speed, Step, Trig, evaluate,
    };
    pub mod columns {
        pub use crate::program::columns::Columns;
    }
    pub mod fused {
        pub use crate::program::fused::fusion;
    }
    pub mod kernel {
        pub use crate::program::kernel::{Angle, Kernel, Term};
    }
    pub mod machine {
        pub use crate::program::machine::Machine;
    }
    pub mod run {
        pub use crate::program::run::State;
    }
}

pub mod random {
    pub use crate::random::Random;
}

pub mod scene {
    pub use crate::scene::{SceneError, SceneKey, SceneRobot, input_hash, motion};
    pub mod base {
        pub use crate::scene::base::{BaseParameters, Parameter};
    }
}

pub mod simplify {
    pub use crate::simplify::{Effort, Pass, WaySource, cost, watched};
}

pub mod sincos {
    pub use crate::sincos::{
        AngleKernel, SinCos, Sines, angle_name, counts, lowered, need, stated,
    };
    pub mod choose {
        pub use crate::sincos::choose::Candidates;
    }
}

pub mod split {
    pub use crate::split::ErrorByCause;
}

pub mod states {
    pub use crate::states::{JointState, SEED, STATES, positions, seeded};
}

pub mod task {
    pub use crate::task::options::{OPTIONS, OptionRow, Problem, Purpose};
    pub use crate::task::{Fma, Prefer, Request, Task};
    pub mod in_scene {
        pub use crate::task::in_scene::{UnknownScene, find};
    }
}

pub mod trace {
    pub use crate::trace::{Trace, trace};
}

pub mod verify {
    pub mod condition {
        pub use crate::verify::condition::Condition;
    }
    pub mod exact {
        pub use crate::verify::exact::{Disproof, Proof, prove, prove_same};
    }
    pub mod floating {
        pub use crate::verify::floating::{BOUND, Emitted, Granted, LEAST_PART, Measure, Runtime};
    }
    pub mod parameters {
        pub use crate::verify::parameters::prove_base;
    }
    pub mod reference {
        pub use crate::verify::reference::{Reference, TrueValue};
    }
    pub mod rounding {
        pub use crate::verify::rounding::Rounding;
    }
}

pub mod watch {
    pub use crate::watch::{Observer, Part, Progress, Watch};
}

pub mod words {
    pub use crate::words::{Word, bundle, parse};
}
