//! Instructions of one function, on a number or on a vector of them.

use std::cell::RefCell;

use cranelift_codegen::ir::condcodes::FloatCC;
use cranelift_codegen::ir::{
    BlockArg, ConstantData, FuncRef, InstBuilder, MemFlagsData, StackSlotData, StackSlotKind, Type,
    Value, types,
};
use cranelift_frontend::FunctionBuilder;
use dalembert_codegen::ScalarType;

pub(crate) fn number(scalar: ScalarType) -> Type {
    match scalar {
        ScalarType::F64 => types::F64,
        ScalarType::F32 => types::F32,
    }
}

pub(crate) fn vector(scalar: ScalarType) -> Type {
    match scalar {
        ScalarType::F64 => types::F64X2,
        ScalarType::F32 => types::F32X4,
    }
}

/// Shared, since the text of the sines computes with values that can be copied.
pub(crate) struct Emitter<'f> {
    builder: RefCell<FunctionBuilder<'f>>,
    floats: Type,
    /// It takes an address of angles, their number, and the kind of [`Call`].
    library: FuncRef,
}

/// A call of libm, or of `dalembert-sines`; the numbers are those of `native`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Call {
    /// `dalembert-sines`, for the angles that its polynomials are not for.
    Unusual = 0,
    Sine = 1,
    Cosine = 2,
    Both = 3,
}

fn unaligned() -> MemFlagsData {
    MemFlagsData::new().with_notrap()
}

impl<'f> Emitter<'f> {
    pub(crate) fn new(builder: FunctionBuilder<'f>, floats: Type, library: FuncRef) -> Emitter<'f> {
        Emitter {
            builder: RefCell::new(builder),
            floats,
            library,
        }
    }

    pub(crate) fn into_builder(self) -> FunctionBuilder<'f> {
        self.builder.into_inner()
    }

    pub(crate) fn with<R>(&self, run: impl FnOnce(&mut FunctionBuilder<'f>) -> R) -> R {
        run(&mut self.builder.borrow_mut())
    }

    pub(crate) fn integers(&self) -> Type {
        self.floats.as_int()
    }

    pub(crate) fn constant(&self, value: f64) -> Value {
        let ty = self.floats;
        self.with(|b| match ty {
            types::F64 => b.ins().f64const(value),
            types::F32 => b.ins().f32const(value as f32),
            types::F64X2 => repeated(b, ty, &value.to_le_bytes()),
            _ => repeated(b, ty, &(value as f32).to_le_bytes()),
        })
    }

    pub(crate) fn power(&self, exponent: usize) -> Value {
        let ty = self.integers();
        self.with(|b| match ty {
            types::I64X2 => repeated(b, ty, &(1u64 << exponent).to_le_bytes()),
            types::I32X4 => repeated(b, ty, &(1u32 << exponent).to_le_bytes()),
            _ => b.ins().iconst(ty, (1u64 << exponent) as i64),
        })
    }

    pub(crate) fn is_within(&self, x: Value, largest: f64) -> Value {
        let largest = self.constant(largest);
        self.with(|b| {
            let magnitude = b.ins().fabs(x);
            b.ins().fcmp(FloatCC::LessThanOrEqual, magnitude, largest)
        })
    }

    /// Reads a number of each lane, at a base and each lane's offset of bytes, or from one offset on.
    pub(crate) fn gather(&self, base: Value, offsets: &[Value]) -> Value {
        let (number, floats) = (self.floats.lane_type(), self.floats);
        self.with(|b| {
            let mut load = |ty: Type, offset: Value| {
                let address = b.ins().iadd(base, offset);
                b.ins().load(ty, unaligned(), address, 0)
            };
            if let [first] = offsets {
                return load(floats, *first);
            }
            let loaded: Vec<Value> = offsets.iter().map(|offset| load(number, *offset)).collect();
            let mut vector = b.ins().scalar_to_vector(floats, loaded[0]);
            for (lane, value) in loaded.iter().enumerate().skip(1) {
                vector = b.ins().insertlane(vector, *value, lane as u8);
            }
            vector
        })
    }

    pub(crate) fn read(&self, address: Value, at: i32) -> Value {
        self.with(|b| b.ins().load(self.floats, unaligned(), address, at))
    }

    pub(crate) fn scatter(&self, value: Value, base: Value, offsets: &[Value]) {
        self.with(|b| {
            for (lane, offset) in offsets.iter().enumerate() {
                let number = match offsets.len() {
                    1 => value,
                    _ => b.ins().extractlane(value, lane as u8),
                };
                let address = b.ins().iadd(base, *offset);
                b.ins().store(unaligned(), number, address, 0);
            }
        });
    }

    pub(crate) fn write(&self, value: Value, address: Value, at: i32) {
        self.with(|b| b.ins().store(unaligned(), value, address, at));
    }

    /// The library is called always, or unless `usual` holds in every lane of what was computed.
    pub(crate) fn call(
        &self,
        call: Call,
        angles: &[Value],
        computed: Option<(Value, &[(Value, Value)])>,
    ) -> Vec<(Value, Value)> {
        let (floats, library) = (self.floats, self.library);
        let width = floats.bytes() as usize;
        let angle_count = angles.len() * floats.lane_count() as usize;
        let place = |index: usize| (index * width) as i32;
        self.with(|b| {
            let room = (3 * angles.len() * width) as u32;
            let slot = StackSlotData::new(StackSlotKind::ExplicitSlot, room, 4);
            let slot = b.create_sized_stack_slot(slot);
            let join = computed.map(|(usual, computed)| {
                let (rare, join) = (b.create_block(), b.create_block());
                b.set_cold_block(rare);
                let mut arguments = Vec::new();
                for &(sin, cos) in computed {
                    arguments.extend([BlockArg::Value(sin), BlockArg::Value(cos)]);
                    b.append_block_param(join, floats);
                    b.append_block_param(join, floats);
                }
                let usual = match floats.is_vector() {
                    true => b.ins().vall_true(usual),
                    false => usual,
                };
                b.ins().brif(usual, join, &arguments, rare, &[]);
                b.switch_to_block(rare);
                join
            });
            let address = b.ins().stack_addr(types::I64, slot, 0);
            for (index, &angle) in angles.iter().enumerate() {
                b.ins().store(unaligned(), angle, address, place(index));
            }
            for (index, &(sin, cos)) in computed.iter().flat_map(|c| c.1).enumerate() {
                let at = place(angles.len() + index);
                b.ins().store(unaligned(), sin, address, at);
                let at = place(2 * angles.len() + index);
                b.ins().store(unaligned(), cos, address, at);
            }
            let count = b.ins().iconst(types::I64, angle_count as i64);
            let kind = b.ins().iconst(types::I64, call as i64);
            b.ins().call(library, &[address, count, kind]);
            let mut load = |index| b.ins().load(floats, unaligned(), address, place(index));
            let mut pair = |index| (load(angles.len() + index), load(2 * angles.len() + index));
            let called: Vec<(Value, Value)> = (0..angles.len()).map(&mut pair).collect();
            let Some(join) = join else { return called };
            let values = called.iter().flat_map(|&(sin, cos)| [sin, cos]);
            let arguments: Vec<BlockArg> = values.map(BlockArg::Value).collect();
            b.ins().jump(join, &arguments);
            b.switch_to_block(join);
            let joined = b.block_params(join).chunks(2);
            joined.map(|pair| (pair[0], pair[1])).collect()
        })
    }
}

fn repeated(b: &mut FunctionBuilder<'_>, ty: Type, lane: &[u8]) -> Value {
    let bytes = lane.repeat(ty.bytes() as usize / lane.len());
    let handle = b.func.dfg.constants.insert(ConstantData::from(&bytes[..]));
    b.ins().vconst(ty, handle)
}
