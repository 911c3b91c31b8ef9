#![allow(dead_code, unused)]
use super::SlantedBox; use farseer_core::math::{Vector2,Vector3};
use serde::{Serialize, Deserialize};
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct KeptAxis(u8);
#[derive(Clone, Copy)]
pub(crate) struct BoxPoint { pub(crate) position: Vector3, pub(crate) separation: f32, pub(crate) feature: u32 }
pub(crate) struct BoxManifold { pub(crate) normal: Vector3, pub(crate) points: [BoxPoint;2], pub(crate) count: usize, pub(crate) kept: KeptAxis, pub(crate) is_depth: bool }
pub(crate) fn prism_box<'a>(b: &SlantedBox, pieces: impl Iterator<Item=&'a [Vector2]> + Clone, z: f32, half: f32, v: Vector3, slop: f32, kept: Option<KeptAxis>, scratch: &mut Vec<Vector2>) -> Option<BoxManifold> { None }
