//! What is right parses to the tree that it says.

use super::*;

#[test]
fn the_four_scenes_parse_without_diagnostics() {
    for scene in SCENES {
        let (file, diagnostics) = parse(scene, 0);
        assert_eq!(plain(scene, &diagnostics), "");
        assert!(file.items.len() >= 5);
    }
}
