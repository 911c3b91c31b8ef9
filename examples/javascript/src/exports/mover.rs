//! Characters that walk, jump and fall. They belong to a simulator, and have a number in it.

use farseer_core::math::Vector2;
use farseer_core::snapshot::SnapshotFormat;
use farseer_core::{BodyId, CharacterMover, MoverInput, MoverOptions, MoverReport, MoverState, MoverTouch};

use crate::boundary::{Answer, Failure, Outcome, exports, leave_bytes, leave_numbers, with_bytes};
use crate::fields::Fields;
use crate::world::{Engine, Simulator, World};

const STATE: SnapshotFormat = SnapshotFormat { magic: *b"MoverSt1", version: 1 };

/// Calls a function with a mover.
fn with_mover<T>(
    simulator: Simulator,
    number: usize,
    act: impl FnOnce(&mut CharacterMover) -> Outcome<T>,
) -> Outcome<T> {
    simulator.with(|world| act(mover_of(&mut world.movers, number)?))
}

fn mover_of(movers: &mut [Option<Box<CharacterMover>>], number: usize) -> Outcome<&mut CharacterMover> {
    let mover = movers.get_mut(number).and_then(Option::as_deref_mut);
    mover.ok_or_else(|| Failure::because(&"the mover was disposed"))
}

fn touch(touch: Option<MoverTouch>) -> Outcome<[f64; 5]> {
    let Some(MoverTouch { geom, point, normal, .. }) = touch else { return Ok([f64::NAN; 5]) };
    let [x, y, normal_x, normal_y] = [point.x, point.y, normal.x, normal.y].map(f64::from);
    Ok([geom.number()?, x, y, normal_x, normal_y])
}

/// Leaves a report: ground, left, right and ceiling in rows of five, then the body that crushes, whether it jumped and landed,
/// and the speed of landing. NaN stands for none.
fn leave_report(report: MoverReport) -> Outcome<f64> {
    let MoverReport { ground, left, right, ceiling, crushed_by, jumped, landed, landing_speed } = report;
    let mut numbers = Vec::with_capacity(24);
    for side in [ground, left, right, ceiling] {
        numbers.extend(touch(side)?);
    }
    numbers.push(crushed_by.map_or(Ok(f64::NAN), Answer::number)?);
    numbers.extend([f64::from(u8::from(jumped)), f64::from(u8::from(landed)), f64::from(landing_speed)]);
    Ok(leave_numbers(numbers))
}

exports! {
    /// A mover with the position, options and shape that were left as numbers; returns its number.
    fn mover_new(simulator: Simulator) {
        let mut fields = Fields::left();
        let position = fields.point("position")?;
        let mut options = MoverOptions::default();
        fields.mover_options(&mut options)?;
        let mover = CharacterMover::new(&fields.geom()?, position, options)?;
        simulator.with(|World { movers, .. }| {
            let free = movers.iter().position(Option::is_none).unwrap_or(movers.len());
            movers.resize_with(movers.len().max(free + 1), || None);
            movers[free] = Some(Box::new(mover));
            Ok(free as f64)
        })
    }

    /// Lets a mover go.
    fn mover_dispose(simulator: Simulator, mover: usize) {
        simulator.with(|world| {
            mover_of(&mut world.movers, mover)?;
            world.movers[mover] = None;
            Ok(())
        })
    }

    /// Overwrites the options that were left.
    fn mover_set_options(simulator: Simulator, mover: usize) {
        with_mover(simulator, mover, |mover| Fields::left().mover_options(&mut mover.options))
    }

    /// Moves it.
    fn mover_update(simulator: Simulator, mover: usize, x: f32, jump: bool, drop: bool, dt: f32) {
        simulator.with(|World { movers, engine, .. }| {
            let mover = mover_of(movers, mover)?;
            match engine {
                Engine::Plane(plane) => leave_report(mover.update(plane, MoverInput { x, jump, drop }, dt)?),
                #[cfg(feature = "depth")]
                Engine::Depth(_) => Err(Failure::because(&"a DepthSimulator has `walk` in its place")),
            }
        })
    }

    /// Its position.
    fn mover_position(simulator: Simulator, mover: usize) { with_mover(simulator, mover, |mover| Ok(mover.position())) }

    /// Puts it to a place.
    fn mover_set_position(simulator: Simulator, mover: usize, x: f32, y: f32) {
        with_mover(simulator, mover, |mover| Ok(mover.set_position(Vector2::new(x, y))?))
    }

    /// Its velocity.
    fn mover_velocity(simulator: Simulator, mover: usize) { with_mover(simulator, mover, |mover| Ok(mover.velocity())) }

    /// Throws it off the ground.
    fn mover_launch(simulator: Simulator, mover: usize, x: f32, y: f32) {
        with_mover(simulator, mover, |mover| Ok(mover.launch(Vector2::new(x, y))?))
    }

    /// Whether it stands.
    fn mover_is_grounded(simulator: Simulator, mover: usize) {
        with_mover(simulator, mover, |mover| Ok(mover.is_grounded()))
    }

    /// Gives it a body that follows it.
    fn mover_set_body(simulator: Simulator, mover: usize, body: BodyId) {
        with_mover(simulator, mover, |mover| { mover.set_body(Some(body)); Ok(()) })
    }

    /// Takes its body from it.
    fn mover_remove_body(simulator: Simulator, mover: usize) {
        with_mover(simulator, mover, |mover| { mover.set_body(None); Ok(()) })
    }

    /// Leaves its state as bytes.
    fn mover_state(simulator: Simulator, mover: usize) {
        with_mover(simulator, mover, |mover| Ok(leave_bytes(STATE.write(&mover.state()))))
    }

    /// Goes back to a state that was left as bytes.
    fn mover_set_state(simulator: Simulator, mover: usize) {
        let state: MoverState = with_bytes(|bytes| STATE.read(bytes))?;
        with_mover(simulator, mover, |mover| Ok(mover.set_state(state)?))
    }
}
