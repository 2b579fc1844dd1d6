//! The formatter keeps what a scene says and settles how it looks.

use super::*;
use crate::format::format;
use crate::{lexer, print};
use proptest::prelude::*;

/// Formats, and holds what is true of every right scene.
fn formatted(text: &str) -> String {
    let once = format(text, 0).unwrap();
    assert_eq!(format(&once, 0).unwrap(), once, "twice is not once");
    let (was, is) = (lexer::lex(text, 0), lexer::lex(&once, 0));
    let tokens = |l: &lexer::Lexed| {
        l.tokens
            .iter()
            .map(|t| t.0.parts().1.to_string())
            .collect::<Vec<_>>()
    };
    let comments = |l: &lexer::Lexed| {
        l.comments
            .iter()
            .map(|c| c.0.to_string())
            .collect::<Vec<_>>()
    };
    assert_eq!(tokens(&was), tokens(&is));
    assert_eq!(comments(&was), comments(&is));
    assert_eq!(
        print::tree(&parse(text, 0).0),
        print::tree(&parse(&once, 0).0)
    );
    once
}

#[test]
fn whole_scenes() {
    let all: Vec<String> = SCENES.iter().map(|scene| formatted(scene)).collect();
    snapshot("formatted_scenes", &all.join("---\n"));
}

/// Every scene of the repository, the library's files included.
#[test]
fn whole_files() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut count = 0;
    for folder in ["examples", "compiler/prelude", "tests/scenes"] {
        for entry in std::fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| e == "scn") {
                formatted(&std::fs::read_to_string(&path).unwrap());
                count += 1;
            }
        }
    }
    assert!(count >= 28, "{count} scenes");
}

#[test]
fn spacing_and_lines() {
    let messy = "\n\n\n//first\nimage  8x8 inks black,white ;// frame\n".replace("8x8", "8 x 8")
        + "param a:real=- 1 in -2..2; // a\n\n\n\nconst table=[ 1,2 ;3 , 4 ] ; // longer than a\n"
        + "fn f ( a : real ,g : fn ( real ) -> [ real ? ] )->real=a+b*- c ^ - 2/3 -1 / 2;\n"
        + "fn h()->real=\nif a<1\nthen {let b=1 ;\nframe   let c=2; // c\n// alone\nb+c[ 1,2 ] . d}\nelse next( - 1 );\n"
        + "shape s(){dist(p)=length( p );\nbound=box(\n1,\n2\n);\n}\nshape t() { }\n"
        + "scene w{s() is 1;\nsphere(1,2,3) is 2; // b\nt();\n}\n"
        + "map m {\n\"##\"\n\"#.\"\n}where '#'=>1,\n'.'=>0;\r\n"
        + "dither d(v:real,x:int,y:int)->ink={spread v - 1 to{(1,0):7 / 16,\n(0,1) : 1/2};\n\nink(loop(i=0)max(3){next(i)}else 1)};\n"
        + "const r=1 / 2+a * 1/2-2/3^2; // no ratio takes a part from what holds it\nshape u(){\n} \n//behind\n"
        + "draw(x,y)=a.f ( not b,c : -d ) [0];  // end\n// after";
    assert_eq!(formatted(""), "");
    assert_eq!(formatted(" // a\n\n"), "// a\n");
    snapshot("formatted_messy", &formatted(&messy));
}

#[test]
fn no_two_items_share_a_line() {
    let text =
        "const a = 1;const b = [1,  2;\n3, 4]; // b\nscene w { s() is 1; } fn f() -> int = a;";
    let wanted = "const a = 1;\nconst b = [1, 2;\n  3, 4];  // b\nscene w { s() is 1; }\nfn f() -> int = a;\n";
    assert_eq!(formatted(text), wanted);
}

#[test]
fn what_is_wrong_is_left_alone() {
    let diagnostics = format("const a = ;", 0).unwrap_err();
    assert_eq!(diagnostics.len(), 1);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// However a scene is broken into lines and commented, all of it stays.
    #[test]
    fn any_layout_of_a_scene(scene in 0..SCENES.len(), gaps in proptest::collection::vec(0..6usize, 1..300)) {
        let lexed = lexer::lex(SCENES[scene], 0);
        let mut text = String::new();
        for (at, (token, _)) in lexed.tokens.iter().enumerate() {
            text += token.parts().1;
            text += ["  ", " ", "\n", "\n\n\n", " // a\n", "\n//  b \n\n"][gaps[at % gaps.len()]];
        }
        formatted(&text);
    }
}
