//! stub
use crate::scenes::GalleryScene;
/// Opens
pub fn open(_scenes: Vec<GalleryScene>, _first: usize) {}
