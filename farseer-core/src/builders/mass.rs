//! Mass, centre of mass and moment of inertia of a body from those of its geoms.

use super::GeomBuilder;
use crate::methods::Methods;
use crate::{Error, Result};

/// Mass properties, in double precision: sums of many geoms keep their digits.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct MassProperties {
    /// Mass in mass units, >= 0.
    pub(crate) mass: f64,
    /// Centre of mass in length units.
    pub(crate) centre: [f64; 2],
    /// Moment of inertia about the centre, in mass units · length units², >= 0.
    pub(crate) inertia: f64,
}

impl MassProperties {
    /// Returns the properties with another mass and the same distribution.
    pub(crate) fn with_mass(self, mass: f64) -> Self {
        let inertia = if self.mass > 0.0 { self.inertia * (mass / self.mass) } else { 0.0 };
        MassProperties { mass, centre: self.centre, inertia }
    }

    /// Returns the properties of a shape that is turned by `rotation` (radians) about its origin and then moved by `offset`
    /// (length units).
    pub(crate) fn placed(self, [x, y]: [f64; 2], rotation: f64) -> Self {
        let (sine, cosine) = (libm::sin(rotation), libm::cos(rotation));
        let [cx, cy] = self.centre;
        MassProperties { centre: [x + cosine * cx - sine * cy, y + sine * cx + cosine * cy], ..self }
    }

    /// Returns the properties of several parts together (parallel axis theorem). The centre of parts without mass is the origin.
    pub(crate) fn sum(parts: &[MassProperties]) -> Self {
        let mass: f64 = parts.iter().map(|part| part.mass).sum();
        if mass <= 0.0 {
            return MassProperties::default();
        }
        let centre =
            [0, 1].map(|axis| parts.iter().map(|part| part.mass * part.centre[axis]).sum::<f64>() / mass);
        let inertia = parts.iter().map(|part| part.inertia_about(centre)).sum();
        MassProperties { mass, centre, inertia }
    }

    /// Returns the moment of inertia about a point, in mass units · length units².
    pub(crate) fn inertia_about(&self, [x, y]: [f64; 2]) -> f64 {
        let [dx, dy] = [self.centre[0] - x, self.centre[1] - y];
        self.inertia + self.mass * (dx * dx + dy * dy)
    }
}

/// Returns the mass properties of a body with these geoms, in the coordinates of the builder. `mass`: the mass that the body is
/// given. Without geoms it has mass 1, and the inertia of a square with sides of one length unit of the methods.
///
/// # Errors
/// A shape that is not possible; geoms without any mass, if none is given.
pub(super) fn of_geoms(geoms: &[GeomBuilder], mass: Option<f32>, methods: Methods) -> Result<MassProperties> {
    let unit = f64::from(methods.length_unit().unwrap_or(1.0));
    let mut parts = Vec::with_capacity(geoms.len());
    let mut areas = Vec::with_capacity(geoms.len());
    let mut spreads = Vec::with_capacity(geoms.len());
    for geom in geoms {
        let offset = [f64::from(geom.offset.x), f64::from(geom.offset.y)];
        let area = geom.shape.of_density_1()?.placed(offset, f64::from(geom.rotation_offset));
        let default = if geom.is_sensor { 0.0 } else { 1.0 / (unit * unit) };
        let density = geom.density.map_or(default, f64::from);
        let spread = geom.shape.spread()?.placed(offset, f64::from(geom.rotation_offset));
        parts.push(match geom.mass {
            Some(mass) => spread.with_mass(f64::from(mass)),
            None => area.with_mass(area.mass * density),
        });
        areas.push(area);
        spreads.push(spread);
    }
    let total = MassProperties::sum(&parts);
    // Sensors have no mass of their own, but a shape.
    let areas = if areas.iter().any(|area| area.mass > 0.0) { &areas } else { &spreads };
    let total = if total.mass > 0.0 { total } else { MassProperties::sum(areas).with_mass(0.0) };
    match mass {
        Some(mass) if total.mass > 0.0 => Ok(total.with_mass(f64::from(mass))),
        Some(mass) => Ok(MassProperties::sum(areas).with_mass(f64::from(mass)).or_square(unit)),
        None if geoms.is_empty() => Ok(MassProperties { mass: 1.0, ..total }.or_square(unit)),
        None if total.mass > 0.0 => Ok(total),
        None => Err(Error::invalid(
            "density",
            0.0,
            "greater than 0 for a geom with an area, unless the body or a geom has a mass",
        )),
    }
}

impl MassProperties {
    /// Returns the properties, with the moment of inertia of a square if there is none. `side` in length units.
    fn or_square(self, side: f64) -> Self {
        let inertia = if self.inertia > 0.0 { self.inertia } else { self.mass * side * side / 6.0 };
        MassProperties { inertia, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::{GeomBuilder, MassProperties, of_geoms};
    use crate::Methods;

    fn near(a: MassProperties, b: MassProperties) -> bool {
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-5 * (1.0 + b.abs());
        close(a.mass, b.mass)
            && close(a.centre[0], b.centre[0])
            && close(a.centre[1], b.centre[1])
            && close(a.inertia, b.inertia)
    }

    #[test]
    fn a_rectangle_of_two_halves_has_the_properties_of_the_whole() {
        let whole =
            of_geoms(&[GeomBuilder::rectangle(8.0, 4.0).density(2.0)], None, Methods::default()).unwrap();
        let half = GeomBuilder::rectangle(4.0, 4.0).density(2.0);
        let halves = [half.clone().offset([-2.0, 0.0]), half.offset([2.0, 0.0])];
        assert!(near(of_geoms(&halves, None, Methods::default()).unwrap(), whole));
        let corners = [[-4.0, -2.0], [4.0, -2.0], [4.0, 2.0], [-4.0, 2.0]];
        let polygon = GeomBuilder::polygon(corners).density(2.0);
        assert!(near(of_geoms(&[polygon], None, Methods::default()).unwrap(), whole));
    }

    #[test]
    fn a_concave_polygon_in_either_direction_has_the_properties_of_its_parts() {
        // An L of two rectangles, away from the origin.
        let mut corners =
            [[10.0, 10.0], [14.0, 10.0], [14.0, 12.0], [12.0, 12.0], [12.0, 16.0], [10.0, 16.0]];
        let parts = [
            GeomBuilder::rectangle(4.0, 2.0).offset([12.0, 11.0]).density(1.0),
            GeomBuilder::rectangle(2.0, 4.0).offset([11.0, 14.0]).density(1.0),
        ];
        let expected = of_geoms(&parts, None, Methods::default()).unwrap();
        for _ in 0..2 {
            corners.reverse();
            let polygon = [GeomBuilder::polygon(corners).density(1.0)];
            assert!(near(of_geoms(&polygon, None, Methods::default()).unwrap(), expected));
        }
    }

    #[test]
    fn a_turned_part_lies_where_its_geom_lies() {
        let tall = [GeomBuilder::rectangle(2.0, 6.0).offset([1.0, 5.0]).density(1.0)];
        let turned = GeomBuilder::rectangle(6.0, 2.0).rotation_offset(std::f32::consts::FRAC_PI_2);
        let turned = [turned.offset([1.0, 5.0]).density(1.0)];
        let [tall, turned] = [&tall, &turned].map(|geoms| of_geoms(geoms, None, Methods::default()).unwrap());
        assert!(near(turned, tall));
    }

    #[test]
    fn a_given_mass_keeps_the_proportions() {
        let parts =
            [GeomBuilder::circle(1.0).mass(3.0), GeomBuilder::circle(1.0).mass(1.0).offset([4.0, 0.0])];
        let body = of_geoms(&parts, Some(8.0), Methods::default()).unwrap();
        assert!((body.mass - 8.0).abs() < 1e-9 && (body.centre[0] - 1.0).abs() < 1e-6);
    }
}
