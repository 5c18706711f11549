//! Arguments of the functions: n columns, or one list of n, for each of q, q̇, q̈ and τ.

use datafusion::arrow::array::{
    Array, ArrayRef, AsArray, BooleanArray, FixedSizeListArray, Float64Array,
};
use datafusion::arrow::buffer::NullBuffer;
use datafusion::arrow::compute::filter;
use datafusion::arrow::datatypes::{DataType, Field, Float64Type};
use datafusion::arrow::error::ArrowError;
use datafusion::common::plan_err;
use datafusion::error::Result;
use std::sync::Arc;

/// States are worked on in pieces of so many: what is computed of them stays in the caches.
pub(crate) const PIECE: usize = 256;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Shape {
    pub(crate) joints: usize,
    pub(crate) time: bool,
    /// The number of q, q̇, q̈ and τ that it takes.
    pub(crate) quantities: usize,
}

const NAMES: [&str; 4] = ["q", "qd", "qdd", "tau"];

pub(crate) fn list(joints: usize) -> DataType {
    let item = Arc::new(Field::new_list_field(DataType::Float64, true));
    DataType::FixedSizeList(item, joints as i32)
}

pub(crate) fn lists(
    n: usize,
    values: Vec<f64>,
    nulls: Option<NullBuffer>,
) -> Result<FixedSizeListArray> {
    let item = Arc::new(Field::new_list_field(DataType::Float64, true));
    let values = Arc::new(Float64Array::from(values));
    Ok(FixedSizeListArray::try_new(item, n as i32, values, nulls)?)
}

impl Shape {
    pub(crate) fn coerce(&self, function: &str, types: &[DataType]) -> Result<Vec<DataType>> {
        let n = self.joints;
        let time = if self.time { "a time, and " } else { "" };
        let expected = format!(
            "`{function}` takes {time}for each of {}: {n} columns of Float64, or one \
             FixedSizeList<Float32 or Float64, {n}>",
            NAMES[..self.quantities].join(", ")
        );
        let mut rest = types;
        let mut coerced = Vec::with_capacity(types.len());
        if self.time {
            let Some((first, others)) = rest.split_first() else {
                return plan_err!("there are no arguments; {expected}");
            };
            if !is_number(first) {
                return plan_err!("the time is {first}, a number was expected; {expected}");
            }
            rest = others;
            coerced.push(DataType::Float64);
        }
        for name in &NAMES[..self.quantities] {
            match rest.first() {
                Some(DataType::FixedSizeList(item, width)) => {
                    let item = item.data_type();
                    if *width as usize != n || !is_number(item) {
                        return plan_err!("`{name}` is FixedSizeList<{item}, {width}>; {expected}");
                    }
                    coerced.push(list(n));
                    rest = &rest[1..];
                }
                Some(_) => {
                    let many = rest.iter().take_while(|of| is_number(of)).count();
                    if many < n {
                        let kind = rest.get(many).map_or("nothing".into(), ToString::to_string);
                        let name = format!("{name}{}", many + 1);
                        return plan_err!("`{name}` is {kind}, a number was expected; {expected}");
                    }
                    coerced.extend(std::iter::repeat_n(DataType::Float64, n));
                    rest = &rest[n..];
                }
                None => return plan_err!("`{name}` is missing; {expected}"),
            }
        }
        match rest.len() {
            0 => Ok(coerced),
            surplus => plan_err!("there are {surplus} arguments too many; {expected}"),
        }
    }

    pub(crate) fn read(&self, arrays: &[ArrayRef]) -> Arguments {
        let mut rest = arrays.iter();
        let time = self.time.then(|| rest.next().cloned()).flatten();
        let mut nulls = time.as_ref().and_then(|time| time.nulls().cloned());
        let mut sources = Vec::with_capacity(self.quantities);
        for _ in 0..self.quantities {
            let mut arrays = Vec::new();
            for array in rest.by_ref() {
                nulls = NullBuffer::union(nulls.as_ref(), array.nulls());
                arrays.push(array.clone());
                let is_list = matches!(array.data_type(), DataType::FixedSizeList(..));
                if is_list {
                    nulls = NullBuffer::union(nulls.as_ref(), nulls_within(array).as_ref());
                }
                if is_list || arrays.len() == self.joints {
                    break;
                }
            }
            sources.push(arrays);
        }
        Arguments {
            joints: self.joints,
            rows: arrays.first().map_or(0, |array| array.len()),
            time,
            sources,
            nulls: nulls.filter(|nulls| nulls.null_count() > 0),
        }
    }
}

fn is_number(of: &DataType) -> bool {
    of.is_numeric() || *of == DataType::Null
}

fn nulls_within(array: &ArrayRef) -> Option<NullBuffer> {
    let lists = array.as_fixed_size_list();
    let width = lists.value_length() as usize;
    let nulls = lists.values().nulls().filter(|of| of.null_count() > 0)?;
    // The values of a slice of an array are those of the slice.
    let valid = (0..lists.len()).map(|row| (0..width).all(|k| nulls.is_valid(row * width + k)));
    Some(NullBuffer::from_iter(valid))
}

pub(crate) struct Arguments {
    joints: usize,
    pub(crate) rows: usize,
    time: Option<ArrayRef>,
    /// For each quantity: n columns, or one list.
    sources: Vec<Vec<ArrayRef>>,
    pub(crate) nulls: Option<NullBuffer>,
}

/// Arguments of up to [`PIECE`] states, in columns.
#[derive(Default)]
pub(crate) struct Piece {
    pub(crate) count: usize,
    pub(crate) time: Vec<f64>,
    pub(crate) quantities: [Vec<f64>; 4],
}

impl Arguments {
    pub(crate) fn valid(self) -> Result<Arguments> {
        let Some(nulls) = &self.nulls else {
            return Ok(self);
        };
        let is_valid = BooleanArray::from(nulls.inner().clone());
        let kept = |array: &ArrayRef| filter(array, &is_valid);
        let mut sources = Vec::with_capacity(self.sources.len());
        for arrays in &self.sources {
            sources.push(arrays.iter().map(kept).collect::<Result<_, ArrowError>>()?);
        }
        Ok(Arguments {
            joints: self.joints,
            rows: is_valid.true_count(),
            time: self.time.as_ref().map(kept).transpose()?,
            sources,
            nulls: None,
        })
    }

    /// Calls with all states, piece after piece, those of nulls too, whatever stands there.
    pub(crate) fn each(&self, mut call: impl FnMut(usize, &Piece) -> Result<()>) -> Result<()> {
        let mut piece = Piece::default();
        for first in (0..self.rows).step_by(PIECE) {
            self.copy(first, self.rows.min(first + PIECE), &mut piece);
            call(first, &piece)?;
        }
        Ok(())
    }

    fn copy(&self, first: usize, last: usize, piece: &mut Piece) {
        let count = last - first;
        piece.count = count;
        if let Some(time) = &self.time {
            piece.time.clear();
            let values = time.as_primitive::<Float64Type>().values();
            piece.time.extend_from_slice(&values[first..last]);
        }
        for (source, to) in self.sources.iter().zip(&mut piece.quantities) {
            to.clear();
            match &source[..] {
                [lists] if matches!(lists.data_type(), DataType::FixedSizeList(..)) => {
                    let n = self.joints;
                    let values = lists.as_fixed_size_list().values();
                    let values = &values.as_primitive::<Float64Type>().values()[first * n..];
                    to.resize(n * count, 0.0);
                    for (s, state) in values.chunks_exact(n).take(count).enumerate() {
                        for (i, value) in state.iter().enumerate() {
                            to[i * count + s] = *value;
                        }
                    }
                }
                columns => {
                    for column in columns {
                        let values = column.as_primitive::<Float64Type>().values();
                        to.extend_from_slice(&values[first..last]);
                    }
                }
            }
        }
    }
}
