//! Springs.

use farseer_core::math::Vector2;
use farseer_core::{BodyId, Error, FixedLinearSpring, Objects, Result, Spring, SpringFactory, SpringId};

use crate::boundary::exports;
use crate::world::Simulator;

fn edit<T>(objects: &mut Objects, spring: SpringId, edit: impl FnOnce(&mut Spring) -> T) -> Result<T> {
    objects.spring_mut(spring).map(edit).ok_or(Error::StaleId { argument: "spring" })
}

exports! {
    /// Between points of two bodies, in their own frames.
    fn spring_linear(
        simulator: Simulator, body1: BodyId, x1: f32, y1: f32, body2: BodyId, x2: f32, y2: f32,
        spring_constant: f32, damping_constant: f32,
    ) {
        let (first, second) = (Vector2::new(x1, y1), Vector2::new(x2, y2));
        simulator.objects(|objects| SpringFactory::create_linear_spring_in(
            objects, body1, first, body2, second, spring_constant, damping_constant,
        ))
    }

    /// Between a point of a body, in its own frame, and one of the world.
    fn spring_fixed_linear(
        simulator: Simulator, body: BodyId, x: f32, y: f32, world_x: f32, world_y: f32,
        spring_constant: f32, damping_constant: f32,
    ) {
        let (on_body, in_world) = (Vector2::new(x, y), Vector2::new(world_x, world_y));
        simulator.objects(|objects| SpringFactory::create_fixed_linear_spring_in(
            objects, body, on_body, in_world, spring_constant, damping_constant,
        ))
    }

    /// Between the angles of two bodies.
    fn spring_angle(simulator: Simulator, body1: BodyId, body2: BodyId, spring_constant: f32, damping_constant: f32) {
        simulator.objects(|objects| {
            SpringFactory::create_angle_spring_in(objects, body1, body2, spring_constant, damping_constant)
        })
    }

    /// A spring of the angle of a body.
    fn spring_fixed_angle(simulator: Simulator, body: BodyId, spring_constant: f32, damping_constant: f32) {
        simulator.objects(|objects| {
            SpringFactory::create_fixed_angle_spring_in(objects, body, spring_constant, damping_constant)
        })
    }

    /// Ends its life with the next update.
    fn spring_dispose(simulator: Simulator, spring: SpringId) { simulator.objects(|objects| objects.dispose(spring)) }

    /// Whether it was disposed.
    fn spring_is_disposed(simulator: Simulator, spring: SpringId) {
        simulator.with(|world| Ok(world.engine.core().is_disposed(spring)))
    }

    /// Whether it is enabled.
    fn spring_enabled(simulator: Simulator, spring: SpringId) {
        simulator.objects(|objects| {
            objects.spring(spring).map(Spring::enabled).ok_or(Error::StaleId { argument: "spring" })
        })
    }

    /// Sets whether it is enabled.
    fn spring_set_enabled(simulator: Simulator, spring: SpringId, value: bool) {
        simulator.objects(|objects| edit(objects, spring, |spring| spring.set_enabled(value)))
    }

    /// The error beyond which it breaks.
    fn spring_set_breakpoint(simulator: Simulator, spring: SpringId, breakpoint: f32) {
        simulator.objects(|objects| edit(objects, spring, |spring| spring.set_breakpoint(breakpoint))?)
    }

    /// Its stiffness.
    fn spring_set_spring_constant(simulator: Simulator, spring: SpringId, spring_constant: f32) {
        simulator.objects(|objects| edit(objects, spring, |spring| spring.set_spring_constant(spring_constant))?)
    }

    /// Its damping.
    fn spring_set_damping_constant(simulator: Simulator, spring: SpringId, damping_constant: f32) {
        simulator.objects(|objects| edit(objects, spring, |spring| spring.set_damping_constant(damping_constant))?)
    }

    /// The point of the world to which a fixed linear spring pulls.
    fn spring_set_world_attach_point(simulator: Simulator, spring: SpringId, x: f32, y: f32) {
        simulator.objects(|objects| {
            objects.spring_as_mut::<FixedLinearSpring>(spring)?.set_world_attach_point(Vector2::new(x, y))
        })
    }
}
