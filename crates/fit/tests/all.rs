//! One program of all test files.

mod accumulator;
mod consistent;
mod differentiate;
mod excite;
mod floating;
mod identified;
mod regressor;
mod statistics;
mod support;
mod suspect;
mod unexcited;
mod watch;
