//! Numbers and tables for people.

/// A duration in seconds, in two units at most: `2 h 43 min`, `9.81 s`.
pub fn duration(seconds: f64) -> String {
    let whole = |n: f64| n.floor() as u64;
    match seconds {
        s if s < 1e-3 => format!("{:.0} us", s * 1e6),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s if s < 60.0 => format!("{s:.2} s"),
        s if s < 3600.0 => format!("{} min {} s", whole(s / 60.0), whole(s % 60.0)),
        s if s < 86400.0 => format!("{} h {} min", whole(s / 3600.0), whole(s % 3600.0 / 60.0)),
        s => format!("{} d {} h", whole(s / 86400.0), whole(s % 86400.0 / 3600.0)),
    }
}

/// A whole number with commas between thousands.
pub fn count(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// Rows of cells as aligned columns: the first column left, the others right.
pub fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |k: usize| {
        let cells = rows.iter().filter_map(|r| r.get(k));
        cells.map(|c| c.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut out = String::new();
    for row in rows {
        let cells = row
            .iter()
            .zip(&widths)
            .enumerate()
            .map(|(k, (cell, &w))| match k {
                0 => format!("{cell:<w$}"),
                _ => format!("{cell:>w$}"),
            });
        out.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(count(0), "0");
        assert_eq!(count(17_779_441_084), "17,779,441,084");
        assert_eq!(count(100), "100");
        assert_eq!(duration(9800.0), "2 h 43 min");
        assert_eq!(duration(0.0125), "12 ms");
        assert_eq!(duration(90000.0), "1 d 1 h");
    }

    #[test]
    fn tables_align() {
        let rows = [["a", "10"], ["bcd", "5"]].map(|r| r.map(str::to_owned).to_vec());
        assert_eq!(table(&rows), "a    10\nbcd   5\n");
    }
}
