//! `Sys`: how a program begins and ends.
//!
//! Its `init` is put together for each program: see [`super::classes`].

/// The statics of `Sys` that say what an error was: whether there was one, and its
/// number. They are declared first.
pub const FAILED: u16 = 0;
/// See [`FAILED`].
pub const NUMBER: u16 = 1;

/// What the machine starts in; these classes are initialised first.
pub(super) fn init(classes: impl Iterator<Item = &'static str>) -> String {
    let calls: String = classes
        .map(|class| format!("        do {class}.init();\n"))
        .collect();
    format!(
        "    function void init() {{
{calls}        do Main.main();
        do Sys.halt();
        return;
    }}
"
    )
}

pub(super) const HALT: &str = "    function void halt() {
        while (true) { }
        return;
    }
";

/// Calls nothing that can fail: what divides may come here, and would be recursive.
/// A character is a word of 3 columns and 5 rows, the upper left in bit 14; each of
/// its pixels is drawn 5 wide and 5 high.
pub(super) const ERROR: &str = "    static boolean failed;
    static int number;
    static Array place;

    /** Shows ERR and the number in the upper left, and halts. */
    function void error(int errorCode) {
        var int rest;
        var boolean begun;
        let failed = true;
        let number = errorCode;
        let place = 16384;
        do Sys.show(31207);
        do Sys.show(27565);
        do Sys.show(27565);
        let rest = errorCode;
        if (rest < 0) { do Sys.show(448); }
        else { let rest = -rest; }
        let begun = (rest < (-9999));
        let rest = Sys.showDigit(rest, 10000, begun);
        let begun = begun | (rest < (-999));
        let rest = Sys.showDigit(rest, 1000, begun);
        let begun = begun | (rest < (-99));
        let rest = Sys.showDigit(rest, 100, begun);
        let begun = begun | (rest < (-9));
        let rest = Sys.showDigit(rest, 10, begun);
        let rest = Sys.showDigit(rest, 1, true);
        do Sys.halt();
        return;
    }

    function int showDigit(int rest, int unit, boolean begun) {
        var int digit;
        let digit = 31599;
        if (~((rest + unit) > 0)) { let digit = 11415; let rest = rest + unit; }
        if (~((rest + unit) > 0)) { let digit = 29671; let rest = rest + unit; }
        if (~((rest + unit) > 0)) { let digit = 29647; let rest = rest + unit; }
        if (~((rest + unit) > 0)) { let digit = 23497; let rest = rest + unit; }
        if (~((rest + unit) > 0)) { let digit = 31183; let rest = rest + unit; }
        if (~((rest + unit) > 0)) { let digit = 31215; let rest = rest + unit; }
        if (~((rest + unit) > 0)) { let digit = 29257; let rest = rest + unit; }
        if (~((rest + unit) > 0)) { let digit = 31727; let rest = rest + unit; }
        if (~((rest + unit) > 0)) { let digit = 31695; let rest = rest + unit; }
        if (begun) { do Sys.show(digit); }
        return rest;
    }

    function void show(int character) {
        var int row, word, line;
        let row = 5;
        while (row > 0) {
            let word = 0;
            let character = character + character;
            if (character < 0) { let word = 31; }
            let character = character + character;
            if (character < 0) { let word = word + 992; }
            let character = character + character;
            if (character < 0) { let word = word + 31744; }
            let line = 5;
            while (line > 0) {
                let place[0] = word;
                let place = place + 32;
                let line = line - 1;
            }
            let row = row - 1;
        }
        let place = place - 799;
        return;
    }
";

/// A millisecond is 7,200 cycles of the processor, in turns of about 9.
pub(super) const WAIT: &str = "    function void wait(int duration) {
        var int turns;
        if (duration < 0) { do Sys.error(1); }
        while (duration > 0) {
            let turns = 800;
            while (turns > 0) { let turns = turns - 1; }
            let duration = duration - 1;
        }
        return;
    }
";
