//! The page's worker as WebAssembly: what `slowlight::live` does for a page alone, told to
//! an object of JavaScript's.

use slowlight::live::{self, Alone, Tell};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Who hears what was found: an object with these methods.
    pub type Told;

    #[wasm_bindgen(method)]
    fn shown(this: &Told, json: &str);

    #[wasm_bindgen(method)]
    fn bytes(this: &Told, name: &str, bytes: &[u8]);

    #[wasm_bindgen(method)]
    fn file(this: &Told, name: &str, bytes: &[u8]);
}

impl Tell for Told {
    fn shown(&self, json: &str) {
        self.shown(json);
    }

    fn bytes(&self, name: &str, bytes: &[u8]) {
        self.bytes(name, bytes);
    }

    fn file(&self, name: &str, bytes: &[u8]) {
        self.file(name, bytes);
    }
}

/// A worker of the page's.
#[wasm_bindgen]
#[derive(Default)]
pub struct Worker(Alone);

#[wasm_bindgen]
impl Worker {
    /// One that has done nothing.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Worker {
        Worker::default()
    }

    /// Reads a wish's scene, says what is wrong with it, and draws it; answers whether it is
    /// right.
    ///
    /// # Errors
    /// Where the wish itself is none.
    pub fn draw(&mut self, wish: &str, told: &Told) -> Result<bool, String> {
        self.0.draw(wish, told)
    }

    /// Runs a wish's program, counts its lines' cycles or makes its files.
    ///
    /// # Errors
    /// Where the wish itself is none.
    pub fn work(&mut self, task: &str, wish: &str, told: &Told) -> Result<(), String> {
        self.0.work(task, wish, told)
    }
}

/// What a page begins with, as JSON: machines, the gallery's scenes, what is shown of nothing.
#[wasm_bindgen]
pub fn about() -> String {
    live::about().to_string()
}
