//! `simulate`: logs of an arm whose parameters are known.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use dalembert_fit::random::{Random, normal, within};
use dalembert_fit::simulate::{Collision, ControlledArm, Log, LogSettings, control};
use dalembert_fit::{Effort, Model, Trajectory, excite};
use dalembert_model::number::Rational;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::robot::{Robot, write};
use parquet::basic::{Compression, ZstdLevel};

use super::number;
use crate::dynamics::{Dynamics, Loaded, States};
use crate::error::Error;
use crate::job::RobotArgs;
use crate::logs::{Table, canonical_names};
use crate::output::{self, Unfinished};
use crate::progress::{Going, Progress};

#[derive(Args, Clone, Debug)]
pub(super) struct SimulateArgs {
    #[command(flatten)]
    robot: RobotArgs,
    /// Folder for the logs, which is created; it must not exist yet, or be empty
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// Number of logs
    #[arg(long, default_value_t = 4)]
    files: u64,
    /// Length of each, s
    #[arg(long, default_value_t = 60.0)]
    seconds: f64,
    /// States a second
    #[arg(long, value_name = "HZ", default_value_t = 1000.0)]
    rate: f64,
    /// The seed of the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Noise of torques, as part of each joint's rms torque
    #[arg(long, value_name = "PART", default_value_t = 0.005)]
    noise: f64,
    /// Steps of the encoders in a turn (or 2π m); 0 for exact positions
    #[arg(long, value_name = "COUNT", default_value_t = 131_072)]
    encoder: u32,
    /// By how much the arm's masses may be other than the file's; they come with friction
    #[arg(long, value_name = "PART", default_value_t = 0.0)]
    vary: f64,
    /// Take up this mass, kg, in the middle of each log
    #[arg(long, value_name = "KG")]
    payload: Option<f64>,
    /// Collisions in each log
    #[arg(long, value_name = "COUNT", default_value_t = 0)]
    collisions: u32,
    /// Leave out velocities and accelerations: they are differentiated when the log is read
    #[arg(long)]
    encoders_only: bool,
    /// Compress logs by Zstandard instead of Snappy: smaller, and slower to read
    #[arg(long)]
    zstd: bool,
    /// The arm follows its trajectory exactly instead of under computed torque: fast
    #[arg(long, conflicts_with = "payload")]
    exact: bool,
    /// Show the progress even if standard error is not a terminal
    #[arg(long)]
    progress: bool,
}

struct Scene {
    args: SimulateArgs,
    truth: Robot,
    controller: Robot,
    trajectory: Trajectory,
    noise: Vec<f64>,
    /// Torques of the true arm, and a period of the trajectory, for `--exact`.
    exact: Arc<Loaded>,
    cycle: Vec<[Vec<f64>; 3]>,
}

pub(super) async fn run(args: SimulateArgs, going: &Going) -> Result<String, Error> {
    let is_noise = args.noise >= 0.0 && args.noise.is_finite();
    if args.files == 0 || args.seconds * args.rate < 1.0 || !is_noise {
        let why = "expected at least one file and one state, and a noise of 0 or more";
        return Err(Error::new(why));
    }
    let folder = args.output.clone();
    let entries = folder.read_dir();
    if entries.is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(Error::new("there is something in it already").at(folder.display()));
    }
    let robot = args.robot.load(false, going).await?;
    let progress = Arc::new(Progress::default());
    let states = (args.seconds * args.rate) as u64;
    progress.expect(states * args.files);
    let counted = progress.clone();
    let (shown, files) = (args.progress, args.files);
    let made = going.blocking(move |going| {
        let scene = Scene::new(args, robot)?;
        // Beside it, under another name, until all logs are there.
        let name = &scene.args.output;
        if name.is_dir() {
            std::fs::remove_dir(name).map_err(|why| Error::new(why).at(name.display()))?;
        }
        let part = Unfinished::beside(name)?;
        let path = part.path();
        std::fs::create_dir(path).map_err(|why| Error::new(why).at(path.display()))?;
        let mut said = String::new();
        for file in 0..files {
            said += &scene.record(path, file, &counted, going)?;
        }
        if scene.args.vary > 0.0 {
            output::write(&path.join("truth.toml"), &write(&scene.truth))?;
        }
        part.finish()?;
        Ok(said)
    });
    let said = progress.shown(shown, made).await?;
    let (folder, states) = (folder.display(), states * files);
    Ok(format!(
        "{said}{states} states in {files} logs in {folder}\n"
    ))
}

impl Scene {
    fn new(args: SimulateArgs, loaded: Arc<Loaded>) -> Result<Scene, Error> {
        let robot = loaded.robot();
        let model = Model::new(robot)?;
        let n = model.joints();
        let effort = Effort {
            starts: 8,
            descents: 1,
            steps: 10,
            seed: args.seed,
            ..Effort::default()
        };
        let (trajectory, _) = excite(&model, &vec![1.0; n], 8.0, &effort)?;
        let (count, period) = (800, 0.01);
        let states = Vec::from_iter((0..count).map(|s| trajectory.at(s as f64 * period)));
        let [.., tau] = computed(&loaded, states.iter())?;
        // A joint that holds nothing has some noise all the same.
        let torque = |torques: &[f64]| {
            let squares: f64 = torques.iter().map(|x| x * x).sum();
            libm::sqrt(squares / count as f64).max(1e-3)
        };
        let usual: Vec<f64> = tau.chunks_exact(count).map(torque).collect();
        let (mut truth, mut exact) = (robot.clone(), loaded.clone());
        if args.vary > 0.0 {
            truth = varied(robot, args.vary, &usual, &mut Random::new(args.seed))?;
            if args.exact {
                exact = Arc::new(Loaded::of(&truth)?);
            }
        }
        let cycle = match args.exact {
            true => ((trajectory.period * args.rate) as usize).max(1),
            false => 0,
        };
        let cycle = (0..cycle).map(|k| trajectory.at(k as f64 * (1.0 / args.rate)));
        Ok(Scene {
            cycle: cycle.collect(),
            noise: usual.iter().map(|torque| args.noise * torque).collect(),
            args,
            truth,
            controller: robot.clone(),
            trajectory,
            exact,
        })
    }

    fn recording(&self, file: u64) -> LogSettings {
        LogSettings {
            period: 1.0 / self.args.rate,
            states: (self.args.seconds * self.args.rate) as usize,
            noise: self.noise.clone(),
            resolution: match self.args.encoder {
                0 => 0.0,
                steps => 2.0 * core::f64::consts::PI / f64::from(steps),
            },
            seed: self.args.seed.wrapping_mul(1_000_003).wrapping_add(file),
        }
    }

    /// Draws contacts of 0.1 s that a joint feels as a hundred times its noise.
    fn collisions(&self, random: &mut Random) -> Vec<Collision> {
        let count = self.args.collisions;
        let collisions = (0..count).map(|k| {
            let part = (f64::from(k) + 0.5 + within(random, 0.2)) / f64::from(count);
            let joint = (random.unit() * self.noise.len() as f64) as usize;
            let joint = joint.min(self.noise.len() - 1);
            let mut torque = vec![0.0; self.noise.len()];
            let sign = if random.unit() < 0.5 { -1.0 } else { 1.0 };
            torque[joint] = sign * 100.0 * self.noise[joint].max(1e-3);
            Collision {
                start: part * self.args.seconds,
                duration: 0.1,
                torque,
            }
        });
        collisions.collect()
    }

    fn record(
        &self,
        folder: &Path,
        file: u64,
        progress: &Progress,
        going: &Going,
    ) -> Result<String, Error> {
        let name = format!("log{file:04}.parquet");
        let path = folder.join(&name);
        let recording = self.recording(file);
        let mut random = Random::new(recording.seed ^ 0x636f_6e74);
        let collisions = self.collisions(&mut random);
        let n = self.noise.len();
        let mut names = canonical_names(n);
        let mut written = vec![0, 1, 2, 3];
        if self.args.encoders_only {
            names.retain(|name| !name.starts_with("qd"));
            // Positions and torques.
            written = vec![0, 3];
        }
        let compression = match self.args.zstd {
            true => Compression::ZSTD(ZstdLevel::default()),
            false => Compression::SNAPPY,
        };
        let mut table = Table::compressed(&path, &names, false, compression)?;
        let log = match self.args.exact {
            true => None,
            false => Some(self.controlled(&recording, &collisions)?),
        };
        let mut random = Random::new(recording.seed);
        for first in (0..recording.states).step_by(BLOCK) {
            going.check()?;
            let last = recording.states.min(first + BLOCK);
            let time: Vec<f64> = (first..last).map(|k| k as f64 * recording.period).collect();
            let columns: [Vec<f64>; 4] = match &log {
                Some(log) => [&log.q, &log.qd, &log.qdd, &log.tau].map(|of| {
                    let entry = |i: usize| of[first..last].iter().map(move |x| x[i]);
                    (0..n).flat_map(entry).collect()
                }),
                None => self.followed(&recording, &collisions, first, &time, &mut random)?,
            };
            table.write("", &time, written.iter().map(|k: &usize| &columns[*k][..]))?;
            progress.add((last - first) as u64);
        }
        table.close()?;
        let mut said = String::new();
        if let Some(payload) = self.args.payload {
            let at = 0.5 * self.args.seconds;
            said += &format!("{name}: {payload} kg more from {at:.3} s on\n");
        }
        for one in &collisions {
            let joint = one.torque.iter().position(|x| *x != 0.0).unwrap_or(0);
            let (from, to) = (one.start, one.start + one.duration);
            let (joint, peak) = (joint + 1, number(one.torque[joint]));
            let when = format!("from {from:.3} to {to:.3} s");
            said += &format!("{name}: contact {when}, joint {joint}, {peak} N·m\n");
        }
        Ok(said)
    }

    fn controlled(&self, recording: &LogSettings, collisions: &[Collision]) -> Result<Log, Error> {
        let mut arms = vec![(0.0, self.truth.clone())];
        if let Some(payload) = self.args.payload {
            let mut loaded = self.truth.clone();
            if let Some(hand) = loaded.joints.last_mut() {
                hand.mass = &hand.mass + &rational(payload)?;
            }
            arms.push((0.5 * self.args.seconds, loaded));
        }
        let controlled = ControlledArm {
            arms,
            controller: self.controller.clone(),
            bandwidth: 20.0,
            collisions: collisions.to_vec(),
        };
        Ok(control(&controlled, &self.trajectory, recording)?)
    }

    fn followed(
        &self,
        recording: &LogSettings,
        collisions: &[Collision],
        first: usize,
        time: &[f64],
        random: &mut Random,
    ) -> Result<[Vec<f64>; 4], Error> {
        let (n, count) = (self.noise.len(), time.len());
        // A period of it is all that there is; only noise goes on.
        let states = (first..first + count).map(|s| &self.cycle[s % self.cycle.len()]);
        let [q, qd, qdd, mut tau] = computed(&self.exact, states)?;
        for (s, time) in time.iter().enumerate() {
            for i in 0..n {
                let torque = &mut tau[i * count + s];
                *torque += self.noise[i] * normal(random);
                for one in collisions {
                    *torque -= one.torque[i] * one.part(*time);
                }
            }
        }
        Ok([recording.read(&q), qd, qdd, tau])
    }
}

const BLOCK: usize = 8192;

/// Returns states in columns, with the robot's torques.
fn computed<'a>(
    robot: &Loaded,
    states: impl ExactSizeIterator<Item = &'a [Vec<f64>; 3]>,
) -> Result<[Vec<f64>; 4], Error> {
    let count = states.len();
    let mut columns = [(); 4].map(|()| vec![0.0; robot.joints() * count]);
    for (s, state) in states.enumerate() {
        for (to, from) in columns.iter_mut().zip(state) {
            for (i, value) in from.iter().enumerate() {
                to[i * count + s] = *value;
            }
        }
    }
    let [q, qd, qdd, tau] = &mut columns;
    robot.inverse_dynamics(States { count, q, qd, qdd }, tau)?;
    Ok(columns)
}

fn rational(value: f64) -> Result<Rational, Error> {
    let ratio = parse_decimal(&format!("{value:.6e}"));
    ratio.map_err(|_| Error::new(format!("{value} is not a number of a robot file")))
}

/// Bodies keep their shape. Coulomb friction is added, up to a tenth of each usual torque.
fn varied(robot: &Robot, part: f64, usual: &[f64], random: &mut Random) -> Result<Robot, Error> {
    let mut robot = robot.clone();
    for (joint, usual) in robot.joints.iter_mut().zip(usual) {
        let factor = rational(1.0 + within(random, part))?;
        joint.mass = &joint.mass * &factor;
        joint.inertia = joint.inertia.map(|x| x * &factor);
        joint.viscous = &joint.viscous + &rational(0.1 * usual * random.unit())?;
        joint.coulomb = &joint.coulomb + &rational(0.05 * usual * (1.0 + random.unit()))?;
        if joint.coulomb_width == Rational::default() {
            joint.coulomb_width = rational(0.01)?;
        }
    }
    Ok(robot)
}
