//! The methods of [`Objects`](crate::Objects) again as the simulator's own: so that the arguments of a call may contain another one, as
//! in `simulator.add(simulator.geoms_of(body)[0])`, and so that the documentation lists them.

use super::PhysicsSimulator;
use crate::Result;
use crate::body::{Body, BodyId};
use crate::controllers::{Controller, ControllerId, ControllerType};
use crate::geom::view::GeomRef;
use crate::geom::{Geom, GeomId};
use crate::joints::{Joint, JointId, JointType};
use crate::limits::Limits;
use crate::math::{Matrix, Vector2};
use crate::object_id::ObjectId;
use crate::objects::{GeomPlacement, GeomPointPair, TypedJointId, TypedSpringId};
use crate::shape::Vertices;
use crate::springs::{Spring, SpringId, SpringType};

macro_rules! verbs {
    (
        looking { $(fn $look:ident $(<$of:ident: $kind:ident>)? ($($seen:ident: $seen_type:ty),*) -> $sight:ty;)* }
        changing { $(fn $change:ident $(<$to:ident: $bound:ident>)? ($($name:ident: $type:ty),*) $(-> $result:ty)?;)* }
    ) => {
        /// Operations on the objects: see [`Objects`](crate::Objects).
        #[allow(clippy::missing_errors_doc, reason = "it is where the link leads")]
        impl PhysicsSimulator {
            $(
                #[doc = concat!("[`Objects::", stringify!($look), "`](crate::Objects::", stringify!($look), ")")]
                #[inline]
                pub fn $look $(<$of: $kind>)? (&self, $($seen: $seen_type),*) -> $sight {
                    self.objects.$look$(::<$of>)?($($seen),*)
                }
            )*
            $(
                #[doc = concat!("[`Objects::", stringify!($change), "`](crate::Objects::", stringify!($change), ")")]
                #[inline]
                pub fn $change $(<$to: $bound>)? (&mut self, $($name: $type),*) $(-> $result)? {
                    self.objects.$change$(::<$to>)?($($name),*)
                }
            )*
        }
    };
}

verbs! {
    looking {
        fn body(body: BodyId) -> Option<&Body>;
        fn geom(geom: GeomId) -> Option<GeomRef<'_>>;
        fn geoms_of(body: BodyId) -> &[GeomId];
        fn body_list() -> &[BodyId];
        fn geom_list() -> &[GeomId];
        fn bodies() -> impl Iterator<Item = BodyId> + '_;
        fn geoms() -> impl Iterator<Item = GeomId> + '_;
        fn body_of(geom: GeomId) -> Option<BodyId>;
        fn limits() -> Limits;
        fn is_listed(object: impl Into<ObjectId>) -> bool;
        fn is_disposed(object: impl Into<ObjectId>) -> bool;
        fn joint(joint: JointId) -> Option<&Joint>;
        fn joint_as<J: JointType>(joint: JointId) -> Result<&J>;
        fn typed_joint<J: JointType>(joint: JointId) -> Result<TypedJointId<J>>;
        fn joint_list() -> &[JointId];
        fn joint_current_anchor(joint: JointId) -> Result<Vector2>;
        fn spring(spring: SpringId) -> Option<&Spring>;
        fn spring_as<S: SpringType>(spring: SpringId) -> Result<&S>;
        fn typed_spring<S: SpringType>(spring: SpringId) -> Result<TypedSpringId<S>>;
        fn spring_list() -> &[SpringId];
        fn controller(controller: ControllerId) -> Option<&Controller>;
        fn controller_as<C: ControllerType>(controller: ControllerId) -> Result<&C>;
        fn controller_list() -> &[ControllerId];
        fn geom_collides_with_point(geom: GeomId, point: Vector2) -> bool;
        fn geom_collides_with_geom(geom: GeomId, other: GeomId) -> bool;
        fn line_segment_all_geoms_intersect(point1: Vector2, point2: Vector2, detect_using_aabb: bool) -> Vec<GeomPointPair>;
        fn line_segment_geom_intersect(point1: Vector2, point2: Vector2, geom: GeomId, detect_using_aabb: bool) -> Vec<Vector2>;
    }
    changing {
        fn body_mut(body: BodyId) -> Option<&mut Body>;
        fn geom_mut(geom: GeomId) -> Option<&mut Geom>;
        fn for_each_body_mut(act: impl FnMut(BodyId, &mut Body));
        fn set_limits(limits: Limits);
        fn add(object: impl Into<ObjectId>) -> Result<()>;
        fn remove(object: impl Into<ObjectId>) -> Result<()>;
        fn dispose(object: impl Into<ObjectId>) -> Result<()>;
        fn create_body(body: Body) -> BodyId;
        fn create_geom(body: BodyId, vertices: impl Into<Vertices>, placement: GeomPlacement) -> Result<GeomId>;
        fn clone_geom(body: BodyId, geom: GeomId) -> Result<GeomId>;
        fn clone_geom_with_offset(body: BodyId, geom: GeomId, offset: Vector2, rotation_offset: f32) -> Result<GeomId>;
        fn set_body(geom: GeomId, body: BodyId) -> Result<()>;
        fn set_vertices(geom: GeomId, vertices: impl Into<Vertices>) -> Result<()>;
        fn create_distance_grid(geom: GeomId) -> Result<()>;
        fn remove_distance_grid(geom: GeomId) -> Result<()>;
        fn set_matrix(geom: GeomId, matrix: &Matrix) -> Result<()>;
        fn set_is_sensor(geom: GeomId, is_sensor: bool) -> Result<()>;
        fn ignore_collision_with(geom: GeomId, other: GeomId) -> Result<()>;
        fn restore_collision_with(geom: GeomId, other: GeomId) -> Result<()>;
        fn set_box_radius(geom: GeomId, radius: Option<f32>) -> Result<()>;
        fn create_empty_joint<J: JointType>() -> JointId;
        fn joint_mut(joint: JointId) -> Option<&mut Joint>;
        fn joint_as_mut<J: JointType>(joint: JointId) -> Result<&mut J>;
        fn set_joint_body1(joint: JointId, body: BodyId) -> Result<()>;
        fn set_joint_body2(joint: JointId, body: BodyId) -> Result<()>;
        fn set_joint_anchor(joint: JointId, anchor: Vector2) -> Result<()>;
        fn set_joint_anchor1(joint: JointId, anchor: Vector2) -> Result<()>;
        fn set_joint_anchor2(joint: JointId, anchor: Vector2) -> Result<()>;
        fn create_empty_spring<S: SpringType>() -> SpringId;
        fn spring_mut(spring: SpringId) -> Option<&mut Spring>;
        fn spring_as_mut<S: SpringType>(spring: SpringId) -> Result<&mut S>;
        fn set_spring_body1(spring: SpringId, body: BodyId) -> Result<()>;
        fn set_spring_body2(spring: SpringId, body: BodyId) -> Result<()>;
        fn create_controller(controller: impl Into<Controller>) -> Result<ControllerId>;
        fn controller_mut(controller: ControllerId) -> Option<&mut Controller>;
        fn controller_as_mut<C: ControllerType>(controller: ControllerId) -> Result<&mut C>;
    }
}
