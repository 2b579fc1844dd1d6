#![allow(clippy::unwrap_used)]

use crate::plan::{Goal, Plan, plan};
use crate::scene::check;
use crate::sema::Options;
use crate::target::{default_mode, find};

fn planned(name: &str, source: &str) -> Plan {
    let target = find("jack").unwrap();
    let scene = check("test", source);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let options = Options {
        inks: Some(2),
        offset: target.offset,
        ..Options::default()
    };
    let graph = scene.lower(&options).unwrap();
    let mode = default_mode(target, graph.image.width, graph.image.height).unwrap();
    let goal = Goal {
        name: name.to_owned(),
        mode,
        rows: None,
        plot: true,
    };
    plan(&graph, target, &goal).unwrap()
}

fn text(name: &str, source: &str) -> String {
    let documents = (super::JACK.emit)(&planned(name, source));
    let mut all = String::new();
    for document in documents {
        assert_eq!(document.text.lines().count(), document.lines.len());
        all += &format!("---- {}\n{}", document.name, document.text);
    }
    all
}

#[test]
fn shown() {
    println!(
        "{}",
        text("mirrors", include_str!("../../../../examples/mirrors.scn"))
    );
}
