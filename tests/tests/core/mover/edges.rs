//! Steps, edges, seams and one-way geoms.

use super::*;

#[test]
fn a_step_is_walked_up_without_losing_speed() {
    for (height, case) in
        [0.06, 0.5, 1.0, 4.0, 7.9].into_iter().flat_map(|it| cases().map(move |case| (it, case)))
    {
        let mut stage = Stage::on_ground(case);
        stage.fixed([400.0, 100.0], [300.0, 50.0 - height]);
        stage.run(RIGHT, 0.2, |_| {});
        let start = stage.at().x;
        stage.run(RIGHT, 1.0, |stage| {
            assert!(
                stage.mover.is_grounded() && stage.height() <= height + 0.1,
                "{height} {}",
                stage.height()
            );
        });
        near(stage.at().x - start, 150.0, 0.2);
        near(stage.height(), height, 0.1);
    }
}

#[test]
fn stairs_are_walked_up_and_down_at_the_speed_of_the_input() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        (0..10)
            .for_each(|i| _ = stage.fixed([20.0, 100.0], [110.0 + 20.0 * i as f32, 44.0 - 6.0 * i as f32]));
        (0..10)
            .for_each(|i| _ = stage.fixed([20.0, 100.0], [310.0 + 20.0 * i as f32, -10.0 + 6.0 * i as f32]));
        stage.run(RIGHT, 0.1, |_| {});
        let start = stage.at().x;
        let mut highest = 0.0f32;
        stage.run(RIGHT, 4.0, |stage| {
            highest = highest.max(stage.height());
            assert!(stage.mover.is_grounded(), "{:?}", stage.at());
        });
        near(stage.at().x - start, 600.0, 1.0);
        near(highest, 60.0, 0.1);
        near(stage.height(), 0.0, 0.1);
    }
}

#[test]
fn a_step_is_walked_up_from_a_stand_beside_it() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        stage.fixed([400.0, 100.0], [215.1, 44.0]);
        stage.run(STILL, 0.3, |stage| near(stage.height(), 0.0, 0.1));
        stage.run(RIGHT, 0.5, |_| {});
        near(stage.at().x, 67.5, 0.2);
        near(stage.height(), 6.0, 0.1);
    }
}

#[test]
fn an_obstacle_higher_than_a_step_is_a_wall() {
    // The flank of the capsule touches the edge: (15² - 6²)^½.
    for (case, half) in cases().zip([15.0, 15.0, 15.0, 13.75, 13.75, 13.75]) {
        let mut stage = Stage::on_ground(case);
        let wall = stage.fixed([400.0, 100.0], [300.0, 41.0]);
        let report = stage.run(RIGHT, 2.0, |stage| near(stage.height(), 0.0, 0.1));
        assert!(report.right.is_some_and(|touch| touch.body == wall), "{report:?}");
        near(stage.at().x, 100.0 - half, 0.1);
    }
}

#[test]
fn down_a_step_it_stays_on_the_ground_and_down_a_ledge_it_falls() {
    for (height, case) in [6.0, 30.0].into_iter().flat_map(|it| cases().map(move |case| (it, case))) {
        let mut stage = Stage::new(case, [0.0, -height - 0.1]);
        stage.fixed([4000.0, 100.0], [0.0, 50.0]);
        stage.fixed([200.0, 100.0], [0.0, 50.0 - height]);
        stage.run(STILL, 0.1, |_| {});
        let mut falls = false;
        stage.run(RIGHT, 1.5, |stage| falls |= !stage.mover.is_grounded());
        assert_eq!(falls, height > 8.0, "{height}");
        near(stage.height(), 0.0, 0.1);
    }
}

#[test]
fn seams_of_tiles_and_of_chains_do_not_stop_it() {
    for case in cases() {
        let mut stage = Stage::new(case.clone(), [0.0, -0.1]);
        (-2..40).for_each(|i| _ = stage.fixed([20.0, 20.0], [20.0 * i as f32, 10.0]));
        let mut chained = Stage::new(case, [0.0, -0.1]);
        let points: Vec<[f32; 2]> = (-2..40).map(|i| [20.0 * i as f32, 0.0]).collect();
        chained.simulator.add_body(BodyBuilder::fixed(), [GeomBuilder::chain(points)]).unwrap();
        for mut stage in [stage, chained] {
            stage.run(STILL, 0.1, |_| {});
            stage.run(RIGHT, 0.1, |_| {});
            let start = stage.at().x;
            stage.run(RIGHT, 3.0, |stage| {
                assert!(stage.mover.is_grounded());
                near(stage.height(), 0.0, 0.1);
            });
            near(stage.at().x - start, 450.0, 0.1);
        }
    }
}

/// Level ground, and a one-way ledge 50 above it.
fn with_ledge(case: (GeomBuilder, f32)) -> (Stage, BodyId) {
    let mut stage = Stage::on_ground(case);
    let ledge = GeomBuilder::rectangle(200.0, 10.0).one_way([0.0, -1.0]);
    let (ledge, _) = stage.simulator.add_body(BodyBuilder::fixed().position([0.0, -45.0]), [ledge]).unwrap();
    (stage, ledge)
}

#[test]
fn it_jumps_through_a_one_way_ledge_lands_on_it_and_drops_through_it() {
    for case in cases() {
        let (mut stage, ledge) = with_ledge(case);
        let mut highest = 0.0f32;
        let report = stage.run(JUMP, 1.0, |stage| highest = highest.max(stage.height()));
        assert_eq!(report.ground.map(|ground| ground.body), Some(ledge));
        near(highest, 60.0, 1.1);
        near(stage.height(), 50.0, 0.1);
        stage.run(RIGHT, 0.3, |stage| assert!(stage.mover.is_grounded()));
        let start = stage.height();
        stage.step(MoverInput { drop: true, ..STILL });
        assert!(!stage.mover.is_grounded());
        stage.run(STILL, 0.2, |_| {});
        // It falls freely: g t² / 2.
        let time = (0.2 / stage.dt).round() * stage.dt + stage.dt;
        near(start - stage.height(), 0.5 * GRAVITY * time * time, 0.1);
        stage.run(STILL, 0.5, |_| {});
        near(stage.height(), 0.0, 0.1);
        // Ground that is not one-way stays.
        stage.step(MoverInput { drop: true, ..STILL });
        assert!(stage.mover.is_grounded());
    }
}

#[test]
fn it_walks_through_a_one_way_ledge_from_the_side_and_drops_to_the_next_below() {
    for case in cases() {
        let (mut stage, _) = with_ledge(case);
        stage.run(RIGHT, 1.5, |stage| assert!(stage.height() < 0.1 && stage.mover.velocity().x > 0.0));
        near(stage.at().x, 217.5, 0.1);
        let upper = GeomBuilder::rectangle(200.0, 10.0).one_way([0.0, -1.0]);
        stage.simulator.add_body(BodyBuilder::fixed().position([0.0, -95.0]), [upper]).unwrap();
        stage.mover.set_position([0.0, -131.0]).unwrap();
        stage.run(STILL, 0.3, |_| {});
        near(stage.height(), 100.0, 0.1);
        for below in [50.0, 0.0] {
            stage.step(MoverInput { drop: true, ..STILL });
            stage.run(STILL, 0.6, |_| {});
            near(stage.height(), below, 0.1);
        }
    }
}
