//! The events of several updates.

use conformance::fixtures::plane::{add_circle, add_floor, simulator, v};
use farseer_core::{Event, EventLog};

#[test]
fn a_frame_with_several_updates_misses_no_event_and_one_without_sees_none_twice() {
    let mut simulator = simulator(100.0);
    add_floor(&mut simulator, (100.0, 20.0), v(0.0, 10.0));
    let (body, _) = add_circle(&mut simulator, 10.0, 16, v(0.0, -30.0));
    simulator[body].set_linear_velocity(v(0.0, 100.0));
    let (mut log, mut all, mut seen) = (EventLog::new(), Vec::new(), Vec::new());
    for updates in [1, 3, 0, 2, 0, 5, 30] {
        for _ in 0..updates {
            simulator.update(0.01);
            log.take(&simulator);
            all.extend_from_slice(simulator.events());
        }
        seen.extend(log.drain());
    }
    assert!(all.iter().any(|event| matches!(event, Event::Collision { .. })), "it lands");
    assert_eq!(seen, all);
    assert_eq!(log.events(), []);
}
