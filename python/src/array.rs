//! NumPy arrays as slices and places: all unsafe code of this crate.
//!
//! A slice of an array's memory is made for one call. What it rests on:
//! - The array's data pointer, shape and strides are NumPy's; strides are not negative, are
//!   multiples of an entry and the data is aligned, or there is no slice: so all entries
//!   lie in the slice from the first to the farthest.
//! - The caller holds a reference to the array until the call returns, so that the memory
//!   stays. While the interpreter's lock is released, other threads of Python may write to
//!   the array: as for every function of NumPy, that is for the caller to leave be. The
//!   compiled code reads and writes plain numbers at checked places, whatever they are.
//! - A result is not written where an argument is read: `function` copies arguments that
//!   share memory with `out`.
#![allow(unsafe_code)]

use dalembert_jit::{Place, Rows, RowsMut};
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// An array as the compiled code reads it: state by state, entry by entry.
pub(crate) struct Layout<T> {
    data: *mut T,
    length: usize,
    pub(crate) place: Place,
}

// SAFETY: it is an address with a length; those who make slices of it hold the array.
unsafe impl<T: Send> Send for Layout<T> {}
// SAFETY: as above; slices to be written are made of unique borrows alone.
unsafe impl<T: Sync> Sync for Layout<T> {}

impl<T: Element> Layout<T> {
    /// The layout of an array whose first axes, so many, count states: none or one.
    /// `None` where the array must be copied first.
    pub(crate) fn of(array: &Bound<'_, PyArrayDyn<T>>, state_axes: usize) -> Option<Layout<T>> {
        let size = size_of::<T>();
        let (shape, strides) = (array.shape(), array.strides());
        if !array.is_aligned() {
            return None;
        }
        let mut steps = Vec::with_capacity(strides.len());
        for (&stride, &length) in strides.iter().zip(shape) {
            let step = usize::try_from(stride).ok().filter(|step| step % size == 0);
            // The stride of an axis of one entry may be anything.
            steps.push(if length <= 1 { 0 } else { step? / size });
        }
        let mut offsets = vec![0];
        for (&step, &length) in steps.iter().zip(shape).skip(state_axes) {
            offsets = offsets
                .iter()
                .flat_map(|offset| (0..length).map(move |index| offset + index * step))
                .collect();
        }
        let state = if state_axes == 1 { steps[0] } else { 0 };
        let states = if state_axes == 1 { shape[0] } else { 1 };
        let farthest = offsets.iter().max().map(|&offset| {
            let last = states.saturating_sub(1);
            last * state + offset + 1
        });
        let length = if states == 0 {
            0
        } else {
            farthest.unwrap_or(0)
        };
        Some(Layout {
            data: array.data(),
            length,
            place: Place { state, offsets },
        })
    }

    /// The entries to be read.
    pub(crate) fn slice(&self) -> &[T] {
        if self.length == 0 {
            return &[];
        }
        // SAFETY: the head of this file; the length reaches to the farthest entry.
        unsafe { std::slice::from_raw_parts(self.data, self.length) }
    }

    /// The entries to be written.
    pub(crate) fn slice_mut(&mut self) -> &mut [T] {
        if self.length == 0 {
            return &mut [];
        }
        // SAFETY: the head of this file; nobody else has this layout, arguments that share
        // its memory were copied.
        unsafe { std::slice::from_raw_parts_mut(self.data, self.length) }
    }

    /// The argument.
    pub(crate) fn rows(&self) -> Rows<'_, T> {
        Rows {
            data: self.slice(),
            place: self.place.clone(),
        }
    }

    /// The result.
    pub(crate) fn rows_mut(&mut self) -> RowsMut<'_, T> {
        let place = self.place.clone();
        RowsMut {
            data: self.slice_mut(),
            place,
        }
    }

    /// Tells whether the memory of two layouts may have something in common.
    pub(crate) fn touches(&self, other: &Layout<T>) -> bool {
        let end = |layout: &Layout<T>| layout.data.wrapping_add(layout.length);
        self.data < end(other) && other.data < end(self)
    }
}

/// Makes an array of zeros for results: what is left out is nothing.
pub(crate) fn zeros<'py, T: Element>(
    py: Python<'py>,
    shape: &[usize],
) -> Bound<'py, PyArrayDyn<T>> {
    PyArrayDyn::zeros(py, shape.to_vec(), false)
}
