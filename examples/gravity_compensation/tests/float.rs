//! Simulates the arms with servos that round, rub and brake as real ones do.

use example_shared::{State, assert_shown, distance, largest};
use gravity_compensation::cycle::{Cycle, PERIOD, Stop};
use gravity_compensation::{OPEN_MANIPULATOR_SERVOS, SO101_SERVOS, Servo, open_manipulator, so101};

dalembert::dynamics! {
    /// The simulated SO-101: its rotors outweigh its wrist.
    mod so101_plant = "robots/so101_geared.toml";
    outputs: forward_dynamics, gravity;
    scalar: f64;
}

dalembert::dynamics! {
    /// The simulated OpenMANIPULATOR-X.
    mod open_manipulator_plant = "robots/open_manipulator_geared.toml";
    outputs: forward_dynamics, gravity;
    scalar: f64;
}

/// A function that returns q̈ from q, q̇ and τ.
type Acceleration<const N: usize> = fn(&[f64; N], &[f64; N], &[f64; N]) -> [f64; N];

/// A simulated arm with its servos, and a controller, which may assume other servos.
struct Bench<const N: usize> {
    servos: [Servo; N],
    cycle: Cycle<N>,
    acceleration: Acceleration<N>,
    state: State<N>,
}

impl<const N: usize> Bench<N> {
    fn ticks(&self) -> [u16; N] {
        core::array::from_fn(|i| tick(&self.servos[i], self.state.q[i]))
    }

    fn hold(&mut self) {
        for _ in 0..2100 {
            self.cycle.step(&self.ticks());
        }
    }

    /// Simulates a torque at the second joint for `seconds`; returns how far each joint moved.
    fn run(&mut self, seconds: f64, push: impl Fn(f64) -> f64) -> [f64; N] {
        let from = self.state.q;
        let period = f64::from(PERIOD);
        for k in 0..(seconds / period).round() as usize {
            let commands = self.cycle.step(&self.ticks());
            let force = push(k as f64 * period);
            // The friction of the gears needs short steps.
            for _ in 0..4 {
                self.state = self.state.step(period / 4.0, |at| {
                    let mut tau =
                        core::array::from_fn(|i| torque(&self.servos[i], commands[i], at.qd[i]));
                    tau[1] += force;
                    (self.acceleration)(&at.q, &at.qd, &tau)
                });
            }
        }
        core::array::from_fn(|i| (self.state.q[i] - from[i]).abs())
    }
}

fn tick(servo: &Servo, q: f64) -> u16 {
    let turns = f64::from(servo.sign) * q / std::f64::consts::TAU;
    (turns * f64::from(servo.ticks) + f64::from(servo.zero)).round() as u16
}

/// Returns the torque at the joint: that of the command, less back-EMF, less friction.
fn torque(servo: &Servo, command: i16, speed: f64) -> f64 {
    let drive =
        f64::from(servo.sign) * f64::from(command) - f64::from(servo.units_per_speed) * speed;
    let rub = f64::from(servo.friction) * speed / (speed * speed + 1e-4).sqrt();
    drive / f64::from(servo.units_per_torque) - rub - 0.01 * speed
}

fn so101_at(q: [f64; so101::N], known: [Servo; so101::N]) -> Bench<{ so101::N }> {
    Bench {
        servos: SO101_SERVOS,
        cycle: Cycle::new(known, so101::gravity),
        acceleration: so101_plant::forward_dynamics,
        state: State::at_rest(q),
    }
}

const POSES: [[f64; so101::N]; 3] = [
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [0.5, 0.6, -0.8, 0.4, 0.2],
    [-1.0, -0.7, 0.9, -0.5, 1.0],
];

#[test]
fn an_so101_floats_and_falls_without_support() {
    for q in POSES {
        let mut bench = so101_at(q, SO101_SERVOS);
        bench.hold();
        let moved = largest(bench.run(3.0, |_| 0.0));
        assert_eq!(bench.cycle.stop(), None);
        assert!(moved < 0.001, "{q:?}: {moved}");
        // A push moves it, and it stays where it was put.
        let pushed = bench.run(0.6, |time| if time < 0.3 { 0.25 } else { 0.0 })[1];
        let after = bench.run(2.0, |_| 0.0)[1];
        assert!((0.25..0.35).contains(&pushed), "{pushed}");
        assert!(after < 0.0115, "{after}");
    }
    // The same arm without gravity compensation.
    let mut bench = so101_at(POSES[0], SO101_SERVOS);
    bench.cycle = Cycle::new(SO101_SERVOS, |_| [0.0; so101::N]);
    let fallen = largest(bench.run(1.0, |_| 0.0));
    assert!(fallen > 0.3, "{fallen}");
}

#[test]
fn an_open_manipulator_floats() {
    let mut bench = Bench {
        servos: OPEN_MANIPULATOR_SERVOS,
        cycle: Cycle::new(OPEN_MANIPULATOR_SERVOS, open_manipulator::gravity),
        acceleration: open_manipulator_plant::forward_dynamics,
        state: State::at_rest([0.2, 0.8, -0.5, 0.3]),
    };
    bench.hold();
    let moved = largest(bench.run(3.0, |_| 0.0));
    assert!(moved < 0.03, "{moved}");
    assert_eq!(bench.cycle.stop(), None);
}

#[test]
fn mistakes_are_noticed() {
    let mut wrong = SO101_SERVOS;
    wrong[1].sign = -1.0;
    let mut bench = so101_at([0.0, 0.4, 0.0, 0.0, 0.0], wrong);
    bench.hold();
    let moved = bench.run(1.0, |_| 0.0);
    assert_eq!(bench.cycle.stop(), Some(Stop::Fast(1)), "{moved:?}");
    // A servo whose angle jumps.
    let mut bench = so101_at(POSES[1], SO101_SERVOS);
    bench.run(0.1, |_| 0.0);
    let mut ticks = bench.ticks();
    ticks[3] += 400;
    assert_eq!(bench.cycle.step(&ticks), [0; so101::N]);
    assert_eq!(bench.cycle.stop(), Some(Stop::Jump(3)));
    // Once released, it stays released.
    ticks[3] -= 400;
    assert_eq!(bench.cycle.step(&ticks), [0; so101::N]);
}

/// The support grows from nothing to all, and never exceeds the servo's limit.
#[test]
fn support_grows() {
    let largest = |commands: [i16; so101::N]| commands.into_iter().map(i16::abs).max();
    let mut bench = so101_at(POSES[0], SO101_SERVOS);
    let ticks = bench.ticks();
    let first = largest(bench.cycle.step(&ticks));
    let mut last = first;
    for _ in 0..3000 {
        let now = largest(bench.cycle.step(&ticks));
        assert!(now >= last, "{now:?} after {last:?}");
        last = now;
    }
    assert!(first <= Some(1) && last > Some(50), "{first:?} {last:?}");
    let mut cycle = Cycle::new(SO101_SERVOS, |_| [99.0; so101::N]);
    let most = (SO101_SERVOS[0].most * SO101_SERVOS[0].units_per_torque).round() as i16;
    for _ in 0..3000 {
        assert!(largest(cycle.step(&ticks)) <= Some(most));
    }
}

#[test]
fn f32_is_enough() {
    for q in POSES {
        let short = so101::gravity(&q.map(|x| x as f32)).map(f64::from);
        assert!(distance(&short, &so101_plant::gravity(&q)) < 1e-6);
        let [q @ .., _] = q;
        let short = open_manipulator::gravity(&q.map(|x| x as f32)).map(f64::from);
        assert!(distance(&short, &open_manipulator_plant::gravity(&q)) < 1e-6);
    }
}

#[test]
fn the_example_prints_what_the_guide_shows() {
    let guide = include_str!("../README.md");
    assert_shown(env!("CARGO_BIN_EXE_gravity_compensation"), guide);
}
