//! Functions that only the 2.5D engine has.

use farseer_core::{BodyId, GeomId, SecondaryMap};
use twohalf::{
    CharacterSettings, ContactTarget, DepthProfile, DepthScheme, DrawOrder, Drawable, MoveInput, Platform,
    PlatformId, PlatformMut, TwoHalfBody, TwoHalfPhysicsSimulator, Vector2, Vector3,
};
use twohalf_factories::{Ball, Figure, Prism, Spawned, Thing, spawn, spawn_lane};

use crate::boundary::{Answer, Outcome, exports, leave_numbers};
use crate::depth::Depth;
use crate::world::{Engine, Simulator, stale};

impl Simulator {
    fn body3d<T>(
        self,
        body: BodyId,
        look: impl FnOnce(TwoHalfBody<&TwoHalfPhysicsSimulator>) -> T,
    ) -> Outcome<T> {
        self.depth(|depth| match depth.simulator.body(body) {
            Some(body) => Ok(look(body)),
            None => Err(stale("body")),
        })
    }

    fn edit_body3d<T>(
        self,
        body: BodyId,
        edit: impl FnOnce(TwoHalfBody<&mut TwoHalfPhysicsSimulator>) -> T,
    ) -> Outcome<T> {
        self.depth(|depth| match depth.simulator.body_mut(body) {
            Some(body) => Ok(edit(body)),
            None => Err(stale("body")),
        })
    }

    fn spawn(self, thing: Thing) -> Outcome<f64> {
        let Spawned { body, geom } = self.depth(|depth| Ok(spawn(&mut depth.simulator, thing)?))?;
        Ok(leave_numbers([body.number()?, geom.number()?]))
    }

    fn edit_platform<T>(
        self,
        platform: PlatformId,
        edit: impl FnOnce(PlatformMut<'_>) -> twohalf::Result<T>,
    ) -> Outcome<T> {
        self.depth(|depth| match depth.simulator.platform_mut(platform) {
            Some(platform) => Ok(edit(platform)?),
            None => Err(stale("platform")),
        })
    }
}

fn drawable(drawable: Drawable) -> Outcome<[f64; 2]> {
    Ok(match drawable {
        Drawable::Body(body) => [0.0, body.number()?],
        Drawable::Platform(platform) => [1.0, platform.number()?],
    })
}

exports! {
    /// A 2.5D simulator; returns its number.
    fn depth_new(height: i32, angle: i32, gravity_x: f32, gravity_y: f32) {
        let gravity = Vector2::new(gravity_x, gravity_y);
        let simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(height, angle, gravity)?;
        let (walkers, order) = (SecondaryMap::new(), DrawOrder::default());
        Ok(Simulator::keep(Engine::Depth(Box::new(Depth { simulator, walkers, order }))))
    }

    /// Chooses the faithful set of methods.
    fn depth_set_faithful(simulator: Simulator) {
        simulator.depth(|depth| Ok(depth.simulator.set_depth_scheme(DepthScheme::Faithful)?))
    }

    /// Makes a box: leaves body and geom.
    fn depth_spawn_prism(
        simulator: Simulator, width: f32, height: f32, depth: f32, mass: f32, friction: f32, restitution: f32,
        is_upright: bool, x: f32, y: f32, z: f32,
    ) {
        let thing = Prism::new([width, height, depth]).mass(mass).friction(friction).restitution(restitution);
        simulator.spawn(if is_upright { thing.upright() } else { thing }.at([x, y, z]))
    }

    /// Makes a ball: leaves body and geom.
    fn depth_spawn_ball(
        simulator: Simulator, radius: f32, mass: f32, friction: f32, restitution: f32, x: f32, y: f32, z: f32,
    ) {
        let thing = Ball::new(radius).mass(mass).friction(friction).restitution(restitution);
        simulator.spawn(thing.at([x, y, z]))
    }

    /// Makes a figure that can walk: leaves body and geom.
    fn depth_spawn_figure(
        simulator: Simulator, width: f32, height: f32, depth: f32, mass: f32, x: f32, y: f32, z: f32,
    ) {
        simulator.spawn(Figure::new([width, height, depth]).mass(mass).at([x, y, z]))
    }

    /// Makes the four walls around a lane; leaves the platforms.
    fn depth_spawn_lane(simulator: Simulator, x0: f32, x1: f32, z0: f32, z1: f32, height: f32) {
        let walls = simulator.depth(|depth| Ok(spawn_lane(&mut depth.simulator, [x0, x1], [z0, z1], height)?))?;
        let numbers: Vec<f64> = walls.into_iter().map(Answer::number).collect::<Outcome<_>>()?;
        Ok(leave_numbers(numbers))
    }

    /// Gives a geom the depth of a prism.
    fn depth_set_prism(simulator: Simulator, geom: GeomId, depth: f32) {
        let profile = DepthProfile::Prism { depth };
        simulator.depth(|depth| Ok(depth.simulator.set_depth_profile(geom, profile)?))
    }

    /// Makes a geom a ball.
    fn depth_set_round(simulator: Simulator, geom: GeomId, radius: f32) {
        let profile = DepthProfile::Round { radius };
        simulator.depth(|depth| Ok(depth.simulator.set_depth_profile(geom, profile)?))
    }

    /// Lets a body lie on the ground with one of its geoms.
    fn depth_set_object_geom(simulator: Simulator, body: BodyId, geom: GeomId) {
        Ok(simulator.edit_body3d(body, |mut body| body.ground_mut().set_object_geom(geom, None))??)
    }

    /// Sets friction and bounciness of a body's ground.
    fn depth_set_ground(simulator: Simulator, body: BodyId, friction: f32, restitution: f32) {
        simulator.edit_body3d(body, |mut body| {
            let mut ground = body.ground_mut();
            ground.set_friction_coefficient(friction);
            ground.set_restitution_coefficient(restitution);
        })
    }

    /// Where a body is: x, y up, z.
    fn depth_position3d(simulator: Simulator, body: BodyId) { simulator.body3d(body, |body| body.position3d()) }

    /// Sets its position.
    fn depth_set_position3d(simulator: Simulator, body: BodyId, x: f32, y: f32, z: f32) {
        simulator.edit_body3d(body, |mut body| body.set_position3d(Vector3::new(x, y, z)))
    }

    /// Its velocity, y up.
    fn depth_velocity3d(simulator: Simulator, body: BodyId) { simulator.body3d(body, |body| body.velocity3d()) }

    /// Sets its velocity.
    fn depth_set_velocity3d(simulator: Simulator, body: BodyId, x: f32, y: f32, z: f32) {
        simulator.edit_body3d(body, |mut body| body.set_velocity3d(Vector3::new(x, y, z)))
    }

    /// A force, y up.
    fn depth_apply_force3d(simulator: Simulator, body: BodyId, x: f32, y: f32, z: f32) {
        simulator.edit_body3d(body, |mut body| body.apply_force3d(Vector3::new(x, y, z)))
    }

    /// An impulse, y up.
    fn depth_apply_impulse3d(simulator: Simulator, body: BodyId, x: f32, y: f32, z: f32) {
        simulator.edit_body3d(body, |mut body| body.apply_impulse3d(Vector3::new(x, y, z)))
    }

    /// Moves a kinematic body to a position in the next update.
    fn depth_move_to3d(simulator: Simulator, body: BodyId, x: f32, y: f32, z: f32) {
        Ok(simulator.edit_body3d(body, |mut body| body.move_to3d(Vector3::new(x, y, z)))??)
    }

    /// Whether it lies or stands on a support.
    fn depth_is_grounded(simulator: Simulator, body: BodyId) { simulator.body3d(body, |body| body.is_grounded()) }

    /// Where its origin appears on the screen.
    fn depth_screen_position(simulator: Simulator, body: BodyId) { simulator.body3d(body, |body| body.position()) }

    /// Lets a body walk; before each step of the same length.
    fn depth_walk(simulator: Simulator, body: BodyId, x: f32, z: f32, jump: bool, dt: f32) {
        simulator.depth(|depth| {
            let mut walker = depth.walker(body);
            depth.simulator.walk(body, &mut walker, MoveInput { x, z, jump }, dt)?;
            depth.walkers.insert(body, walker);
            Ok(walker.is_grounded())
        })
    }

    /// How a body walks.
    fn depth_set_walk(
        simulator: Simulator, body: BodyId, acceleration: f32, air_acceleration: f32, jump_height: f32,
        step_up: f32, snap: f32, max_slope: f32, coyote_time: f32, ledge_reach: f32, climb_speed: f32,
    ) {
        let walk = CharacterSettings {
            acceleration, air_acceleration, jump_height, step_up, snap, max_slope, coyote_time, ledge_reach, climb_speed,
        };
        simulator.body3d(body, |_| ())?;
        simulator.depth(|depth| {
            let mut walker = depth.walker(body);
            walker.walk = walk;
            depth.walkers.insert(body, walker);
            Ok(())
        })
    }

    /// How a body walks: leaves the nine numbers.
    fn depth_walk_settings(simulator: Simulator, body: BodyId) {
        simulator.depth(|depth| {
            let walk = depth.walker(body).walk;
            let CharacterSettings { acceleration, air_acceleration, jump_height, step_up, snap, .. } = walk;
            let CharacterSettings { max_slope, coyote_time, ledge_reach, climb_speed, .. } = walk;
            let first = [acceleration, air_acceleration, jump_height, step_up, snap];
            let last = [max_slope, coyote_time, ledge_reach, climb_speed];
            Ok(leave_numbers(first.into_iter().chain(last).map(f64::from)))
        })
    }

    /// Lets a figure fall without walking any more.
    fn depth_let_go(simulator: Simulator, body: BodyId) {
        simulator.depth(|depth| {
            let mut walker = depth.walker(body);
            depth.simulator.let_go(body, &mut walker)?;
            depth.walkers.insert(body, walker);
            Ok(())
        })
    }

    /// A platform.
    fn platform_new(
        simulator: Simulator, width: f32, height: f32, depth: f32, x: f32, y: f32, z: f32, rotation: f32,
    ) {
        let position3d = Vector3::new(x, y, z);
        simulator.depth(|of| {
            Ok(Platform::with_rotation(&mut of.simulator, width, height, depth, position3d, rotation, None)?)
        })
    }

    /// Takes it away.
    fn platform_remove(simulator: Simulator, platform: PlatformId) {
        simulator.doubt()?;
        simulator.depth(|depth| Ok(depth.simulator.remove_platform(platform)?))
    }

    /// Whether it was taken away.
    fn platform_is_removed(simulator: Simulator, platform: PlatformId) {
        simulator.depth(|depth| Ok(depth.simulator.platform(platform).is_none()))
    }

    /// Where it is.
    fn platform_position3d(simulator: Simulator, platform: PlatformId) {
        simulator.depth(|depth| Ok(depth.simulator.platform(platform).ok_or_else(|| stale("platform"))?.position3d()))
    }

    /// Leaves where its eight corners appear on the screen, those of the front first.
    fn platform_screen_corners(simulator: Simulator, platform: PlatformId) {
        simulator.depth(|depth| {
            let projection = depth.simulator.projection();
            let corners = depth.simulator.platform(platform).ok_or_else(|| stale("platform"))?.corners();
            let points = corners.into_iter().map(|corner| projection.to_screen(corner));
            Ok(leave_numbers(points.flat_map(|point| [point.x, point.y]).map(f64::from)))
        })
    }

    /// Sets its position.
    fn platform_set_position3d(simulator: Simulator, platform: PlatformId, x: f32, y: f32, z: f32) {
        simulator.edit_platform(platform, |mut platform| platform.set_position3d(Vector3::new(x, y, z)))
    }

    /// Lets it move.
    fn platform_set_velocity(simulator: Simulator, platform: PlatformId, x: f32, y: f32, z: f32) {
        simulator.edit_platform(platform, |mut platform| platform.set_velocity(Vector3::new(x, y, z)))
    }

    /// Moves it to a position in the next update.
    fn platform_move_to(simulator: Simulator, platform: PlatformId, x: f32, y: f32, z: f32) {
        simulator.edit_platform(platform, |mut platform| platform.move_to(Vector3::new(x, y, z)))
    }

    /// Makes it a belt.
    fn platform_set_surface_speed(simulator: Simulator, platform: PlatformId, along: f32, depth: f32) {
        simulator.edit_platform(platform, |mut platform| platform.set_surface_speed(along, depth))
    }

    /// Opens it from below and from its sides.
    fn platform_set_one_way(simulator: Simulator, platform: PlatformId, value: bool) {
        simulator.edit_platform(platform, |mut platform| platform.set_one_way(value))
    }

    /// Sets its friction and bounciness.
    fn platform_set_surface(simulator: Simulator, platform: PlatformId, friction: f32, restitution: f32) {
        simulator.edit_platform(platform, |mut platform| {
            platform.set_friction_coefficient(friction);
            platform.set_restitution_coefficient(restitution);
            Ok(())
        })
    }

    /// Where a point of the world appears on the screen.
    fn depth_to_screen(simulator: Simulator, x: f32, y: f32, z: f32) {
        simulator.depth(|depth| Ok(depth.simulator.projection().to_screen(Vector3::new(x, y, z))))
    }

    /// The point of the ground that appears at a point of the screen.
    fn depth_screen_to_ground(simulator: Simulator, x: f32, y: f32) {
        simulator.depth(|depth| Ok(depth.simulator.screen_to_ground(Vector2::new(x, y))))
    }

    /// Leaves the drawables, from back to front: body 0 or platform 1, and its id.
    fn depth_draw_order(simulator: Simulator) {
        simulator.depth(|depth| {
            let order = depth.order.sort(&depth.simulator);
            let rows: Vec<[f64; 2]> = order.iter().map(|&item| drawable(item)).collect::<Outcome<_>>()?;
            Ok(leave_numbers(rows.into_iter().flatten()))
        })
    }

    /// Leaves the front drawable at a point of the screen: body 0 or platform 1, and its id; no numbers if there is none.
    fn depth_pick_front(simulator: Simulator, x: f32, y: f32) {
        simulator.depth(|depth| {
            let front = depth.simulator.pick_front(Vector2::new(x, y)).map(drawable).transpose()?;
            Ok(leave_numbers(front.into_iter().flatten()))
        })
    }

    /// Leaves the height of the surface beneath a body.
    fn depth_height_beneath(simulator: Simulator, body: BodyId) {
        simulator.body3d(body, |_| ())?;
        simulator.depth(|depth| {
            let surface = depth.simulator.surface_beneath_body(body);
            Ok(leave_numbers(surface.map(|surface| f64::from(surface.height))))
        })
    }

    /// Leaves the first hit of a ray: kind of partner, partner, point, normal and fraction; no numbers if there is none.
    fn depth_ray_cast3d(
        simulator: Simulator, start_x: f32, start_y: f32, start_z: f32, end_x: f32, end_y: f32, end_z: f32,
    ) {
        let (start, end) = (Vector3::new(start_x, start_y, start_z), Vector3::new(end_x, end_y, end_z));
        simulator.depth(|depth| {
            let Some(hit) = depth.simulator.ray_cast3d(start, end, |_| true) else { return Ok(leave_numbers([])) };
            let partner = match hit.partner {
                ContactTarget::Geom(geom) => [0.0, geom.number()?],
                ContactTarget::Platform(platform) => [1.0, platform.number()?],
                ContactTarget::Ground => [2.0, 0.0],
            };
            let place = hit.point.iter().chain(hit.normal.iter()).copied().chain([hit.fraction]);
            Ok(leave_numbers(partner.into_iter().chain(place.map(f64::from))))
        })
    }
}
