//! What templates look up in tables, written out or called: `look` before a subroutine's name.

/// A template with what it looks up in tables written out, or called where memory is short:
/// y a holds a distance, below 0 where the name ends so, of which the complement is one less
/// than its magnitude. Behind the pages with upper bytes the subroutine is called.
pub fn looked_up(text: &str, calls: bool) -> String {
    let parts: Vec<&str> = text.split(['|', '\n']).map(str::trim).collect();
    let look = |part: &str| part.strip_prefix("look ").map(str::to_owned);
    let of_equals = "equal{n}: | [s lda {0.2} | sta {r.2}] | jmp none{n}";
    if calls {
        let call = |part: &&str| match look(part) {
            Some(name) if name == "log_difference_less" => {
                format!("jsr {name} | cpx #1 | beq equal{{n}} | clc")
            }
            Some(name) => format!("jsr {name}"),
            None if part.starts_with("jmp grownd") => format!("{part} | {of_equals}"),
            None => (*part).to_owned(),
        };
        return parts.iter().map(call).collect::<Vec<_>>().join(" | ");
    }
    let mut made: Vec<String> = Vec::new();
    for (at, part) in parts.iter().enumerate() {
        made.push(look(part).map_or((*part).to_owned(), |name| inline(&name, at)));
        // Nothing comes by here: what is called where the first, or the second, is far greater.
        if part.starts_with("jmp grown") {
            let before = (0..at).rev().find_map(|k| Some((k, look(parts[k])?)));
            let behind = (at..parts.len()).find_map(|k| Some((k, look(parts[k])?)));
            if part.starts_with("jmp grownd") {
                made.push(of_equals.to_owned());
            }
            for (at, name) in before.into_iter().chain(behind) {
                made.push(format!(
                    "slow{at}x{{n}}: | jsr {name}_slow | bcc back{at}x{{n}}"
                ));
            }
        }
    }
    made.join(" | ")
}

/// What a subroutine of so much a name does where both bytes are in its table.
fn inline(name: &str, at: usize) -> String {
    let table = match name.starts_with("log_sum") {
        true => "sums",
        false => "lost",
    };
    // Sums know the distance where the first is greater, and its complement, one less, where the
    // second is; differences, where equals are told apart, the other way round.
    let less = name.ends_with("_less");
    let turned = match less {
        true => "eor #$ff | tax | tya | eor #$ff | tay | txa |",
        false => "",
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
        "{turned} cmp #log_{table}_pages | bcs slow{at}x{{n}} | adc #>(log_{table}{by})
        sta {pointer}_at+1 | adc #log_pages | sta {pointer}_up+1
        lda ({pointer}_up),y | tax | {equal} lda ({pointer}_at),y | back{at}x{{n}}:"
    )
}
