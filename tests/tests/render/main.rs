//! Drawings of both engines on a canvas.

mod bodies;
mod canvases;
mod debug_view;
mod draw_order;
mod plane_debug_view;
mod platforms;
mod shadows;
mod sunk;
mod uprights;
mod waters;
