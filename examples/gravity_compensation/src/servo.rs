//! A servo: its ticks, its sign, and what it makes of a command.

/// A joint's servo. All of it but the kind of servo is measured once on the arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    /// Ticks of a turn.
    pub ticks: f32,
    /// The tick at which the robot file's angle is zero.
    pub zero: f32,
    /// 1 where more ticks are a larger angle, −1 where they are a smaller one.
    pub sign: f32,
    /// Units of the command for 1 N·m.
    pub units_per_torque: f32,
    /// Units of the command for 1 rad/s: what the turning motor's own voltage takes of a duty;
    /// zero where the servo controls the current.
    pub units_per_speed: f32,
    /// The torque that its gears take, N·m.
    pub friction: f32,
    /// No more than this, N·m.
    pub most: f32,
}

/// A turn, rad.
const TURN: f32 = core::f32::consts::TAU;

impl Servo {
    /// Returns the angle of a tick, rad.
    pub fn angle(&self, tick: u16) -> f32 {
        self.sign * (f32::from(tick) - self.zero) * (TURN / self.ticks)
    }

    /// Returns the command for a torque at a speed, N·m and rad/s.
    pub fn command(&self, torque: f32, speed: f32) -> i16 {
        let torque = torque.clamp(-self.most, self.most);
        let units = torque * self.units_per_torque + speed * self.units_per_speed;
        // To the nearest unit; what is no number becomes zero.
        let half = if units < 0.0 { -0.5 } else { 0.5 };
        (self.sign * (units + half)) as i16
    }
}
