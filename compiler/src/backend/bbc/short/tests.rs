//! Short programs: what they are, and that they compute the same.

use super::*;

#[test]
fn spaces_stay_where_basic_needs_them() {
    let none = BTreeMap::new();
    for (text, small) in [
        ("IF a<1E5 THEN =a ELSE =0", "IFa<1E5 THEN=a ELSE=0"),
        (
            "IF b%>88 THEN c%=b% ELSE c%=2 DIV 3",
            "IFb%>88c%=b%ELSEc%=2DIV3",
        ),
        ("q%=n% MOD E%:r%=n% MOD 7", "q%=n%MOD E%:r%=n%MOD 7"),
        // A name or an exponent would go on, and a result would be compared.
        ("IF a<b THEN c=d:d=e", "IFa<b c=d:d=e"),
        ("IF a%<0 THEN e=d", "IFa%<0THENe=d"),
        ("IF a%<1E9 THEN PROCrow", "IFa%<1E9 PROCrow"),
        ("IF (a%) THEN IF b% THEN GOTO 3", "IF(a%)IFb%GOTO3"),
        ("IF a% THEN ?b%=3", "IFa%THEN?b%=3"),
        (
            "IF NOT done AND TRUE THEN \u{1}4\u{1}",
            "IFNOTdone ANDTRUE THEN\u{1}4\u{1}",
        ),
        (
            "IF ABS(a)<HALF THEN =x EOR 2 EOR y",
            "IFABS(a)<HALF THEN=x EOR 2 EOR y",
        ),
        (
            "PRINT \"a  b\":REM as  it is",
            "PRINT\"a  b\":REM as  it is",
        ),
    ] {
        assert_eq!(written(text, &none), small);
    }
}

#[test]
fn where_memory_is_short_numbers_below_0_stand_in_place_and_nothing_is_unread() {
    let mut body = Lines::default();
    for text in [
        "big=1.7E38:half=big/2:c=-96:d=-5",
        "x=y+c",
        "y=x-d:IF x<y THEN x=y",
    ] {
        body.line(text, None);
    }
    let constants = ["c", "d"].map(str::to_owned).into();
    let found = in_place(&body, &constants, SELDOM, true);
    assert_eq!(found, [("c".to_owned(), "-96".to_owned())].into());
    assert_eq!(in_place(&body, &constants, SELDOM, false), [].into());
    assert_eq!(
        unread(&body, &[]),
        ["big", "half"].map(str::to_owned).into()
    );
    let first = "big=1.7E38:half=big/2:c=-96:d=-5";
    assert_eq!(without_unread(first, &unread(&body, &[])), "c=-96:d=-5");
}

#[test]
fn where_memory_is_scant_calls_have_one_letter() {
    let mut body = Lines::default();
    for text in [
        "PROCrow:PROCa:x=FNdiv(x,FNsub(1,2))",
        "DEF PROCrow",
        "DEF FNdiv(a,b)",
        "PRINT \"PROCrow\"",
    ] {
        body.line(text, None);
    }
    with_short_calls(&mut body);
    let expected = [
        "PROCb:PROCa:x=FNa(x,FNb(1,2))",
        "DEF PROCb",
        "DEF FNa(a,b)",
        "PRINT \"PROCrow\"",
    ];
    assert_eq!(body.texts().collect::<Vec<_>>(), expected);
}

#[test]
fn short_names_keep_out_of_each_others_way() {
    let counts = [("long_one", 9), ("count%", 5), ("other%", 2), ("rare", 1)];
    let counts = counts.map(|(name, n)| (name.to_owned(), n)).into();
    let names = given(&counts, &["a".to_owned()]);
    let found: Vec<&str> = counts
        .keys()
        .filter_map(|n| names.get(n))
        .map(String::as_str)
        .collect();
    assert_eq!(found, ["A%", "e", "B%", "f"]);
}

#[test]
fn many_names_are_all_different_and_none_is_the_programs_own() {
    let mut counts = BTreeMap::new();
    for k in 0..150u64 {
        counts.insert(format!("whole_{k}%"), k);
        counts.insert(format!("real_{k}"), k);
        counts.insert(format!("list_{k}%("), k);
    }
    let names = given(&counts, &["first%".to_owned()]);
    assert_eq!(names.len(), 450);
    let mut seen = std::collections::BTreeSet::new();
    for (name, short) in &names {
        // An array's name is its own.
        let array = if name.ends_with('(') { "(" } else { "" };
        assert!(seen.insert(format!("{short}{array}")), "{short}");
        assert_eq!(
            name.trim_end_matches('(').ends_with('%'),
            short.ends_with('%')
        );
        assert!(array == "(" || !["I%", "R%", "X%", "Y%"].contains(&short.as_str()));
    }
}
