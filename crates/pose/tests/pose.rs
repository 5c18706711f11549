//! The promises of the helpers: identities in exact arithmetic, the error bounds of the documentation,
//! Pinocchio's values, and the same numbers from the text for C.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::path::Path;
use std::process::Command;
use std::{env, fs};

use dalembert_model::number::Wide;
use dalembert_model::scalar::dual::Dual;
use dalembert_model::scalar::field::{Field, Points};
use dalembert_model::scalar::{Divide, Scalar};
use dalembert_pose::{Axes, C_HEADER, Pose, Quaternion, Real};
use serde_json::Value;

const AXES: [Axes; 3] = [Axes::Mixed, Axes::World, Axes::Split];

/// A number of the model's arithmetics.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Number<S>(S);

trait Exact: Divide + Copy + PartialEq {
    fn over(&self, other: &Self) -> Self {
        self.div(other)
    }
    /// Returns false in a field, which has no order.
    fn is_below(&self, _: &Self) -> bool {
        false
    }
}

impl Exact for Field {}
impl Exact for Dual<Field> {}

impl Exact for Wide {
    fn over(&self, other: &Self) -> Self {
        Wide::over(self, other).unwrap()
    }
    fn is_below(&self, other: &Self) -> bool {
        self.sub(other).is_negative()
    }
}

impl<S: Exact> Add for Number<S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Number(self.0.add(&other.0))
    }
}

impl<S: Exact> Sub for Number<S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Number(self.0.sub(&other.0))
    }
}

impl<S: Exact> Mul for Number<S> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Number(self.0.mul(&other.0))
    }
}

impl<S: Exact> Div for Number<S> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Number(self.0.over(&other.0))
    }
}

impl<S: Exact> Neg for Number<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Number(self.0.neg())
    }
}

impl<S: Exact> PartialOrd for Number<S> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match (self.0.is_below(&other.0), other.0.is_below(&self.0)) {
            (true, _) => Some(Ordering::Less),
            (_, true) => Some(Ordering::Greater),
            _ => Some(Ordering::Equal),
        }
    }
}

impl<S: Exact> From<u16> for Number<S> {
    fn from(count: u16) -> Self {
        let digits = [S::zero(), S::one()];
        let bit = |place: u32| usize::from(count >> place & 1);
        let bits = (0..u16::BITS).rev().map(bit);
        Number(bits.fold(S::zero(), |sum, bit| sum.double().add(&digits[bit])))
    }
}

impl<S: Exact> Real for Number<S> {}

type Residue = Number<Field>;

fn some<const N: usize>(points: &mut Points) -> [Residue; N] {
    std::array::from_fn(|_| Number(points.field()))
}

fn pose_of<T: Real>(position: [T; 3], xyzw: [T; 4]) -> Pose<T> {
    Pose {
        position,
        orientation: Quaternion::from_xyzw(xyzw),
    }
}

fn dot(a: [Residue; 3], b: [Residue; 3]) -> Residue {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Modulo 2⁶¹ − 465, at random quaternions of any length.
#[test]
fn rotations_are_those_of_the_textbook() {
    let mut points = Points::new(1);
    for _ in 0..20 {
        let [x, y, z, w] = some(&mut points);
        let orientation = Quaternion::from_wxyz([w, x, y, z]);
        assert_eq!(orientation, Quaternion::from_xyzw([x, y, z, w]));
        let [xx, yy, zz, ww] = [x, y, z, w].map(|entry| entry * entry);
        let two = Residue::from(2);
        let [xy, yz, xz] = [two * x * y, two * y * z, two * x * z];
        let [wx, wy, wz] = [x, y, z].map(|entry| two * w * entry);
        let rows = [
            [ww + xx - yy - zz, xy - wz, xz + wy],
            [xy + wz, ww - xx + yy - zz, yz - wx],
            [xz - wy, yz + wx, ww - xx - yy + zz],
        ];
        let vector = some(&mut points);
        let expected = rows.map(|row| dot(row, vector) / (xx + yy + zz + ww));
        assert_eq!(orientation.rotate(vector), expected);
        assert_eq!(orientation.rotate_back(expected), vector);
        let other = Quaternion::from_xyzw(some(&mut points));
        let both = orientation.after(other).rotate(vector);
        assert_eq!(both, orientation.rotate(other.rotate(vector)));
    }
}

/// The rate of what `velocity_in` returns, along a motion of the pose, by dual numbers.
#[test]
fn accelerations_are_rates_of_velocities() {
    let mut points = Points::new(2);
    for _ in 0..20 {
        let here = pose_of(some(&mut points), some(&mut points));
        let [velocity, acceleration]: [[Residue; 6]; 2] = [some(&mut points), some(&mut points)];
        let moving = |value: Residue, rate: Residue| {
            let (value, rate) = (value.0, rate.0);
            Number(Dual { value, rate })
        };
        let [a, b, c, d, e, f] = velocity;
        let half = Residue::from(1) / Residue::from(2);
        let by = Quaternion::from_xyzw([half * d, half * e, half * f, Residue::from(0)]);
        let position_rate = here.orientation.rotate([a, b, c]);
        let turn_rate = here.orientation.after(by).to_xyzw();
        let orientation = here.orientation.to_xyzw();
        let moved = pose_of(
            std::array::from_fn(|i| moving(here.position[i], position_rate[i])),
            std::array::from_fn(|i| moving(orientation[i], turn_rate[i])),
        );
        let changing = std::array::from_fn(|i| moving(velocity[i], acceleration[i]));
        for axes in AXES {
            let expected = moved.velocity_in(axes, changing);
            let value = expected.map(|number| Number(number.0.value));
            let rate = expected.map(|number| Number(number.0.rate));
            assert_eq!(here.velocity_in(axes, velocity), value, "{axes:?}");
            assert_eq!(here.velocity_from(axes, value), velocity, "{axes:?}");
            let there = here.acceleration_in(axes, velocity, acceleration);
            assert_eq!(there, rate, "{axes:?}");
            let back = here.acceleration_from(axes, velocity, there);
            assert_eq!(back, acceleration, "{axes:?}");
        }
    }
}

fn wide<const N: usize>(values: [f64; N]) -> [Number<Wide>; N] {
    values.map(|value| Number(Wide::from_f64(value).unwrap()))
}

fn widened(pose: &Pose<f64>) -> Pose<Number<Wide>> {
    pose_of(wide(pose.position), wide(pose.orientation.to_xyzw()))
}

/// Poses and steps with turns from zero to half a turn, most of them near either end.
fn steps() -> impl Iterator<Item = (Pose<f64>, [f64; 6])> {
    let mut points = Points::new(3);
    (0..4000).map(move |round| {
        let mut unit = || points.unit();
        let position = [unit(), unit(), unit()];
        let xyzw: [f64; 4] = [unit(), unit(), unit(), unit()];
        let length = xyzw.iter().map(|x| x * x).sum::<f64>().sqrt();
        let pose = pose_of(position, xyzw.map(|x| x / length));
        let mut step: [f64; 6] = [unit(), unit(), unit(), unit(), unit(), unit()];
        let turn = step[3..].iter().map(|x| x * x).sum::<f64>().sqrt();
        let part = 10f64.powi(-(round % 18));
        let angle = match round % 3 {
            0 => part * 3.0,
            1 => std::f64::consts::PI - part.max(1e-12),
            _ => 3.0 * unit().abs(),
        };
        step[3..].iter_mut().for_each(|x| *x *= angle / turn);
        (pose, step)
    })
}

const UNIT: f64 = 1.0 / (1u64 << 53) as f64;

fn largest<'v>(values: impl IntoIterator<Item = &'v f64>) -> f64 {
    values.into_iter().fold(0.0, |most, x| x.abs().max(most))
}

fn worst<const N: usize>(values: [f64; N], truth: [Number<Wide>; N]) -> f64 {
    let off = wide(values).into_iter().zip(truth);
    off.map(|(value, truth)| (value - truth).0.magnitude())
        .fold(0.0, f64::max)
}

/// The text in 256 bits is the reference: only the rounding of doubles differs. The cut-off rest
/// of the series is far below it, as the bounds of their first terms left out say.
#[test]
fn errors_are_below_their_bounds() {
    let mut most = [0.0_f64; 5];
    for (pose, step) in steps() {
        let next = pose.integrate(step);
        let truth = widened(&pose).integrate(wide(step));
        let longest = largest(pose.position.iter().chain(&step[..3]));
        let turned = worst(next.orientation.to_xyzw(), truth.orientation.to_xyzw());
        most[0] = most[0].max(turned / UNIT);
        let moved = worst(next.position, truth.position);
        most[1] = most[1].max(moved / UNIT / longest);
        let length: f64 = next.orientation.to_xyzw().iter().map(|x| x * x).sum();
        assert!((length - 1.0).abs() < 16.0 * UNIT, "{length}");
        let difference = pose.difference(&next);
        let truth = widened(&pose).difference(&widened(&next));
        let longest = largest(pose.position.iter().chain(&next.position));
        let [linear, turn] = [0, 3].map(|from| {
            let part = |i: usize| (difference[from + i], truth[from + i]);
            let parts = [part(0), part(1), part(2)];
            worst(parts.map(|pair| pair.0), parts.map(|pair| pair.1))
        });
        most[2] = most[2].max(turn / UNIT);
        most[3] = most[3].max(linear / UNIT / longest);
        // As many of an angle's digits are left as the two orientations have of it.
        let lost: [f64; 3] = std::array::from_fn(|i| step[3 + i] - difference[3 + i]);
        most[4] = most[4].max(largest(&lost) / UNIT);
        assert!(largest(&difference[3..]) < 3.2);
    }
    println!("of u: {most:?}");
    for (error, bound) in most.into_iter().zip([4.0, 16.0, 16.0, 32.0, 64.0]) {
        assert!(error < bound, "{most:?}");
    }
}

fn read(value: &Value) -> Vec<f64> {
    let entries = value.as_array().unwrap().iter();
    entries.map(|entry| entry.as_f64().unwrap()).collect()
}

fn entries<const N: usize>(row: &Value, key: &str) -> [f64; N] {
    read(&row[key]).try_into().unwrap()
}

#[test]
fn values_are_pinocchio_s() {
    let rows: Value = serde_json::from_str(include_str!("data/values.json")).unwrap();
    let mut most: f64 = 0.0;
    for row in rows.as_array().unwrap() {
        let pose = pose_of(entries(row, "position"), entries(row, "xyzw"));
        let [px, py, pz, x, y, z, w]: [f64; 7] = entries(row, "to");
        let next = pose.integrate(entries(row, "step"));
        let to = pose_of([px, py, pz], [x, y, z, w]);
        let velocity = entries(row, "velocity");
        let acceleration = entries(row, "acceleration");
        let gravity = pose.orientation.rotate_back([0.0, 0.0, -9.81]);
        let mut compared = vec![
            (next.position.to_vec(), vec![px, py, pz]),
            (next.orientation.to_xyzw().to_vec(), vec![x, y, z, w]),
            (pose.difference(&to).to_vec(), read(&row["difference"])),
            (gravity.to_vec(), read(&row["gravity"])),
        ];
        for (axes, name) in [(Axes::Mixed, "mixed"), (Axes::World, "world")] {
            let in_axes = pose.velocity_in(axes, velocity);
            let rate = pose.acceleration_in(axes, velocity, acceleration);
            for (key, value) in [("velocity", in_axes), ("acceleration", rate)] {
                compared.push((value.to_vec(), read(&row[format!("{name}_{key}")])));
            }
        }
        for (found, expected) in compared {
            assert_eq!(found.len(), expected.len());
            for (found, expected) in found.iter().zip(&expected) {
                most = most.max((found - expected).abs());
            }
        }
    }
    println!("{most:e}");
    // Pinocchio's logarithm loses digits near half a turn.
    assert!(most < 1e-13, "{most:e}");
}

const MAIN: &str = r#"
#include <stdio.h>
#include "pose.h"
int main(void) {
    POSE_REAL in[25];
    double read[25];
    for (;;) {
        for (int i = 0; i < 25; i++) {
            if (scanf("%lf", &read[i]) != 1) return 0;
            in[i] = (POSE_REAL)read[i];
        }
        pose_base a = {{in[0], in[1], in[2]}, pose_from_xyzw(in + 3)}, b;
        POSE_REAL out[6], q[4];
        b = pose_integrate(&a, in + 7);
        pose_to_wxyz(&b.orientation, q);
        printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g ", (double)b.position[0], (double)b.position[1],
               (double)b.position[2], (double)q[0], (double)q[1], (double)q[2], (double)q[3]);
        pose_difference(&a, &b, out);
        for (int i = 0; i < 6; i++) printf("%.17g ", (double)out[i]);
        for (int axes = 0; axes < 3; axes++) {
            pose_velocity_in(&a, (pose_axes)axes, in + 13, out);
            for (int i = 0; i < 6; i++) printf("%.17g ", (double)out[i]);
            pose_velocity_from(&a, (pose_axes)axes, in + 13, out);
            for (int i = 0; i < 6; i++) printf("%.17g ", (double)out[i]);
            pose_acceleration_in(&a, (pose_axes)axes, in + 13, in + 19, out);
            for (int i = 0; i < 6; i++) printf("%.17g ", (double)out[i]);
            pose_acceleration_from(&a, (pose_axes)axes, in + 13, in + 19, out);
            for (int i = 0; i < 6; i++) printf("%.17g ", (double)out[i]);
        }
        printf("\n");
    }
}
"#;

fn there(names: &[&'static str]) -> Vec<&'static str> {
    let is_there = |name: &&str| {
        let version = Command::new(name).arg("--version").output();
        version.is_ok_and(|output| output.status.success())
    };
    let compilers: Vec<&str> = names.iter().copied().filter(is_there).collect();
    if compilers.is_empty() {
        eprintln!("none of {names:?} is here: the header is not compiled");
    }
    compilers
}

fn run(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {said}");
    String::from_utf8(output.stdout).unwrap()
}

/// Each line of the program's input: a pose, a step, and a velocity and an acceleration.
fn rust_values<T: Real + Into<f64>>(input: [f64; 25], rounded: fn(f64) -> T) -> Vec<f64> {
    let numbers = input.map(rounded);
    let at = |from: usize| -> [T; 6] { std::array::from_fn(|i| numbers[from + i]) };
    let [px, py, pz, x, y, z, w, ..] = numbers;
    let pose = pose_of([px, py, pz], [x, y, z, w]);
    let next = pose.integrate(at(7));
    let mut values = next.position.to_vec();
    values.extend(next.orientation.to_wxyz());
    values.extend(pose.difference(&next));
    for axes in AXES {
        values.extend(pose.velocity_in(axes, at(13)));
        values.extend(pose.velocity_from(axes, at(13)));
        values.extend(pose.acceleration_in(axes, at(13), at(19)));
        values.extend(pose.acceleration_from(axes, at(13), at(19)));
    }
    values.into_iter().map(Into::into).collect()
}

#[test]
fn c_returns_the_same_numbers() {
    let inputs: Vec<[f64; 25]> = steps()
        .take(500)
        .map(|(pose, step)| {
            let mut numbers = pose.position.to_vec();
            numbers.extend(pose.orientation.to_xyzw());
            numbers.extend(step);
            numbers.extend(step.map(|x| 1.5 - x));
            numbers.extend(step.map(|x| x * 3.0 - 0.2));
            numbers.try_into().unwrap()
        })
        .collect();
    let text = |input: &[f64; 25]| input.map(|x| format!("{x:e}")).join(" ");
    let lines = inputs.iter().map(text).collect::<Vec<_>>().join("\n");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    fs::write(folder.join("pose.h"), C_HEADER).unwrap();
    fs::write(folder.join("main.c"), MAIN).unwrap();
    fs::write(folder.join("states"), lines).unwrap();
    for compiler in there(&["gcc", "clang"]) {
        for real in ["double", "float"] {
            let program = folder.join(format!("{compiler}_{real}"));
            let flags = "-std=c99 -O2 -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion \
                         -Wdouble-promotion -Werror main.c -o";
            let real_is = format!("-DPOSE_REAL={real}");
            let built = &mut Command::new(compiler);
            let built = built.current_dir(folder).args(flags.split_whitespace());
            run(built.arg(&program).arg(real_is));
            let states = fs::File::open(folder.join("states")).unwrap();
            let said = run(Command::new(&program).stdin(states));
            assert_eq!(said.lines().count(), inputs.len());
            for (line, input) in said.lines().zip(&inputs) {
                let found: Vec<f64> = line.split(' ').filter_map(|x| x.parse().ok()).collect();
                let expected = match real {
                    "double" => rust_values(*input, |x| x),
                    _ => rust_values(*input, |x| x as f32),
                };
                assert_eq!(found, expected, "{compiler} {real} {input:?}");
            }
        }
    }
}
