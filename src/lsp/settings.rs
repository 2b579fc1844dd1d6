//! What the server can do, and what a user sets.

use crate::target_args;
use serde_json::{Value, json};
use slowlight_compiler::targets::Target;

/// How requests for settings are told from others.
pub const ASKED: &str = "settings";

/// The machine that lines are measured on: `slowlight.target`, or `target` alone; none where
/// it is empty or not said.
///
/// # Errors
/// That there is no such machine.
pub fn target(given: &Value) -> Result<Option<&'static Target>, String> {
    let own = [
        &given["slowlight"]["target"],
        &given["slowlight.target"],
        &given["target"],
    ];
    let name = own.into_iter().find_map(Value::as_str).unwrap_or("");
    match name.trim() {
        "" => Ok(None),
        name => target_args::target(name)
            .map(Some)
            .map_err(|why| format!("slowlight.target: {why}")),
    }
}

/// What the server can do, as the protocol says it.
pub fn capabilities() -> Value {
    json!({
        "positionEncoding": "utf-16",
        "textDocumentSync": { "openClose": true, "change": 2, "save": true },
        "hoverProvider": true,
        "completionProvider": { "triggerCharacters": ["."] },
        "signatureHelpProvider": { "triggerCharacters": ["(", ","] },
        "definitionProvider": true,
        "referencesProvider": true,
        "documentHighlightProvider": true,
        "documentSymbolProvider": true,
        "documentFormattingProvider": true,
        "renameProvider": { "prepareProvider": true },
        "inlayHintProvider": true,
    })
}
