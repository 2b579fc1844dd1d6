//! The interval timer, read at known cycles.

use super::*;

/// What INTIM reads so many cycles after the cycle that stored to the timer.
fn after(register: u16, value: u8, cycles: u32) -> u8 {
    // A read takes place in the last of `lda abs`'s four cycles.
    let mut left = cycles - 4;
    let mut wait = String::new();
    while left > 600 {
        // 2 + 5 n - 1 cycles.
        wait.push_str(&format!(" ldx #100\nw{left}: dex\n bne w{left}\n"));
        left -= 501;
    }
    if left % 2 == 1 {
        wait.push_str(" bit $90\n");
        left -= 3;
    }
    wait.push_str(&" nop\n".repeat(left as usize / 2));
    let mut machine = machine(&format!(
        " lda #{value}\n sta ${register:04X}\n{wait} lda $0284\n sta $80\nstays: jmp stays\n"
    ));
    machine.run(400_000, &mut |_| true);
    machine.peek(0x80)
}

#[test]
fn the_timer_counts_by_its_interval() {
    for (register, interval) in [(0x294, 1), (0x295, 8), (0x296, 64), (0x297, 1024)] {
        let value = 20;
        // One less in the cycle after the store, then one less every interval.
        for (cycles, expected) in [
            (interval.max(6), value - 1 - u32::from(interval < 6) * 5),
            (3 * interval + 8, value - 1 - (3 * interval + 7) / interval),
            (value * interval, 0),
            (value * interval + 1, 255),
            // From there by one a cycle, and a first read does not change that yet.
            (value * interval + 2, 254),
            (value * interval + 101, 155),
        ] {
            let found = u32::from(after(register, value as u8, cycles));
            assert_eq!(found, expected, "interval {interval}, {cycles} cycles");
        }
    }
}

/// The flag is set when the timer has passed 0, and a read of the timer clears it and gives it
/// its interval back.
#[test]
fn the_flag_is_cleared_by_a_read_of_the_timer() {
    let mut machine = machine(
        " lda #1\n sta $0295\n lda $0285\n sta $80\n nop\n nop\n nop\n lda $0285\n sta $81\n \
         lda $0285\n sta $82\n lda $0284\n sta $83\n lda $0285\n sta $84\n lda $0284\n sta $85\n \
         lda $0284\n sta $86\nstays: jmp stays\n",
    );
    machine.run(400, &mut |_| true);
    // 1 is stored in cycle 0; the timer is 0 to cycle 8, and 255 in cycle 9. Reads are in
    // cycles 4, 17, 24 (the flag, which they leave), 31 (the timer), 38, 45 and 52.
    let found = (0x80..0x87).map(|at| machine.peek(at)).collect::<Vec<u8>>();
    assert_eq!(found, [0, 128, 128, 255 - 22, 0, 255 - 24, 255 - 25]);
}
