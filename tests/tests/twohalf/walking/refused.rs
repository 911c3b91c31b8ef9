//! Partners that a handler refuses hold a walking figure neither up nor back.

use super::*;
use conformance::fixtures::depth::geom_of;
use twohalf::{Collision, Context, Event, EventHandler};

/// Refuses contacts by a function of the position of the figure and of its contact.
struct Refusing<F>(BodyId, F);

impl<F: FnMut(Vector3, ContactTarget) -> bool> EventHandler for Refusing<F> {
    fn on_collision(&mut self, context: &mut Context<'_>, collision: &Collision) -> bool {
        let place = context.body(self.0).unwrap().position3d();
        !(self.1)(place, collision.partner)
    }
}

impl Stage {
    /// Walks for some seconds with a handler that refuses this, and checks each step.
    fn walk_refused(
        &mut self,
        wish: MoveInput,
        seconds: f32,
        mut refuses: impl FnMut(Vector3, ContactTarget) -> bool,
        mut look: impl FnMut(&mut Self),
    ) {
        for _ in 0..(seconds / self.dt).round() as usize {
            self.simulator.walk(self.figure, &mut self.walker, wish, self.dt).unwrap();
            self.simulator.update_with(self.dt, &mut Refusing(self.figure, &mut refuses));
            look(self);
        }
    }
}

/// Whether the middle of a figure is over a hole.
fn is_over_hole(place: Vector3) -> bool {
    place.x > 100.0 && place.x < 400.0
}

fn in_all_shapes(test: impl Fn()) {
    for shape in [None, Some(CYLINDER), Some(CAPSULE)] {
        SHAPE.set(shape);
        test();
    }
    SHAPE.set(None);
}

/// It falls freely from the edge on: with v = 150 px/s and g = 900 px/s² it is 0.5 g t² lower after t.
#[test]
fn over_ground_that_is_refused_it_falls_as_any_body() {
    in_all_shapes(|| {
        for rate in RATES {
            let mut stage = Stage::new(rate, [0.0, 0.0, 0.0]);
            let mut since = 0.0;
            stage.walk_refused(
                RIGHT,
                1.8,
                |place, partner| partner == ContactTarget::Ground && is_over_hole(place),
                |stage| {
                    let is_over = is_over_hole(stage.at());
                    since += if is_over { stage.dt } else { 0.0 };
                    // The handler returns in the update after, and gravity acts from the next one on.
                    let late = (since - 3.0 * stage.dt).max(0.0);
                    assert!(
                        stage.soles() < 0.3 - 0.5 * GRAVITY * late * late,
                        "{rate}: {since} {}",
                        stage.at()
                    );
                },
            );
            assert!(stage.soles() < -200.0 && !stage.walker.is_grounded(), "{rate}: {}", stage.at());
        }
    });
}

#[test]
fn a_figure_falls_through_a_refused_platform_flush_with_its_own() {
    in_all_shapes(|| {
        let mut stage = Stage::new(60.0, [0.0, 50.0, 0.0]);
        stage.platform([200.0, 50.0, 200.0], [0.0, 0.0, 0.0], 0.0);
        let trap = stage.platform([400.0, 50.0, 200.0], [300.0, 0.0, 0.0], 0.0);
        stage.walk_refused(RIGHT, 2.0, |_, partner| partner == ContactTarget::Platform(trap), |_| {});
        assert!(stage.soles() < 0.1 && stage.at().x > 120.0, "{}", stage.at());
        assert!(stage.walker.floor() == Some(ContactTarget::Ground), "{:?}", stage.walker);
    });
}

#[test]
fn a_figure_passes_a_refused_slope_and_a_refused_static_body() {
    let mut stage = Stage::new(60.0, [0.0, 200.0, 0.0]);
    let slope = stage.platform([400.0, 20.0, 200.0], [0.0, 150.0, 0.0], 0.3);
    stage.walk(STILL, 1.0, |_| {});
    assert!(stage.walker.is_grounded() && stage.soles() > 150.0, "{}", stage.at());
    stage.walk_refused(STILL, 1.5, |_, partner| partner == ContactTarget::Platform(slope), |_| {});
    assert_near(stage.soles(), 0.0, 0.1);

    let mut stage = Stage::new(60.0, [0.0, 40.0, 0.0]);
    let block = stage.crate_box([100.0, 40.0, 100.0], 10.0, [0.0, 0.0, 0.0]);
    stage.simulator.body_mut(block).unwrap().set_is_static(true);
    let geom = geom_of(&stage.simulator, block);
    stage.walk(STILL, 0.5, |_| {});
    assert_near(stage.soles(), 40.0, 0.1);
    stage.walk_refused(STILL, 1.5, |_, partner| partner != ContactTarget::Ground, |_| {});
    assert_near(stage.soles(), 0.0, 0.1);
    assert!(stage.walker.floor() != Some(ContactTarget::Geom(geom)));
}

#[test]
fn a_curb_that_is_refused_is_not_stepped_on() {
    in_all_shapes(|| {
        for rate in [60.0, 120.0] {
            let mut stage = Stage::new(rate, [0.0, 0.0, 0.0]);
            let curb = stage.platform([100.0, 6.0, 200.0], [150.0, 0.0, 0.0], 0.0);
            stage.walk_refused(RIGHT, 0.2, |_, _| false, |_| {});
            stage.walk_refused(
                RIGHT,
                1.8,
                |_, partner| partner == ContactTarget::Platform(curb),
                |stage| {
                    assert!(stage.soles() < 0.2, "{rate}: {}", stage.at());
                },
            );
            assert!(stage.at().x > 220.0, "{rate}: {}", stage.at());
        }
    });
}

#[test]
fn walls_that_are_refused_are_walked_through() {
    in_all_shapes(|| {
        let mut stage = Stage::new(60.0, [0.0, 0.0, 0.0]);
        let wall = stage.platform([40.0, 100.0, 200.0], [100.0, 0.0, 0.0], 0.0);
        let block = stage.crate_box([40.0, 100.0, 200.0], 10.0, [200.0, 0.0, 0.0]);
        stage.simulator.body_mut(block).unwrap().set_is_static(true);
        stage.walk_refused(RIGHT, 2.5, |_, partner| partner != ContactTarget::Ground, |_| {});
        assert!(stage.at().x > 260.0 && stage.soles().abs() < 0.2, "{}", stage.at());
        assert!(stage.simulator.platform(wall).is_some());
    });
}

#[test]
fn a_refused_edge_is_not_grabbed() {
    let mut stage = Stage::new(60.0, [0.0, 100.0, 0.0]);
    stage.walker.walk.ledge_reach = 60.0;
    let wall = stage.platform([40.0, 90.0, 200.0], [40.0, 0.0, 0.0], 0.0);
    let mut hung = 0;
    stage.walk_refused(
        RIGHT,
        1.0,
        |_, partner| partner == ContactTarget::Platform(wall),
        |stage| {
            hung += usize::from(stage.walker.ledge().is_some());
        },
    );
    // One step until the handler was called.
    assert!(hung <= 1 && stage.soles() < 0.2, "{hung} {}", stage.at());
}

#[test]
fn a_platform_ignored_for_one_figure_carries_another_and_carries_again_once_it_is_accepted() {
    let mut stage = Stage::new(60.0, [0.0, 50.0, 0.0]);
    let floor = stage.platform([400.0, 20.0, 200.0], [0.0, 30.0, 0.0], 0.0);
    let other = figure(&mut stage.simulator, [100.0, 50.0, 0.0]);
    let mut walker = CharacterController::new(CharacterSettings::default());
    let refused_geom = geom_of(&stage.simulator, stage.figure);
    let (figure, dt) = (stage.figure, stage.dt);
    struct One(twohalf::GeomId, PlatformId);
    impl EventHandler for One {
        fn on_collision(&mut self, _: &mut Context<'_>, collision: &Collision) -> bool {
            (collision.this, collision.partner) != (self.0, ContactTarget::Platform(self.1))
        }
    }
    for _ in 0..60 {
        stage.simulator.walk(figure, &mut stage.walker, STILL, dt).unwrap();
        stage.simulator.walk(other, &mut walker, STILL, dt).unwrap();
        stage.simulator.update_with(dt, &mut One(refused_geom, floor));
    }
    assert!(stage.soles() < 0.1 && walker.is_grounded() && place(&stage.simulator, other).y > 49.9);
    // Without a handler no contact is refused.
    stage.simulator.body_mut(figure).unwrap().set_position3d(Vector3::new(-100.0, 50.0, 0.0));
    stage.walk(STILL, 0.5, |_| {});
    assert_near(stage.soles(), 50.0, 0.1);
}

#[test]
fn a_handler_that_accepts_all_changes_no_bit_and_is_called_for_walls_without_contacts() {
    let mut plain = Stage::new(60.0, [0.0, 0.0, 0.0]);
    plain.platform([40.0, 100.0, 200.0], [100.0, 0.0, 0.0], 0.0);
    plain.platform([60.0, 6.0, 200.0], [30.0, 0.0, 0.0], 0.0);
    let mut asked = plain.clone();
    let mut partners = Vec::new();
    plain.walk(RIGHT, 1.5, |_| {});
    asked.walk_refused(
        RIGHT,
        1.5,
        |_, partner| {
            partners.push(partner);
            false
        },
        |_| {},
    );
    assert_eq!(plain.at(), asked.at());
    partners.sort();
    partners.dedup();
    assert_eq!(partners.len(), 3, "{partners:?}");
}

#[test]
fn a_figure_that_was_saved_over_a_hole_falls_with_the_same_bits() {
    for steps in [20, 43, 44, 45, 46, 60] {
        let mut stage = Stage::new(60.0, [0.0, 0.0, 0.0]);
        stage.platform([60.0, 6.0, 200.0], [130.0, 0.0, 0.0], 0.0);
        let refuses = |place: Vector3, _: ContactTarget| is_over_hole(place);
        stage.walk_refused(RIGHT, steps as f32 / 60.0, refuses, |_| {});
        let mut loaded = stage.clone();
        let snapshot = stage.simulator.snapshot();
        loaded.simulator.restore(&snapshot).unwrap();
        for stage in [&mut stage, &mut loaded] {
            stage.walk_refused(RIGHT, 0.5, refuses, |_| {});
        }
        assert_eq!(stage.at(), loaded.at(), "{steps}");
        assert_eq!(stage.simulator.snapshot(), loaded.simulator.snapshot(), "{steps}");
    }
}

#[test]
fn a_refusal_without_a_contact_is_an_event() {
    let mut stage = Stage::new(60.0, [0.0, 0.0, 0.0]);
    let wall = stage.platform([40.0, 100.0, 200.0], [60.0, 0.0, 0.0], 0.0);
    let mut told = false;
    stage.walk_refused(
        RIGHT,
        0.5,
        |_, partner| partner == ContactTarget::Platform(wall),
        |stage| {
            told |= stage.simulator.events().iter().any(|event| {
            matches!(event, Event::Collision(collision) if collision.vetoed && collision.contacts == 0)
        });
        },
    );
    assert!(told);
}
