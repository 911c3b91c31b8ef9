//! What happens by law: in closed form, or integrated finely where there is none. Lengths px, y down, times s, angles
//! rad, masses kg.

/// Place of a body thrown from `start` at `velocity` under `gravity` (px/s², down), after a time. Its drag is a
/// force of `rate * mass` times the velocity; the rate is per s.
pub fn thrown(start: [f64; 2], velocity: [f64; 2], gravity: f64, rate: f64, time: f64) -> [f64; 2] {
    if rate == 0.0 {
        return [start[0] + velocity[0] * time, start[1] + velocity[1] * time + gravity * time * time / 2.0];
    }
    let final_velocity = [0.0, gravity / rate];
    let decayed = -(-rate * time).exp_m1() / rate;
    std::array::from_fn(|axis| {
        start[axis] + final_velocity[axis] * time + (velocity[axis] - final_velocity[axis]) * decayed
    })
}

/// The same throw by the discrete law of the original (behaviour chapter 02): the drag of the old velocity
/// first, then the place by the new velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteppedThrow {
    /// Place in px.
    pub position: [f64; 2],
    /// In px/s.
    pub velocity: [f64; 2],
    /// In px/s², down.
    pub gravity: f64,
    /// Drag per mass and velocity, per s.
    pub rate: f64,
}

impl SteppedThrow {
    /// Moves by a step in s.
    pub fn step(&mut self, dt: f64) {
        let gravity = [0.0, self.gravity];
        for (axis, gravity) in gravity.into_iter().enumerate() {
            self.velocity[axis] += (gravity - self.rate * self.velocity[axis]) * dt;
            self.position[axis] += self.velocity[axis] * dt;
        }
    }
}

/// Height of the `bounces`-th apex of what fell from `height` and bounces with a restitution.
pub fn apex(height: f64, restitution: f64, bounces: i32) -> f64 {
    height * restitution.powi(2 * bounces)
}

/// How far something slides down an incline until it stops; infinite where it does not.
pub fn stopping_distance(speed: f64, gravity: f64, angle: f64, friction: f64) -> f64 {
    let deceleration = gravity * (friction * angle.cos() - angle.sin());
    if deceleration > 0.0 { speed * speed / (2.0 * deceleration) } else { f64::INFINITY }
}

/// Acceleration down an incline of what rolls without slipping.
pub fn rolling_acceleration(gravity: f64, angle: f64, mass: f64, radius: f64, inertia: f64) -> f64 {
    gravity * angle.sin() / (1.0 + inertia / (mass * radius * radius))
}

/// A rigid regular polygon that rolls down a slope from corner to corner, and neither slips nor hops. While it turns
/// about the corner it stands on, it keeps its energy. When the next corner lands, without a bounce, the ground takes
/// the part of the motion that cannot go on about that corner: angular momentum about it stays. It knows only the way
/// down; [`RollingPolygon::push`] says whether it would hop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingPolygon {
    /// How many corners it has.
    pub corners: u32,
    /// From the centre to a corner, in px.
    pub radius: f64,
    /// In kg.
    pub mass: f64,
    /// About the centre, in kg px².
    pub inertia: f64,
    /// In px/s².
    pub gravity: f64,
    /// Of the ground, down in the way it rolls, in rad.
    pub slope: f64,
    /// Where the corner it stands on is, down the slope, in px.
    pub foot: f64,
    /// How far the centre has turned ahead of that corner, from the normal of the slope, in rad.
    pub lean: f64,
    /// In rad/s, ahead.
    pub rate: f64,
}

impl RollingPolygon {
    /// How far down the slope the centre is, in px.
    pub fn way(&self) -> f64 {
        self.foot + self.radius * self.lean.sin()
    }

    /// Kinetic energy and that of height, in kg px²/s².
    pub fn energy(&self) -> f64 {
        let height = self.radius * self.lean.cos() * self.slope.cos() - self.way() * self.slope.sin();
        self.inertia_about_corner() * self.rate.powi(2) / 2.0 + self.mass * self.gravity * height
    }

    /// The force of the ground on the corner, in kg px/s²: down the slope, and away from the ground. It hops when the
    /// second is not positive, and slips when the first is larger than friction gives of the second.
    pub fn push(&self) -> [f64; 2] {
        let (sine, cosine) = self.lean.sin_cos();
        let (turning, pulling) = (self.acceleration(), self.rate * self.rate);
        let acceleration = [turning * cosine - pulling * sine, -turning * sine - pulling * cosine];
        let gravity = [self.gravity * self.slope.sin(), -self.gravity * self.slope.cos()];
        [0, 1].map(|axis| self.mass * (self.radius * acceleration[axis] - gravity[axis]))
    }

    /// Rolls on for a time in s.
    pub fn roll(&mut self, time: f64) {
        // The error of a turn goes with the square of the step: a millionth at this one.
        const STEP: f64 = 1e-4;
        let steps = (time / STEP).ceil();
        (0..steps as u64).for_each(|_| self.step(time / steps));
    }

    fn step(&mut self, dt: f64) {
        let half = std::f64::consts::PI / f64::from(self.corners);
        let ahead = self.turned(dt);
        if ahead.lean < half {
            *self = ahead;
            return;
        }
        let share = (half - self.lean) / (ahead.lean - self.lean);
        *self = self.turned(share * dt);
        self.land(half);
        *self = self.turned((1.0 - share) * dt);
    }

    /// Turned about the corner, by the leapfrog method.
    fn turned(mut self, dt: f64) -> Self {
        self.rate += self.acceleration() * dt / 2.0;
        self.lean += self.rate * dt;
        self.rate += self.acceleration() * dt / 2.0;
        self
    }

    /// The next corner becomes that on which it stands.
    fn land(&mut self, half: f64) {
        let reach = self.mass * self.radius.powi(2);
        self.rate *= (self.inertia + reach * (2.0 * half).cos()) / self.inertia_about_corner();
        self.foot += 2.0 * self.radius * half.sin();
        self.lean -= 2.0 * half;
    }

    /// Of the turn, in rad/s².
    fn acceleration(&self) -> f64 {
        self.mass * self.gravity * self.radius * (self.lean + self.slope).sin() / self.inertia_about_corner()
    }

    fn inertia_about_corner(&self) -> f64 {
        self.inertia + self.mass * self.radius.powi(2)
    }
}

/// Period of a pendulum that swings out to `amplitude`; its inertia is that about the centre of mass, which is
/// `length` from the pivot. Exact: the complete elliptic integral by the arithmetic-geometric mean.
pub fn pendulum_period(gravity: f64, mass: f64, length: f64, inertia: f64, amplitude: f64) -> f64 {
    let rate = (mass * gravity * length / (inertia + mass * length * length)).sqrt();
    std::f64::consts::TAU / rate / arithmetic_geometric_mean(1.0, (amplitude / 2.0).cos())
}

fn arithmetic_geometric_mean(mut a: f64, mut b: f64) -> f64 {
    // The distance is squared in every round: so many are more than enough.
    for _ in 0..40 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    a
}

/// Velocities of two discs without friction after a hit along the unit vector from the first to the second.
pub fn after_hit(
    (velocity_a, mass_a): ([f64; 2], f64),
    (velocity_b, mass_b): ([f64; 2], f64),
    restitution: f64,
    normal: [f64; 2],
) -> [[f64; 2]; 2] {
    let approach: f64 = (0..2).map(|axis| (velocity_a[axis] - velocity_b[axis]) * normal[axis]).sum();
    let impulse = (1.0 + restitution) * approach / (1.0 / mass_a + 1.0 / mass_b);
    let change = |velocity: [f64; 2], factor: f64| {
        std::array::from_fn(|axis| velocity[axis] + factor * impulse * normal[axis])
    };
    [change(velocity_a, -1.0 / mass_a), change(velocity_b, 1.0 / mass_b)]
}

/// Unit vector from a disc moving along x at first, whose path passes a resting one at a distance `offset`
/// above it (y down: the resting one has the larger y), when they touch at a distance `reach` of the centres.
pub fn normal_of_oblique_hit(offset: f64, reach: f64) -> [f64; 2] {
    let sine = offset / reach;
    [(1.0 - sine * sine).sqrt(), sine]
}
