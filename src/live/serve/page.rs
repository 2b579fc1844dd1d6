//! The page's files, all in the binary: nothing is fetched from outside.

/// A file of the page.
pub struct Asset {
    /// Its name in the address.
    pub name: &'static str,
    /// What it is.
    pub kind: &'static str,
    /// What is in it.
    pub bytes: &'static [u8],
}

/// Text in UTF-8.
const SCRIPT: &str = "text/javascript; charset=utf-8";

/// One file.
macro_rules! asset {
    ($name:literal, $kind:expr) => {
        Asset {
            name: $name,
            kind: $kind,
            bytes: include_bytes!(concat!("../page/", $name)),
        }
    };
}

/// All of them; the page itself is the first.
static ASSETS: &[Asset] = &[
    asset!("index.html", "text/html; charset=utf-8"),
    asset!("page.css", "text/css; charset=utf-8"),
    asset!("page.js", SCRIPT),
    asset!("desk.js", SCRIPT),
    asset!("pictures.js", SCRIPT),
    asset!("panel.js", SCRIPT),
    asset!("frontier.js", SCRIPT),
    asset!("plot.js", SCRIPT),
    asset!("params.js", SCRIPT),
    asset!("lines.js", SCRIPT),
    asset!("editor.js", SCRIPT),
    asset!("editor.licences.txt", "text/plain; charset=utf-8"),
];

/// The file of a name; the page's own is empty.
pub fn asset(name: &str) -> Option<&'static Asset> {
    let name = if name.is_empty() { "index.html" } else { name };
    ASSETS.iter().find(|asset| asset.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_has_no_backticks_and_asks_for_what_there_is() {
        let page = asset("").expect("the page");
        let text = std::str::from_utf8(page.bytes).expect("text");
        assert!(!text.contains('\u{60}'));
        let names = text.split(['"']).filter(|part| part.ends_with(".js"));
        assert!(names.clone().count() > 0);
        assert!(names.into_iter().all(|name| asset(name).is_some()));
        assert!(!text.contains("://"));
    }
}
