//! Chains, and a vehicle on a track (behaviour chapter 16, section C.2, demos 4 and 5).

use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, ComplexFactory, GeomFactory, GeomPlacement, LinearSpring, LinkType, Path, Result,
    SpringFactory,
};

use super::{AngularDrive, BLACK, GOLD, SampleScene, WHITE, border};

/// Advanced 4: five chains of different links.
pub(super) fn chains_factory() -> Result<SampleScene> {
    let mut scene = SampleScene::new(150.0)?;
    let point = Vector2::new;
    let plain = ComplexFactory::default();
    let soft = ComplexFactory {
        spring_constant: 150.0,
        damping_constant: 10.0,
        spring_rest_length_factor: 1.0,
        ..plain
    };
    let sliding = ComplexFactory { min: 0.0, max: 15.0, ..soft };
    let wide = ComplexFactory {
        spring_constant: 300.0,
        damping_constant: 10.0,
        spring_rest_length_factor: 0.1,
        ..sliding
    };
    let mut group = 0;
    for (factory, link_width, start, end, link_type) in [
        (plain, 20.0, point(150.0, 100.0), point(200.0, 300.0), LinkType::RevoluteJoint),
        (plain, 20.0, point(250.0, 100.0), point(300.0, 300.0), LinkType::PinJoint),
        (soft, 20.0, point(350.0, 100.0), point(400.0, 300.0), LinkType::LinearSpring),
        (sliding, 20.0, point(450.0, 100.0), point(500.0, 300.0), LinkType::SliderJoint),
        (wide, 40.0, point(650.0, 100.0), point(600.0, 600.0), LinkType::LinearSpring),
    ] {
        group += 1;
        let simulator = &mut scene.simulator;
        let mut chain = factory.create_chain_with_link_width_in(
            simulator, start, end, 20.0, 10.0, link_width, 1.0, true, false, link_type,
        )?;
        chain.create_geoms_in(simulator, group)?;
        // Their geoms are half as high.
        for &body in chain.bodies() {
            scene.show_rectangle(body, [20.0, 20.0], WHITE, BLACK);
        }
    }
    border(&mut scene)?;
    Ok(scene)
}

/// Advanced 5: two wheels with a spring between them drive in an endless track.
pub(super) fn path_factory() -> Result<SampleScene> {
    let mut scene = SampleScene::new(100.0)?;
    let centre = Vector2::new(400.0, 500.0);
    let track = track(&mut scene, centre)?;
    for &geom in track.geoms() {
        scene.simulator[geom].set_friction_coefficient(1.0);
        scene.show(geom, WHITE, BLACK);
    }
    let mut geoms = Vec::new();
    let simulator = &mut scene.simulator;
    let mut wheel = |x| {
        let body = BodyFactory::create_circle_body_in(simulator, 45.0, 30.0)?;
        simulator[body].set_position(centre + Vector2::new(x, 0.0));
        let geom = GeomFactory::create_circle_geom_in(simulator, body, 45.0, 36, GeomPlacement::default())?;
        simulator[geom].set_friction_coefficient(1.0);
        geoms.push(geom);
        Ok(body)
    };
    let wheels = [wheel(-50.0)?, wheel(50.0)?];
    let middle = Vector2::zeros();
    let spring = SpringFactory::create_linear_spring_in(
        simulator, wheels[0], middle, wheels[1], middle, 5200.0, 3050.0,
    )?;
    let spring = simulator.spring_as_mut::<LinearSpring>(spring)?;
    spring.set_rest_length(spring.rest_length() + 20.0)?;
    geoms.into_iter().for_each(|geom| scene.show(geom, GOLD, BLACK));
    scene.act(AngularDrive { wheels, impulse: 3500.0 });
    border(&mut scene)?;
    Ok(scene)
}

fn track(scene: &mut SampleScene, centre: Vector2) -> Result<Path> {
    let points = [
        (-15.0, -50.0),
        (-50.0, -50.0),
        (-100.0, -25.0),
        (-100.0, 25.0),
        (-50.0, 50.0),
        (50.0, 50.0),
        (100.0, 25.0),
        (100.0, -25.0),
        (50.0, -50.0),
        (-10.0, -50.0),
    ]
    .map(|(x, y)| centre + Vector2::new(x, y));
    ComplexFactory::default().create_track_in(
        &mut scene.simulator,
        &points,
        20.0,
        10.0,
        3.0,
        true,
        2,
        LinkType::RevoluteJoint,
    )
}
