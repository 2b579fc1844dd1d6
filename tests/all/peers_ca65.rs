//! The generated assembly, unchanged, under ca65 and ld65 as its header says.

use crate::cli::{directory, success};
use std::process::Command;

/// The commands that a listing's header quotes for a tool, in backticks.
fn quoted<'a>(listing: &'a str, tool: &str) -> Vec<&'a str> {
    let quotes = listing.lines().filter(|l| l.starts_with(';'));
    let pieces = quotes.flat_map(|l| l.split('`').skip(1).step_by(2));
    pieces.filter(|p| p.starts_with(tool)).collect()
}

#[test]
fn the_headers_commands_make_the_binary() {
    let dir = directory(&[("mirrors.scn", include_str!("../../examples/mirrors.scn"))]);
    success(dir.path(), &["build", "mirrors.scn", "--target", "6502"]);
    let read = |name: &str| std::fs::read(dir.path().join(name)).expect(name);
    let listing = String::from_utf8(read("mirrors.asm")).expect("text");
    for (tool, given) in [("ca65", "mirrors.asm"), ("ld65", "mirrors.o")] {
        let commands = quoted(&listing, tool);
        assert_eq!(commands.len(), 1, "{tool}: {commands:?}");
        let mut words: Vec<&str> = commands[0].split_whitespace().collect();
        // A header may leave its reader to add the files.
        if !words.contains(&given) {
            words.extend([
                given,
                "-o",
                if tool == "ca65" {
                    "mirrors.o"
                } else {
                    "linked"
                },
            ]);
        }
        let done = Command::new(words[0])
            .args(&words[1..])
            .current_dir(dir.path())
            .output()
            .expect("cc65 is installed: see tests/peers/setup");
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.success(), "{words:?}: {said}");
    }
    let linked = ["linked", "a.out", "mirrors"].map(|n| dir.path().join(n));
    let linked = linked.iter().find(|p| p.exists()).expect("ld65 writes");
    let linked = std::fs::read(linked).expect("ld65's file");
    // Our binary starts with its load address, two bytes; ld65's is only the program.
    assert_eq!(read("mirrors.bin")[2..], linked);
}
