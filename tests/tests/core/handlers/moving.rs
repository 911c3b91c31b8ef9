//! Bodies that a handler moves when they have moved.

use conformance::fixtures::plane::{add_box, both_sets, simulator_with, v};
use farseer_core::{BodyId, Context, Event, EventHandler};

/// Puts every moved body back to its position in every callback; stops after a while so that the test ends.
struct Holds {
    position: farseer_core::math::Vector2,
    calls: u32,
}

impl EventHandler for Holds {
    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        self.calls += 1;
        if self.calls < 100_000 {
            context.body_mut(body).unwrap().set_position(self.position);
        }
    }
}

/// In the original a setter inside the callback calls the callback again, until the stack is exhausted.
#[test]
fn a_body_moved_in_the_callback_about_its_movement_does_not_hang_the_update() {
    for methods in both_sets() {
        let mut simulator = simulator_with(100.0, methods);
        let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        let mut handler = Holds { position: v(5.0, 5.0), calls: 0 };
        simulator.update_with(0.01, &mut handler);
        assert!(handler.calls < 1000, "told {} times in one update", handler.calls);
        assert_eq!(simulator[body].position(), v(5.0, 5.0));
    }
}

#[test]
fn a_body_may_be_brought_back_in_the_callback_about_its_movement() {
    for methods in both_sets() {
        struct Wraps;
        impl EventHandler for Wraps {
            fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
                let body = context.body_mut(body).unwrap();
                if body.position().x > 10.0 {
                    body.set_position(v(-10.0, 0.0));
                }
            }
        }
        let mut simulator = simulator_with(0.0, methods);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(9.9, 0.0));
        simulator[body].set_linear_velocity(v(100.0, 0.0));
        simulator.update_with(0.01, &mut Wraps);
        assert_eq!(simulator[body].position(), v(-10.0, 0.0));
        assert_eq!(simulator.geom(geom).unwrap().position(), v(-10.0, 0.0));
        assert_eq!(
            simulator.events().iter().filter(|event| matches!(event, Event::BodyUpdated { .. })).count(),
            3
        );
    }
}
