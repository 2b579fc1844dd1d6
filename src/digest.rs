//! Digests: by which one sees whether two programs, or two pictures, are the same.

use sha2::{Digest, Sha256};
use slowlight_compiler::plan::Plan;

/// SHA-256 of a program's files, names and texts, in hexadecimal.
pub fn program(plan: &Plan) -> String {
    let documents = slowlight_compiler::backend::emit(plan);
    let parts = documents.iter().flat_map(|d| [&d.name, &d.text]);
    let mut hash = Sha256::new();
    for part in parts {
        hash.update(part.as_bytes());
        hash.update([0]);
    }
    hexadecimal(&hash.finalize())
}

/// SHA-256 of some bytes, in hexadecimal.
pub fn bytes(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// Bytes as two digits each.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}
