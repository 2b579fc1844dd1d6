//! `explain --why`: what is said of a line is there for a reason, and what it says would be
//! spared is spared where it is done.

use crate::cli::{directory, json, slowlight, success};
use serde_json::Value;

/// A param without a range, and one with.
const RANGES: &str = "image 32 x 24 inks black, white;
param k: real = 2;
param spin: angle = 32deg in -90deg .. 90deg;
draw (x, y) = {
  let u = (x - 16) / 8;
  let w = (y - 12) / 8;
  let s = sin(u * k * 1rad + spin) + sqrt(u * u + w * w * k);
  threshold(s / 4 + 0.5, bayer(4)[x mod 4, y mod 4])
};
";

/// A twisted box, of which no box can be derived; rays without an end.
const SCREW: &str = "image 24 x 16 inks black, white;
shape screw() {
  dist(p) = {
    let a = p.y * 2rad;
    let q = (p.x * cos(a) - p.z * sin(a), p.y, p.x * sin(a) + p.z * cos(a));
    let d = abs(q) - (0.5, 1, 0.3);
    0.5 * (length(max(d, (0, 0, 0))) + min(max(d.x, max(d.y, d.z)), 0))
  };
}
scene world { screw() is 0.9; }
draw (x, y) = {
  let r = ray((0, 0, 4), unit(((x - 11.5) / 12, (7.5 - y) / 12, -1)));
  let v = if let h = world.trace(r) then h.normal.y * 0.4 + 0.5 else 0.05;
  threshold(v, bayer(4)[x mod 4, y mod 4])
};
";

/// Balls without end, and rays between them.
const FIELD: &str = "image 24 x 16 inks black, white;
shape field() {
  dist(p) = {
    let q = (p.x - 2 * round(p.x / 2), p.y, p.z - 2 * round(p.z / 2));
    length(q) - 0.3
  };
}
scene world { field() is 0.9; }
draw (x, y) = {
  let r = ray((0.3, 0.1, 4), unit(((x - 11.5) / 12, (7.5 - y) / 12, -1)));
  let v = if let h = world.trace(r) then h.normal.y * 0.4 + 0.5 else 0.05;
  threshold(v, bayer(2)[x mod 2, y mod 2])
};
";

/// Nothing to be had.
const PLAIN: &str = "image 32 x 24 inks black, white;
draw (x, y) = threshold((x + y) / 56, bayer(4)[x mod 4, y mod 4]);
";

fn explained(scene: &str, more: &[&str]) -> Value {
    let dir = directory(&[("s.scn", scene)]);
    let args = [&["explain", "s.scn", "--json"], more].concat();
    json(dir.path(), &args)
}

/// The lines' remarks, with the lines' own reports.
fn remarks(profile: &Value) -> Vec<(&Value, &Value)> {
    let lines = profile["lines"].as_array().expect("a list").iter();
    let said = lines.map(|line| (line, line.get("why").expect("a remark or null")));
    said.filter(|(_, why)| !why.is_null()).collect()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().expect("a number")
}

/// The scene with what a remark says; `--freeze` and all are the same to it.
fn done(scene: &str, change: &str) -> String {
    let replaced = |begins: &str| -> String {
        let lines = scene.lines().map(|line| match line.starts_with(begins) {
            true => change,
            false => line,
        });
        lines.map(|line| format!("{line}\n")).collect()
    };
    let name = |rest: &str| {
        let end = rest.find(|c: char| !c.is_alphanumeric());
        format!("param {}:", &rest[..end.unwrap_or(rest.len())])
    };
    match change.split_once(' ') {
        Some(("param" | "const", rest)) => replaced(&name(rest)),
        Some(("bound", _)) => scene.replacen("\n}", &format!("\n{change} }}"), 1),
        Some(("max", _)) => scene.replace("max 24", change),
        Some(("far:", _)) => scene.replace("trace(r)", &format!("trace(r, {change})")),
        _ => panic!("{change}"),
    }
}

/// Whether each remark, done, spares about what it says, in its line and in all; the texts.
fn hold(scene: &str, args: &[&str]) -> Vec<String> {
    let before = explained(scene, &[args, &["--why"]].concat());
    let said = remarks(&before);
    for (line, why) in &said {
        let text = why["text"].as_str().expect("a text");
        let change = why["change"].as_str().expect("a text");
        assert!(text.contains(change), "{text}: {change}");
        let edited = done(scene, change);
        assert_ne!(edited, scene, "{change}");
        let after = explained(&edited, args);
        let all = number(&before, "cycles") - number(&after, "cycles");
        let told = number(why, "saves_in_all");
        assert!((all / told - 1.0).abs() < 0.3, "{text}: {all} of {told}");
        let lines = after["lines"].as_array().expect("a list").iter();
        let same = lines.into_iter().find(|l| l["line"] == line["line"]);
        let left = same.map_or(0.0, |l| number(l, "cycles"));
        let spared = number(line, "cycles") - left;
        let told = number(why, "saves");
        assert!(spared > 0.7 * told, "{text}: {spared} of {told}");
    }
    let texts = said.iter().map(|(_, why)| why["text"].as_str());
    texts.map(|text| text.expect("a text").to_owned()).collect()
}

fn any(texts: &[String], parts: &[&str]) {
    let all = |text: &&String| parts.iter().all(|part| text.contains(part));
    assert!(texts.iter().any(|text| all(&text)), "{parts:?}: {texts:#?}");
}

#[test]
fn a_range_lets_cheaper_routines_be_taken() {
    let texts = hold(RANGES, &["-t", "6502:plain", "--format", "log10"]);
    any(
        &texts,
        &[
            "`add` in `u * u + w * w * k` not done by the cheaper routine",
            "`w * w * k` may be -4.3e9 .. 4.3e9 and would be 0 .. ",
            "as `k` has no range; `param k: real = 2 in ",
        ],
    );
}

/// Fixed point needs ranges of all params: without them it is no choice.
#[test]
fn ranges_let_formats_be_taken() {
    let texts = hold(RANGES, &["-t", "jack"]);
    any(
        &texts,
        &[
            "not held in fixed16, which is quicker than ",
            "as `k` has no range; ",
        ],
    );
}

#[test]
fn a_constant_lets_formulas_be_folded() {
    let scene = "image 32 x 24 inks black, white;
param bend: real = 1 in 0.5 .. 1.5;
draw (x, y) = {
  let u = x / 8;
  let s = sin(u ^ bend * 1rad) * cos(y * 0.3rad);
  threshold(s / 2 + 0.5, bayer(4)[x mod 4, y mod 4])
};
";
    for target in [["-t", "jack"], ["-t", "6502:plain"]] {
        let texts = hold(
            scene,
            &[&target[..], &["--format", format(target[1])]].concat(),
        );
        any(
            &texts,
            &[
                "as `bend` may be changed in the program; ",
                "`const bend = 1.0;` or `--freeze bend` would spare ",
            ],
        );
    }
}

fn format(target: &str) -> &'static str {
    match target {
        "jack" => "f316r",
        _ => "fixed16.16",
    }
}

#[test]
fn a_bound_lets_rays_pass_by() {
    let scene = SCREW.replace("trace(r)", "trace(r, far: 20)");
    let texts = hold(
        &scene,
        &["-t", "jack", "--format", "f316r", "--rows", "7..8"],
    );
    any(
        &texts,
        &[
            "rays that pass by are followed all the way, as `screw` has no bound and none was derived; ",
            "`bound = box((-",
        ],
    );
    // With one there is no more to be said of it.
    let change = "  bound = box((-0.7, -1.1, -0.7), (0.7, 1.1, 0.7));\n}";
    let bounded = scene.replacen("\n}", &format!("\n{change}"), 1);
    let args = ["-t", "jack", "--format", "f316r", "--rows", "7..8", "--why"];
    let texts = remarks(&explained(&bounded, &args)).len();
    assert_eq!(texts, 0);
}

#[test]
fn an_end_of_rays_lets_them_end() {
    let args = ["-t", "jack", "--format", "f316r", "--rows", "7..8"];
    any(
        &hold(FIELD, &args),
        &[
            "rays that meet nothing near are followed on, as `world.trace` has no `far`; `far: ",
            "` there, if nothing farther is to be seen, would spare ",
        ],
    );
}

#[test]
fn fewer_turns_keep_what_is_carried_small() {
    let scene = "image 32 x 24 inks black, white;
fn sum(u: real) -> real = loop (s = u, w = 1.0) max 24 {
  if s * w > 1.2 then s else next(s + w * 0.4, w + 0.1)
} else s;
draw (x, y) = threshold(sum(x / 40 + y / 60) / 2, bayer(4)[x mod 4, y mod 4]);
";
    any(
        &hold(scene, &["-t", "jack"]),
        &[
            " not done by the cheaper routine (",
            "as its loop may take `max 24` turns; `max ",
            "`, if so many are enough, would spare ",
        ],
    );
}

#[test]
fn where_nothing_is_to_be_had_nothing_is_said() {
    for target in ["jack", "6502:plain", "bbc:micro"] {
        let told = explained(PLAIN, &["-t", target, "--why"]);
        assert_eq!(remarks(&told).len(), 0, "{target}: {told}");
    }
    let dir = directory(&[("s.scn", PLAIN)]);
    let out = success(dir.path(), &["explain", "s.scn", "-t", "jack", "--why"]);
    assert!(out.contains("no line would be cheaper by a range"), "{out}");
}

#[test]
fn remarks_are_in_the_text_and_on_the_page() {
    let dir = directory(&[("s.scn", RANGES)]);
    let args = ["explain", "s.scn", "-t", "6502:plain", "--format", "log10"];
    let why = ["--why", "--html", "s.html"];
    let text = success(dir.path(), &[&args[..], &why].concat());
    let (_, said) = text.split_once("what lines could not do").expect("remarks");
    let shares: Vec<f64> = (said.lines().skip(1))
        .map(|line| {
            let share = line
                .split_once('(')
                .and_then(|(_, rest)| rest.split_once('%'));
            share.expect(line).0.parse().expect("a share")
        })
        .collect();
    assert!(
        !shares.is_empty() && shares.is_sorted_by(|a, b| a >= b),
        "{said}"
    );
    let page = std::fs::read_to_string(dir.path().join("s.html")).expect("a page");
    assert!(page.contains("<h2>What lines could not do</h2>"), "{page}");
    assert!(page.contains("as <code>k</code> has no range"), "{page}");
    // Nobody asked: nothing is said.
    let plain = explained(RANGES, &args[2..]);
    let lines = plain["lines"].as_array().expect("a list");
    assert!(
        lines.iter().all(|line| line.get("why").is_none()),
        "{plain}"
    );
    let out = slowlight(dir.path(), &[&args[..], &["--whys"]].concat());
    assert_eq!(out.status.code(), Some(2));
}

/// A sentence that holds of several lines of a shape is said once, of all of them, and the file
/// is named where what it asks for is not the scene's own.
#[test]
fn what_is_true_of_several_lines_is_said_once() {
    let (shape, rest) = SCREW.split_at(SCREW.find("scene world").expect("its scene"));
    let (image, shape) = shape.split_once('\n').expect("two lines");
    let rest = rest.replace("trace(r)", "trace(r, far: 20)");
    let scene = format!("{image}\nuse \"screw.scn\";\n{rest}");
    let dir = directory(&[("s.scn", &scene), ("screw.scn", shape)]);
    let args = ["explain", "s.scn", "-t", "jack", "--format", "f316r"];
    let text = success(
        dir.path(),
        &[&args[..], &["--rows", "7..8", "--why"]].concat(),
    );
    let (_, said) = text.split_once("what lines could not do").expect("remarks");
    let sentences: Vec<&str> = (said.lines().skip(1))
        .filter_map(|line| line.split_once("): ")?.1.split(" would spare ").next())
        .collect();
    let mut once = sentences.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), sentences.len(), "{said}");
    assert!(
        said.contains("s.scn, line 6; screw.scn, lines 3, "),
        "{said}"
    );
    assert!(
        said.contains("`screw` in screw.scn has no bound and none was derived"),
        "{said}"
    );
}
