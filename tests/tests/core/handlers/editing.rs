//! Edits of bodies and geoms by a handler in the middle of an update.

use conformance::fixtures::plane::{is_finite, lively_scene, methods, not_finite, pairs, v};
use farseer_core::{BodyId, CollisionCategory, Contact, Context, Event, EventHandler, GeomId, Methods};

use super::{AtCollision, body_of, middle_of_stack, stack};

#[test]
fn bodies_made_static_inside_a_callback_stay_finite() {
    for methods in methods() {
        let mut simulator = stack(methods);
        let mut handler =
            AtCollision(Some(|context: &mut Context<'_>, this, other, _: &mut Vec<Contact>| {
                for body in [body_of(context, this), body_of(context, other)] {
                    context.body_mut(body).unwrap().set_is_static(true);
                }
                true
            }));
        simulator.update_with(0.01, &mut handler);
        let reported = not_finite(&simulator);
        assert!(reported.iter().all(|(_, disabled)| !disabled), "{methods:?}: {reported:?}");
        for _ in 0..10 {
            assert!(is_finite(&simulator), "{methods:?}");
            assert!(simulator.body_list().iter().all(|&body| simulator[body].enabled()), "{methods:?}");
            simulator.update(0.01);
        }
    }
}

#[test]
fn a_body_moved_inside_a_callback_takes_its_geom_along_at_once() {
    for methods in methods() {
        let mut simulator = stack(methods);
        let mut seen = None;
        let mut handler =
            AtCollision(Some(|context: &mut Context<'_>, this, other, _: &mut Vec<Contact>| {
                let middle = middle_of_stack(context, this, other);
                let body = body_of(context, middle);
                context.body_mut(body).unwrap().set_position(v(500.0, 500.0));
                seen = Some((middle, context.geom(middle).unwrap().position()));
                true
            }));
        simulator.update_with(0.01, &mut handler);
        let (geom, position) = seen.unwrap();
        assert_eq!(position, v(500.0, 500.0));
        assert!(simulator.geom(geom).unwrap().position().x > 490.0);
        // The later pairs use the new position; the precise set has found all contacts before its first callback.
        let found = if let Methods::Faithful { .. } = methods { 1 } else { 2 };
        assert_eq!(pairs(&simulator).len(), found, "{methods:?}");
        assert!(is_finite(&simulator));
    }
}

#[test]
fn a_geom_disposed_inside_a_callback_has_no_later_contacts() {
    for methods in [Methods::default(), Methods::PRECISE] {
        let mut simulator = stack(methods);
        let mut disposed = None;
        let mut handler =
            AtCollision(Some(|context: &mut Context<'_>, this, other, _: &mut Vec<Contact>| {
                let middle = middle_of_stack(context, this, other);
                context.dispose(middle).unwrap();
                disposed = Some(middle);
                true
            }));
        simulator.update_with(0.01, &mut handler);
        let disposed = disposed.unwrap();
        assert!(simulator.geom(disposed).unwrap().is_disposed());
        let later: Vec<&Event> = simulator
            .events()
            .iter()
            .skip_while(|event| !matches!(event, Event::Collision { .. }))
            .skip(2)
            .filter(|event| matches!(event, Event::Collision { .. }))
            .collect();
        assert_eq!(later, [] as [&Event; 0], "{methods:?}");
        simulator.update(0.01);
        assert!(simulator.geom(disposed).is_none());
        assert_eq!(simulator.arbiter_count(), 0);
    }
}

/// Edits that separate a geom from its contacts.
const PARTINGS: [fn(&mut Context<'_>, GeomId); 4] = [
    |context, geom| context.dispose(geom).unwrap(),
    |context, geom| {
        let body = body_of(context, geom);
        context.body_mut(body).unwrap().set_enabled(false);
    },
    |context, _| {
        for geom in context.geom_list().to_vec() {
            context.geom_mut(geom).unwrap().set_collision_group(3);
        }
    },
    |context, _| {
        for geom in context.geom_list().to_vec() {
            context.geom_mut(geom).unwrap().set_collides_with(CollisionCategory::NONE);
        }
    },
];

/// Separates a geom from its contacts in the first collision callback, and records the calls.
struct Parts {
    part: fn(&mut Context<'_>, GeomId),
    geom: GeomId,
    asked: Vec<(GeomId, GeomId)>,
}

impl EventHandler for Parts {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        if self.asked.is_empty() {
            (self.part)(context, self.geom);
        }
        self.asked.push((this, other));
        true
    }
}

/// The precise set knows all contacts before its first callback.
#[test]
fn pairs_separated_in_a_callback_get_no_callback_and_no_impulse() {
    for (number, part) in PARTINGS.into_iter().enumerate() {
        let mut simulator = stack(Methods::PRECISE);
        simulator.update(0.01);
        let [floor, middle, top] = simulator.geom_list()[..] else { panic!("three geoms") };
        simulator[top].set_friction_coefficient(0.0);
        let [body, thrown] = [middle, top].map(|geom| simulator.body_of(geom).unwrap());
        simulator[thrown].set_linear_velocity(v(0.0, 500.0));
        let mut handler = Parts { part, geom: top, asked: Vec::new() };
        simulator.update_with(0.01, &mut handler);
        assert_eq!(handler.asked, [(floor, middle), (middle, floor)], "parting {number}");
        // The floor would not stop an impulse from above within a step, but the body is at rest as before.
        assert!(simulator[body].linear_velocity().norm() < 5.0, "parting {number}");
    }
}

#[test]
fn bodies_may_be_disposed_inside_every_callback() {
    for methods in methods() {
        for callback in 0..5 {
            let mut simulator = lively_scene(methods, 8);
            let mut handler = DisposesIn { callback, left: 5 };
            for step in 0..60 {
                if step % 10 == 5 {
                    let body = simulator.body_list()[3];
                    simulator[body].set_position(v(0.0, 0.0));
                    simulator.dispose(body).unwrap();
                }
                simulator.update_with(0.01, &mut handler);
                assert!(is_finite(&simulator), "{methods:?} {callback}");
            }
            assert!(handler.left < 5, "{methods:?}: callback {callback} never came");
        }
    }
}

/// Disposes, removes and adds the objects of a callback, in one kind of callback.
struct DisposesIn {
    callback: usize,
    left: usize,
}

impl DisposesIn {
    fn act(
        &mut self,
        callback: usize,
        context: &mut Context<'_>,
        geom: Option<GeomId>,
        body: Option<BodyId>,
    ) {
        if callback != self.callback || self.left == 0 {
            return;
        }
        let body = body.or_else(|| Some(context.geom(geom?)?.body()));
        let Some(body) = body.filter(|&body| context.body(body).is_some_and(|body| !body.is_static())) else {
            return;
        };
        self.left -= 1;
        if let Some(geom) = geom {
            context.remove(geom).unwrap();
            context.add(geom).unwrap();
        }
        context.body_mut(body).unwrap().set_position(v(1.0, 1.0));
        context.dispose(body).unwrap();
        context.dispose(body).unwrap();
        context.add(body).unwrap();
    }
}

impl EventHandler for DisposesIn {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        _: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        self.act(0, context, Some(this), None);
        true
    }
    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, _: GeomId) {
        self.act(1, context, Some(this), None);
    }
    fn handles_broad_phase(&self) -> bool {
        self.callback == 2
    }
    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, geom1: GeomId, _: GeomId) -> bool {
        self.act(2, context, Some(geom1), None);
        true
    }
    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        self.act(3, context, None, Some(body));
    }
    fn on_body_disposed(&mut self, context: &mut Context<'_>, body: BodyId) {
        self.act(4, context, None, Some(body));
    }
}

#[test]
fn an_object_removed_inside_a_callback_leaves_with_the_next_update() {
    let mut simulator = stack(Default::default());
    let mut removed = None;
    let mut handler =
        AtCollision(Some(|context: &mut Context<'_>, _, other: GeomId, _: &mut Vec<Contact>| {
            context.remove(other).unwrap();
            removed = Some(other);
            true
        }));
    simulator.update_with(0.01, &mut handler);
    let removed = removed.unwrap();
    assert!(simulator.geom_list().contains(&removed));
    simulator.update(0.01);
    assert!(!simulator.geom_list().contains(&removed));
    assert!(simulator.geom(removed).is_some());
}
