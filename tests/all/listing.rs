//! A 6502 program's listing: every byte has its place, every line of the scene its code.

use crate::cli::{directory, names, success};

const BALL: &str = include_str!("../scenes/ball.scn");

/// The rows of the table under a headline, as words.
fn rows<'t>(listing: &'t str, head: &str) -> Vec<Vec<&'t str>> {
    let (_, rest) = listing.split_once(head).expect("its headline");
    let lines = rest.lines().skip(3).take_while(|line| !line.is_empty());
    lines.map(|l| l.split_whitespace().collect()).collect()
}

/// A number as tables write it.
fn number(text: &str) -> u64 {
    text.replace(',', "").parse().expect("a number")
}

#[test]
fn a_listing_has_all_bytes_and_all_lines_of_the_scene() {
    let dir = directory(&[("ball.scn", BALL)]);
    for (target, origin) in [("6502:plain", 0x02fd), ("6502:bbc", 0x1900)] {
        let options = ["build", "ball.scn", "-t", target, "--style", "listing"];
        success(dir.path(), &options);
        assert!(names(dir.path()).contains(&"ball.lst".to_owned()));
        let read = |name: &str| std::fs::read(dir.path().join(name)).expect("a file");
        let listing = String::from_utf8(read("ball.lst")).expect("text");

        // The parts lie behind each other, and are the whole file.
        let mut behind = None;
        let mut bytes = 0;
        for row in rows(&listing, "Where things lie") {
            let [.., addresses, size] = row[..] else {
                panic!("{row:?}");
            };
            let Some((first, last)) = addresses.split_once('-') else {
                // Only names: the last word is where they are.
                continue;
            };
            let [first, last] = [first, last].map(|a| u64::from_str_radix(a, 16).expect("hex"));
            assert_eq!(number(size), last - first + 1, "{row:?}");
            assert!(behind.is_none_or(|at| at == first), "{row:?}");
            assert!(first >= origin, "{row:?}");
            behind = Some(last + 1);
            bytes += number(size);
        }
        assert_eq!(bytes, read("ball.prg").len() as u64 - 2);

        // Each operation takes something.
        let operations = rows(&listing, "Operations:");
        assert!(operations.len() > 5);
        for row in &operations {
            assert!(number(row[1]) > 0 && number(row[2]) > 0, "{row:?}");
        }

        // Lines of the scene stand above code.
        for (number, line) in [
            (4, "effect shine(h: hit) -> real else 0.5"),
            (6, "let r = ray((0, 0, 3), unit("),
            (8, "threshold(v, bayer(2)"),
        ] {
            let head = format!("; ball.scn:{number}: {line}");
            let coded = listing.match_indices(&head).map(|(at, _)| {
                let code = listing[at..].lines().skip(1).take(12);
                code.filter(|l| l.starts_with(|c: char| c.is_ascii_hexdigit()))
                    .count()
            });
            assert!(coded.max() > Some(3), "{head}");
        }
        // An instruction with its cycles.
        assert!(listing.contains("  60                        6           rts"));
    }
}
