//! Flags of written programs, set in vain or not.

use super::dead::without;
use super::lines::texts::of_texts;

/// The lines `texts`, where `@n` goes to the line number n, without dead flags.
fn written(texts: &[&str]) -> String {
    let mut lines = without(of_texts(texts).0);
    lines.remove_empty();
    lines.finish().0
}

#[test]
fn a_flag_that_is_asked_for_on_no_way_is_not_set() {
    let source = [
        "FOR x%=1 TO 9",
        "a%=x%<4",
        "IF a% THEN b%=TRUE:a%=FALSE:GOTO @5;",
        "b%=FALSE",
        "IF x%<7 THEN a%=TRUE:GOTO @2;",
        "IF b% THEN PRINT x%",
        "a%=TRUE",
        "NEXT",
    ];
    let expected = "10FOR x%=1 TO 9\n20a%=x%<4\n30IF a% THEN b%=TRUE:GOTO 60\n40b%=FALSE\n\
        50IF x%<7 THEN a%=TRUE:GOTO 30\n60IF b% THEN PRINT x%\n70NEXT\n";
    assert_eq!(written(&source), expected);
}

#[test]
fn what_a_procedure_or_another_turn_reads_is_set() {
    let source = [
        "FOR y%=1 TO 9:a%=FALSE:FOR x%=1 TO 9",
        "PROCrow",
        "IF b% THEN a%=TRUE:GOTO @3;",
        "NEXT:NEXT:END",
        "DEF PROCrow",
        "IF a% THEN b%=TRUE:GOTO @7;",
        "b%=FALSE",
        "ENDPROC",
    ];
    let text = written(&source);
    assert!(
        text.contains("THEN a%=TRUE:GOTO 40\n") && text.contains("70b%=FALSE\n"),
        "{text}"
    );
}

#[test]
fn what_a_procedure_sets_before_it_asks_is_not_set_for_it() {
    let source = [
        "FOR x%=1 TO 9:PROCrun",
        "a%=x%<4",
        "IF a% THEN b%=TRUE:a%=FALSE:GOTO @3;",
        "IF b% THEN c%=TRUE",
        "NEXT:END",
        "DEF PROCrun",
        "IF x%>2 THEN PROCone:a%=b%:c%=a% ELSE a%=FALSE",
        "IF a% THEN PRINT x%",
        "ENDPROC",
        "DEF PROCone",
        "IF c% THEN b%=FALSE",
        "ENDPROC",
    ];
    let text = written(&source);
    assert!(
        text.contains("THEN b%=TRUE:GOTO 40\n") && text.contains("THEN c%=TRUE\n"),
        "{text}"
    );
}

#[test]
fn a_procedure_that_sets_a_flag_on_each_way_needs_none_before() {
    let source = [
        "FOR x%=1 TO 9",
        "IF x%<4 THEN a%=TRUE:GOTO @2;",
        "PROCset:b%=a%",
        "NEXT:END",
        "DEF PROCset",
        "IF b% THEN a%=TRUE:ENDPROC",
        "a%=x%<7",
        "ENDPROC",
    ];
    assert!(written(&source).contains("20IF x%<4 THEN 30\n"));
    let mut one = source;
    one[6] = "c%=x%<7";
    assert!(written(&one).contains("20IF x%<4 THEN a%=TRUE:GOTO 30\n"));
}
