//! Functions around a program: one state, and many in vectors.

use cranelift_codegen::Context;
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{AbiParam, BlockArg, InstBuilder, MemFlagsData, Value, types};
use cranelift_codegen::settings::{self, Configurable};
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, Linkage, Module, default_libcall_names};
use dalembert_codegen::workspace::{Argument, Code};

use crate::emit::{Emitter, number, vector};
use crate::error::Error;
use crate::program;

/// The arguments and results of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// The arguments in order, each with its number of entries.
    pub arguments: Vec<(Argument, usize)>,
    /// The results in order, each with its number of entries.
    pub results: Vec<usize>,
}

impl Signature {
    fn argument(&self, wanted: Argument) -> Option<(usize, usize)> {
        let mut arguments = self.arguments.iter().enumerate();
        arguments.find_map(|(place, &(argument, len))| (argument == wanted).then_some((place, len)))
    }

    fn first_entry(&self, place: usize) -> usize {
        self.arguments[..place].iter().map(|&(_, len)| len).sum()
    }
}

const LIBRARY: &str = "dalembert_sines_of";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum States {
    /// One state: arrays of arguments and one of results.
    One,
    /// Many: an address an entry, and the states of each argument and result so far apart.
    Apart,
    /// Many, the numbers of an entry one after the other: no stride is read.
    Adjacent,
}

pub(crate) fn compile(
    code: &Code,
    signature: &Signature,
    states: States,
    library: *const u8,
) -> Result<(JITModule, *const u8), Error> {
    let mut flags = settings::builder();
    let verifies = cfg!(debug_assertions).to_string();
    for (name, value) in [
        ("use_colocated_libcalls", "false"),
        ("is_pic", "false"),
        ("opt_level", "speed"),
        // Large programs have frames beyond a guard page.
        ("enable_probestack", "true"),
        ("probestack_strategy", "inline"),
        ("enable_verifier", verifies.as_str()),
    ] {
        Error::cranelift(flags.set(name, value))?;
    }
    let isa = Error::cranelift(cranelift_native::builder())?;
    let isa = Error::cranelift(isa.finish(settings::Flags::new(flags)))?;
    let mut builder = JITBuilder::with_isa(isa, default_libcall_names());
    builder.symbol(LIBRARY, library);
    let mut module = JITModule::new(builder);
    let function = define(&mut module, code, signature, states)?;
    Error::cranelift(module.finalize_definitions())?;
    let entry = module.get_finalized_function(function);
    Ok((module, entry))
}

fn define(
    module: &mut JITModule,
    code: &Code,
    signature: &Signature,
    states: States,
) -> Result<FuncId, Error> {
    let (floats, parameters) = match states {
        // Addresses of the arguments, and of the results.
        States::One => (number(code.scalar), 2),
        // Addresses of all arguments' entries, the arguments' strides, addresses of all results'
        // entries, the results' strides, the number of states.
        States::Apart | States::Adjacent => (vector(code.scalar), 5),
    };
    let mut library = module.make_signature();
    library.params = vec![AbiParam::new(types::I64); 3];
    let library = module.declare_function(LIBRARY, Linkage::Import, &library);
    let library = Error::cranelift(library)?;
    let mut function_signature = module.make_signature();
    function_signature.params = vec![AbiParam::new(types::I64); parameters];
    let function = module.declare_function("function", Linkage::Local, &function_signature);
    let function = Error::cranelift(function)?;
    let mut context: Context = module.make_context();
    context.func.signature = function_signature;
    let library = module.declare_func_in_func(library, &mut context.func);
    let mut frontend = FunctionBuilderContext::new();
    let mut builder = FunctionBuilder::new(&mut context.func, &mut frontend);
    let block = builder.create_block();
    builder.append_block_params_for_function_params(block);
    builder.switch_to_block(block);
    let parameters = builder.block_params(block).to_vec();
    let emitter = Emitter::new(builder, floats, library);
    match states {
        States::One => one(&emitter, code, signature, &parameters)?,
        _ => many(&emitter, code, signature, &parameters, states)?,
    }
    let mut builder = emitter.into_builder();
    builder.ins().return_(&[]);
    builder.seal_all_blocks();
    builder.finalize(module.target_config());
    Error::cranelift(module.define_function(function, &mut context))?;
    Ok(function)
}

fn one(
    emitter: &Emitter<'_>,
    code: &Code,
    signature: &Signature,
    parameters: &[Value],
) -> Result<(), Error> {
    let &[arguments, results] = parameters else {
        return Err(Error::Program);
    };
    let width = number(code.scalar).bytes() as i32;
    let argument = |index| address(emitter, arguments, index);
    let addresses: Vec<Value> = (0..signature.arguments.len()).map(argument).collect();
    let read = |argument, index: usize| {
        let (place, len) = signature.argument(argument)?;
        (index < len).then(|| emitter.read(addresses[place], index as i32 * width))
    };
    let values = program::emit(emitter, code, read)?;
    for (index, value) in values.into_iter().enumerate() {
        emitter.write(value, results, index as i32 * width);
    }
    Ok(())
}

fn address(emitter: &Emitter<'_>, table: Value, index: usize) -> Value {
    let flags = MemFlagsData::trusted();
    emitter.with(|b| b.ins().load(types::I64, flags, table, 8 * index as i32))
}

/// The loop ends before the states that do not fill a vector.
fn many(
    emitter: &Emitter<'_>,
    code: &Code,
    signature: &Signature,
    parameters: &[Value],
    layout: States,
) -> Result<(), Error> {
    let &[entries, strides, results, result_strides, states] = parameters else {
        return Err(Error::Program);
    };
    let lanes = vector(code.scalar).lane_count();
    let (head, end, first, next) = emitter.with(|b| {
        let [head, body, end] = [(); 3].map(|()| b.create_block());
        b.append_block_param(head, types::I64);
        let zero = b.ins().iconst(types::I64, 0);
        b.ins().jump(head, &[BlockArg::Value(zero)]);
        b.switch_to_block(head);
        let first = b.block_params(head)[0];
        let next = b.ins().iadd_imm_s(first, i64::from(lanes));
        let is_in = b.ins().icmp(IntCC::SignedLessThanOrEqual, next, states);
        b.ins().brif(is_in, body, &[], end, &[]);
        b.switch_to_block(body);
        (head, end, first, next)
    });
    // The offset of each lane's state from the first, of everything with this stride; of
    // adjacent states, that of the vector.
    let offsets = |strides: Value, place: usize| -> Vec<Value> {
        if layout == States::Adjacent {
            let width = i64::from(number(code.scalar).bytes());
            return vec![emitter.with(|b| b.ins().imul_imm_s(first, width))];
        }
        let stride = address(emitter, strides, place);
        emitter.with(|b| {
            let mut offset = b.ins().imul(first, stride);
            let mut offsets = vec![offset];
            for _ in 1..lanes {
                offset = b.ins().iadd(offset, stride);
                offsets.push(offset);
            }
            offsets
        })
    };
    let mut of_arguments: Vec<Option<Vec<Value>>> = vec![None; signature.arguments.len()];
    let read = |argument, index: usize| {
        let (place, len) = signature.argument(argument)?;
        let at = (index < len).then(|| signature.first_entry(place) + index)?;
        let offsets = of_arguments[place].get_or_insert_with(|| offsets(strides, place));
        let base = address(emitter, entries, at);
        Some(emitter.gather(base, offsets))
    };
    let mut values = program::emit(emitter, code, read)?.into_iter().enumerate();
    for (place, &len) in signature.results.iter().enumerate() {
        let offsets = offsets(result_strides, place);
        for (index, value) in values.by_ref().take(len) {
            let base = address(emitter, results, index);
            emitter.scatter(value, base, &offsets);
        }
    }
    emitter.with(|b| {
        b.ins().jump(head, &[BlockArg::Value(next)]);
        b.switch_to_block(end);
    });
    Ok(())
}
