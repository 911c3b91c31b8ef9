//! Objects of options that JavaScript has left as rows of numbers: NaN stands for an option that was not given.

use farseer_core::math::Vector2;
use farseer_core::{BodyBuilder, Explosion, GeomBuilder, MoverOptions, QueryFilter, WantedEvents};

use crate::boundary::{Argument, Outcome, invalid, with_numbers};

/// Numbers that are still to be read.
pub(crate) struct Fields {
    numbers: std::vec::IntoIter<f64>,
}

impl Fields {
    /// The numbers that JavaScript has left.
    pub(crate) fn left() -> Self {
        Fields { numbers: with_numbers(<[f64]>::to_vec).into_iter() }
    }

    fn next(&mut self) -> f64 {
        self.numbers.next().unwrap_or(f64::NAN)
    }

    /// The next number, or `None` if it was not given.
    pub(crate) fn maybe<T: Argument>(&mut self, name: &'static str) -> Outcome<Option<T>> {
        let number = self.next();
        if number.is_nan() { Ok(None) } else { read(name, number).map(Some) }
    }

    /// The next number.
    pub(crate) fn get<T: Argument>(&mut self, name: &'static str) -> Outcome<T> {
        read(name, self.next())
    }

    /// The next two numbers.
    pub(crate) fn point(&mut self, name: &'static str) -> Outcome<Vector2> {
        Ok(Vector2::new(self.get(name)?, self.get(name)?))
    }

    fn maybe_point(&mut self, name: &'static str) -> Outcome<Option<Vector2>> {
        let (x, y) = (self.maybe(name)?, self.maybe(name)?);
        Ok(x.zip(y).map(|(x, y)| Vector2::new(x, y)))
    }

    /// Overwrites an option that was given.
    fn set<T: Argument>(&mut self, name: &'static str, option: &mut T) -> Outcome {
        if let Some(value) = self.maybe(name)? {
            *option = value;
        }
        Ok(())
    }

    /// A body.
    pub(crate) fn body(&mut self) -> Outcome<BodyBuilder> {
        let mut body = match self.get::<usize>("type")? {
            0 => BodyBuilder::dynamic(),
            1 => BodyBuilder::kinematic(),
            _ => BodyBuilder::fixed(),
        };
        macro_rules! options {
            ($($read:ident $method:ident $name:literal;)*) => {$(
                if let Some(value) = self.$read($name)? {
                    body = body.$method(value);
                }
            )*};
        }
        options! {
            maybe_point position "position";
            maybe rotation "rotation";
            maybe_point linear_velocity "linearVelocity";
            maybe angular_velocity "angularVelocity";
            maybe linear_damping "linearDamping";
            maybe angular_damping "angularDamping";
            maybe gravity_scale "gravityScale";
            maybe mass "mass";
            maybe moment_of_inertia "momentOfInertia";
            maybe lock_rotation "lockRotation";
            maybe bullet "bullet";
            maybe sleep_allowed "sleepAllowed";
            maybe starts_asleep "startsAsleep";
            maybe sleep_events "sleepEvents";
            maybe enabled "enabled";
        }
        Ok(body)
    }

    /// A shape: its kind, and the count of its numbers before these.
    fn shape(&mut self) -> Outcome<GeomBuilder> {
        let (kind, count) = (self.get::<usize>("shape")?, self.get::<usize>("shape")?);
        let points =
            |fields: &mut Self| (0..count / 2).map(|_| fields.point("points")).collect::<Outcome<Vec<_>>>();
        Ok(match kind {
            0 => GeomBuilder::rectangle(self.get("width")?, self.get("height")?),
            1 => GeomBuilder::circle(self.get("radius")?),
            2 => GeomBuilder::capsule(self.get("height")?, self.get("endRadius")?),
            3 => GeomBuilder::polygon(points(self)?),
            _ => GeomBuilder::chain(points(self)?),
        })
    }

    /// A geom.
    pub(crate) fn geom(&mut self) -> Outcome<GeomBuilder> {
        let mut geom = self.shape()?;
        macro_rules! options {
            ($($read:ident $method:ident $name:literal;)*) => {$(
                if let Some(value) = self.$read($name)? {
                    geom = geom.$method(value);
                }
            )*};
        }
        options! {
            maybe_point offset "offset";
            maybe rotation_offset "rotationOffset";
            maybe density "density";
            maybe mass "mass";
            maybe friction "friction";
            maybe restitution "restitution";
            maybe categories "categories";
            maybe collides_with "collidesWith";
            maybe group "group";
            maybe sensor "sensor";
            maybe events "events";
            maybe_point one_way "oneWay";
        }
        Ok(geom)
    }

    /// A filter of queries.
    pub(crate) fn filter(&mut self) -> Outcome<QueryFilter<'static>> {
        let mut filter = QueryFilter::default();
        self.set("categories", &mut filter.categories)?;
        self.set("asCategories", &mut filter.as_categories)?;
        self.set("fixed", &mut filter.fixed)?;
        self.set("kinematic", &mut filter.kinematic)?;
        self.set("dynamic", &mut filter.dynamic)?;
        self.set("sensors", &mut filter.sensors)?;
        filter.exclude_body = self.maybe("excludeBody")?;
        filter.exclude_geom = self.maybe("excludeGeom")?;
        Ok(filter)
    }

    /// An explosion.
    pub(crate) fn explosion(&mut self) -> Outcome<Explosion<'static>> {
        Ok(Explosion {
            position: self.point("position")?,
            radius: self.get("radius")?,
            falloff: self.get("falloff")?,
            strength: self.get("strength")?,
            filter: self.filter()?,
        })
    }

    /// Overwrites the options of a mover that were given.
    pub(crate) fn mover_options(&mut self, options: &mut MoverOptions) -> Outcome {
        let MoverOptions {
            acceleration,
            air_acceleration,
            gravity_scale,
            jump_height,
            jump_cut,
            coyote_time,
            jump_buffer,
            max_slope,
            step_up,
            snap,
            push_force,
            mass,
            categories,
            as_categories,
        } = options;
        self.set("acceleration", acceleration)?;
        self.set("airAcceleration", air_acceleration)?;
        self.set("gravityScale", gravity_scale)?;
        self.set("jumpHeight", jump_height)?;
        self.set("jumpCut", jump_cut)?;
        self.set("coyoteTime", coyote_time)?;
        self.set("jumpBuffer", jump_buffer)?;
        self.set("maxSlope", max_slope)?;
        self.set("stepUp", step_up)?;
        self.set("snap", snap)?;
        self.set("pushForce", push_force)?;
        self.set("mass", mass)?;
        self.set("categories", categories)?;
        self.set("asCategories", as_categories)
    }
}

fn read<T: Argument>(name: &'static str, number: f64) -> Outcome<T> {
    T::read(number).ok_or_else(|| invalid(name, number, T::REQUIREMENT))
}

impl Argument for WantedEvents {
    const REQUIREMENT: &'static str = usize::REQUIREMENT;

    fn read(number: f64) -> Option<Self> {
        let bits = usize::read(number)?;
        let wanted = [WantedEvents::TOUCH, WantedEvents::SENSOR, WantedEvents::HIT];
        let set = (0..).zip(wanted).filter(|(at, _)| bits >> at & 1 == 1);
        Some(set.fold(WantedEvents::NONE, |all, (_, event)| all | event))
    }
}
