//! A simulated arm under computed torque: collisions are found.

use dalembert_fit::simulate::{Collision, ControlledArm, Log, LogSettings, control};
use dalembert_fit::{Differentiator, Error, Model, Trajectory, Watch, excite};
use dalembert_model::robot::Robot;

use crate::support::{
    differentiated, guess, model, noise, short_effort, torques, true_parameters, truth,
};

const PERIOD: f64 = 1e-3;

/// The PUMA on an exciting trajectory of 8 s, again and again.
struct Scene {
    truth: Robot,
    model: Model,
    trajectory: Trajectory,
    filter: Differentiator,
}

impl Scene {
    fn new() -> Scene {
        let truth = truth("puma560");
        let model = model(&guess(&truth));
        let (trajectory, _) = excite(&model, &[1.0; 6], 8.0, &short_effort()).unwrap();
        Scene {
            truth,
            model,
            trajectory,
            filter: Differentiator::for_motion(PERIOD, 4.0).unwrap(),
        }
    }

    fn arm(&self, collisions: &[Collision]) -> ControlledArm {
        ControlledArm {
            arms: vec![(0.0, self.truth.clone())],
            controller: guess(&self.truth),
            bandwidth: 20.0,
            collisions: collisions.to_vec(),
        }
    }

    fn controlled(&self, arm: &ControlledArm, states: usize, seed: u64) -> Result<Log, Error> {
        let recording = LogSettings {
            period: PERIOD,
            states,
            noise: (0..6).map(noise).collect(),
            resolution: 2.0 * std::f64::consts::PI / 131_072.0,
            seed,
        };
        control(arm, &self.trajectory, &recording)
    }

    fn record(&self, collisions: &[Collision], seconds: f64, seed: u64) -> Log {
        let states = (seconds / PERIOD) as usize;
        let log = self.controlled(&self.arm(collisions), states, seed);
        log.unwrap()
    }
}

fn watched(scene: &Scene, log: &Log, bar: f64) -> Vec<(f64, Option<usize>, f64)> {
    let right = true_parameters(&scene.truth);
    let sigma: Vec<f64> = (0..6).map(noise).collect();
    let mut watch = Watch::new(&sigma, 1.0, bar).unwrap();
    let states = differentiated(&scene.filter, log).into_iter().enumerate();
    let said = states.map(|(k, [q, qd, qdd])| {
        let y = scene.model.regressor(&q, &qd, &qdd).unwrap();
        let at = k + scene.filter.half();
        let both = log.tau[at].iter().zip(torques(&y, &right));
        let residuals: Vec<f64> = both.map(|(t, p)| t - p).collect();
        let alarm = watch.push(&residuals).unwrap();
        (at as f64 * PERIOD, alarm, watch.level())
    });
    said.collect()
}

/// Returns the number of false alarms; the bar is twice the level of a log without collisions.
fn false_alarms(logs: u64, seconds: f64) -> usize {
    let scene = Scene::new();
    let quiet = scene.record(&[], 16.0, 999);
    let levels = watched(&scene, &quiet, 1e9).into_iter().map(|said| said.2);
    let level = levels.fold(0.0, f64::max);
    let push = |part: f64, torque: [f64; 6]| Collision {
        start: part * seconds,
        duration: 0.1,
        torque: torque.to_vec(),
    };
    // A tenth of the second joint's weight, ten times the fifth's noise.
    let collisions = [
        push(0.41, [0.0, 6.0, 0.0, 0.0, 0.0, 0.0]),
        push(0.77, [0.0, 0.0, 0.0, 0.0, -1.0, 0.0]),
    ];
    println!("level {level:.1}");
    let near = |one: &Collision, time: f64| time > one.start - 0.2 && time < one.start + 0.4;
    let far = |time: &&f64| !collisions.iter().any(|one| near(one, **time));
    let others_of = |seed: u64| -> usize {
        let log = scene.record(&collisions, seconds, seed);
        let said = watched(&scene, &log, 2.0 * level);
        let alarms = said.iter().filter(|said| said.1.is_some());
        let alarms = Vec::from_iter(alarms.map(|said| said.0));
        for one in &collisions {
            let is_found = alarms.iter().any(|time| near(one, *time));
            assert!(is_found, "missed {one:?}: {alarms:?}");
        }
        alarms.iter().filter(far).count()
    };
    let others: usize = std::thread::scope(|scope| {
        let halves = [0, 1].map(|half| {
            let counts = (half..logs).step_by(2).map(&others_of);
            scope.spawn(move || counts.sum::<usize>())
        });
        halves.map(|half| half.join().unwrap()).iter().sum()
    });
    println!("{} collisions found, {others} false alarms", 2 * logs);
    others
}

#[test]
fn collisions_are_found_and_nothing_else() {
    assert_eq!(false_alarms(1, 20.0), 0);
}

#[test]
#[ignore = "minutes: the step `campaigns` of .ci/run"]
fn an_hour_has_one_false_alarm_at_most() {
    assert!(false_alarms(60, 60.0) <= 1);
}

#[test]
fn scenes_and_watches_that_cannot_be_are_refused() {
    let scene = Scene::new();
    let good = scene.arm(&[]);
    assert_eq!(scene.controlled(&good, 10, 1).unwrap().q.len(), 10);
    let refused = |states: usize, change: &dyn Fn(&mut ControlledArm)| {
        let mut changed = good.clone();
        change(&mut changed);
        let log = scene.controlled(&changed, states, 1);
        log.unwrap_err().to_string()
    };
    let why = refused(10, &|of| of.arms.clear());
    assert!(why.contains("beginning"), "{why}");
    let why = refused(10, &|of| of.arms[0].1 = crate::support::file("panda"));
    assert_eq!(why, "`arms` has 7 values instead of 6");
    let short = Collision {
        start: 0.0,
        duration: 0.1,
        torque: vec![1.0],
    };
    let why = refused(10, &|of| of.collisions.push(short.clone()));
    assert!(why.contains("collisions"), "{why}");
    // So fast that the period is too long for it: the arm runs away, and nothing is recorded.
    let why = refused(1000, &|of| of.bandwidth = 1e5);
    assert!(why.contains("qdd"), "{why}");
    assert!(Watch::new(&[0.0], 1.0, 10.0).is_err());
    assert!(Watch::new(&[1.0], f64::NAN, 10.0).is_err());
    let mut watch = Watch::new(&[1.0, 2.0], 1.0, 10.0).unwrap();
    assert!(watch.push(&[1.0]).is_err());
    // Five noises less one a state: over ten at the third.
    let said: Vec<_> = (0..4).map(|_| watch.push(&[0.0, -10.0]).unwrap()).collect();
    assert_eq!(said, [None, None, Some(1), None]);
}
