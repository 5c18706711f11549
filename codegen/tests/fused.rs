//! Products that are fused with sums: which they are, how they are rounded, and certificates of
//! them; certificates of sines that are taken together.

use dalembert_codegen::workspace::{
    Argument, Code, JointState, Library, Setup, Signature, Sizes, testing::Rounding,
};
use dalembert_codegen::{Function, ScalarType};

use crate::certified::Certified;
use crate::support::{self, Case, says, variants};

#[test]
fn a_fused_product_saves_an_operation_and_a_rounding() {
    for name in ["stanford", "puma560", "panda"] {
        let case = Case::in_scene(name, "", "inverse_dynamics");
        let plain = case.generated().functions.remove(0);
        let setup = Setup::whole(case.robot());
        let program = plain.program.fused();
        let (before, after) = (plain.counts(), program.counts());
        assert_eq!(before.fma, 0);
        assert_eq!(after.mul + after.fma, before.mul);
        assert_eq!(after.add + after.fma, before.add);
        assert!(4 * after.fma > before.mul, "{name}: {after}");
        assert_eq!(program.fused(), program);
        let [before, after] =
            [&plain.program, &program].map(|program| Rounding::estimate(&setup, program));
        assert!(after.worst() < before.worst(), "{name}");
        let mut pairs = after.per_output.iter().zip(&before.per_output);
        assert!(pairs.all(|(after, before)| after <= before), "{name}");
    }
}

#[test]
fn the_option_gives_the_fused_program() {
    let case = |fma: &str| Case::in_scene("stanford", "", &format!("inverse_dynamics; fma: {fma}"));
    let [plain, fused] = ["off", "on"].map(|fma| case(fma).generated());
    let [before, after] = [&plain, &fused].map(|generated| &generated.functions[0]);
    assert_eq!(after.program, before.program.fused());
    assert_eq!(after.found.as_ref(), Some(&before.program));
    assert!(!plain.text().contains("mul_add") && fused.text().contains("mul_add"));
}

#[test]
fn a_line_is_rounded_once() {
    const TEXT: &str = "\
pub fn gravity(q: &[f64; 2]) -> [f64; 2] {
    let (s1, c1) = libm::sincos(q[0]);
    let t2 = s1.mul_add(0.1, c1);
    let t4 = (-t2).mul_add(c1, s1);
    let t6 = t4.mul_add(0.3, -0.7);
    let t7 = t6 * t4;
    [t7, -t6]
}
";
    let single = TEXT.replace("f64", "f32").replace("sincos", "sincosf");
    let read = |text: &str, scalar| {
        let signature = Signature {
            function: Function::Gravity,
            arguments: &[Argument::Position],
            sizes: Sizes::whole(2),
            scalar,
        };
        Code::parse(text, &signature).unwrap()
    };
    let (text, single) = (read(TEXT, ScalarType::F64), read(&single, ScalarType::F32));
    assert_eq!(text.counts().to_string(), "1 mul, 0 add, 3 fma, 1 sincos");
    macro_rules! once {
        ($sines:expr) => {{
            let (s1, c1) = $sines;
            let t2 = s1.mul_add(0.1, c1);
            let t4 = (-t2).mul_add(c1, s1);
            let t6 = t4.mul_add(0.3, -0.7);
            [t6 * t4, -t6]
        }};
    }
    let state = |k| JointState::at_rest(vec![f64::from(k as f32 * 0.03 - 3.0), 0.0]);
    let states: Vec<JointState> = (0..200).map(state).collect();
    let columns = text.run_at_many(&states);
    let mut twice = 0;
    for (k, state) in states.iter().enumerate() {
        let q = state.q[0];
        let expected = once!(libm::sincos(q));
        assert_eq!(text.run_at(state), expected);
        assert_eq!([columns[0][k], columns[1][k]], expected);
        let expected = once!(libm::sincosf(q as f32)).map(f64::from);
        assert_eq!(single.run_at(state), expected);
        let (s1, c1) = libm::sincos(q);
        twice += usize::from(s1.mul_add(0.1, c1) != s1 * 0.1 + c1);
    }
    assert!(twice > 5, "{twice}");
}

#[test]
fn bounds_are_of_one_rounding() {
    let scene = "\n[scene.hold]\ntolerance = { value = 1e-2, relative_to = \"range\" }\n";
    let asked = "outputs: gravity; scene: hold; scalar: f64, f32; fma: ";
    let [off, on] = ["off", "on"].map(|fma| Case::new("puma560", scene, &format!("{asked}{fma}")));
    let (plain, fma) = (off.generated(), on.generated());
    assert_eq!(variants(&fma).len(), variants(&plain).len());
    for (variant, plain) in variants(&fma).iter().zip(variants(&plain)) {
        assert!(variant.emitted.fuses() && variant.text.contains(".mul_add("));
        assert_eq!(variant.emitted, plain.emitted.fused());
        assert_eq!(variant.emitted, fma.functions[0].program);
        let mut smaller = 0;
        for (bound, other) in variant.bounds.iter().zip(&plain.bounds) {
            assert!(bound.rounding <= other.rounding && bound.real == other.real);
            smaller += usize::from(bound.rounding < other.rounding);
        }
        assert!(smaller > 0);
        Certified::variant(&support::source("puma560", scene), variant).is_shown(1, "fused");
    }
    assert_eq!(on.plan(&fma).write(), off.plan(&plain).write());
}

#[test]
fn claims_name_the_library() {
    let scene = "\n[scene.slow]\noutputs = [\"gravity\"]\n\
                 tolerance = { value = 1e-9, relative_to = \"range\" }\nscalar = \"f64\"\n";
    let generated = Case::new("planar2r", scene, "scene: slow; sincos: together").generated();
    says(&generated.text(), "dalembert_sines::sincos(&[");
    let variant = &variants(&generated)[0];
    assert_eq!(variant.library, Library::Together);
    Certified::variant(&support::source("planar2r", scene), variant).is_shown(1, "together");
}
