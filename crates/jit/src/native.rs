//! Machine code in memory, and calls of it: all unsafe code of this crate.
//!
//! It rests on this:
//! - The code is what [`compile`](crate::compile) made of a program: it reads the entries
//!   of its signature at the addresses given, writes the results, calls [`library`] and
//!   nothing else, keeps nothing, and ends. It has no unwinding and no state, so that any
//!   number of threads may run it at once.
//! - Memory that holds code is never writable and executable at once: `JITModule` maps it
//!   to be written, then makes it executable, and nothing is defined in it afterwards.
//! - The memory lives as long as [`InMemory`], and every call borrows that.
#![allow(unsafe_code)]

use std::mem::ManuallyDrop;
use std::sync::OnceLock;

use cranelift_jit::JITModule;
use dalembert_codegen::ScalarType;
use dalembert_codegen::workspace::{Code, Machine};
use dalembert_sines::text::Angle;

use crate::check::{STATES, check, check_many};
use crate::compile::{Signature, States, compile};
use crate::emit::{Call, vector};
use crate::error::Error;
use crate::rows::Place;

struct InMemory {
    /// Taken when dropped, to free the memory.
    module: ManuallyDrop<JITModule>,
    entry: *const u8,
}

// SAFETY: the module is not touched between its making and its end, and the address is of
// memory that is never written: both may be used by any thread.
unsafe impl Send for InMemory {}
// SAFETY: as above; shared, only the address is read, and the code has no state.
unsafe impl Sync for InMemory {}

impl InMemory {
    fn of(code: &Code, signature: &Signature, states: States) -> Result<InMemory, Error> {
        let library = match code.scalar {
            ScalarType::F64 => library::<f64> as *const u8,
            ScalarType::F32 => library::<f32> as *const u8,
        };
        let (module, entry) = compile(code, signature, states, library)?;
        let module = ManuallyDrop::new(module);
        Ok(InMemory { module, entry })
    }
}

impl Drop for InMemory {
    fn drop(&mut self) {
        // SAFETY: taken once, here, and not read afterwards.
        let module = unsafe { ManuallyDrop::take(&mut self.module) };
        // SAFETY: every call borrows `self`: none is running, and the address is kept nowhere.
        unsafe { module.free_memory() };
    }
}

type One<T> = unsafe extern "C" fn(arguments: *const *const T, results: *mut T);
type Vectors<T> = unsafe extern "C" fn(
    entries: *const *const T,
    strides: *const isize,
    results: *const *mut T,
    result_strides: *const isize,
    states: isize,
);

/// A float that machine code computes in.
pub trait Real: Machine + Angle + std::fmt::Debug + Send + Sync + 'static {}
impl Real for f64 {}
impl Real for f32 {}

fn sines<T: Real>(angles: &[T], sines: &mut [T], cosines: &mut [T], kind: usize) {
    for ((&angle, sin), cos) in angles.iter().zip(sines).zip(cosines) {
        if kind == Call::Sine as usize {
            *sin = angle.sin();
        } else if kind == Call::Cosine as usize {
            *cos = angle.cos();
        } else if kind == Call::Both as usize {
            (*sin, *cos) = angle.sincos();
        } else if !angle.are_within(T::LARGEST) {
            (*sin, *cos) = angle.together();
        }
    }
}

/// Behind the `count` angles lie as many sines, then cosines.
extern "C" fn library<T: Real>(angles: *mut T, count: usize, kind: usize) {
    // SAFETY: the code passes the address of a slot of its own frame that has room for
    // three times as many numbers and is aligned to them (whatever bits are there are a
    // number); nothing else refers to it until this returns. `T` is the scalar that it was
    // compiled for, since `InMemory::of` chose this function by it.
    let numbers = unsafe { std::slice::from_raw_parts_mut(angles, 3 * count) };
    let (angles, pairs) = numbers.split_at_mut(count);
    let (sines, cosines) = pairs.split_at_mut(count);
    self::sines(angles, sines, cosines, kind);
}

/// The machine code of a program, which it was compared with, to the last bit, at 64 states.
pub struct Native {
    program: Code,
    signature: Signature,
    one: InMemory,
    apart: OnceLock<Many>,
    adjacent: OnceLock<Many>,
}

type Many = Result<InMemory, Error>;

impl Native {
    /// Compiles a program.
    ///
    /// # Errors
    /// [`Error`]: among others, the code computes other bits than the program.
    pub fn compile(program: Code, signature: Signature) -> Result<Native, Error> {
        let (expected, found) = (signature.results.iter().sum(), program.dag.outputs.len());
        if expected != found {
            return Err(Error::Results { expected, found });
        }
        let native = Native {
            one: InMemory::of(&program, &signature, States::One)?,
            program,
            signature,
            apart: OnceLock::new(),
            adjacent: OnceLock::new(),
        };
        match native.program.scalar {
            ScalarType::F64 => native.check_one::<f64>()?,
            ScalarType::F32 => native.check_one::<f32>()?,
        }
        Ok(native)
    }

    pub(crate) fn check_one<T: Real>(&self) -> Result<(), Error> {
        check(&self.program, &self.signature, |arguments, results| {
            self.call::<T>(arguments, results)
        })
    }

    fn check_many<T: Real>(&self, states: States, code: &InMemory) -> Result<(), Error> {
        let place = |entries| match states {
            States::Adjacent => Place::columns(entries, STATES),
            _ => Place::rows(entries),
        };
        let (program, signature) = (&self.program, &self.signature);
        check_many(program, signature, place, |arguments, results| {
            self.rows::<T>(code, arguments, results, STATES, 1)
        })
    }

    /// Returns the program.
    pub fn program(&self) -> &Code {
        &self.program
    }

    /// Returns its arguments and results.
    pub fn signature(&self) -> &Signature {
        &self.signature
    }

    fn check_scalar<T: Real>(&self) -> Result<(), Error> {
        let expected = self.program.scalar;
        Error::Scalar { expected }.unless(T::SCALAR == expected)
    }

    /// Computes the results of one state, one array after the other.
    ///
    /// # Errors
    /// [`Error`], if a slice has another length than the signature says.
    pub fn call<T: Real>(&self, arguments: &[&[T]], results: &mut [T]) -> Result<(), Error> {
        self.check_scalar::<T>()?;
        let expected = &self.signature.arguments;
        count(expected.len(), arguments.len())?;
        let lengths = expected.iter().map(|&(_, len)| len).enumerate();
        for ((place, expected), argument) in lengths.zip(arguments) {
            Error::length(place, expected, argument.len())?;
        }
        let outputs = self.program.dag.outputs.len();
        Error::length(expected.len(), outputs, results.len())?;
        self.run_one(arguments, results);
        Ok(())
    }

    /// Runs the code for one state, whose slices are as long as the signature says.
    fn run_one<T: Real>(&self, arguments: &[impl AsRef<[T]>], results: &mut [T]) {
        let mut addresses = [std::ptr::null(); MOST_ARGUMENTS];
        for (address, argument) in addresses.iter_mut().zip(arguments) {
            *address = argument.as_ref().as_ptr();
        }
        // SAFETY: the address is of a function of this type: compiled for one state, its
        // two parameters are addresses, and `T` is its scalar.
        let one = unsafe { std::mem::transmute::<*const u8, One<T>>(self.one.entry) };
        // SAFETY: each address is of a slice of as many numbers as the signature says, and
        // the code reads no others; the results are as many as it writes.
        unsafe { one(addresses.as_ptr(), results.as_mut_ptr()) };
    }

    /// Computes the results of many states, on so many threads at most, each argument and result
    /// a slice with where the numbers lie in it.
    ///
    /// # Errors
    /// [`Error`], if an entry is outside of its slice or two results are at one place.
    pub fn call_rows<T: Real>(
        &self,
        arguments: &[(&[T], Place)],
        results: &mut [(&mut [T], Place)],
        states: usize,
        threads: usize,
    ) -> Result<(), Error> {
        let read = arguments.iter().map(|(_, place)| place);
        let mut places = read.chain(results.iter().map(|(_, place)| place));
        let layout = match places.all(|place| place.state == 1) {
            true => States::Adjacent,
            false => States::Apart,
        };
        self.rows(self.many(layout)?, arguments, results, states, threads)
    }

    fn rows<T: Real>(
        &self,
        many: &InMemory,
        arguments: &[(&[T], Place)],
        results: &mut [(&mut [T], Place)],
        states: usize,
        threads: usize,
    ) -> Result<(), Error> {
        self.check_scalar::<T>()?;
        let signature = &self.signature;
        count(signature.arguments.len(), arguments.len())?;
        count(signature.results.len(), results.len())?;
        let lengths = signature.arguments.iter().map(|&(_, len)| len);
        for ((at, len), (data, place)) in lengths.enumerate().zip(arguments) {
            place.check(at, len, states, data.len())?;
        }
        for ((at, &len), (data, place)) in signature.results.iter().enumerate().zip(&*results) {
            let at = at + arguments.len();
            place.check(at, len, states, data.len())?;
            place.check_apart(at, states)?;
        }
        let read = arguments.iter().map(|(data, place)| (data.as_ptr(), place));
        let results = results.iter_mut();
        let written = results.map(|(data, place)| (data.as_mut_ptr(), &*place));
        let (read, written) = (SharedSlice(read.collect()), SharedSlice(written.collect()));
        let lanes = vector(self.program.scalar).lane_count() as usize;
        let threads = threads.clamp(1, (states / LEAST_STATES).max(1));
        // Whole vectors to all but the last.
        let chunk = states.div_ceil(threads).next_multiple_of(lanes);
        std::thread::scope(|scope| {
            for first in (chunk..states).step_by(chunk.max(1)) {
                let (read, written) = (&read, &written);
                scope.spawn(move || {
                    self.run_many(many, read, written, first..(first + chunk).min(states));
                });
            }
            self.run_many(many, &read, &written, 0..chunk.min(states));
        });
        Ok(())
    }

    /// Runs the states of a range; places were checked for all of them.
    fn run_many<T: Real>(
        &self,
        many: &InMemory,
        read: &SharedSlice<Vec<(*const T, &Place)>>,
        written: &SharedSlice<Vec<(*mut T, &Place)>>,
        states: std::ops::Range<usize>,
    ) {
        let size = size_of::<T>();
        let stride = |place: &Place| (place.state * size) as isize;
        let strides: Vec<isize> = read.0.iter().map(|(_, place)| stride(place)).collect();
        let result_strides: Vec<isize> = written.0.iter().map(|(_, place)| stride(place)).collect();
        let entries = read.0.iter().flat_map(|&(data, place)| {
            let first = place.entries(states.start);
            // SAFETY: `Place::check` found it in its slice, or there is no state.
            first.map(move |entry| unsafe { data.add(entry) })
        });
        let entries: Vec<*const T> = entries.collect();
        let results = written.0.iter().flat_map(|&(data, place)| {
            let first = place.entries(states.start);
            // SAFETY: as above.
            first.map(move |entry| unsafe { data.add(entry) })
        });
        let results: Vec<*mut T> = results.collect();
        // SAFETY: the address is of a function of this type: compiled for vectors, its
        // parameters are four addresses and a count, and `T` is its scalar.
        let function = unsafe { std::mem::transmute::<*const u8, Vectors<T>>(many.entry) };
        // SAFETY: the tables have an address an entry and a stride an argument or result.
        // All that the code reads and writes for these states was found to be inside of the
        // slices. The slices of results are borrowed for this alone, no two numbers have one
        // place there, and no other thread has these states.
        unsafe {
            function(
                entries.as_ptr(),
                strides.as_ptr(),
                results.as_ptr(),
                result_strides.as_ptr(),
                states.len() as isize,
            );
        }
        let lanes = vector(self.program.scalar).lane_count() as usize;
        let rest = states.start + states.len() / lanes * lanes..states.end;
        let mut outputs = vec![T::default(); self.program.dag.outputs.len()];
        for state in rest {
            let gathered = |&(data, place): &(*const T, &Place)| -> Vec<T> {
                let entries = place.entries(state);
                // SAFETY: `Place::check` found every entry of every state in its slice.
                entries.map(|at| unsafe { data.add(at).read() }).collect()
            };
            let arguments: Vec<Vec<T>> = read.0.iter().map(gathered).collect();
            self.run_one(&arguments, &mut outputs);
            let mut values = outputs.iter();
            for &(data, place) in &written.0 {
                for (at, &value) in place.entries(state).zip(values.by_ref()) {
                    // SAFETY: as for the code's own results.
                    unsafe { data.add(at).write(value) };
                }
            }
        }
    }

    fn many(&self, states: States) -> Result<&InMemory, Error> {
        let many = match states {
            States::Adjacent => &self.adjacent,
            _ => &self.apart,
        };
        let many = many.get_or_init(|| {
            let code = InMemory::of(&self.program, &self.signature, states)?;
            match self.program.scalar {
                ScalarType::F64 => self.check_many::<f64>(states, &code)?,
                ScalarType::F32 => self.check_many::<f32>(states, &code)?,
            }
            Ok(code)
        });
        many.as_ref().map_err(Error::clone)
    }

    /// Compiles and compares the code for many states in columns, as the first call does otherwise.
    ///
    /// # Errors
    /// As of [`Native::compile`].
    pub fn prepare_columns(&self) -> Result<(), Error> {
        self.many(States::Adjacent).map(|_| ())
    }
}

struct SharedSlice<T>(T);

// SAFETY: threads read disjoint states' entries through shared slices, and write those of
// disjoint states: see `run_many`.
unsafe impl<T> Sync for SharedSlice<T> {}

/// Fewer states a thread take less time than starting it.
const LEAST_STATES: usize = 2048;

/// The most arguments that a function has.
pub const MOST_ARGUMENTS: usize = dalembert_codegen::workspace::Argument::COUNT;

fn count(expected: usize, found: usize) -> Result<(), Error> {
    Error::Count { expected, found }.unless(expected == found)
}

#[cfg(test)]
mod tests;
