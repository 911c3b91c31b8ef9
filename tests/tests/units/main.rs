//! Single functions of the 2D engine against the recordings of the original (`golden/units`).

mod bodies;
mod contacts;
mod controllers;
mod curves;
mod distance_grids;
mod exceptions;
mod joints;
mod math;
mod matrices;
mod pair_ids;
mod pairs;
mod paths;
mod polygon_tools;
mod polygons;
mod queries;
mod rays;
mod shapes;
