//! What `Screen` draws, pixel by pixel.

use super::main;
use super::os::{error, run};
use crate::{Screen, Stop};

/// The screen after `body`, a character a pixel, of the columns and rows up to 16 by 8.
fn corner(body: &str) -> Vec<String> {
    let (run, _) = main(0, body);
    assert_eq!(run.stop, Stop::Ended);
    rows(&run.screen, 0, 0, 16, 8)
}

fn rows(screen: &Screen, x: u32, y: u32, width: u32, height: u32) -> Vec<String> {
    let ink = |x: u32, y: u32| screen.pixels[(y * screen.width + x) as usize];
    let row = |y: u32| {
        (x..x + width)
            .map(|x| if ink(x, y) == 0 { '#' } else { '.' })
            .collect()
    };
    (y..y + height).map(row).collect()
}

#[test]
fn screen_words_are_16_pixels_the_lowest_bit_left() {
    let (run, _) = main(0, &run("Memory.poke", &[16384 + 32, 0x7001]));
    assert_eq!((run.screen.width, run.screen.height), (512, 256));
    assert_eq!(run.screen.pixels.len(), 512 * 256);
    assert_eq!(run.screen.palette, [[0, 0, 0], [255, 255, 255]]);
    assert_eq!(
        rows(&run.screen, 0, 0, 16, 2),
        ["................", "#...........###."]
    );
}

#[test]
fn pixels_and_colours() {
    assert_eq!(
        corner(
            &(run("Screen.drawPixel", &[1, 0])
                + &run("Screen.drawPixel", &[15, 1])
                + &run("Screen.drawPixel", &[3, 2])
                + &run("Screen.setColor", &[0])
                + &run("Screen.drawPixel", &[3, 2])
                + &run("Screen.init", &[])
                + &run("Screen.drawPixel", &[4, 3]))
        )[..4],
        [
            ".#..............",
            "...............#",
            "................",
            "....#..........."
        ]
    );
    let cleared = corner(&(run("Screen.drawPixel", &[1, 0]) + &run("Screen.clearScreen", &[])));
    assert!(cleared.iter().all(|row| !row.contains('#')));
    for outside in [[-1, 0], [512, 0], [0, -1], [0, 256]] {
        assert_eq!(error("Screen.drawPixel", &outside), 7);
    }
    let (run, _) = main(0, &run("Screen.drawPixel", &[511, 255]));
    assert_eq!(run.screen.pixels[512 * 256 - 1], 0);
}

#[test]
fn lines() {
    let shallow = [
        "#...............",
        ".##.............",
        "...##...........",
        ".....#..........",
    ];
    assert_eq!(corner(&run("Screen.drawLine", &[0, 0, 5, 3]))[..4], shallow);
    // Either way round.
    assert_eq!(corner(&run("Screen.drawLine", &[5, 3, 0, 0]))[..4], shallow);
    let upwards: Vec<&str> = shallow.iter().rev().copied().collect();
    assert_eq!(corner(&run("Screen.drawLine", &[5, 0, 0, 3]))[..4], upwards);
    let steep = corner(&run("Screen.drawLine", &[2, 0, 3, 7]));
    let columns: Vec<usize> = steep.iter().map(|row| row.find('#').unwrap()).collect();
    assert_eq!(columns, [2, 2, 2, 2, 3, 3, 3, 3]);
    assert_eq!(
        corner(&(run("Screen.drawLine", &[2, 3, 12, 3]) + &run("Screen.drawLine", &[7, 5, 7, 1])))
            [1..6],
        [
            ".......#........",
            ".......#........",
            "..###########...",
            ".......#........",
            ".......#........"
        ]
    );
    for outside in [[-1, 0, 3, 3], [0, 0, 512, 3], [0, -1, 3, 3], [0, 0, 3, 256]] {
        assert_eq!(error("Screen.drawLine", &outside), 8);
    }
}

#[test]
fn rectangles() {
    assert_eq!(
        corner(&run("Screen.drawRectangle", &[3, 1, 9, 2]))[..4],
        [
            "................",
            "...#######......",
            "...#######......",
            "................"
        ]
    );
    let (drawn, _) = main(0, &run("Screen.drawRectangle", &[14, 0, 49, 0]));
    assert_eq!(
        rows(&drawn.screen, 12, 0, 40, 1),
        ["..####################################.."]
    );
    let (all, _) = main(0, &run("Screen.drawRectangle", &[0, 0, 511, 255]));
    assert!(all.screen.pixels.iter().all(|ink| *ink == 0));
    for wrong in [
        [3, 0, 2, 5],
        [0, 3, 5, 2],
        [-1, 0, 5, 5],
        [0, 0, 512, 5],
        [0, 0, 5, 256],
    ] {
        assert_eq!(error("Screen.drawRectangle", &wrong), 9);
    }
}

#[test]
fn circles() {
    assert_eq!(
        corner(&run("Screen.drawCircle", &[4, 3, 3]))[..8],
        [
            "...###..........",
            "..#####.........",
            ".#######........",
            ".#######........",
            ".#######........",
            "..#####.........",
            "...###..........",
            "................"
        ]
    );
    assert_eq!(
        corner(&run("Screen.drawCircle", &[0, 0, 0]))[0],
        "#..............."
    );
    assert_eq!(error("Screen.drawCircle", &[512, 0, 1]), 12);
    assert_eq!(error("Screen.drawCircle", &[5, 5, 6]), 13);
    assert_eq!(error("Screen.drawCircle", &[5, 5, -1]), 13);
    // The largest that fits.
    let (big, _) = main(0, &run("Screen.drawCircle", &[256, 128, 127]));
    assert_eq!(rows(&big.screen, 128, 128, 3, 1), [".##"]);
    assert_eq!(error("Screen.drawCircle", &[256, 128, 128]), 13);
}
