//! Recordings: any state again, replays, and the update in which two runs part.

use conformance::fixtures::plane::{add_box, add_floor, simulator, v};
use farseer_core::{Error, Methods, PhysicsSimulator, Recording};

const DT: f32 = 1.0 / 60.0;
const UPDATES: usize = 130;

/// Returns a simulator with five boxes above a floor.
fn pile(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator(320.0);
    simulator.set_methods(methods).unwrap();
    add_floor(&mut simulator, (400.0, 20.0), v(0.0, 10.0));
    for number in 0..5 {
        add_box(&mut simulator, (20.0, 20.0), v(3.0 * number as f32, -20.0 - 30.0 * number as f32));
    }
    simulator
}

/// Makes the calls of a game for an update: the input pushes a body.
fn play(simulator: &mut PhysicsSimulator, input: &[u8], dt: f32) {
    if let &[body, push] = input {
        let body = simulator.body_list()[usize::from(body)];
        simulator[body].apply_impulse(v(f32::from(push), -50.0));
    }
    simulator.update(dt);
}

fn input(update: usize) -> Vec<u8> {
    if update % 7 == 3 { vec![1 + (update % 5) as u8, (update % 50) as u8] } else { Vec::new() }
}

/// Returns the recording of a run and the snapshots after 0, 1, 2... updates.
fn recorded(methods: Methods, interval: u32) -> (Recording, Vec<Vec<u8>>) {
    let mut simulator = pile(methods);
    simulator.update(DT);
    let mut recording = Recording::new(&simulator, interval).unwrap();
    let mut snapshots = vec![simulator.snapshot()];
    for update in 0..UPDATES {
        play(&mut simulator, &input(update), DT);
        recording.record(&simulator, DT, &input(update));
        snapshots.push(simulator.snapshot());
    }
    (recording, snapshots)
}

#[test]
fn state_after_any_update_is_that_of_the_run() {
    for methods in [Methods::PRECISE, Methods::default()] {
        for interval in [1, 30, 1000] {
            let (recording, snapshots) = recorded(methods, interval);
            let recording = Recording::from_bytes(&recording.to_bytes()).unwrap();
            assert_eq!(recording.len(), UPDATES);
            for updates in (0..=UPDATES).step_by(13) {
                let state = recording.state_after(updates, play).unwrap();
                assert!(state.snapshot() == snapshots[updates], "{methods:?} {interval} {updates}");
            }
            assert_eq!(recording.first_divergence(play).unwrap(), None);
        }
    }
}

#[test]
fn replay_with_another_call_diverges_in_the_update_of_the_call() {
    let (recording, _) = recorded(Methods::PRECISE, 50);
    let mut update = 0;
    let other = |simulator: &mut PhysicsSimulator, input: &[u8], dt: f32| {
        if update == 71 {
            let body = simulator.body_list()[2];
            simulator[body].apply_impulse(v(0.0, -1.0));
        }
        update += 1;
        play(simulator, input, dt);
    };
    assert_eq!(recording.first_divergence(other).unwrap(), Some(71));
    let forgetful = |simulator: &mut PhysicsSimulator, _: &[u8], dt: f32| simulator.update(dt);
    // The first input is that of update 3; keyframes need no input.
    assert!(recording.state_after(3, forgetful).is_ok() && recording.state_after(50, forgetful).is_ok());
    assert!(matches!(recording.state_after(4, forgetful), Err(Error::DamagedSave { .. })));
}

#[test]
fn a_replay_has_the_largest_speed_that_play_sets() {
    let mut simulator = pile(Methods::PRECISE);
    simulator.set_largest_speed(Some(20.0)).unwrap();
    let mut recording = Recording::new(&simulator, 30).unwrap();
    for _ in 0..60 {
        simulator.update(DT);
        recording.record(&simulator, DT, &[]);
    }
    let without = |simulator: &mut PhysicsSimulator, _: &[u8], dt: f32| simulator.update(dt);
    assert_ne!(recording.first_divergence(without).unwrap(), None);
    let with = |simulator: &mut PhysicsSimulator, _: &[u8], dt: f32| {
        simulator.set_largest_speed(Some(20.0)).unwrap();
        simulator.update(dt);
    };
    assert_eq!(recording.first_divergence(with).unwrap(), None);
    assert!(recording.state_after(45, with).is_ok());
}

#[test]
fn first_difference_is_the_first_update_with_another_state_or_input() {
    let (recording, _) = recorded(Methods::PRECISE, 30);
    assert_eq!(recording.first_difference(&recording.clone()), None);
    let (faithful, _) = recorded(Methods::default(), 30);
    assert_eq!(recording.first_difference(&faithful), Some(0));
    let mut longer = recording.clone();
    let state = recording.state_after(UPDATES, play).unwrap();
    longer.record(&state, DT, &[]);
    assert_eq!(recording.first_difference(&longer), Some(UPDATES));
    assert_eq!(longer.first_difference(&recording), Some(UPDATES));
}

#[test]
fn bytes_that_are_no_recording_are_refused() {
    let (recording, _) = recorded(Methods::PRECISE, 30);
    let bytes = recording.to_bytes();
    for cut in [0, 7, 30, bytes.len() - 1] {
        assert!(Recording::from_bytes(&bytes[..cut]).is_err(), "{cut}");
    }
    let mut altered = bytes.clone();
    altered[bytes.len() / 2] ^= 1;
    assert!(Recording::from_bytes(&altered).is_err());
    assert!(Recording::from_bytes(&pile(Methods::PRECISE).snapshot()).is_err());
    assert!(Recording::new(&pile(Methods::PRECISE), 0).is_err());
    assert!(recording.state_after(UPDATES + 1, play).is_err());
}
