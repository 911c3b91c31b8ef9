//! Which geoms a query finds.

use super::exists;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::methods::CollisionCategory;
use crate::objects::Objects;

/// Which geoms a query finds. Geoms of disabled bodies, and disposed ones, are never found.
///
/// ```
/// use farseer_core::{CollisionCategory, QueryFilter};
/// let walls = QueryFilter { categories: CollisionCategory::CAT2, dynamic: false, ..QueryFilter::default() };
/// assert!(walls.kinematic && !walls.sensors);
/// ```
#[derive(Clone, Copy)]
pub struct QueryFilter<'a> {
    /// Geoms of at least one of these categories are found. Default all.
    pub categories: CollisionCategory,
    /// The categories of the query itself: geoms that [collide with](crate::Geom::collides_with) none of them are not found.
    /// Default all.
    pub as_categories: CollisionCategory,
    /// Whether geoms of static bodies are found. Default true.
    pub fixed: bool,
    /// Whether geoms of kinematic bodies are found. Default true.
    pub kinematic: bool,
    /// Whether geoms of dynamic bodies are found. Default true.
    pub dynamic: bool,
    /// Whether sensors, and other geoms without collision response, are found. Default false.
    pub sensors: bool,
    /// A body that is not found, such as that of the figure that looks. Default none.
    pub exclude_body: Option<BodyId>,
    /// A geom that is not found. Default none.
    pub exclude_geom: Option<GeomId>,
    /// A further test: geoms for which it returns false are not found. Default none.
    pub accepts: Option<&'a dyn Fn(GeomId) -> bool>,
}

impl Default for QueryFilter<'_> {
    fn default() -> Self {
        QueryFilter {
            categories: CollisionCategory::ALL,
            as_categories: CollisionCategory::ALL,
            fixed: true,
            kinematic: true,
            dynamic: true,
            sensors: false,
            exclude_body: None,
            exclude_geom: None,
            accepts: None,
        }
    }
}

impl std::fmt::Debug for QueryFilter<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("QueryFilter")
            .field("categories", &self.categories)
            .field("as_categories", &self.as_categories)
            .field("kinds", &[self.fixed, self.kinematic, self.dynamic])
            .field("sensors", &self.sensors)
            .field("exclude_body", &self.exclude_body)
            .field("exclude_geom", &self.exclude_geom)
            .field("accepts", &self.accepts.is_some())
            .finish()
    }
}

impl QueryFilter<'_> {
    /// Whether a geom may be found.
    pub(super) fn admits(&self, objects: &Objects, id: GeomId) -> bool {
        let Some(geom) = objects.geom(id).filter(|_| exists(objects, id)) else { return false };
        let Some(body) = objects.body(geom.body()).filter(|body| body.enabled()) else { return false };
        let is_wanted = match (body.is_static(), body.is_kinematic()) {
            (true, _) => self.fixed,
            (_, true) => self.kinematic,
            _ => self.dynamic,
        };
        is_wanted
            && (self.sensors || geom.collision_response_enabled())
            && geom.collision_categories().intersects(self.categories)
            && geom.collides_with().intersects(self.as_categories)
            && self.exclude_geom != Some(id)
            && self.exclude_body != Some(geom.body())
            && self.accepts.is_none_or(|accepts| accepts(id))
    }
}
