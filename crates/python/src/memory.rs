//! NumPy's arrays and XLA's buffers as slices: all unsafe code of this crate.
//!
//! A slice of an array's memory is made for one call. It rests on this:
//! - The array's data pointer, shape and strides are NumPy's; strides are not negative, are
//!   multiples of an entry and the data is aligned, or there is no slice: so all entries
//!   lie in the slice from the first to the farthest.
//! - The caller holds a reference to the array until the call returns, so that the memory
//!   stays. While the interpreter's lock is released, other threads of Python may write to
//!   the array: as for every function of NumPy, that is for the caller to leave be. The
//!   compiled code reads and writes plain numbers at checked places, whatever they are.
//! - A result is not written where something else of the call lies: `call` gives a copy in
//!   place of an array that shares memory.
//!
//! A buffer of XLA's is what its call frame says, whose types are those of its header
//! `xla/ffi/api/c_api.h`. Fields are only ever added there behind those that are read here.
#![allow(unsafe_code)]

use std::ffi::{CString, c_char, c_void};
use std::ptr::null_mut;

use dalembert_jit::{Place, Real, Scalar};
use numpy::npyffi::flags::NPY_ARRAY_WRITEABLE;
use numpy::npyffi::{PY_ARRAY_API, npy_intp};
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::xla;

pub(crate) struct Layout<T> {
    data: *mut T,
    length: usize,
    states: usize,
    place: Place,
}

// SAFETY: it is an address with a length; those who make slices of it hold the array.
unsafe impl<T: Send> Send for Layout<T> {}
// SAFETY: as above; slices to be written are made of unique borrows alone.
unsafe impl<T: Sync> Sync for Layout<T> {}

impl<T: Element> Layout<T> {
    /// The first axes, none or one, count states. `None` where the array must be copied first.
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
            let along = |offset: usize| (0..length).map(move |index| offset + index * step);
            offsets = offsets.into_iter().flat_map(along).collect();
        }
        let (state, states) = match state_axes {
            0 => (0, 1),
            _ => (steps[0], shape[0]),
        };
        let last = states.checked_sub(1).map(|last| last * state);
        let farthest = offsets.iter().max().zip(last);
        let length = farthest.map_or(0, |(offset, last)| last + offset + 1);
        Some(Layout {
            data: array.data(),
            length,
            states,
            place: Place { state, offsets },
        })
    }

    pub(crate) fn slice(&self) -> &[T] {
        if self.length == 0 {
            return &[];
        }
        // SAFETY: the head of this file; the length reaches to the farthest entry.
        unsafe { std::slice::from_raw_parts(self.data, self.length) }
    }

    pub(crate) fn rows(&self) -> (&[T], Place) {
        (self.slice(), self.place.clone())
    }

    pub(crate) fn rows_mut(&mut self) -> (&mut [T], Place) {
        let place = self.place.clone();
        if self.length == 0 {
            return (&mut [], place);
        }
        // SAFETY: the head of this file; nobody else has this layout, arguments that share
        // its memory were copied.
        let entries = unsafe { std::slice::from_raw_parts_mut(self.data, self.length) };
        (entries, place)
    }

    pub(crate) fn find(&self, is_such: impl Fn(&T) -> bool) -> Option<(usize, usize)> {
        let data = self.slice();
        for state in 0..self.states {
            let rest = data.get(state * self.place.state..)?;
            let mut entries = self.place.offsets.iter();
            if let Some(entry) = entries.position(|&offset| rest.get(offset).is_some_and(&is_such))
            {
                return Some((state, entry));
            }
        }
        None
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
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let lengths = shape.iter().map(|&length| length.try_into());
    let mut lengths = lengths.collect::<Result<Vec<npy_intp>, _>>()?;
    let dtype = T::get_dtype(py).into_ptr().cast();
    // SAFETY: the lengths are as many as is said, and the call takes the reference to the dtype.
    let array = unsafe {
        let axes = lengths.len() as i32;
        let zeros = PY_ARRAY_API.PyArray_Zeros(py, axes, lengths.as_mut_ptr(), dtype, 0);
        Bound::from_owned_ptr_or_err(py, zeros)?
    };
    Ok(array.cast_into()?)
}

pub(crate) fn entries<'a, T: Element>(array: &'a Bound<'_, PyArrayDyn<T>>) -> Option<&'a [T]> {
    if array.ndim() != 1 || !array.is_c_contiguous() || !array.is_aligned() {
        return None;
    }
    // SAFETY: the head of this file; the array has so many entries without gaps.
    Some(unsafe { std::slice::from_raw_parts(array.data(), array.len()) })
}

pub(crate) fn filled<'py, T: Element>(
    py: Python<'py>,
    shape: &[usize],
    fill: impl FnOnce(&mut [T]) -> PyResult<()>,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let array = zeros(py, shape)?;
    // SAFETY: it was made here, and nobody else has it; its entries are in one piece.
    fill(unsafe { std::slice::from_raw_parts_mut(array.data(), array.len()) })?;
    Ok(array)
}

/// Tells whether an array has this shape, lies in one piece and may be written.
pub(crate) fn writeable<T: Element>(array: &Bound<'_, PyArrayDyn<T>>, shape: &[usize]) -> bool {
    // SAFETY: it is an array, whose object is NumPy's.
    let flags = unsafe { (*array.as_array_ptr()).fields.flags };
    let plain = array.is_c_contiguous() && array.is_aligned() && array.shape() == shape;
    plain && flags & NPY_ARRAY_WRITEABLE != 0
}

/// Writes the numbers of an array that is [`writeable`]; no slice of it may be held.
pub(crate) fn write<T: Element + Copy>(array: &Bound<'_, PyArrayDyn<T>>, values: &[T]) {
    let length = array.len().min(values.len());
    // SAFETY: the head of this file; the array has so many entries in one piece, and the
    // values are no array's.
    unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), array.data(), length) };
}

#[repr(C)]
struct Extension {
    size: usize,
    kind: i32,
    next: *mut Extension,
}

#[repr(C)]
struct Version {
    size: usize,
    extension: *mut Extension,
    major: i32,
    minor: i32,
}

#[repr(C)]
struct Metadata {
    size: usize,
    version: Version,
}

#[repr(C)]
struct MetadataExtension {
    base: Extension,
    metadata: *mut Metadata,
}

#[repr(C)]
struct Buffers {
    size: usize,
    extension: *mut Extension,
    count: i64,
    kinds: *const i32,
    items: *const *const Buffer,
}

#[repr(C)]
struct Buffer {
    size: usize,
    extension: *mut Extension,
    dtype: i32,
    data: *mut c_void,
    rank: i64,
    lengths: *const i64,
}

#[repr(C)]
struct Attributes {
    size: usize,
    extension: *mut Extension,
    count: i64,
    kinds: *const i32,
    names: *const *const c_void,
    items: *const *const Attribute,
}

#[repr(C)]
struct Attribute {
    dtype: i32,
    value: *const u64,
}

#[repr(C)]
struct Api {
    size: usize,
    extension: *mut Extension,
    version: Version,
    internal: *const c_void,
    error_create: unsafe extern "C" fn(*mut ErrorCreate) -> *mut c_void,
}

#[repr(C)]
struct ErrorCreate {
    size: usize,
    extension: *mut Extension,
    message: *const c_char,
    code: i32,
}

#[repr(C)]
struct Frame {
    size: usize,
    extension: *mut Extension,
    api: *const Api,
    context: *mut c_void,
    stage: i32,
    arguments: Buffers,
    results: Buffers,
    attributes: Attributes,
}

/// XLA_FFI_Extension_Metadata.
const METADATA: i32 = 1;
/// XLA_FFI_AttrType_SCALAR.
const NUMBER: i32 = 3;
/// XLA_FFI_DataType_U64.
const U64: i32 = 9;
/// XLA_FFI_Error_Code_INVALID_ARGUMENT.
const INVALID_ARGUMENT: i32 = 3;

/// Returns the address by which XLA calls functions.
#[pyfunction]
pub(crate) fn xla_handler() -> usize {
    handle as *const c_void as usize
}

/// Answers XLA: which interface this is for, or the results of a function.
unsafe extern "C" fn handle(frame: *mut Frame) -> *mut c_void {
    // SAFETY: XLA passes a frame and what that refers to, all of it for this call alone.
    let (frame, api) = unsafe { (&*frame, &*(*frame).api) };
    // SAFETY: as above; an extension begins with its head.
    if let Some(extension) = unsafe { frame.extension.as_ref() } {
        if extension.kind == METADATA {
            // SAFETY: of this kind, it goes on with an address of what is to be written.
            let metadata = unsafe { &mut *(*frame.extension.cast::<MetadataExtension>()).metadata };
            // All of version 0 have the fields that are read here.
            metadata.version.major = 0;
            metadata.version.minor = api.version.minor;
        }
        return null_mut();
    }
    // SAFETY: as above.
    let Err(why) = (unsafe { answer(frame) }) else {
        return null_mut();
    };
    let message = CString::new(why).unwrap_or_default();
    let mut error = ErrorCreate {
        size: size_of::<ErrorCreate>(),
        extension: null_mut(),
        message: message.as_ptr(),
        code: INVALID_ARGUMENT,
    };
    // SAFETY: XLA copies the message, and owns the error.
    unsafe { (api.error_create)(&mut error) }
}

/// # Safety
/// The frame is XLA's, and lives as long as this runs.
unsafe fn answer(frame: &Frame) -> Result<(), String> {
    let attributes = &frame.attributes;
    // SAFETY: there are `count` kinds and items; an item of this kind is a number, whose
    // address is of one of its type.
    let number = unsafe {
        (attributes.count == 1 && *attributes.kinds == NUMBER)
            .then(|| &**attributes.items)
            .filter(|item| item.dtype == U64)
            .map(|item| *item.value)
    };
    let entry = number.and_then(xla::find);
    let (arm, place) = entry.ok_or("expected one attribute, the number of a function")?;
    let function = &arm.functions()[place];
    // SAFETY: the caller's.
    match function.scalar() {
        Scalar::F64 => unsafe { computed::<f64>(frame, function, 12) },
        Scalar::F32 => unsafe { computed::<f32>(frame, function, 11) },
    }
}

/// # Safety
/// As for [`answer`].
unsafe fn computed<T: Real>(
    frame: &Frame,
    function: &dalembert_jit::Function,
    dtype: i32,
) -> Result<(), String> {
    // SAFETY: the caller's.
    let arguments = unsafe { numbers::<T>(&frame.arguments, dtype)? };
    // SAFETY: as above.
    let results = unsafe { numbers::<T>(&frame.results, dtype)? };
    // SAFETY: buffers are aligned, and have as many numbers as their lengths say; they stay
    // while this runs, in which nobody writes the arguments.
    let slice = |&(data, length): &(*mut T, usize)| unsafe {
        std::slice::from_raw_parts(data.cast_const(), length)
    };
    let arguments: Vec<&[T]> = arguments.iter().map(slice).collect();
    // SAFETY: as above, and XLA gives a result memory of its own: no aliases were allowed.
    let slice =
        |&(data, length): &(*mut T, usize)| unsafe { std::slice::from_raw_parts_mut(data, length) };
    xla::run(function, &arguments, results.iter().map(slice).collect())
}

/// Returns the addresses of buffers, with how many numbers there are.
///
/// # Safety
/// As for [`answer`].
unsafe fn numbers<T>(buffers: &Buffers, dtype: i32) -> Result<Vec<(*mut T, usize)>, String> {
    let mut slices = Vec::new();
    for index in 0..usize::try_from(buffers.count).unwrap_or(0) {
        // SAFETY: there are `count` items, each the address of a buffer: XLA has no other
        // kind of argument or result.
        let buffer = unsafe { &**buffers.items.add(index) };
        if buffer.dtype != dtype {
            let found = format!("is of XLA's type {}", buffer.dtype);
            return Err(format!("buffer {index} {found}, expected {dtype}"));
        }
        let mut length = 1;
        for axis in 0..usize::try_from(buffer.rank).unwrap_or(0) {
            // SAFETY: there are `rank` lengths.
            length *= usize::try_from(unsafe { *buffer.lengths.add(axis) }).unwrap_or(0);
        }
        let data = match length {
            0 => std::ptr::NonNull::dangling().as_ptr(),
            _ => buffer.data.cast(),
        };
        slices.push((data, length));
    }
    Ok(slices)
}
