//! Laws of motion as references for measurements: in closed form, or integrated with small steps where there is none.
//! Lengths are px, y points down, times are s, angles rad, masses kg.

/// Returns the position in px of a body after `time` s that was thrown from `start` (px) at `velocity` (px/s). `gravity`
/// points down, in px/s². The drag force is `rate * mass` times the velocity; `rate` is in 1/s, >= 0.
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

/// State of a body thrown with drag, by the discrete law of the original engine (behaviour chapter 02). Each step applies the
/// drag of the old velocity first, then moves the position by the new velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteppedThrow {
    /// Position of the centre of mass in px, y down.
    pub position: [f64; 2],
    /// Velocity in px/s, y down.
    pub velocity: [f64; 2],
    /// Gravity in px/s², downwards.
    pub gravity: f64,
    /// Drag force divided by mass and velocity, in 1/s, >= 0.
    pub rate: f64,
}

impl SteppedThrow {
    /// Advances position and velocity by a step of `dt` s.
    pub fn step(&mut self, dt: f64) {
        let gravity = [0.0, self.gravity];
        for (axis, gravity) in gravity.into_iter().enumerate() {
            self.velocity[axis] += (gravity - self.rate * self.velocity[axis]) * dt;
            self.position[axis] += self.velocity[axis] * dt;
        }
    }
}

/// Returns the height in px of apex number `bounces` of a body that fell from `height` (px); `restitution` is 0..=1.
pub fn apex(height: f64, restitution: f64, bounces: i32) -> f64 {
    height * restitution.powi(2 * bounces)
}

/// Returns the distance in px that a body slides down an incline until it stops; infinite if it does not stop. `speed` in
/// px/s, `gravity` in px/s², `angle` in rad, `friction` coefficient.
pub fn stopping_distance(speed: f64, gravity: f64, angle: f64, friction: f64) -> f64 {
    let deceleration = gravity * (friction * angle.cos() - angle.sin());
    if deceleration > 0.0 { speed * speed / (2.0 * deceleration) } else { f64::INFINITY }
}

/// Returns the acceleration in px/s² down an incline of a body that rolls without slipping. `gravity` in px/s², `angle` in
/// rad, `mass` in kg, `radius` in px, `inertia` about the centre in kg px².
pub fn rolling_acceleration(gravity: f64, angle: f64, mass: f64, radius: f64, inertia: f64) -> f64 {
    gravity * angle.sin() / (1.0 + inertia / (mass * radius * radius))
}

/// A rigid regular polygon that rolls down a slope from corner to corner, and neither slips nor hops.
///
/// While the polygon turns about the corner on which it stands, its energy is constant. When the next corner lands, without
/// a bounce, the angular momentum about that corner is conserved and the ground absorbs the remaining energy. Only rolling
/// downhill is modelled; [`RollingPolygon::push`] shows whether a real polygon would hop or slip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingPolygon {
    /// Number of corners of the polygon.
    pub corners: u32,
    /// Distance from the centre to a corner, in px.
    pub radius: f64,
    /// Mass of the polygon in kg.
    pub mass: f64,
    /// Moment of inertia about the centre in kg px².
    pub inertia: f64,
    /// Gravity in px/s², downwards.
    pub gravity: f64,
    /// Inclination of the ground in rad, positive downhill in the direction of rolling.
    pub slope: f64,
    /// Position along the slope, positive downhill, of the corner on which the polygon stands, in px.
    pub foot: f64,
    /// Angle in rad from the normal of the slope to the line from the standing corner to the centre, positive downhill.
    pub lean: f64,
    /// Angular velocity in rad/s, positive downhill.
    pub rate: f64,
}

impl RollingPolygon {
    /// Returns the position of the centre along the slope, positive downhill, in px.
    pub fn way(&self) -> f64 {
        self.foot + self.radius * self.lean.sin()
    }

    /// Returns the sum of kinetic and potential energy in kg px²/s².
    pub fn energy(&self) -> f64 {
        let height = self.radius * self.lean.cos() * self.slope.cos() - self.way() * self.slope.sin();
        self.inertia_about_corner() * self.rate.powi(2) / 2.0 + self.mass * self.gravity * height
    }

    /// Returns the force of the ground on the standing corner in kg px/s²: component down the slope, and component along the
    /// normal away from the ground. The polygon hops if the normal component is not positive. It slips if the other one
    /// exceeds the friction coefficient times the normal component.
    pub fn push(&self) -> [f64; 2] {
        let (sine, cosine) = self.lean.sin_cos();
        let (turning, pulling) = (self.acceleration(), self.rate * self.rate);
        let acceleration = [turning * cosine - pulling * sine, -turning * sine - pulling * cosine];
        let gravity = [self.gravity * self.slope.sin(), -self.gravity * self.slope.cos()];
        [0, 1].map(|axis| self.mass * (self.radius * acceleration[axis] - gravity[axis]))
    }

    /// Advances the motion by `time` s.
    pub fn roll(&mut self, time: f64) {
        // Time step in s. The error of a turn is proportional to the square of the step: a millionth at this one.
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

    /// Returns the polygon after it has turned about the standing corner for `dt` s, by the leapfrog method.
    fn turned(mut self, dt: f64) -> Self {
        self.rate += self.acceleration() * dt / 2.0;
        self.lean += self.rate * dt;
        self.rate += self.acceleration() * dt / 2.0;
        self
    }

    /// Makes the next corner the standing one, and sets the angular velocity after that impact; `half` is half of the angle
    /// in rad between neighbouring corners.
    fn land(&mut self, half: f64) {
        let reach = self.mass * self.radius.powi(2);
        self.rate *= (self.inertia + reach * (2.0 * half).cos()) / self.inertia_about_corner();
        self.foot += 2.0 * self.radius * half.sin();
        self.lean -= 2.0 * half;
    }

    /// Returns the angular acceleration about the standing corner, in rad/s².
    fn acceleration(&self) -> f64 {
        self.mass * self.gravity * self.radius * (self.lean + self.slope).sin() / self.inertia_about_corner()
    }

    fn inertia_about_corner(&self) -> f64 {
        self.inertia + self.mass * self.radius.powi(2)
    }
}

/// Returns the period in s of a pendulum with amplitude `amplitude` in rad. `gravity` in px/s², `mass` in kg, `length` in px
/// from the pivot to the centre of mass, `inertia` about the centre of mass in kg px². Exact: the complete elliptic integral
/// by the arithmetic-geometric mean.
pub fn pendulum_period(gravity: f64, mass: f64, length: f64, inertia: f64, amplitude: f64) -> f64 {
    let rate = (mass * gravity * length / (inertia + mass * length * length)).sqrt();
    std::f64::consts::TAU / rate / arithmetic_geometric_mean(1.0, (amplitude / 2.0).cos())
}

fn arithmetic_geometric_mean(mut a: f64, mut b: f64) -> f64 {
    // Each round squares the relative distance of a and b: 40 rounds are more than enough.
    for _ in 0..40 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    a
}

/// Returns the velocities in px/s of two frictionless discs after a collision along `normal`, the unit vector from the first
/// to the second disc. Each disc is given by its velocity in px/s and its mass in kg.
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

/// Returns the unit vector from the moving to the resting disc at first touch; `reach` is the distance of the centres then,
/// in px. The moving disc travels along x and passes `offset` px above the resting one (y down, so the resting one has the
/// larger y).
pub fn normal_of_oblique_hit(offset: f64, reach: f64) -> [f64; 2] {
    let sine = offset / reach;
    [(1.0 - sine * sine).sqrt(), sine]
}
