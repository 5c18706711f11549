//! Where the links are and how the hand moves with the joints, in base axes: those that
//! gravity is given in.

use crate::dynamics::{Products, State, Vector, sum, way, ways};
use crate::fault::Fault;
use crate::number::{Number, Work};
use crate::robot::Step;
use crate::scene::Setting;

/// A frame: its axes x, y, z, and its origin, m.
#[derive(Clone, Debug)]
pub struct Pose<N>([[N; 3]; 4]);

impl<N: Number> Pose<N> {
    /// Returns [R | p], row by row.
    pub fn rows(&self) -> Vec<N> {
        let row = |r: usize| self.0.iter().map(move |column| column[r].clone());
        (0..3).flat_map(row).collect()
    }
}

/// The ways from base axes to the frames of an arm at a state.
pub struct Arm<'a, N> {
    setting: &'a Setting,
    /// To the frame of each joint, moved.
    joints: Vec<Vec<Step<N>>>,
}

impl<'a, N: Number> Arm<'a, N> {
    /// Returns the arm at a state.
    ///
    /// # Errors
    /// As of [`Number::times`].
    pub fn new(
        setting: &'a Setting,
        states: &[State<N>],
        work: &mut Work,
    ) -> Result<Arm<'a, N>, Fault> {
        let (mut all, mut joints) = (way(&setting.base), Vec::new());
        for way in ways(setting, states, work)? {
            all.extend(way);
            joints.push(all.clone());
        }
        Ok(Arm { setting, joints })
    }

    /// Returns the way to a frame to which another leads from that of a joint.
    fn steps(&self, joint: usize, behind: &[&[Step]]) -> Vec<Step<N>> {
        let mut steps = self.joints[joint].clone();
        steps.extend(way(&behind.concat()));
        steps
    }

    /// Returns the pose of a frame to which a way leads from that of a joint.
    fn pose(&self, joint: usize, behind: &[&[Step]], work: &mut Work) -> Result<Pose<N>, Fault> {
        let steps = self.steps(joint, behind);
        let (mut pose, products) = (Pose(Default::default()), &mut Products(work));
        for axis in 0..3 {
            let mut unit = Vector::default();
            unit[axis] = N::one();
            pose.0[axis] = products.outward(&unit, &steps, false)?;
        }
        pose.0[3] = products.outward(&Vector::default(), &steps, true)?;
        Ok(pose)
    }

    /// Returns the pose of a link's own frame.
    ///
    /// # Errors
    /// As of [`Number::times`].
    pub fn link(&self, joint: usize, work: &mut Work) -> Result<Pose<N>, Fault> {
        let own = &self.setting.joints[joint];
        self.pose(joint, &[&own.behind, &own.frame], work)
    }

    /// Returns the pose of the hand: of the tool, else of the last row's frame.
    ///
    /// # Errors
    /// As of [`Number::times`].
    pub fn hand(&self, work: &mut Work) -> Result<Pose<N>, Fault> {
        let last = self.joints.len() - 1;
        let behind = &self.setting.joints[last].behind;
        self.pose(last, &[behind, &self.setting.tool], work)
    }

    /// Returns J of the hand by its columns, linear over angular velocity.
    ///
    /// # Errors
    /// As of [`Number::times`].
    pub fn jacobian(&self, work: &mut Work) -> Result<Vec<[N; 6]>, Fault> {
        let Pose([.., hand]) = self.hand(work)?;
        let mut columns = Vec::new();
        for (joint, own) in self.setting.joints.iter().enumerate() {
            let Pose([_, _, axis, origin]) = self.pose(joint, &[], work)?;
            let [x, y, z] = origin.map(|x| x.negated());
            let across = Products(work).cross(&axis, &sum(&hand, &[x, y, z]))?;
            let (linear, angular) = match own.turns {
                true => (across, axis),
                false => (axis, Vector::default()),
            };
            let ([a, b, c], [d, e, f]) = (linear, angular);
            columns.push([a, b, c, d, e, f]);
        }
        Ok(columns)
    }

    /// Returns U = −Σ m g·r, J, with r from the origin of base axes.
    ///
    /// # Errors
    /// As of [`Number::times`].
    pub fn potential_energy(&self, work: &mut Work) -> Result<N, Fault> {
        let gravity = self.setting.gravity.map(|g| N::constant(g).negated());
        let mut energy = N::default();
        for (joint, own) in self.setting.joints.iter().enumerate() {
            for body in &own.bodies {
                let steps = self.steps(joint, &[&own.behind, &body.frame]);
                let (com, products) = (body.com.map(N::constant), &mut Products(work));
                let com = products.outward(&com, &steps, true)?;
                let height = products.dot(&gravity, &com)?;
                energy = energy.plus(&N::constant(body.mass).times(&height, products.0)?);
            }
        }
        Ok(energy)
    }
}
