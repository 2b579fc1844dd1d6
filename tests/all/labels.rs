//! Symbol files for emulators' debuggers: the same addresses in each form, and the scene's lines.

use crate::cli::{directory, names, slowlight, success};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const BALL: &str = include_str!("../scenes/ball.scn");

fn read(dir: &Path, name: &str) -> String {
    std::fs::read_to_string(dir.join(name)).expect("a file of text")
}

fn hex(text: &str) -> u32 {
    u32::from_str_radix(text, 16).expect("hexadecimal")
}

/// The names of a file for VICE.
fn vice(text: &str) -> BTreeMap<String, u32> {
    let name = |line: &str| {
        let (address, name) = line.strip_prefix("al C:").expect("al C:")[..]
            .split_once(" .")
            .expect("a name");
        (name.to_owned(), hex(address))
    };
    text.lines().map(name).collect()
}

/// Those of a file as beebasm's.
fn beebasm(text: &str) -> BTreeMap<String, u32> {
    let inner = text.trim().strip_prefix("[{").expect("[{");
    let inner = inner.strip_suffix("}]").expect("}]");
    let name = |entry: &str| {
        let (name, value) = entry.split_once(':').expect("a value");
        let value = value.strip_suffix('L').expect("L");
        (
            name.trim_matches('\'').to_owned(),
            value.parse().expect("decimal"),
        )
    };
    inner.split(',').map(name).collect()
}

/// Records of one kind in a file as ld65's: their keys.
fn records<'t>(text: &'t str, kind: &str) -> Vec<BTreeMap<&'t str, &'t str>> {
    let own = text.lines().filter_map(|line| line.split_once('\t'));
    let own = own.filter(|(k, _)| *k == kind);
    let pairs = |rest: &'t str| rest.split(',').filter_map(|pair| pair.split_once('='));
    own.map(|(_, rest)| pairs(rest).collect()).collect()
}

#[test]
fn each_form_has_the_same_names() {
    let dir = directory(&[("ball.scn", BALL)]);
    let dir = dir.path();
    for target in ["6502:plain", "6502:bbc", "6502:c64"] {
        let forms = ["--labels", "vice,beebasm", "--labels", "ca65"];
        let build = ["build", "ball.scn", "-t", target, "--style", "listing"];
        success(dir, &[&build[..], &forms].concat());
        let vice = vice(&read(dir, "ball.vs"));
        assert_eq!(vice, beebasm(&read(dir, "ball.labels")), "{target}");
        let debug = read(dir, "ball.dbg");
        let symbols = records(&debug, "sym");
        let symbols: BTreeMap<String, u32> = (symbols.iter())
            .map(|s| (s["name"].trim_matches('"').to_owned(), hex(&s["val"][2..])))
            .collect();
        assert_eq!(vice, symbols, "{target}");

        // Every label of the source, and the first byte is where the program lies.
        let source = read(dir, "ball.asm");
        let labels = source.lines().filter_map(|line| line.split_once(':'));
        let labels = labels.map(|(name, _)| name);
        let labels = labels.filter(|n| n.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'));
        let mut found = 0;
        for label in labels {
            assert!(vice.contains_key(label), "{target}: {label}");
            found += 1;
        }
        assert!(found > 50, "{found}");

        lines_lead_to_their_code(&read(dir, "ball.lst"), &vice);
        records_fit_together(&debug, &read(dir, "ball.lst"));
    }
}

/// The addresses below each line of the scene in a listing.
fn told(listing: &str) -> BTreeMap<usize, BTreeSet<u32>> {
    let mut found: BTreeMap<usize, BTreeSet<u32>> = BTreeMap::new();
    let mut line = None;
    for row in listing.lines() {
        if let Some((_, rest)) = row.split_once("; ball.scn:") {
            line = rest.split(':').next().and_then(|n| n.parse().ok());
        } else if row.contains("; ") && row.trim_start().contains(".scn:") {
            // A line of the library.
            line = None;
        }
        let digits = row
            .get(..4)
            .filter(|d| d.chars().all(|c| c.is_ascii_hexdigit()));
        if let (Some(line), Some(digits)) = (line, digits) {
            found.entry(line).or_default().insert(hex(digits));
        }
    }
    found
}

/// `ball_6` and so on stand where the listing has that line's code.
fn lines_lead_to_their_code(listing: &str, names: &BTreeMap<String, u32>) {
    let told = told(listing);
    let mut lines = BTreeSet::new();
    for (name, address) in names {
        let Some(rest) = name.strip_prefix("ball_") else {
            continue;
        };
        let line = rest.split('_').next().and_then(|n| n.parse().ok());
        let line = line.expect("a line's number");
        assert!(told[&line].contains(address), "{name}");
        lines.insert(line);
    }
    assert!(lines.is_superset(&BTreeSet::from([4, 6, 8])), "{lines:?}");
}

/// Counts, ids and sizes of a file as ld65's.
fn records_fit_together(debug: &str, listing: &str) {
    let info = records(debug, "info").remove(0);
    for kind in ["file", "line", "mod", "scope", "seg", "span", "sym"] {
        let all = records(debug, kind);
        assert_eq!(info[kind], all.len().to_string(), "{kind}");
        let ids: Vec<String> = all.iter().map(|r| r["id"].to_owned()).collect();
        let counted: Vec<String> = (0..all.len()).map(|k| k.to_string()).collect();
        assert_eq!(ids, counted, "{kind}");
    }
    let segment = records(debug, "seg").remove(0);
    let (start, size) = (hex(&segment["start"][2..]), hex(&segment["size"][2..]));
    let spans = records(debug, "span");
    let number = |text: &str| text.parse::<u32>().expect("a number");
    for span in &spans {
        assert!(number(span["start"]) + number(span["size"]) <= size);
    }
    let told = told(listing);
    let mut own = 0;
    for line in records(debug, "line") {
        if line.get("type") != Some(&"1") || line["file"] != "1" {
            continue;
        }
        for span in line["span"].split('+') {
            let at = start + number(spans[number(span) as usize]["start"]);
            let of = number(line["line"]) as usize;
            assert!(told[&of].contains(&at), "line {of}: {at:04X}");
            own += 1;
        }
    }
    assert!(own > 5, "{own}");
}

#[test]
fn the_hack_s_functions_have_addresses_in_its_rom() {
    let dir = directory(&[("ball.scn", BALL)]);
    let dir = dir.path();
    let build = ["build", "ball.scn", "-t", "jack", "--os", "jack"];
    success(dir, &[&build[..], &["--labels", "hack"]].concat());
    let words = read(dir, "Main.hack").lines().count();
    let symbols = read(dir, "Main.sym");
    let symbols: BTreeMap<&str, usize> = (symbols.lines())
        .filter_map(|line| line.split_once(' '))
        .map(|(at, name)| (name, at.parse().expect("an address")))
        .collect();
    let assembly = read(dir, "Main.asm");
    for name in ["Main.main", "Sys.init", "Ball.draw"] {
        let Some(at) = symbols.get(name) else {
            assert_ne!(name, "Main.main", "{symbols:?}");
            continue;
        };
        assert!(*at < words);
        let before = assembly.split(&format!("({name})\n")).next();
        let code = before.expect("its label").lines();
        let code = code.filter(|l| !l.trim().is_empty() && !l.starts_with('('));
        assert_eq!(code.count(), *at, "{name}");
    }
}

#[test]
fn a_form_that_a_machine_has_not_is_refused() {
    let dir = directory(&[("ball.scn", BALL)]);
    for (target, more, form, said) in [
        ("bbc", &[][..], "vice", "has line numbers"),
        ("jack", &[], "vice", "jack has hack"),
        ("jack", &[], "hack", "--os jack"),
        ("6502:c64", &[], "hack", "vice, beebasm and ca65"),
        ("6502", &["--syntax", "acme"], "ca65", "leave --syntax out"),
    ] {
        let build = ["build", "ball.scn", "-t", target, "--labels", form];
        let output = slowlight(dir.path(), &[&build[..], more].concat());
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(said), "{told}");
    }
    assert_eq!(names(dir.path()), ["ball.scn"]);
}
