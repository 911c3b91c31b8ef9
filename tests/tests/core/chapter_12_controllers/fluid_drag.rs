//! Fluid that drags and carries.

use super::{DT, add_controller, bits, floating, follow, octagon, pool};
use conformance::fixtures::plane::{simulator, v};
use conformance::units::{assert_bits, assert_words, floats};
use farseer_core::{
    Aabb, AabbFluidContainer, Body, BodyId, ControllerId, Error, Event, FluidContainer, FluidDragController,
    GeomId, GeomPlacement, PhysicsSimulator, Vertices,
};

/// A fluid that carries one geom, of a body that is not in the simulation: forces stay in its accumulators.
struct Basin {
    simulator: PhysicsSimulator,
    body: BodyId,
    geom: GeomId,
    drag: ControllerId,
}

impl Basin {
    fn new(outline: Vertices) -> Self {
        let mut simulator = simulator(0.0);
        let body = simulator.create_body(Body::new());
        let geom = simulator.create_geom(body, outline, GeomPlacement::with_grid_size(0.5)).unwrap();
        let mut drag = FluidDragController::new(pool(), 0.8, 1.1, 0.5, v(0.0, 10.0)).unwrap();
        drag.add_geom(geom).unwrap();
        let drag = add_controller(&mut simulator, drag);
        Basin { simulator, body, geom, drag }
    }

    /// The one of check 2.
    fn with_octagon() -> Self {
        let mut basin = Basin::new(octagon());
        let body = basin.body();
        body.set_mass(3.0).unwrap();
        body.set_moment_of_inertia(2.0).unwrap();
        body.set_position(v(0.25, -0.5));
        body.set_rotation(0.2);
        body.set_linear_velocity(v(-1.25, 3.0));
        body.set_angular_velocity(-2.0);
        basin
    }

    fn body(&mut self) -> &mut Body {
        &mut self.simulator[self.body]
    }

    /// Force and torque of one update, with the body at this height, and the numbers of vertices of entries.
    fn update_at(&mut self, y: f32) -> ([f32; 3], Vec<u32>) {
        let body = self.body();
        let x = body.position().x;
        body.clear_force();
        body.clear_torque();
        body.set_position(v(x, y));
        self.simulator.update(DT);
        let body = &self.simulator[self.body];
        let entry = |event: &Event| match *event {
            Event::FluidEntry { controller, geom, vertices } => {
                assert_eq!((controller, geom), (self.drag, self.geom));
                Some(vertices)
            }
            _ => None,
        };
        let entries = self.simulator.events().iter().filter_map(entry).collect();
        ([body.force().x, body.force().y, body.torque()], entries)
    }

    fn drag(&mut self) -> &mut FluidDragController {
        self.simulator.controller_as_mut(self.drag).unwrap()
    }
}

#[track_caller]
fn assert_load(actual: [f32; 3], expected: &str) {
    assert_bits(&actual, &floats(expected), || "force and torque".to_owned());
}

const HALF_IN: &str = "bdcf6c91 c067e1be 3f868122";
const NOTHING: &str = "00000000 00000000 00000000";

#[test]
fn check_1_a_box_of_fluid_keeps_a_margin_inside_but_touches() {
    let mut container = AabbFluidContainer::new(Aabb::new(v(0.0, 0.0), v(10.0, 5.0))).unwrap();
    assert!(!container.contains(v(0.0, 1.0)));
    assert!(!container.contains(v(bits(0x3727_c5ac), 1.0)));
    assert!(container.contains(v(bits(0x3729_732b), 1.0)));
    assert!(!container.contains(v(bits(0x411f_fff6), 1.0)));
    assert!(container.contains(v(bits(0x411f_ff97), 1.0)));
    assert!(container.intersect(&Aabb::new(v(10.0, 5.0), v(11.0, 6.0))));
}

#[test]
fn check_2_the_octagon_lies_where_the_original_has_it() {
    let mut basin = Basin::with_octagon();
    basin.simulator.update(DT);
    let geom = basin.simulator.geom(basin.geom).unwrap();
    assert_words(&geom.world_vertices()[0], "3f91289e bf8b039e");
    assert_words(&geom.world_vertices()[7], "3fbccf87 be80da04");
}

#[test]
fn check_2_entry_is_reported_once_while_the_force_is_the_same_every_time() {
    let mut basin = Basin::with_octagon();
    let (load, entries) = basin.update_at(-0.5);
    assert_load(load, HALF_IN);
    assert_eq!(entries, [3]);
    let (load, entries) = basin.update_at(-0.5);
    assert_load(load, HALF_IN);
    assert!(entries.is_empty());
}

#[test]
fn check_2_a_geom_that_leaves_the_box_in_one_step_does_not_enter_again() {
    let mut basin = Basin::with_octagon();
    basin.update_at(-0.5);
    let (load, _) = basin.update_at(-5.0);
    assert_load(load, NOTHING);
    assert!(basin.update_at(-0.5).1.is_empty());
}

#[test]
fn check_2_a_geom_that_only_touches_the_box_in_between_enters_again() {
    let mut basin = Basin::with_octagon();
    basin.update_at(-0.5);
    let (load, _) = basin.update_at(-1.2);
    assert_load(load, NOTHING);
    assert_eq!(basin.update_at(-0.5).1, [3]);
}

#[test]
fn check_2_after_a_reset_entry_is_reported_again() {
    let mut basin = Basin::with_octagon();
    basin.update_at(-0.5);
    basin.drag().reset();
    assert_eq!(basin.update_at(-0.5).1, [3]);
}

#[test]
fn check_2_under_water_the_loads_are_the_recorded_ones() {
    let mut basin = Basin::with_octagon();
    assert_load(basin.update_at(10.0).0, "40818122 c21ed9e5 4040002e");
    basin.body().set_linear_velocity(v(0.0, 0.0));
    basin.body().set_angular_velocity(0.0);
    assert_load(basin.update_at(10.0).0, "00000000 c1f00008 b6960005");
}

#[test]
fn check_2_a_drag_that_would_be_nan_is_not_applied_and_reported() {
    let mut basin = Basin::with_octagon();
    basin.body().set_linear_velocity(v(1e-30, 0.0));
    basin.body().set_angular_velocity(0.0);
    assert_load(basin.update_at(10.0).0, NOTHING);
    let report = Event::ControllerNotFinite { controller: basin.drag };
    assert!(basin.simulator.events().contains(&report));
}

#[test]
fn check_3_a_box_with_two_corners_in_the_water_has_no_force() {
    let outline = [v(-1.0, -1.0), v(-1.0, 1.0), v(1.0, 1.0), v(1.0, -1.0)];
    let mut basin = Basin::new(Vertices::from(&outline[..]));
    let (load, entries) = basin.update_at(0.0);
    assert_load(load, NOTHING);
    assert!(entries.is_empty());
}

#[test]
fn check_4_a_geom_added_twice_is_refused_and_carried_once() {
    let mut basin = Basin::with_octagon();
    let geom = basin.geom;
    assert!(matches!(basin.drag().add_geom(geom), Err(Error::InvalidArgument { argument: "geom", .. })));
    assert_load(basin.update_at(-0.5).0, HALF_IN);
    basin.drag().remove_geom(geom);
    assert_load(basin.update_at(-0.5).0, NOTHING);
}

#[test]
fn check_5_three_of_32_vertices_enter_in_every_update() {
    let mut basin = Basin::new(Vertices::create_circle(2.0, 32).unwrap());
    for _ in 0..3 {
        assert_eq!(basin.update_at(-1.9).1, [3]);
    }
}

#[test]
fn check_6_the_floating_octagon_moves_as_recorded() {
    let (mut simulator, body) = floating(|_| pool());
    let table = [
        (1, "3f800000 c03fd27d 3dcccccd 00000000 3e2aaaab 00000000"),
        (60, "3f800032 3fd428f8 3dcf7700 3840d7fa 40c3729c 3c13d93a"),
        (120, "3f800119 405f821d 3ddf216e 377f9f2e bf83f8b6 3bd3ad26"),
        (600, "3f98b0dd 3f5ab15f 3f4c1a4f 3c4e7b0a bf182d96 be30480e"),
    ];
    follow(&mut simulator, body, &table);
}
