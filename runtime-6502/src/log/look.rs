//! What templates look up in tables, written out or called: `look` before a subroutine's name.

/// A template with what it looks up in tables written out, or called where memory is short,
/// and added to the operand whose number stands behind the subroutine's name: y a holds a
/// distance, below 0 where the name ends so, of which the complement is one less than its
/// magnitude. Behind the pages with upper bytes the subroutine is called.
pub fn looked_up(text: &str, calls: bool) -> String {
    let parts: Vec<&str> = text.split(['|', '\n']).map(str::trim).collect();
    let look = |part: &str| {
        let (name, operand) = part.strip_prefix("look ")?.split_once(' ')?;
        Some((name.to_owned(), operand.to_owned()))
    };
    let of_equals = "equal{n}: | [s lda {0.2} | sta {r.2}] | jmp none{n}";
    if calls {
        let call = |part: &&str| match look(part) {
            Some((name, operand)) => {
                let told = match name.as_str() {
                    "log_difference_less" => "cpx #1 | beq equal{n} | clc |",
                    _ => "",
                };
                format!(
                    "jsr {name} | {told} {} txa | {}",
                    low(&operand),
                    high(&operand)
                )
            }
            None if part.starts_with("jmp grownd") => format!("{part} | {of_equals}"),
            None => (*part).to_owned(),
        };
        return parts.iter().map(call).collect::<Vec<_>>().join(" | ");
    }
    let mut made: Vec<String> = Vec::new();
    for (at, part) in parts.iter().enumerate() {
        let written = look(part).map(|(name, operand)| inline(&name, &operand, at));
        made.push(written.unwrap_or_else(|| (*part).to_owned()));
        // Nothing comes by here: what is called where the first, or the second, is far greater.
        if part.starts_with("jmp grown") {
            let before = (0..at).rev().find_map(|k| Some((k, look(parts[k])?)));
            let behind = (at..parts.len()).find_map(|k| Some((k, look(parts[k])?)));
            if part.starts_with("jmp grownd") {
                made.push(of_equals.to_owned());
            }
            for (at, (name, operand)) in before.into_iter().chain(behind) {
                // What sums add is not below 0.
                let back = match name.starts_with("log_sum") {
                    true => "bpl",
                    false => "jmp",
                };
                made.push(format!(
                    "slow{at}x{{n}}: | jsr {name}_slow | {} txa | {back} back{at}x{{n}}",
                    low(&operand)
                ));
            }
        }
    }
    made.join(" | ")
}

/// Adds the lower byte to an operand's.
fn low(operand: &str) -> String {
    format!("adc {{{operand}.0}} | sta {{r.0}} |")
}

/// The upper one, with that carry.
fn high(operand: &str) -> String {
    format!("adc {{{operand}.1}} | sta {{r.1}}")
}

/// What a subroutine of so much a name does where both bytes are in its table.
fn inline(name: &str, operand: &str, at: usize) -> String {
    let table = match name.starts_with("log_sum") {
        true => "sums",
        false => "lost",
    };
    // Sums know the distance where the first is greater, and its complement, one less, where the
    // second is; differences, where equals are told apart, the other way round.
    let less = name.ends_with("_less");
    let (page, place) = match less {
        true => ("eor #$ff |", "tya | eor #$ff | tay |"),
        false => ("", ""),
    };
    let (by, pointer) = match less == (table == "sums") {
        true => ("+1", format!("less_{table}")),
        false => ("", table.to_owned()),
    };
    let equal = match name {
        "log_difference_less" => "bpl equal{n} |",
        _ => "",
    };
    format!(
        "{page} cmp #log_{table}_pages | bcs slow{at}x{{n}} | adc #>(log_{table}{by})
        sta {pointer}_at+1 | adc #log_pages | sta {pointer}_up+1
        {place} lda ({pointer}_at),y | {} lda ({pointer}_up),y | {equal} back{at}x{{n}}: | {}",
        low(operand),
        high(operand)
    )
}
