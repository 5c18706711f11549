//! Machine code against the programs that it is made of.

mod bits;
mod cache;
mod calls;
mod generated;
mod support;
