//! Lines before and behind.

use super::super::lines::texts::of_texts;
use super::super::test_line::opposite;
use super::*;

/// The lines `texts`, where `@n;` goes to the line number n, without tests that are known.
fn written(texts: &[&str], copies: bool) -> String {
    let copies = if copies { Copies::Ends } else { Copies::None };
    let (lines, mut labels) = of_texts(texts);
    let lines = super::super::dead::without(split(lines, &mut labels, copies));
    let mut lines = split(lines, &mut labels, Copies::None);
    lines.remove_empty();
    lines.finish().0
}

const FLAG: [&str; 10] = [
    "FOR x%=1 TO 9",
    "IF f% THEN a%=x>=0 ELSE a%=x<0",
    "IF a% THEN @5;",
    "y=x*2",
    "a%=FALSE",
    "z=x*x",
    "IF z<1 THEN @8;",
    "IF NOT a% THEN z=y",
    "PRINT z",
    "NEXT",
];

#[test]
fn a_way_has_a_copy_of_what_stands_before_a_known_test() {
    // The way where a% holds goes past the test; the other way needs no flag.
    let expected = "10FOR x%=1 TO 9\n20IF f%=(x>=0) THEN 50\n30y=x*2\n40GOTO 80\n\
        50z=x*x\n60IF z<1 THEN 110\n70GOTO 110\n80z=x*x\n90IF z<1 THEN 110\n\
        100z=y\n110PRINT z\n120NEXT\n";
    assert_eq!(written(&FLAG, true), expected);
}

#[test]
fn without_memory_nothing_is_copied() {
    let text = written(&FLAG, false);
    assert!(text.contains("IF NOT a% THEN z=y"), "{text}");
    assert_eq!(text.matches("z=x*x").count(), 1, "{text}");
}

#[test]
fn what_is_known_wherever_control_comes_from_is_not_asked() {
    let source = [
        "IF x<0 THEN a%=TRUE:GOTO @3;",
        "a%=y<1",
        "IF NOT a% THEN @6;",
        "IF a% THEN z=1",
        "PRINT z",
        "END",
        "z=2",
        "END",
    ];
    let expected = "10IF x<0 THEN 30\n20IF y>=1 THEN 60\n30z=1\n40PRINT z\n50END\n\
        60z=2\n70END\n";
    assert_eq!(written(&source, true), expected);
}

#[test]
fn a_flag_that_is_read_later_is_kept() {
    let source = [
        "a%=x<1",
        "IF a% THEN @3;",
        "z=2",
        "PRINT z",
        "IF a% THEN z=1",
        "END",
    ];
    let text = written(&source, false);
    assert!(text.starts_with("10a%=x<1\n20IF a% THEN 40\n"), "{text}");
}

#[test]
fn a_flag_tells_what_it_was_compared_with() {
    let mut source = [
        "FOR x%=1 TO 9",
        "IF f%=(x>=0) THEN @5;",
        "y=x*2",
        "IF x>=0 THEN @6;",
        "GOTO @7;",
        "IF x<0 THEN @7;",
        "z=1",
        "NEXT",
    ];
    let expected = "10FOR x%=1 TO 9\n20IF f%=(x>=0) THEN 60\n30y=x*2\n40IF NOT f% THEN 70\n\
        50GOTO 80\n60IF NOT f% THEN 80\n70z=1\n80NEXT\n";
    assert_eq!(written(&source, false), expected);
    // Of what is another value by then it tells nothing.
    for set in ["x=y", "f%=TRUE", "PROCa"] {
        source[2] = set;
        let text = written(&source, false);
        assert!(text.contains("40IF x>=0 THEN 70\n"), "{text}");
    }
}

#[test]
fn lowest_bits_are_asked_for_in_place() {
    let source = [
        "IF y<1 THEN @7;",
        "n%=INT(x)+INT(y)",
        "IF n% AND 1 THEN @5;",
        "z=2",
        "END",
        "z=1",
        "END",
        "n%=FNfloor(x)",
        "GOTO @2;",
    ];
    let expected = "10IF y<1 THEN 70\n20IF INT(x)+INT(y) AND 1 THEN 50\n30z=2\n40END\n\
        50z=1\n60END\n70IF FNfloor(x) AND 1 THEN 50\n80GOTO 30\n";
    assert_eq!(written(&source, false), expected);
    let mut read = source;
    read[3] = "z=n%+1";
    assert!(written(&read, false).contains("n%=INT(x)+INT(y)\n"));
}

#[test]
fn opposites() {
    assert_eq!(opposite("a<b+1").as_deref(), Some("a>=b+1"));
    assert_eq!(opposite("NOT a%").as_deref(), Some("a%"));
    assert_eq!(opposite("a<>b").as_deref(), Some("a=b"));
    assert_eq!(opposite("a<b AND c"), None);
    assert_eq!(opposite("a%=(b<c)"), None);
}
