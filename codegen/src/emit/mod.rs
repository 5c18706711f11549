//! The module of a robot: header, documentation, functions.
//!
//! - [`module`]: the module of a robot with its header, and of its `scene`;
//!   `escape`: names that users chose
//! - [`header`]: the header of a robot in C; `c_sines`: the sines that its functions call
//! - `state_box`: where functions hold that do not hold everywhere
//! - `generated`: a function with what was found and proved of it
//! - `variant`: what a tolerance left of a function; `scale`: what its errors
//!   are relative to; `said`: of polynomials for sines, Coulomb friction and fused products
//! - `parameters`: what the columns of a regressor are; `arguments`: what a payload and
//!   its load are, and gravity where it is an argument

pub(crate) mod arguments;
mod c_sines;
mod escape;
mod generated;
pub(crate) mod header;
pub(crate) mod module;
mod parameters;
mod said;
mod scale;
mod scene;
mod state_box;
mod variant;

pub use generated::GeneratedFunction;

fn say<const N: usize>(lines: &mut Vec<String>, own: [&str; N]) {
    lines.extend(own.map(String::from));
}
