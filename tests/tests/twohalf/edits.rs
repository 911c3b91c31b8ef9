//! Edits of a game in callbacks; a handler without edits has no effect.

use conformance::fixtures::depth::{
    AXES, DT, assert_near3, ball, busy_scene, falling, pair_along, place, platform, run, run_with,
    set_platform_surface, set_surface, solid, throw, velocity, weightless, with_scheme,
};
use twohalf::{
    BodyId, Collision, ContactTarget, Context, DepthScheme, EventHandler, GeomId, Vector2, Vector3,
};

/// Edits a body in a callback.
type Edit = fn(&mut Context<'_>, BodyId);

const EDITS: [Edit; 6] = [
    |context, body| context.body_mut(body).unwrap().set_position3d(Vector3::new(900.0, 700.0, 900.0)),
    |context, body| context.body_mut(body).unwrap().set_velocity3d(Vector3::new(-50.0, 60.0, -70.0)),
    |context, body| context.dispose(body).unwrap(),
    |context, body| context.remove(body).unwrap(),
    |context, body| context.body_mut(body).unwrap().set_enabled(false),
    |context, body| context.body_mut(body).unwrap().set_is_static(true),
];

/// Makes an edit in the first callback of a body.
struct Editor {
    edit: Edit,
    done: usize,
    on: &'static str,
}

impl Editor {
    fn run(&mut self, on: &str, context: &mut Context<'_>, body: Option<BodyId>) {
        if let Some(body) =
            body.filter(|&body| self.done < 3 && on == self.on && context.body(body).is_some())
        {
            (self.edit)(context, body);
            self.done += 1;
        }
    }
}

impl EventHandler for Editor {
    fn on_collision(&mut self, context: &mut Context<'_>, collision: &Collision) -> bool {
        let body = context.geom(collision.this).map(|geom| geom.body());
        self.run("collision", context, body);
        true
    }

    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, _: ContactTarget) {
        let body = context.geom(this).map(|geom| geom.body());
        self.run("separation", context, body);
    }

    fn handles_broad_phase(&self) -> bool {
        true
    }

    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, geom1: GeomId, _: GeomId) -> bool {
        let body = context.geom(geom1).map(|geom| geom.body());
        self.run("broad phase", context, body);
        true
    }

    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        self.run("updated", context, Some(body));
    }
}

#[test]
pub(crate) fn edits_in_every_callback_are_safe() {
    for edit in EDITS {
        for on in ["collision", "separation", "broad phase", "updated"] {
            for scene in 0..5 {
                let (mut simulator, body) = match AXES.get(scene) {
                    Some(&axis) => {
                        let (simulator, bodies, _) = pair_along(axis, 1.0);
                        (simulator, bodies[1])
                    }
                    None => {
                        let (simulator, body, _) = falling(scene == 3, true, 0.5);
                        (simulator, body)
                    }
                };
                let mut editor = Editor { edit, done: 0, on };
                run_with(&mut simulator, &mut editor, 250);
                assert!(editor.done > 0 || (scene > 2 && on == "broad phase"), "{on}, scene {scene}");
                if let Some(view) = simulator.body(body) {
                    let (at, speed) = (view.position3d(), view.velocity3d());
                    assert!(at.iter().chain(speed.iter()).all(|number| number.is_finite()));
                }
            }
        }
    }
}

#[test]
pub(crate) fn a_body_teleported_in_a_callback_gets_no_further_impulse() {
    for axis in AXES {
        let (mut simulator, bodies, _) = pair_along(axis, 1.0);
        let mut editor = Editor { edit: EDITS[0], done: 2, on: "collision" };
        run_with(&mut simulator, &mut editor, 100);
        // The older one got the first callback.
        assert_near3(place(&simulator, bodies[0]), [900.0, 700.0, 900.0], 100.0);
        assert!(simulator.contacts().next().is_none(), "{axis:?}");
    }
}

#[test]
pub(crate) fn a_body_disposed_in_a_callback_is_stale_after_the_next_update() {
    for axis in AXES {
        let (mut simulator, bodies, _) = pair_along(axis, 1.0);
        let mut editor = Editor { edit: EDITS[2], done: 2, on: "collision" };
        while editor.done < 3 {
            simulator.update_with(DT, &mut editor);
        }
        assert!(simulator.body(bodies[0]).is_some_and(|body| body.is_disposed()));
        simulator.update_with(DT, &mut editor);
        assert!(simulator.body(bodies[0]).is_none() && simulator.body(bodies[1]).is_some());
    }
}

/// Does nothing.
struct Nothing;

impl EventHandler for Nothing {}

/// Does nothing and subscribes to all callbacks.
struct Asked;

impl EventHandler for Asked {
    fn handles_broad_phase(&self) -> bool {
        true
    }
}

#[test]
pub(crate) fn a_handler_without_actions_changes_no_bit() {
    let make = || {
        let (mut simulator, bodies) = busy_scene();
        let floor = platform(&mut simulator, [60.0, 30.0, 60.0], [140.0, 10.0, 15.0]);
        set_platform_surface(&mut simulator, floor, 0.3, 0.2);
        let thrown = solid(&mut simulator, [30.0, 30.0, 30.0], [105.0, 5.0, 160.0]);
        set_surface(&mut simulator, thrown, 0.3, 0.3);
        throw(&mut simulator, thrown, [0.0, 30.0, -90.0]);
        simulator.body_mut(bodies[1]).unwrap().apply_impulse(Vector2::new(30.0, -20.0));
        simulator
    };
    let [mut alone, mut with_nothing, mut with_questions] = [make(), make(), make()];
    let mut touching = 0;
    for step in 0..400 {
        alone.update(DT);
        with_nothing.update_with(DT, &mut Nothing);
        with_questions.update_with(DT, &mut Asked);
        assert_eq!(alone.events(), with_nothing.events(), "step {step}");
        assert_eq!(alone.events(), with_questions.events(), "step {step}");
        touching += alone.contacts().count();
        if step % 50 == 49 {
            let saved = serde_json::to_string(&alone).unwrap();
            assert!(saved == serde_json::to_string(&with_nothing).unwrap(), "step {step}");
            assert!(saved == serde_json::to_string(&with_questions).unwrap(), "step {step}");
        }
    }
    assert!(touching > 500);
}

#[test]
fn a_force_along_z_is_kept_for_a_disabled_body_as_in_the_plane() {
    with_scheme(DepthScheme::Precise, || {
        let mut simulator = weightless();
        let body = ball(&mut simulator, 10.0, [0.0, 100.0, 0.0]);
        run(&mut simulator, 1);
        let mut view = simulator.body_mut(body).unwrap();
        view.set_enabled(false);
        view.apply_force3d(Vector3::new(50.0, 0.0, 50.0));
        run(&mut simulator, 3);
        simulator.body_mut(body).unwrap().set_enabled(true);
        run(&mut simulator, 1);
        // Mass 1, for one step.
        let velocity = velocity(&simulator, body);
        assert_near3(velocity, [50.0 * DT, 0.0, 50.0 * DT], 1e-6);
    });
}
