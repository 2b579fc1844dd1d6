//! What the instructions compute, apart from where their operands are.

use super::{Bus, Cpu, Step, flag};

/// The bits that `ane` and `lxa` find set in the accumulator beside its own. They
/// vary between chips and with temperature; $EE is what most are measured at.
const MAGIC: u8 = 0xEE;

impl Cpu {
    #[inline(always)]
    fn set_nz(&mut self, value: u8) {
        self.n = value;
        self.z = value;
    }

    #[inline(always)]
    pub(super) fn load_a(&mut self, value: u8) {
        self.a = value;
        self.set_nz(value);
    }

    #[inline(always)]
    pub(super) fn load_x(&mut self, value: u8) {
        self.x = value;
        self.set_nz(value);
    }

    #[inline(always)]
    pub(super) fn load_y(&mut self, value: u8) {
        self.y = value;
        self.set_nz(value);
    }

    #[inline(always)]
    pub(super) fn ora(&mut self, value: u8) {
        self.load_a(self.a | value);
    }

    #[inline(always)]
    pub(super) fn and(&mut self, value: u8) {
        self.load_a(self.a & value);
    }

    #[inline(always)]
    pub(super) fn eor(&mut self, value: u8) {
        self.load_a(self.a ^ value);
    }

    #[inline(always)]
    pub(super) fn bit(&mut self, value: u8) {
        self.n = value;
        self.v = value & flag::V != 0;
        self.z = self.a & value;
    }

    #[inline(always)]
    fn compare(&mut self, register: u8, value: u8) {
        self.c = register >= value;
        self.set_nz(register.wrapping_sub(value));
    }

    #[inline(always)]
    pub(super) fn cmp(&mut self, value: u8) {
        self.compare(self.a, value);
    }

    #[inline(always)]
    pub(super) fn cpx(&mut self, value: u8) {
        self.compare(self.x, value);
    }

    #[inline(always)]
    pub(super) fn cpy(&mut self, value: u8) {
        self.compare(self.y, value);
    }

    #[inline(always)]
    fn adc_binary(&mut self, value: u8) {
        let sum = u16::from(self.a) + u16::from(value) + u16::from(self.c);
        let [carry, result] = sum.to_be_bytes();
        self.v = (self.a ^ result) & (value ^ result) & 0x80 != 0;
        self.c = carry != 0;
        self.load_a(result);
    }

    #[inline(always)]
    pub(super) fn adc(&mut self, value: u8) {
        if self.d {
            self.adc_decimal(value)
        } else {
            self.adc_binary(value)
        }
    }

    #[inline(always)]
    pub(super) fn sbc(&mut self, value: u8) {
        if self.d {
            self.sbc_decimal(value)
        } else {
            self.adc_binary(!value)
        }
    }

    #[inline(always)]
    fn adc_decimal(&mut self, value: u8) {
        *self = decimal_sum(*self, value);
    }

    #[inline(always)]
    fn sbc_decimal(&mut self, value: u8) {
        *self = decimal_difference(*self, value);
    }

    #[inline(always)]
    pub(super) fn asl(&mut self, value: u8) -> u8 {
        self.c = value & 0x80 != 0;
        let result = value << 1;
        self.set_nz(result);
        result
    }

    #[inline(always)]
    pub(super) fn lsr(&mut self, value: u8) -> u8 {
        self.c = value & 0x01 != 0;
        let result = value >> 1;
        self.set_nz(result);
        result
    }

    #[inline(always)]
    pub(super) fn rol(&mut self, value: u8) -> u8 {
        let result = value << 1 | u8::from(self.c);
        self.c = value & 0x80 != 0;
        self.set_nz(result);
        result
    }

    #[inline(always)]
    pub(super) fn ror(&mut self, value: u8) -> u8 {
        let result = value >> 1 | u8::from(self.c) << 7;
        self.c = value & 0x01 != 0;
        self.set_nz(result);
        result
    }

    #[inline(always)]
    pub(super) fn inc(&mut self, value: u8) -> u8 {
        let result = value.wrapping_add(1);
        self.set_nz(result);
        result
    }

    #[inline(always)]
    pub(super) fn dec(&mut self, value: u8) -> u8 {
        let result = value.wrapping_sub(1);
        self.set_nz(result);
        result
    }

    // The undocumented opcodes: two documented ones at once.

    #[inline(always)]
    pub(super) fn lax(&mut self, value: u8) {
        self.x = value;
        self.load_a(value);
    }

    #[inline(always)]
    pub(super) fn slo(&mut self, value: u8) -> u8 {
        let result = self.asl(value);
        self.ora(result);
        result
    }

    #[inline(always)]
    pub(super) fn rla(&mut self, value: u8) -> u8 {
        let result = self.rol(value);
        self.and(result);
        result
    }

    #[inline(always)]
    pub(super) fn sre(&mut self, value: u8) -> u8 {
        let result = self.lsr(value);
        self.eor(result);
        result
    }

    #[inline(always)]
    pub(super) fn rra(&mut self, value: u8) -> u8 {
        let result = self.ror(value);
        self.adc(result);
        result
    }

    #[inline(always)]
    pub(super) fn dcp(&mut self, value: u8) -> u8 {
        let result = value.wrapping_sub(1);
        self.cmp(result);
        result
    }

    #[inline(always)]
    pub(super) fn isc(&mut self, value: u8) -> u8 {
        let result = value.wrapping_add(1);
        self.sbc(result);
        result
    }

    #[inline(always)]
    pub(super) fn anc(&mut self, value: u8) {
        self.and(value);
        self.c = self.a & 0x80 != 0;
    }

    #[inline(always)]
    pub(super) fn alr(&mut self, value: u8) {
        self.a = self.lsr(self.a & value);
    }

    #[inline(always)]
    pub(super) fn arr(&mut self, value: u8) {
        *self = and_ror(*self, value);
    }

    #[inline(always)]
    pub(super) fn sbx(&mut self, value: u8) {
        let both = self.a & self.x;
        self.compare(both, value);
        self.x = both.wrapping_sub(value);
    }

    #[inline(always)]
    pub(super) fn ane(&mut self, value: u8) {
        self.load_a((self.a | MAGIC) & self.x & value);
    }

    #[inline(always)]
    pub(super) fn lxa(&mut self, value: u8) {
        self.lax((self.a | MAGIC) & value);
    }

    #[inline(always)]
    pub(super) fn las(&mut self, value: u8) {
        self.sp &= value;
        self.lax(self.sp);
    }

    // Flow.

    #[inline(always)]
    pub(super) fn branch<B: Bus>(&mut self, bus: &mut B, taken: bool) {
        let offset = self.fetch(bus);
        if !taken {
            return;
        }
        bus.read(self.pc);
        let target = self.pc.wrapping_add_signed(i16::from(offset.cast_signed()));
        let early = (self.pc & 0xFF00) | (target & 0x00FF);
        if early != target {
            bus.read(early);
        }
        self.pc = target;
    }

    #[inline(always)]
    pub(super) fn brk<B: Bus>(&mut self, bus: &mut B) -> Step {
        self.fetch(bus);
        let p = self.status();
        self.enter(bus, p, 0xFFFE);
        Step::Brk
    }

    /// The high byte of the target is fetched after the return address is pushed.
    #[inline(always)]
    pub(super) fn jsr<B: Bus>(&mut self, bus: &mut B) {
        let lo = self.fetch(bus);
        self.peek_stack(bus);
        let [back_hi, back_lo] = self.pc.to_be_bytes();
        self.push(bus, back_hi);
        self.push(bus, back_lo);
        let hi = bus.read(self.pc);
        self.pc = u16::from_le_bytes([lo, hi]);
    }

    #[inline(always)]
    pub(super) fn rts<B: Bus>(&mut self, bus: &mut B) {
        bus.read(self.pc);
        self.peek_stack(bus);
        let lo = self.pull(bus);
        let hi = self.pull(bus);
        self.pc = u16::from_le_bytes([lo, hi]);
        self.fetch(bus);
    }

    #[inline(always)]
    pub(super) fn rti<B: Bus>(&mut self, bus: &mut B) {
        bus.read(self.pc);
        self.peek_stack(bus);
        let p = self.pull(bus);
        self.set_status(p);
        let lo = self.pull(bus);
        let hi = self.pull(bus);
        self.pc = u16::from_le_bytes([lo, hi]);
    }

    /// The pointer's high byte comes from the same page: the famous fault.
    #[inline(always)]
    pub(super) fn jmp_indirect<B: Bus>(&mut self, bus: &mut B) {
        let at = super::address::abs(self, bus);
        let lo = bus.read(at);
        let hi = bus.read((at & 0xFF00) | (at.wrapping_add(1) & 0x00FF));
        self.pc = u16::from_le_bytes([lo, hi]);
    }
}

// What is rare takes registers and answers them: nothing then needs an address of those
// that the loop around the processor has, which so can be the host's own registers.

/// Z is that of the binary sum; N and V are those after the low digit's
/// correction and before the high digit's. Digits above 9 go through as on the chip.
#[cold]
#[inline(never)]
fn decimal_sum(mut cpu: Cpu, value: u8) -> Cpu {
    let (a, b, carry) = (u16::from(cpu.a), u16::from(value), u16::from(cpu.c));
    let mut low = (a & 0x0F) + (b & 0x0F) + carry;
    if low > 0x09 {
        low = ((low + 0x06) & 0x0F) + 0x10;
    }
    let mut sum = (a & 0xF0) + (b & 0xF0) + low;
    let early = sum.to_be_bytes()[1];
    cpu.z = cpu.a.wrapping_add(value).wrapping_add(u8::from(cpu.c));
    cpu.n = early;
    cpu.v = (cpu.a ^ early) & !(cpu.a ^ value) & 0x80 != 0;
    if sum > 0x9F {
        sum += 0x60;
    }
    cpu.c = sum > 0xFF;
    cpu.a = sum.to_be_bytes()[1];
    cpu
}

/// All flags are those of the binary difference.
#[cold]
#[inline(never)]
fn decimal_difference(mut cpu: Cpu, value: u8) -> Cpu {
    let (a, b, borrow) = (i16::from(cpu.a), i16::from(value), i16::from(!cpu.c));
    let mut low = (a & 0x0F) - (b & 0x0F) - borrow;
    if low < 0 {
        low = ((low - 0x06) & 0x0F) - 0x10;
    }
    let mut difference = (a & 0xF0) - (b & 0xF0) + low;
    if difference < 0 {
        difference -= 0x60;
    }
    cpu.adc_binary(!value);
    cpu.a = difference.to_be_bytes()[1];
    cpu
}

/// `and` and `ror` with the adder's carries mixed in; in decimal mode the
/// adder corrects the digits. Behaves so on every chip measured, though
/// listed as unstable.
#[cold]
#[inline(never)]
fn and_ror(mut cpu: Cpu, value: u8) -> Cpu {
    let both = cpu.a & value;
    let rotated = both >> 1 | u8::from(cpu.c) << 7;
    cpu.load_a(rotated);
    cpu.v = (both ^ rotated) & 0x40 != 0;
    if !cpu.d {
        cpu.v = (rotated ^ rotated << 1) & 0x40 != 0;
        cpu.c = rotated & 0x40 != 0;
        return cpu;
    }
    if (both & 0x0F) + (both & 0x01) > 0x05 {
        cpu.a = (rotated & 0xF0) | (rotated.wrapping_add(0x06) & 0x0F);
    }
    cpu.c = u16::from(both & 0xF0) + u16::from(both & 0x10) > 0x50;
    if cpu.c {
        cpu.a = cpu.a.wrapping_add(0x60);
    }
    cpu
}
