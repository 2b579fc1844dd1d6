//! What things are called in a program.

use super::memory::Machine;
use crate::plan::Plan;
use slowlight_isa::opcodes;
use slowlight_routine::Source;
use std::collections::BTreeSet;

/// Labels and symbols of the frame; see there.
const RESERVED: &[&str] = &[
    "start",
    "next_entry",
    "entries_done",
    "vcs_boot",
    "vcs_show",
    "vcs_shown",
    "vcs_kernel",
    "vcs_publish",
    "vcs_convert",
    "vcs_fires",
    "vcs_striped",
    "vcs_whole",
    "vcs_begins",
    "vcs_reset",
    "vcs_ask",
    "vcs_ask_top",
    "vcs_frame_part",
    "vcs_publish_wait",
    "vcs_kernel_rows",
    "vcs_kernel_backs",
    "vcs_boot_clear",
    "vcs_boot_chip",
    "vcs_column_byte",
    "vcs_column_bit",
    "vcs_steps_low",
    "vcs_steps_high",
    "vcs_ask_least",
    "vcs_publish_least",
    "next_row",
    "next_column",
    "next_step",
    "low_step",
    "last_step",
    "next_pixel",
    "more_pixels",
    "last_pixel",
    "more_rows",
    "picture_done",
    "halted",
    "take_params",
    "take_param",
    "take_value",
    "take_least",
    "take_greatest",
    "take_wrong",
    "take_right",
    "take_int",
    "first_row",
    "last_row",
    "clamp_index",
    "clamp_index_above",
    "clamp_index_done",
    "width_port",
    "height_port",
    "inks_port",
    "x_port",
    "y_port",
    "ink_port",
    "exit_port",
    "palette_port",
    "hands_port",
    "held_port",
    "next_picture",
    "colours",
    "unseen_pixel",
    "next_pass",
    "next_start",
    "same_turn",
    "row_done",
    "whole_steps",
    "next_run",
    "still_pixel",
    "still_ink",
    "still_column",
    "more_still_done",
    "more_pixels_done",
    "pass_over",
    "at_pass",
    "right_to_pass",
    "errors",
    "clear_errors",
    "wrong_param",
    "wrong_letter",
    "wrong_ten",
    "wrong_text",
    "oswrch",
    "osbyte",
    "osrdch",
    "oscli",
    "basic",
    "begin",
    "screen_code",
    "screen_codes",
    "keep_picture",
    "skip_row",
    "skip_line",
    "first_line",
    "block_dot",
    "part_of_byte",
    "next_byte",
    "copy_line",
    "copy_byte",
    "copied_byte",
    "unseen_row",
    "next_line",
    "next_character",
    "patterns",
    "move_down",
    "copy_mover",
    "mover",
    "move_byte",
    "program_end",
    "port",
    "chrout",
    "cint",
    "keep_page",
    "fill_pages",
    "fill_page",
    "fill_last",
    "to_basic",
    "give_back",
    "give_byte",
    "no_interrupt",
];

/// What else programs for a BBC Micro have.
const ON_BBC: [&str; 12] = [
    "set_up",
    "picture",
    "shape",
    "colour",
    "screen_shape",
    "screen_colour",
    "clear_byte",
    "hidden",
    "hidden_low",
    "hidden_high",
    "shown_low",
    "shown_high",
];

/// Words that some assembler keeps for itself beside the 6502's instructions: those of
/// its successors, aliases of branches, other names of undocumented opcodes, operators,
/// constants. In small letters.
const FOREIGN: &[&str] = &[
    "bbr", "bbs", "bge", "blt", "bra", "brl", "cop", "cpa", "cpu", "gcc", "gcs", "geq", "gge",
    "glt", "gmi", "gne", "gpl", "gvc", "gvs", "jml", "jsl", "mvn", "mvp", "not", "pea", "pei",
    "per", "phb", "phd", "phk", "phx", "phy", "pi", "plb", "pld", "plx", "ply", "rep", "rmb",
    "rtl", "sep", "shl", "shr", "smb", "stp", "stz", "tcd", "tcs", "tdc", "trb", "tsb", "tsc",
    "txy", "tyx", "wai", "wdb", "xba", "xce", "ahx", "aso", "asr", "axs", "dcm", "dop", "ins",
    "isb", "jam", "lae", "lds", "lse", "shs", "top", "xaa",
];

/// Makes names that the assembler and the rest of the program leave free.
/// Kept in small letters: assemblers know their own words, and many know all
/// symbols, in either case.
pub(super) struct Names(BTreeSet<String>);

impl Names {
    pub fn new(plan: &Plan) -> Names {
        let mut taken: BTreeSet<String> = RESERVED.iter().map(|n| (*n).to_owned()).collect();
        taken.extend(["a", "x", "y", "s"].map(str::to_owned));
        taken.extend(FOREIGN.iter().map(|n| (*n).to_owned()));
        if Machine::of(plan) == Machine::Bbc {
            taken.extend(ON_BBC.iter().map(|n| (*n).to_owned()));
        }
        for part in plan.runtime.parts {
            let Source::Text(text) = part.source else {
                continue;
            };
            for line in text.lines() {
                let name = line.split([' ', ':', '=']).next().unwrap_or_default();
                taken.insert(name.to_ascii_lowercase());
            }
        }
        Names(taken)
    }

    pub fn fresh(&mut self, wanted: &str) -> String {
        // A name that begins with `_` would be seen only up to the next label in 64tass.
        let own = if wanted.starts_with('_') { "v" } else { "" };
        let wanted = &format!("{own}{wanted}");
        let mut name = wanted.to_owned();
        // Numbered labels are a word and a number; a table's have its plane's behind that.
        let numbered = wanted.ends_with(|c: char| c.is_ascii_digit()) && !wanted.contains('_');
        let small = wanted.to_ascii_lowercase();
        if numbered || small.starts_with("table") || opcodes::is_mnemonic(&small) {
            name.push('_');
        }
        let mut number = 1;
        while !self.0.insert(name.to_ascii_lowercase()) {
            number += 1;
            name = format!("{wanted}_{number}");
        }
        name
    }
}

#[cfg(test)]
mod tests {
    use crate::targets;
    use slowlight_routine::Source;
    use slowlight_runtime_6502::tidy::outline::{CALLED, WITHIN};

    /// The words of labels that are numbered as they come, in the code of a graph.
    const NUMBERED: [&str; 17] = [
        "after", "beyond", "column", "done", "else", "end", "go", "loop", "low", "moved", "out",
        "palette", "param", "run", "still", CALLED, WITHIN,
    ];

    #[test]
    fn no_runtime_has_a_label_that_is_a_numbered_one() {
        let all = targets::TARGETS.iter().chain(targets::OTHER_FORMATS);
        let all = all.flat_map(|target| target.runtime.parts);
        let mut seen = 0;
        for part in all {
            let Source::Text(text) = part.source else {
                continue;
            };
            for line in text.lines().filter(|line| line.contains(':')) {
                let label = line.split(':').next().unwrap_or_default();
                let word = label.trim_end_matches(|c: char| c.is_ascii_digit());
                seen += usize::from(word != label);
                assert!(word == label || !NUMBERED.contains(&word), "{label}");
            }
        }
        assert!(seen > 20, "{seen} labels end in a number");
    }
}
