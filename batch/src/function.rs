//! A generated function as batches see it.

/// A function of A arguments of N numbers each, which returns M numbers; in
/// lanes, so many states at once as somebody says.
///
/// Its methods must be `#[inline(always)]`: they are compiled for the vectors of
/// whoever calls them.
pub trait Function<const A: usize, const N: usize, const M: usize> {
    /// f64 or f32.
    type Scalar: Copy + Default;
    /// The results of one state.
    type State;
    /// The results of L states.
    type Lanes<const L: usize>;

    /// Its results at L states: entry `[a][i][l]` is argument a's number i in
    /// state l.
    fn lanes<const L: usize>(arguments: &[[[Self::Scalar; L]; N]; A]) -> Self::Lanes<L>;

    /// The results of one of the states.
    fn state<const L: usize>(results: &Self::Lanes<L>, l: usize) -> Self::State;

    /// The numbers of the results in their order, each with its lanes.
    fn columns<const L: usize>(results: &Self::Lanes<L>) -> [[Self::Scalar; L]; M];
}
