//! The names of version 0.1 go on.

#![allow(deprecated, reason = "this is about deprecated names")]

use conformance::fixtures::depth::{crate_box, simulator};
use twohalf::{
    CharacterController, CharacterSettings, ContactTarget, CrushInfo, MoveInput, Partner, Squeeze, Walk,
    Walker, Wish,
};

#[test]
fn the_names_of_version_0_1_are_aliases() {
    let controller: CharacterController = Walker::new(Walk { jump_height: 100.0, ..Walk::default() });
    let settings: CharacterSettings = controller.walk;
    assert_eq!(settings.jump_height, 100.0);
    let input: MoveInput = Wish { x: 1.0, z: 0.0, jump: false };
    assert_eq!(input.x, 1.0);
    let target: ContactTarget = Partner::Ground;
    assert!(matches!(target, Partner::Ground));
    let mut simulator = simulator();
    let body = crate_box(&mut simulator, [10.0, 10.0], [0.0; 3]);
    let info: Option<CrushInfo> = simulator.squeeze(body);
    let former: Option<Squeeze> = simulator.crush_info(body);
    assert_eq!(info, former);
}
