//! Which mode a picture is drawn in.

use super::{bbc, find, modes_for};

/// Of modes with all of a picture's inks the one that leaves most memory comes first.
#[test]
fn modes_have_the_pictures_inks_and_leave_memory() {
    let first = |width, inks| modes_for(&bbc::MICRO, width, 120, inks)[0].name;
    assert_eq!(first(160, 2), "5");
    assert_eq!(first(160, 4), "5");
    assert_eq!(first(160, 5), "2");
    assert_eq!(first(160, 16), "2");
    assert_eq!(first(320, 2), "4");
    assert_eq!(first(320, 4), "1");
    assert_eq!(first(320, 16), "1");
    assert_eq!(first(640, 4), "0");
    // What no mode shows whole: most pixels.
    assert_eq!(first(800, 4), "0");
    let agon = find("bbc:agon").map(|agon| modes_for(agon, 160, 120, 4)[0].name);
    assert_eq!(agon, Some("9"));
}
