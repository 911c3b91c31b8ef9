//! Calls that make joints and springs.

use farseer_core::math::Vector2;
use farseer_core::{BodyId, Error, JointFactory, JointId, Objects, SpringFactory, SpringId};

use crate::random::Random;

/// A function that makes a joint or spring between two bodies and returns its id.
pub(crate) type Make<I> = fn(&mut Objects, [BodyId; 2], &mut Random) -> Result<I, Error>;

fn points(random: &mut Random) -> [Vector2; 2] {
    [random.vector(10.0), random.vector(10.0)]
}

/// Functions that make joints. Pins and sliders come first, and twice, because they act along all three axes.
pub(crate) const JOINTS: &[Make<JointId>] = &[
    |objects, [a, b], random| {
        let [one, other] = points(random);
        JointFactory::create_pin_joint(objects, a, one, b, other)
    },
    |objects, [a, b], random| {
        let [one, other] = points(random);
        let (min, max) = (random.number(0.0, 20.0), random.number(20.0, 80.0));
        JointFactory::create_slider_joint(objects, a, one, b, other, min, max)
    },
    |objects, [a, b], _| JointFactory::create_pin_joint(objects, a, Vector2::zeros(), b, Vector2::zeros()),
    |objects, [a, b], random| {
        let max = random.number(10.0, 80.0);
        JointFactory::create_slider_joint(objects, a, Vector2::zeros(), b, Vector2::zeros(), 0.0, max)
    },
    |objects, [a, b], random| JointFactory::create_revolute_joint(objects, a, b, random.vector(100.0)),
    |objects, [a, _], random| JointFactory::create_fixed_revolute_joint(objects, a, random.vector(100.0)),
    |objects, [a, b], random| JointFactory::create_weld_joint(objects, a, b, random.vector(100.0)),
    |objects, [a, b], random| {
        JointFactory::create_prismatic_joint(objects, a, b, random.vector(100.0), random.vector(1.0))
    },
    |objects, [a, b], _| JointFactory::create_angle_joint(objects, a, b),
    |objects, [a, b], random| {
        JointFactory::create_angle_limit_joint(
            objects,
            a,
            b,
            random.number(-2.0, 0.0),
            random.number(0.0, 2.0),
        )
    },
];

pub(crate) const SPRINGS: &[Make<SpringId>] = &[
    |objects, [a, b], random| {
        let [one, other] = points(random);
        let (spring, damping) = (random.number(0.0, 100.0), random.number(0.0, 5.0));
        SpringFactory::create_linear_spring(objects, a, one, b, other, spring, damping)
    },
    |objects, [a, _], random| {
        let (point, of_world) = (random.vector(10.0), random.vector(100.0));
        let (spring, damping) = (random.number(0.0, 100.0), random.number(0.0, 5.0));
        SpringFactory::create_fixed_linear_spring(objects, a, point, of_world, spring, damping)
    },
    |objects, [a, b], random| {
        let (spring, damping) = (random.number(0.0, 1000.0), random.number(0.0, 50.0));
        SpringFactory::create_angle_spring(objects, a, b, spring, damping)
    },
];
