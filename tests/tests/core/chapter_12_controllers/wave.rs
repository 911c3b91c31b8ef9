//! Waves, and bodies that float on them.

use super::{DT, add_controller, bits, floating, follow};
use conformance::fixtures::plane::v;
use conformance::units::{assert_bits, floats};
use farseer_core::{
    Aabb, BodyId, ControllerId, Error, FluidContainer, FluidContainerRef, PhysicsSimulator, WaveController,
};

/// The wave of check 7 after its two disturbances.
fn wave_of_check_7() -> WaveController {
    let mut wave = WaveController::new(v(-3.0, 2.0), 10.0, 4.0, 6).unwrap();
    wave.disturb(1.0, 0.5).unwrap();
    wave.disturb(3.0, -0.25).unwrap();
    wave.set_wave_generator_max(0.3).unwrap();
    wave.set_wave_generator_min(-0.3).unwrap();
    wave.set_wave_generator_step(0.2).unwrap();
    wave
}

/// A box that reaches down to `bottom`.
fn above(bottom: f32) -> Aabb {
    Aabb::new(v(0.0, -5.0), v(1.0, bottom))
}

#[test]
fn check_7_nodes_are_spread_evenly() {
    assert_eq!(wave_of_check_7().x_position(), [-3.0, -1.0, 1.0, 3.0, 5.0, 7.0]);
}

#[test]
fn check_7_a_disturbance_on_an_inner_node_moves_both_segments() {
    let mut wave = WaveController::new(v(-3.0, 2.0), 10.0, 4.0, 6).unwrap();
    wave.disturb(1.0, 0.5).unwrap();
    assert_eq!(wave.current_wave(), [0.0, 0.5, 0.5, 0.0, 0.0, 0.0]);
    wave.disturb(3.0, -0.25).unwrap();
    assert_eq!(wave.current_wave(), [0.0, 0.5, 0.25, -0.25, 0.0, 0.0]);
}

#[test]
fn check_7_wave_steps_come_on_every_third_call_with_the_recorded_offsets() {
    let table = [
        (3, "3e733333 3e733333 3e733333 be733333 3e4ccccd"),
        (6, "be7f5c28 3e5ae147 3e733333 3ed4cccd 3ecccccd"),
        (9, "bcb8d501 be72978c 3ebe9ba5 3f54cccd 3ecccccd"),
        (12, "3c4212dd 3e044538 3ead919d 3ead7a43 3e4ccccd"),
        (15, "3e139b0d 3f0ef10a 3dba37dc be8e264e 00000000"),
        (18, "3f04e9e9 3dce0b59 bd62bf95 be71275d be4ccccd"),
        (24, "bf141bb2 bead66b5 bc4eb800 beb85bfe becccccd"),
        (60, "be4605fd bf5ad25a bf9e0167 befbb827 00000000"),
    ];
    let mut wave = wave_of_check_7();
    for call in 1..=60 {
        let before = wave.current_wave().to_vec();
        wave.update(0.1).unwrap();
        assert_eq!(wave.current_wave() != before, call % 3 == 0, "call {call}");
        if let Some((_, words)) = table.iter().find(|row| row.0 == call) {
            assert_bits(&wave.current_wave()[1..], &floats(words), || format!("call {call}"));
        }
    }
}

#[test]
fn check_7_the_box_follows_the_highest_inner_node_from_the_first_wave_step_on() {
    let mut wave = wave_of_check_7();
    assert!(wave.intersect(&above(2.0)));
    assert!(!wave.intersect(&above(bits(0x3fff_ffff))));
    for _ in 0..3 {
        wave.update(0.1).unwrap();
    }
    assert!(wave.intersect(&above(bits(0x3fe1_999a))));
    assert!(!wave.intersect(&above(bits(0x3fe1_9999))));
}

#[test]
fn check_7_points_are_compared_with_the_extended_surface() {
    let mut wave = wave_of_check_7();
    for _ in 0..3 {
        wave.update(0.1).unwrap();
    }
    for (x, y, expected) in [
        (0.0, bits(0x400f_3333), true),
        (0.0, 2.2, false),
        (-100.0, 2.5, true),
        (100.0, 2.5, false),
        (100.0, 25.0, true),
        (3.0, 50.0, true),
    ] {
        assert_eq!(wave.contains(v(x, y)), expected, "{x} {y}");
        assert_eq!(wave.vector_point(), v(x, y));
    }
}

#[test]
fn check_7_a_position_that_does_not_fit_32_bits_is_taken_for_the_first_segment() {
    let mut wave = wave_of_check_7();
    assert!(!wave.contains(v(3e10, 1.0)));
    assert_eq!(wave.vector_near_wave_edge(), v(-3.0, 2.0));
    assert_eq!(wave.vector_far_wave_edge(), v(-1.0, 2.5));
}

#[test]
fn check_8_waves_without_a_segment_are_refused() {
    for nodes in [0, 1] {
        let wave = WaveController::new(v(0.0, 0.0), 10.0, 4.0, nodes);
        assert!(matches!(wave, Err(Error::InvalidArgument { argument: "node_count", .. })));
        let mut wave = WaveController::new(v(0.0, 0.0), 10.0, 4.0, 2).unwrap();
        assert!(wave.set_node_count(nodes).is_err());
        assert_eq!(wave.node_count(), 2);
    }
}

/// The wave and the octagon of check 9.
fn wave_and_octagon() -> (PhysicsSimulator, BodyId, ControllerId) {
    let mut made = None;
    let (simulator, body) = floating(|simulator| {
        let mut wave = WaveController::new(v(-8.0, 0.0), 16.0, 20.0, 9).unwrap();
        wave.set_wave_generator_max(0.6).unwrap();
        wave.set_wave_generator_min(-0.6).unwrap();
        wave.set_wave_generator_step(0.15).unwrap();
        wave.set_frequency(0.05).unwrap();
        wave.set_damping_coefficient(0.97).unwrap();
        let wave = add_controller(simulator, wave);
        made = Some(wave);
        FluidContainerRef::Wave(wave)
    });
    (simulator, body, made.unwrap())
}

#[test]
fn check_9_the_octagon_on_waves_moves_as_recorded() {
    let (mut simulator, body, _) = wave_and_octagon();
    let table = [
        (60, "3f7ffea0 3fdb1612 3dca5fd4 b901fda5 40c82730 bba98be5"),
        (120, "3f7ff9c1 4068933f 3dc1644e b82c220c bf7b9926 bb72c00f"),
        (600, "3f7f8480 3f4c590a 3d897a01 3a2c5897 bf3fe131 3d24c930"),
    ];
    follow(&mut simulator, body, &table);
}

#[test]
fn check_9_the_surface_moves_as_recorded() {
    let (mut simulator, _, wave) = wave_and_octagon();
    let table = [
        (60, "be8d935e bed4c6f4 bee1b066 bee676d8 beef9822 beed0614 bef29d6a bf19999a"),
        (600, "be42a710 be9655ff bed397e1 bf0fc4d3 bf1d605a bf2c93ea bf328251 bf19999a"),
    ];
    for step in 1..=600 {
        simulator.update(DT);
        if let Some((_, words)) = table.iter().find(|row| row.0 == step) {
            let offsets = simulator.controller_as::<WaveController>(wave).unwrap().current_wave();
            assert_eq!(offsets[0], 0.0);
            assert_bits(&offsets[1..], &floats(words), || format!("step {step}"));
        }
    }
}
