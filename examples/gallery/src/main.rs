//! The gallery: a window, or, with arguments, a list, a film, a table of times or hashes.

#[cfg(not(target_arch = "wasm32"))]
mod command;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    command::run()
}

#[cfg(target_arch = "wasm32")]
fn main() {
    gallery::window::open(gallery::scenes::scenes(), 0, None, 4);
}
