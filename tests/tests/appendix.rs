//! Every member of the thesis' API (appendix A, and the two of section 3.3) has its place here: the table of
//! `docs/twohalf-appendix.csv`, and that what it names exists.

use std::collections::BTreeSet;

use farseer_core::{Body, BodyId, CollisionCategory, Geom, GeomId, GeomPlacement, GeomRef, Vertices};
use twohalf::{
    Context, EventHandler, Ground, GroundMut, Partner, Platform, PlatformId, Result, TextureId, TwoHalfBody,
    TwoHalfGeom, TwoHalfPhysicsSimulator, Vector2, Vector3,
};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};
use twohalf_render::DrawBody;

const TABLE: &str = include_str!("../../docs/twohalf-appendix.csv");
/// Members of the thesis' API.
const MEMBERS: usize = 95;

type Simulator = TwoHalfPhysicsSimulator;
type BodyView = TwoHalfBody<&'static mut Simulator>;
type GroundView = GroundMut<'static, &'static mut Simulator>;

/// A handler that leaves everything as it is.
struct Silent;
impl EventHandler for Silent {}

/// Texts of paths, each of which the compiler has found, with the type that is given for it; methods of traits on the
/// type that implements them.
macro_rules! existing {
    (@one ($type:ty) $crate_name:ident::$trait:ident::$method:ident) => {{
        let _ = <$type as $crate_name::$trait>::$method;
        concat!(stringify!($crate_name), "::", stringify!($trait), "::", stringify!($method))
    }};
    (@one [$type:ty] $path:path) => {{
        let _: $type = $path;
        stringify!($path)
    }};
    ($($path:tt $($more:ident)::* : $type:tt,)*) => { () };
}
