use super::outline;

/// A program's own lines, and what stands behind them.
fn outlined(own: &str, behind: &str, excess: u32) -> String {
    let head = ["a_1 = $10", "a_2 = $11", "b_1 = $12", "b_2 = $300"];
    let lines = |text: &str| -> Vec<(String, ())> {
        text.lines().map(|line| (line.to_owned(), ())).collect()
    };
    let mut all: Vec<(String, ())> = lines(&head.join("\n"));
    let start = all.len();
    all.extend(lines(own));
    let end = all.len();
    all.extend(lines(behind));
    outline(&mut all, &(0..start), &(start..end), excess);
    let text: Vec<String> = all.into_iter().skip(start).map(|(line, ())| line).collect();
    text.join("\n")
}

const ROUNDED: &str = "        lda a_1
        bpl NAME
        inc a_2
        bne NAME
        sec
        adc #1
NAME:
        sta b_2";

fn rounded(name: &str) -> String {
    ROUNDED.replace("NAME", name)
}

#[test]
fn what_a_program_has_twice_becomes_a_subroutine() {
    let own = format!(
        "        ; one\n{}\n        clc\n        ; two\n{}\n        rts",
        rounded("r1"),
        rounded("r2")
    );
    let made = outlined(&own, "", 100);
    let wanted = "        ; one
        jsr shared1
        clc
        ; two
        jsr shared1
        rts
shared1:
        lda a_1
        bpl within2
        inc a_2
        bne within2
        sec
        adc #1
within2:
        sta b_2
        rts";
    assert_eq!(made, wanted);
}

#[test]
fn no_more_is_called_than_a_program_is_too_large_by() {
    let own = format!(
        "{}\n        clc\n{}\n        rts",
        rounded("r1"),
        rounded("r2")
    );
    assert_eq!(outlined(&own, "", 0), own);
}

/// One that is entered in the middle is left as it is, whoever enters it; so is one that is left
/// in the middle.
#[test]
fn what_is_entered_or_left_in_the_middle_stays() {
    let (one, two) = (rounded("r1"), rounded("r2"));
    let apart = "        clc\n        rts\n        sec";
    for (own, behind) in [
        (
            format!("{one}\n{apart}\n{two}\n        rts"),
            "        jmp r1",
        ),
        (
            format!("{one}\n{apart}\n{two}\n        rts"),
            "        .word r2",
        ),
        (
            format!("        bcc r1\n{one}\n{apart}\n{two}\n        rts"),
            "",
        ),
        (
            format!("{one}\n{apart}\n{two}\n        rts")
                .replace("        sec\n        adc", "        bcs r1\n        adc"),
            "",
        ),
    ] {
        let made = outlined(&own, behind, 100);
        // What ends at the label may be a subroutine, but not what goes on behind it.
        assert_eq!(made.matches("sta b_2").count(), 2, "{made}");
    }
}

/// Loops go back within a subroutine, and what goes behind the last instruction leaves it.
#[test]
fn branches_to_either_end_stay_within() {
    let turn = |name: &str| {
        format!(
            "{name}:\n        asl a_1\n        rol b_2\n        rol b_2+1\n        bcs {name}_e\n        dex\n        bne {name}\n{name}_e:"
        )
    };
    let own = format!(
        "{}\n        clc\n{}\n        sec\n        rts",
        turn("t"),
        turn("u")
    );
    let made = outlined(&own, "", 100);
    assert!(
        made.contains("bcs within2\n        dex\n        bne shared1\nwithin2:\n        rts"),
        "{made}"
    );
    assert_eq!(made.matches("jsr shared1").count(), 2);
}

#[test]
fn what_uses_the_stack_stays() {
    let part = "        pha\n        lda b_2\n        sta b_2+1\n        pla\n        rts";
    let own = format!("{part}\n        clc\n{part}");
    let made = outlined(&own, "", 100);
    assert_eq!(made.matches("pha").count(), 2, "{made}");
}

/// What subroutines have alike is a subroutine as well.
#[test]
fn subroutines_call_others() {
    let part = |k: u32| {
        format!(
            "{}\n        ldx #{k}\n        stx b_2+2",
            rounded(&format!("r{k}_SIDE"))
        )
    };
    let whole = |side: &str| format!("{}\n{}", part(1), part(2)).replace("SIDE", side);
    let own = format!("{}\n        clc\n{}\n        rts", whole("l"), whole("r"));
    let made = outlined(&own, "", 100);
    assert_eq!(made.matches("inc a_2").count(), 1, "{made}");
}
