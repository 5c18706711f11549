//! One program of all test files: they share what they link, and both cores.

mod accuracy_limit;
mod arguments;
mod c99;
mod certified;
mod certified_hidden;
mod certified_texts;
mod certify_mutations;
mod certify_plans;
mod counts;
mod disproved;
mod fused;
mod golden;
mod identity;
mod kept;
mod libm_ulps;
mod printed;
mod random;
mod refused;
mod regressor;
mod sincos;
mod sources;
mod support;
mod text;
mod tolerance;
mod values;
mod watch;
