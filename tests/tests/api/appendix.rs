//! Every member of the thesis' API has its place here: appendix A, and what section 3.3 adds. The table is
//! `docs/twohalf-appendix.csv`; what it names exists, as far as a compiler can tell.

use std::collections::BTreeSet;

use farseer_core::{Body, BodyId, CollisionCategory, Geom, GeomId, GeomPlacement, GeomRef, Vertices};
use twohalf::{
    EventHandler, Ground, GroundMut, Partner, PlatformId, Result, TextureId, TwoHalfBody, TwoHalfGeom,
    TwoHalfPhysicsSimulator, Vector2, Vector3,
};

const TABLE: &str = include_str!("../../../docs/twohalf-appendix.csv");
/// Members of the thesis' API.
const MEMBERS: usize = 95;
/// Columns of the table.
const COLUMNS: [&str; 6] = ["type", "member", "member_kind", "signature", "rust", "note"];

type Simulator = TwoHalfPhysicsSimulator;
type BodyView = TwoHalfBody<&'static mut Simulator>;
type GroundView = GroundMut<'static, &'static mut Simulator>;

/// A handler that leaves everything as it is.
struct Silent;
impl EventHandler for Silent {}

/// The text of a path that exists and has a type, or of a method of a trait that a type implements.
macro_rules! path {
    ($path:path: $type:ty) => {{
        let _: $type = $path;
        stringify!($path)
    }};
    ($crate_name:ident::$trait:ident::$method:ident of $type:ty) => {{
        let _ = <$type as $crate_name::$trait>::$method;
        concat!(stringify!($crate_name), "::", stringify!($trait), "::", stringify!($method))
    }};
}

/// What the table names, in its order.
#[expect(clippy::type_complexity, reason = "these are the types of the thesis' members")]
fn named() -> Vec<&'static str> {
    vec![
        path!(twohalf::TwoHalfPhysicsSimulator::new: fn(i32) -> Result<Simulator>),
        path!(twohalf::TwoHalfPhysicsSimulator::with_angle: fn(i32, i32) -> Result<Simulator>),
        path!(twohalf::TwoHalfPhysicsSimulator::with_gravity: fn(i32, Vector2) -> Result<Simulator>),
        path!(
            twohalf::TwoHalfPhysicsSimulator::with_angle_and_gravity:
                fn(i32, i32, Vector2) -> Result<Simulator>
        ),
        path!(twohalf::TwoHalfPhysicsSimulator::enabled: fn(&Simulator) -> bool),
        path!(twohalf::TwoHalfPhysicsSimulator::set_enabled: fn(&mut Simulator, bool)),
        path!(twohalf::TwoHalfPhysicsSimulator::gravity: fn(&Simulator) -> Vector2),
        path!(twohalf::TwoHalfPhysicsSimulator::set_gravity: fn(&mut Simulator, Vector2) -> Result<()>),
        path!(twohalf::TwoHalfPhysicsSimulator::iterations: fn(&Simulator) -> i32),
        path!(twohalf::TwoHalfPhysicsSimulator::set_iterations: fn(&mut Simulator, i32)),
        path!(twohalf::TwoHalfPhysicsSimulator::max_contacts_to_detect: fn(&Simulator) -> i32),
        path!(twohalf::TwoHalfPhysicsSimulator::set_max_contacts_to_detect: fn(&mut Simulator, i32)),
        path!(twohalf::TwoHalfPhysicsSimulator::max_contacts_to_resolve: fn(&Simulator) -> i32),
        path!(
            twohalf::TwoHalfPhysicsSimulator::set_max_contacts_to_resolve:
                fn(&mut Simulator, i32) -> Result<()>
        ),
        path!(twohalf::TwoHalfPhysicsSimulator::add: fn(&mut Simulator, GeomId) -> Result<()>),
        path!(twohalf::TwoHalfPhysicsSimulator::add: fn(&mut Simulator, BodyId) -> Result<()>),
        path!(twohalf::TwoHalfPhysicsSimulator::clear: fn(&mut Simulator)),
        path!(twohalf::TwoHalfPhysicsSimulator::collide: fn(&Simulator, Vector2) -> Option<GeomId>),
        path!(twohalf::TwoHalfPhysicsSimulator::collide_all: fn(&Simulator, Vector2) -> Vec<GeomId>),
        path!(twohalf::TwoHalfPhysicsSimulator::remove: fn(&mut Simulator, GeomId) -> Result<()>),
        path!(twohalf::TwoHalfPhysicsSimulator::remove: fn(&mut Simulator, BodyId) -> Result<()>),
        path!(twohalf::TwoHalfPhysicsSimulator::update: fn(&mut Simulator, f32)),
        path!(twohalf::TwoHalfPhysicsSimulator::height: fn(&Simulator) -> i32),
        path!(twohalf::TwoHalfPhysicsSimulator::set_height: fn(&mut Simulator, i32) -> Result<()>),
        path!(twohalf::TwoHalfPhysicsSimulator::angle: fn(&Simulator) -> i32),
        path!(twohalf::TwoHalfPhysicsSimulator::body_list: fn(&Simulator) -> &[BodyId]),
        path!(twohalf::TwoHalfPhysicsSimulator::geom_list: fn(&Simulator) -> &[GeomId]),
        path!(twohalf::TwoHalfPhysicsSimulator::update_time: fn(&Simulator) -> f32),
        path!(twohalf::TwoHalfPhysicsSimulator::update_timed: fn(&mut Simulator, f32, fn() -> f64)),
        path!(twohalf::TwoHalfPhysicsSimulator::create_body: fn(&mut Simulator, Body) -> BodyId),
        path!(twohalf::TwoHalfPhysicsSimulator::clone_body: fn(&mut Simulator, BodyId) -> Result<BodyId>),
        path!(twohalf::TwoHalfBody::angular_velocity: fn(&BodyView) -> f32),
        path!(twohalf::TwoHalfBody::set_angular_velocity: fn(&mut BodyView, f32)),
        path!(twohalf::TwoHalfBody::enabled: fn(&BodyView) -> bool),
        path!(twohalf::TwoHalfBody::set_enabled: fn(&mut BodyView, bool)),
        path!(twohalf::TwoHalfBody::ignore_gravity: fn(&BodyView) -> bool),
        path!(twohalf::TwoHalfBody::set_ignore_gravity: fn(&mut BodyView, bool)),
        path!(twohalf::TwoHalfBody::linear_drag_coefficient: fn(&BodyView) -> f32),
        path!(twohalf::TwoHalfBody::set_linear_drag_coefficient: fn(&mut BodyView, f32)),
        path!(twohalf::TwoHalfBody::linear_velocity: fn(&BodyView) -> Vector2),
        path!(twohalf::TwoHalfBody::set_linear_velocity: fn(&mut BodyView, Vector2)),
        path!(twohalf::TwoHalfBody::rotational_drag_coefficient: fn(&BodyView) -> f32),
        path!(twohalf::TwoHalfBody::set_rotational_drag_coefficient: fn(&mut BodyView, f32)),
        path!(twohalf::TwoHalfBody::tag: fn(&BodyView) -> u64),
        path!(twohalf::TwoHalfBody::set_tag: fn(&mut BodyView, u64)),
        path!(twohalf_render::DrawBody::draw_shadow of Simulator),
        path!(twohalf::TwoHalfBody::apply_angular_impulse: fn(&mut BodyView, f32)),
        path!(twohalf::TwoHalfBody::apply_force: fn(&mut BodyView, Vector2)),
        path!(twohalf::TwoHalfBody::apply_impulse: fn(&mut BodyView, Vector2)),
        path!(twohalf::TwoHalfBody::apply_torque: fn(&mut BodyView, f32)),
        path!(twohalf::TwoHalfBody::clear_force: fn(&mut BodyView)),
        path!(twohalf::TwoHalfBody::clear_impulse: fn(&mut BodyView)),
        path!(twohalf::TwoHalfBody::clear_torque: fn(&mut BodyView)),
        path!(twohalf::TwoHalfPhysicsSimulator::dispose: fn(&mut Simulator, BodyId) -> Result<()>),
        path!(twohalf::TwoHalfBody::ground: fn(&BodyView) -> &Ground),
        path!(twohalf::TwoHalfBody::ground_mut: fn(&mut BodyView) -> GroundMut<'_, &'static mut Simulator>),
        path!(twohalf::TwoHalfBody::layer_depth: fn(&BodyView) -> f32),
        path!(twohalf::TwoHalfBody::position3d: fn(&BodyView) -> Vector3),
        path!(twohalf::TwoHalfBody::set_position3d: fn(&mut BodyView, Vector3)),
        path!(twohalf::TwoHalfBody::force: fn(&BodyView) -> Vector2),
        path!(twohalf::TwoHalfBody::inverse_mass: fn(&BodyView) -> f32),
        path!(twohalf::TwoHalfBody::is_disposed: fn(&BodyView) -> bool),
        path!(twohalf::TwoHalfPhysicsSimulator::dispose: fn(&mut Simulator, BodyId) -> Result<()>),
        path!(twohalf::TwoHalfBody::is_static: fn(&BodyView) -> bool),
        path!(twohalf::TwoHalfBody::set_is_static: fn(&mut BodyView, bool)),
        path!(twohalf::TwoHalfBody::mass: fn(&BodyView) -> f32),
        path!(twohalf::TwoHalfBody::set_mass: fn(&mut BodyView, f32) -> Result<()>),
        path!(twohalf::TwoHalfBody::position: fn(&BodyView) -> Vector2),
        path!(twohalf::TwoHalfBody::set_position: fn(&mut BodyView, Vector2)),
        path!(twohalf::TwoHalfBody::rotation: fn(&BodyView) -> f32),
        path!(twohalf::TwoHalfBody::set_rotation: fn(&mut BodyView, f32)),
        path!(twohalf::TwoHalfBody::torque: fn(&BodyView) -> f32),
        path!(twohalf::TwoHalfBody::apply_force_z: fn(&mut BodyView, f32)),
        path!(twohalf::TwoHalfBody::linear_velocity_z: fn(&BodyView) -> f32),
        path!(twohalf::TwoHalfBody::set_linear_velocity_z: fn(&mut BodyView, f32)),
        path!(farseer_core::Geom::default: fn() -> Geom),
        path!(
            twohalf::TwoHalfPhysicsSimulator::clone_geom:
                fn(&mut Simulator, BodyId, GeomId) -> Result<GeomId>
        ),
        path!(
            twohalf::TwoHalfPhysicsSimulator::create_geom:
                fn(&mut Simulator, BodyId, Vertices, GeomPlacement) -> Result<GeomId>
        ),
        path!(farseer_core::Geom::collides_with: fn(&Geom) -> CollisionCategory),
        path!(farseer_core::Geom::set_collides_with: fn(&mut Geom, CollisionCategory)),
        path!(farseer_core::Geom::collision_categories: fn(&Geom) -> CollisionCategory),
        path!(farseer_core::Geom::set_collision_categories: fn(&mut Geom, CollisionCategory)),
        path!(farseer_core::Geom::collision_enabled: fn(&Geom) -> bool),
        path!(farseer_core::Geom::set_collision_enabled: fn(&mut Geom, bool)),
        path!(farseer_core::Geom::collision_group: fn(&Geom) -> i32),
        path!(farseer_core::Geom::set_collision_group: fn(&mut Geom, i32)),
        path!(farseer_core::Geom::collision_response_enabled: fn(&Geom) -> bool),
        path!(farseer_core::Geom::set_collision_response_enabled: fn(&mut Geom, bool)),
        path!(farseer_core::Geom::friction_coefficient: fn(&Geom) -> f32),
        path!(farseer_core::Geom::set_friction_coefficient: fn(&mut Geom, f32)),
        path!(farseer_core::Geom::restitution_coefficient: fn(&Geom) -> f32),
        path!(farseer_core::Geom::set_restitution_coefficient: fn(&mut Geom, f32)),
        path!(farseer_core::Geom::tag: fn(&Geom) -> u64),
        path!(farseer_core::Geom::set_tag: fn(&mut Geom, u64)),
        path!(twohalf::EventHandler::on_collision of Silent),
        path!(twohalf::EventHandler::on_separation of Silent),
        path!(twohalf::TwoHalfGeom::collides_with_geom: fn(&TwoHalfGeom<'static>, GeomId) -> bool),
        path!(twohalf::TwoHalfGeom::collides_with_point: fn(&TwoHalfGeom<'static>, Vector2) -> bool),
        path!(twohalf::TwoHalfPhysicsSimulator::dispose: fn(&mut Simulator, GeomId) -> Result<()>),
        path!(twohalf::TwoHalfPhysicsSimulator::set_body: fn(&mut Simulator, GeomId, BodyId) -> Result<()>),
        path!(twohalf::TwoHalfGeom::is_ground: fn(&TwoHalfGeom<'static>) -> bool),
        path!(twohalf::Partner::is_ground: fn(&Partner) -> bool),
        path!(farseer_core::GeomRef::body: fn(&GeomRef<'static>) -> BodyId),
        path!(farseer_core::GeomRef::is_disposed: fn(&GeomRef<'static>) -> bool),
        path!(twohalf::TwoHalfPhysicsSimulator::dispose: fn(&mut Simulator, GeomId) -> Result<()>),
        path!(farseer_core::GeomRef::is_sensor: fn(&GeomRef<'static>) -> bool),
        path!(
            twohalf::TwoHalfPhysicsSimulator::set_is_sensor:
                fn(&mut Simulator, GeomId, bool) -> Result<()>
        ),
        path!(twohalf::TwoHalfGeom::position: fn(&TwoHalfGeom<'static>) -> Vector2),
        path!(farseer_core::GeomRef::rotation: fn(&GeomRef<'static>) -> f32),
        path!(
            twohalf_factories::TwoHalfBodyFactory::clone_body:
                fn(&mut Simulator, BodyId) -> Result<BodyId>
        ),
        path!(
            twohalf_factories::TwoHalfBodyFactory::create_body:
                fn(&mut Simulator, f32, f32) -> Result<BodyId>
        ),
        path!(
            twohalf_factories::TwoHalfBodyFactory::create_circle_body:
                fn(&mut Simulator, f32, f32) -> Result<BodyId>
        ),
        path!(
            twohalf_factories::TwoHalfBodyFactory::create_ellipse_body:
                fn(&mut Simulator, f32, f32, f32) -> Result<BodyId>
        ),
        path!(
            twohalf_factories::TwoHalfBodyFactory::create_polygon_body:
                fn(&mut Simulator, Vertices, f32) -> Result<BodyId>
        ),
        path!(
            twohalf_factories::TwoHalfBodyFactory::create_rectangle_body:
                fn(&mut Simulator, f32, f32, f32) -> Result<BodyId>
        ),
        path!(
            twohalf_factories::TwoHalfGeomFactory::create_geom:
                fn(&mut Simulator, BodyId, GeomId) -> Result<GeomId>
        ),
        path!(
            twohalf_factories::TwoHalfGeomFactory::create_geom_in:
                fn(&mut Simulator, BodyId, GeomId) -> Result<GeomId>
        ),
        path!(
            twohalf_factories::TwoHalfGeomFactory::create_circle_geom:
                fn(&mut Simulator, BodyId, f32, i32) -> Result<GeomId>
        ),
        path!(
            twohalf_factories::TwoHalfGeomFactory::create_ellipse_geom:
                fn(&mut Simulator, BodyId, f32, f32, i32) -> Result<GeomId>
        ),
        path!(
            twohalf_factories::TwoHalfGeomFactory::create_polygon_geom:
                fn(&mut Simulator, BodyId, Vertices, f32) -> Result<GeomId>
        ),
        path!(
            twohalf_factories::TwoHalfGeomFactory::create_rectangle_geom:
                fn(&mut Simulator, BodyId, f32, f32) -> Result<GeomId>
        ),
        path!(twohalf::Ground::object_geom: fn(&Ground) -> Option<GeomId>),
        path!(twohalf::Ground::restitution_coefficient: fn(&Ground) -> f32),
        path!(twohalf::GroundMut::set_restitution_coefficient: fn(&mut GroundView, f32)),
        path!(twohalf::Ground::friction_coefficient: fn(&Ground) -> f32),
        path!(twohalf::GroundMut::set_friction_coefficient: fn(&mut GroundView, f32)),
        path!(
            twohalf::GroundMut::set_object_geom:
                fn(&mut GroundView, GeomId, Option<TextureId>) -> Result<()>
        ),
        path!(
            twohalf::Platform::new:
                fn(&mut Simulator, f32, f32, f32, Vector3, Option<TextureId>) -> Result<PlatformId>
        ),
        path!(
            twohalf::Platform::with_rotation:
                fn(&mut Simulator, f32, f32, f32, Vector3, f32, Option<TextureId>) -> Result<PlatformId>
        ),
        path!(
            twohalf::Platform::with_rotation_and_angle:
                fn(&mut Simulator, f32, f32, f32, Vector3, f32, Option<TextureId>, i32) -> Result<PlatformId>
        ),
    ]
}

/// The rows below the head.
fn rows() -> Vec<[String; COLUMNS.len()]> {
    conformance::table::rows(TABLE, COLUMNS)
}

#[test]
fn appendix_table_maps_every_member_once() {
    let rows = rows();
    let members: BTreeSet<_> = rows.iter().map(|[of, member, ..]| (of, member)).collect();
    let is_mapped = |row: &&[String; COLUMNS.len()]| row[4].split(' ').all(|path| path.contains("::"));
    let mapped = rows.iter().filter(is_mapped).count();
    println!("appendix coverage: {mapped} of {MEMBERS}");
    assert_eq!((rows.len(), members.len(), mapped), (MEMBERS, MEMBERS, MEMBERS));
}

#[test]
fn appendix_table_names_what_exists() {
    let rows = rows();
    let in_table: Vec<&str> = rows.iter().flat_map(|row| row[4].split(' ')).collect();
    assert_eq!(in_table, named());
}

#[test]
fn appendix_properties_that_can_be_set_have_a_setter() {
    for [of, member, kind, signature, rust, _] in &rows() {
        let is_event = signature.ends_with("EventHandler");
        if (kind == "field" && !is_event) || signature.ends_with("get/set") {
            let paths: Vec<&str> = rust.split(' ').collect();
            let sets = |path: &str| path.contains("::set_") || path.ends_with("::dispose");
            assert!(paths.len() == 2 && !sets(paths[0]) && sets(paths[1]), "{of}.{member}: {rust}");
        }
    }
}
