//! Jumps that are threaded, in small programs.

use super::*;

fn program(lines: &[(&str, Option<usize>)], labels: &mut Labels, all: &[Label]) -> Lines {
    let mut out = Lines::default();
    let _ = labels;
    for (text, label) in lines {
        if let Some(label) = label {
            out.place(all[*label]);
        }
        let mut text = (*text).to_owned();
        for (k, label) in all.iter().enumerate() {
            text = text.replace(&format!("@{k}"), &label.to_string());
        }
        out.line(text, None);
    }
    out
}

#[test]
fn what_is_known_is_not_tested_again() {
    let mut labels = Labels::default();
    let all = [labels.next(), labels.next(), labels.next()];
    let source = [
        ("IF x<0 THEN v%=FALSE:GOTO @0", None),
        ("IF x<1 THEN v%=TRUE:GOTO @0", None),
        ("IF x<2 THEN w%=TRUE:GOTO @0", None),
        ("v%=y<1", None),
        ("IF NOT v% THEN @1", Some(0)),
        ("z=1", None),
        ("GOTO @2", Some(1)),
        ("z=2", None),
        ("END", Some(2)),
    ];
    let (text, _) = threaded(program(&source, &mut labels, &all), &mut labels, true).finish();
    let expected = "10IF x<0 THEN v%=FALSE:GOTO 90\n20IF x<1 THEN v%=TRUE:GOTO 60\n\
        30IF x<2 THEN w%=TRUE:GOTO 50\n40v%=y<1\n50IF NOT v% THEN 90\n60z=1\n70GOTO 90\n\
        80z=2\n90END\n";
    assert_eq!(text, expected);
}

#[test]
fn what_a_known_way_does_is_done_on_the_way() {
    let mut labels = Labels::default();
    let all = [labels.next(), labels.next(), labels.next()];
    let source = [
        ("IF x<0 THEN v%=TRUE:GOTO @0", None),
        ("v%=y<1", None),
        ("IF v% THEN z=x ELSE z=y", Some(0)),
        ("IF NOT v% THEN w%=TRUE", None),
        ("IF v% THEN w%=FALSE ELSE w%=z<1", None),
        ("IF w% THEN @1", None),
        ("z=1", None),
        ("END", Some(1)),
        // A procedure may set anything.
        ("IF x<0 THEN v%=TRUE:GOTO @2", None),
        ("IF v% THEN PROCa ELSE z=y", Some(2)),
        ("IF v% THEN z=x", None),
    ];
    let (text, _) = threaded(program(&source, &mut labels, &all), &mut labels, true).finish();
    let expected = "10IF x<0 THEN v%=TRUE:z=x:w%=FALSE:GOTO 80\n20v%=y<1\n30IF v% THEN z=x ELSE z=y\n\
        40IF NOT v% THEN w%=TRUE\n50IF v% THEN w%=FALSE:GOTO 80\n60w%=z<1\n70IF w% THEN 90\n80z=1\n\
        90END\n100IF x<0 THEN v%=TRUE:PROCa:GOTO 120\n110IF v% THEN PROCa ELSE z=y\n120IF v% THEN z=x\n";
    assert_eq!(text, expected);
}

#[test]
fn the_end_of_a_procedure_is_no_jump() {
    let mut labels = Labels::default();
    let all = [labels.next(), labels.next()];
    let source = [
        ("DEF PROCa", None),
        ("IF x<0 THEN @0", None),
        ("IF x<1 THEN v%=TRUE ELSE v%=y<1", None),
        ("IF v% THEN z=1:GOTO @0", None),
        ("z=2", None),
        ("ENDPROC", Some(0)),
    ];
    let (text, _) = threaded(program(&source, &mut labels, &all), &mut labels, true).finish();
    let expected = "10DEF PROCa\n20IF x<0 THEN ENDPROC\n30IF x<1 THEN v%=TRUE:z=1:ENDPROC\n\
        40v%=y<1\n50IF v% THEN z=1:ENDPROC\n60z=2\n70ENDPROC\n";
    assert_eq!(text, expected);
}

#[test]
fn jumps_in_a_ring_end() {
    let mut labels = Labels::default();
    let all = [labels.next(), labels.next(), labels.next()];
    let source = [("GOTO @1", Some(0)), ("GOTO @0", Some(1))];
    let (text, _) = threaded(program(&source, &mut labels, &all), &mut labels, true).finish();
    assert!(text.lines().count() == 2 && text.contains("GOTO"));
}
