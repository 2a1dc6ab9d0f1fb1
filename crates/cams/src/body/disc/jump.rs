//! The speed of a cam at which its follower first leaves it.

use super::Disc;
use crate::load::Pressing;
use camgen_kernel::numeric::root;
use camgen_kernel::profile::Worst;

/// By how much the speed grows from try to try while a damped follower still keeps on the cam.
const STEP: f64 = 1.25;
/// As many tries as reach a thousand times the speed of the undamped one.
const TRIES: u32 = 32;

impl Disc {
    /// Speed of the cam at which the follower first leaves it, rad/s, and where: infinite where it never does.
    ///
    /// Without damping m ω² s'' + k s + F0 is 0 first where −m s''/(k s + F0) = 1/ω² is largest. With damping the speed is the first at
    /// which the least force of the turn is 0.
    ///
    /// # Errors
    /// Why it is not known. `None` of a motion that is not a program, and where neither mass nor spring is given.
    pub fn jump(&self) -> Option<Result<Worst, String>> {
        let follower = &self.machine.follower;
        let pressed = follower.preload.is_some() || self.program_follower.spring.is_some();
        if !self.is_of_program()
            || self.is_closed()
            || (follower.mass.is_none() && self.program_follower.spring.is_none())
        {
            return None;
        }
        let inertia = if self.motion.quantity() == camgen_kernel::motion::Quantity::Angle { "inertia" } else { "mass" };
        let Some(mass) = follower.mass else { return Some(Err(format!("{}.{inertia} is not given", follower.path))) };
        if !pressed {
            return Some(Err("no preload and no [spring] press the follower on".into()));
        }
        let mass = self.curves().metal_side() * mass;
        let pressing = Pressing { mass, ..self.pressing().unwrap_or_default() };
        if !(pressing.constant > 0.0) {
            return Some(Err("nothing presses the follower on at its lowest position; give spring.preload".into()));
        }
        Some(Ok(*self.program_follower.jump.get_or_init(|| {
            let undamped = self.undamped_jump(&pressing);
            if pressing.damping == 0.0 { undamped } else { self.damped_jump(&pressing, undamped) }
        })))
    }

    fn undamped_jump(&self, pressing: &Pressing) -> Worst {
        let ratio = |piece: usize, angle: f64| {
            let lift = self.motion.jet(piece, angle);
            -pressing.mass * lift.dds / pressing.still(&lift)
        };
        let largest = self.largest_force(ratio);
        let speed = if largest.value > 0.0 { 1.0 / largest.value.sqrt() } else { f64::INFINITY };
        Worst { value: speed, ..largest }
    }

    fn damped_jump(&self, pressing: &Pressing, undamped: Worst) -> Worst {
        let least = |speed: f64| {
            let faster = pressing.at_speed(speed);
            let lifting = self.largest_force(|piece, angle| -faster.force_at(&self.motion.jet(piece, angle)));
            Worst { value: -lifting.value, ..lifting }
        };
        if undamped.value.is_infinite() {
            return undamped;
        }
        let (mut low, mut high) = (0.0, 0.1 * undamped.value);
        for _ in 0..TRIES {
            if !(least(high).value > 0.0) {
                let speed = root::bracketed(|speed| least(speed).value, low, high, 0.0).unwrap_or(high);
                return Worst { value: speed, ..least(speed) };
            }
            (low, high) = (high, STEP * high);
        }
        Worst { value: f64::INFINITY, ..undamped }
    }
}
