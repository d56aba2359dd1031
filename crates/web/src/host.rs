//! What the browser provides: a way out of work that is to stop, the clock, and an ear for what is found.

use chetaev::symbolic::meter::{escape_by, Escape};
use wasm_bindgen::prelude::*;

#[wasm_bindgen(module = "/host/host.js")]
extern "C" {
    fn attempt(what: &mut dyn FnMut()) -> bool;
    fn leave();
    /// Seconds since some moment.
    pub(crate) fn seconds() -> f64;
    fn panicked(words: &str);
}

#[wasm_bindgen]
extern "C" {
    /// An object with the method `told(kind, text)`.
    pub type Listener;

    /// Hears of something.
    #[wasm_bindgen(method, structural)]
    pub(crate) fn told(this: &Listener, kind: &str, text: &str);
}

/// Exceptions of the host: they pass through the frames of the module, which drop nothing.
struct Exceptions;

impl Escape for Exceptions {
    fn attempt(&self, what: &mut dyn FnMut()) -> bool {
        attempt(&mut || what())
    }

    fn leave(&self) -> ! {
        leave();
        // The host has thrown.
        std::process::abort()
    }
}

/// Sets up what all calls need, once.
pub(crate) fn begin() {
    escape_by(&Exceptions);
    std::panic::set_hook(Box::new(|info| panicked(&info.to_string())));
}
