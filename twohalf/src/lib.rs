//! 2.5D game physics.
