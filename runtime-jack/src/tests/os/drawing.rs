//! `Screen`, pixel by pixel.

use super::{agreed, error, program};

#[test]
fn pixels_lines_and_areas_at_random() {
    let more = "function int across() { return Main.random() & 511; }
        function int down() { return Main.random() & 255; }";
    for (what, count) in [
        ("do Screen.drawPixel(Main.across(), Main.down());", 400),
        (
            "do Screen.drawLine(Main.across(), Main.down(), Main.across(), Main.down());",
            80,
        ),
        (
            "let x = Main.across(); let y = Main.down();
             do Screen.drawRectangle(x & 480, y & 240, x | 37, y | 9);",
            40,
        ),
        (
            "do Screen.drawCircle(128 + (Main.across() & 255), 100 + (Main.down() & 31), \
             Main.down() & 63);",
            40,
        ),
    ] {
        let body = format!(
            "var int k, x, y;
            while (k < {count}) {{
                do Screen.setColor((k & 3) < 3);
                {what}
                let k = k + 1;
            }}"
        );
        let left = agreed(&program(&body, more));
        assert_eq!(left.error, None, "{what}");
        assert!(left.screen.pixels.contains(&0), "{what}");
    }
}

#[test]
fn lines_and_areas_at_the_edges() {
    let body = "
        do Screen.drawLine(0, 0, 511, 255); do Screen.drawLine(511, 0, 0, 255);
        do Screen.drawLine(0, 0, 0, 255); do Screen.drawLine(511, 255, 511, 0);
        do Screen.drawLine(7, 9, 7, 9); do Screen.drawLine(0, 255, 511, 255);
        do Screen.drawLine(10, 10, 20, 20); do Screen.drawLine(40, 10, 30, 20);
        do Screen.drawLine(100, 100, 103, 101); do Screen.drawLine(100, 110, 101, 113);
        do Screen.drawRectangle(15, 30, 16, 31); do Screen.drawRectangle(32, 40, 47, 40);
        do Screen.drawCircle(200, 100, 0); do Screen.drawCircle(220, 100, 1);
        do Screen.drawCircle(256, 127, 127);
        do Screen.setColor(false); do Screen.drawRectangle(250, 100, 260, 150);
        do Screen.drawCircle(256, 127, 9);";
    assert_eq!(error(body), None);
    assert_eq!(error(&format!("{body} do Screen.clearScreen();")), None);
    let after = "do Screen.clearScreen(); do Screen.init(); do Screen.drawPixel(3, 4);";
    assert_eq!(error(&format!("{body} {after}")), None);
}

#[test]
fn drawing_that_fails() {
    let far = "(-32767) - 1";
    for outside in ["-1, 0", "512, 0", "0, -1", "0, 256", "32767, 0"] {
        assert_eq!(error(&format!("do Screen.drawPixel({outside});")), Some(7));
        assert_eq!(
            error(&format!("do Screen.drawLine({outside}, 5, 5);")),
            Some(8)
        );
        assert_eq!(
            error(&format!("do Screen.drawLine(5, 5, {outside});")),
            Some(8)
        );
        assert_eq!(
            error(&format!("do Screen.drawRectangle({outside}, 5, 5);")),
            Some(9)
        );
        assert_eq!(
            error(&format!("do Screen.drawCircle({outside}, 5);")),
            Some(12)
        );
    }
    assert_eq!(error(&format!("do Screen.drawPixel({far}, 0);")), Some(7));
    assert_eq!(error("do Screen.drawRectangle(5, 5, 4, 6);"), Some(9));
    assert_eq!(error("do Screen.drawRectangle(5, 5, 6, 4);"), Some(9));
    assert_eq!(error("do Screen.drawCircle(256, 127, 128);"), Some(13));
    assert_eq!(error("do Screen.drawCircle(256, 127, -1);"), Some(13));
    assert_eq!(error("do Screen.drawCircle(256, 127, 32767);"), Some(13));
    assert_eq!(error("do Screen.drawCircle(3, 127, 4);"), Some(13));
}
