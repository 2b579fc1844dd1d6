//! `survey --shard` and `--merge`: parts that job arrays measure, and the document they make.

use crate::cli::{directory, names, slowlight, success};
use std::path::Path;

const DISC: &str = "// A disc, in a dither.
image 16 x 16 inks black, white;
draw (x, y) = {
  let away = (x - 7.5)^2 + (y - 7.5)^2;
  threshold(if away < 20 then 0.9 - away / 40 else x / 32, bayer(2)[x mod 2, y mod 2])
};
";

/// Two scenes, one of which has another limit, on two machines.
const ASKED: [&str; 12] = [
    "disc.scn",
    "other.scn",
    "-t",
    "6502",
    "-t",
    "jack",
    "--settings",
    "1",
    "--limit",
    "9000000",
    "--limit",
    "other/jack=20000",
];

fn shard(dir: &Path, of: &str, to: &str) {
    let part = ["--shard", of, "-o", to, "--no-cache"];
    success(dir, &[&["survey"][..], &ASKED, &part].concat());
}

/// What a command that must fail says.
fn refused(dir: &Path, args: &[&str], status: i32) -> String {
    let output = slowlight(dir, &[&["survey"][..], args].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{said}");
    said
}

#[test]
fn parts_make_the_document_of_one_run() {
    let other = DISC.replace("7.5", "9.5");
    let dir = directory(&[("disc.scn", DISC), ("other.scn", &other)]);
    let dir = dir.path();
    let out = ["-o", "docs/found.md", "--pictures", "docs/plots"];
    success(
        dir,
        &[&["survey"][..], &ASKED, &out, &["--no-cache"]].concat(),
    );
    let files = [
        "found.md",
        "plots/accuracy-disc-6502-plain.svg",
        "plots/accuracy-disc-jack.svg",
        "plots/accuracy-other-6502-plain.svg",
        "plots/accuracy-other-jack.svg",
    ];
    let read = || files.map(|name| std::fs::read(dir.join("docs").join(name)).expect("a file"));
    let whole = read();
    std::fs::remove_dir_all(dir.join("docs")).expect("it was there");

    for (of, to) in [("3/3", "c"), ("1/3", "a"), ("2/3", "parts/b")] {
        shard(dir, of, to);
    }
    assert_eq!(names(dir), ["a", "c", "disc.scn", "other.scn", "parts"]);
    let merge = ["--merge", "parts/b", "c", "a"];
    success(dir, &[&["survey"][..], &merge, &out].concat());
    assert!(read() == whole, "joined parts are another document");

    // What is no whole survey is none.
    let said = refused(dir, &["--merge", "a", "c", "-o", "x.md"], 1);
    assert!(
        said.contains("1 of 3 parts are missing, 2/3 first"),
        "{said}"
    );
    let said = refused(dir, &["--merge", "a", "c", "a", "-o", "x.md"], 1);
    assert!(said.contains("part 1/3 is there twice"), "{said}");
    let said = refused(dir, &["--merge", "disc.scn", "-o", "x.md"], 1);
    assert!(said.contains("disc.scn is no part of a survey"), "{said}");
    shard(dir, "2/2", "half");
    let said = refused(dir, &["--merge", "a", "half", "-o", "x.md"], 1);
    assert!(
        said.contains("half is of another number of parts"),
        "{said}"
    );
    std::fs::write(dir.join("disc.scn"), DISC.replace("0.9", "0.8")).expect("written");
    shard(dir, "1/2", "changed");
    let said = refused(dir, &["--merge", "changed", "half", "-o", "x.md"], 1);
    assert!(
        said.contains("half is of another text of a scene"),
        "{said}"
    );
    for (args, said) in [
        (
            &["disc.scn", "-o", "x.md", "--shard", "4/3"][..],
            "write K/N",
        ),
        (
            &["disc.scn", "-o", "x.md", "--merge", "a"],
            "cannot be used",
        ),
        (&["-o", "x.md"], "required"),
    ] {
        let told = refused(dir, args, 2);
        assert!(told.contains(said), "{told}");
    }
    assert!(!names(dir).contains(&"x.md".to_owned()));
}
