//! Which opcode does what where: one line an opcode.

use super::address::*;
use super::{Bus, Cpu, Step};

impl Cpu {
    /// Runs one instruction; every bus access of it is made through `bus`.
    #[inline(always)]
    pub fn step<B: Bus>(&mut self, bus: &mut B) -> Step {
        match self.fetch(bus) {
            // $00
            0x00 => return self.brk(bus),
            0x01 => self.load(bus, ind_x, Cpu::ora),
            0x03 => self.modify(bus, ind_x, Cpu::slo),
            0x04 => self.load(bus, zp, |_, _| {}),
            0x05 => self.load(bus, zp, Cpu::ora),
            0x06 => self.modify(bus, zp, Cpu::asl),
            0x07 => self.modify(bus, zp, Cpu::slo),
            0x08 => self.push_op(bus, Cpu::status),
            0x09 => self.immediate(bus, Cpu::ora),
            0x0A => self.implied(bus, |c| c.a = c.asl(c.a)),
            0x0B => self.immediate(bus, Cpu::anc),
            0x0C => self.load(bus, abs, |_, _| {}),
            0x0D => self.load(bus, abs, Cpu::ora),
            0x0E => self.modify(bus, abs, Cpu::asl),
            0x0F => self.modify(bus, abs, Cpu::slo),
            // $10
            0x10 => self.branch(bus, self.n & 0x80 == 0),
            0x11 => self.load(bus, ind_y_read, Cpu::ora),
            0x13 => self.modify(bus, ind_y, Cpu::slo),
            0x14 => self.load(bus, zp_x, |_, _| {}),
            0x15 => self.load(bus, zp_x, Cpu::ora),
            0x16 => self.modify(bus, zp_x, Cpu::asl),
            0x17 => self.modify(bus, zp_x, Cpu::slo),
            0x18 => self.implied(bus, |c| c.c = false),
            0x19 => self.load(bus, abs_y_read, Cpu::ora),
            0x1A => self.implied(bus, |_| {}),
            0x1B => self.modify(bus, abs_y, Cpu::slo),
            0x1C => self.load(bus, abs_x_read, |_, _| {}),
            0x1D => self.load(bus, abs_x_read, Cpu::ora),
            0x1E => self.modify(bus, abs_x, Cpu::asl),
            0x1F => self.modify(bus, abs_x, Cpu::slo),
            // $20
            0x20 => self.jsr(bus),
            0x21 => self.load(bus, ind_x, Cpu::and),
            0x23 => self.modify(bus, ind_x, Cpu::rla),
            0x24 => self.load(bus, zp, Cpu::bit),
            0x25 => self.load(bus, zp, Cpu::and),
            0x26 => self.modify(bus, zp, Cpu::rol),
            0x27 => self.modify(bus, zp, Cpu::rla),
            0x28 => self.pull_op(bus, Cpu::set_status),
            0x29 => self.immediate(bus, Cpu::and),
            0x2A => self.implied(bus, |c| c.a = c.rol(c.a)),
            0x2B => self.immediate(bus, Cpu::anc),
            0x2C => self.load(bus, abs, Cpu::bit),
            0x2D => self.load(bus, abs, Cpu::and),
            0x2E => self.modify(bus, abs, Cpu::rol),
            0x2F => self.modify(bus, abs, Cpu::rla),
            // $30
            0x30 => self.branch(bus, self.n & 0x80 != 0),
            0x31 => self.load(bus, ind_y_read, Cpu::and),
            0x33 => self.modify(bus, ind_y, Cpu::rla),
            0x34 => self.load(bus, zp_x, |_, _| {}),
            0x35 => self.load(bus, zp_x, Cpu::and),
            0x36 => self.modify(bus, zp_x, Cpu::rol),
            0x37 => self.modify(bus, zp_x, Cpu::rla),
            0x38 => self.implied(bus, |c| c.c = true),
            0x39 => self.load(bus, abs_y_read, Cpu::and),
            0x3A => self.implied(bus, |_| {}),
            0x3B => self.modify(bus, abs_y, Cpu::rla),
            0x3C => self.load(bus, abs_x_read, |_, _| {}),
            0x3D => self.load(bus, abs_x_read, Cpu::and),
            0x3E => self.modify(bus, abs_x, Cpu::rol),
            0x3F => self.modify(bus, abs_x, Cpu::rla),
            // $40
            0x40 => self.rti(bus),
            0x41 => self.load(bus, ind_x, Cpu::eor),
            0x43 => self.modify(bus, ind_x, Cpu::sre),
            0x44 => self.load(bus, zp, |_, _| {}),
            0x45 => self.load(bus, zp, Cpu::eor),
            0x46 => self.modify(bus, zp, Cpu::lsr),
            0x47 => self.modify(bus, zp, Cpu::sre),
            0x48 => self.push_op(bus, |c| c.a),
            0x49 => self.immediate(bus, Cpu::eor),
            0x4A => self.implied(bus, |c| c.a = c.lsr(c.a)),
            0x4B => self.immediate(bus, Cpu::alr),
            0x4C => self.pc = abs(self, bus),
            0x4D => self.load(bus, abs, Cpu::eor),
            0x4E => self.modify(bus, abs, Cpu::lsr),
            0x4F => self.modify(bus, abs, Cpu::sre),
            // $50
            0x50 => self.branch(bus, !self.v),
            0x51 => self.load(bus, ind_y_read, Cpu::eor),
            0x53 => self.modify(bus, ind_y, Cpu::sre),
            0x54 => self.load(bus, zp_x, |_, _| {}),
            0x55 => self.load(bus, zp_x, Cpu::eor),
            0x56 => self.modify(bus, zp_x, Cpu::lsr),
            0x57 => self.modify(bus, zp_x, Cpu::sre),
            0x58 => self.implied(bus, |c| c.i = false),
            0x59 => self.load(bus, abs_y_read, Cpu::eor),
            0x5A => self.implied(bus, |_| {}),
            0x5B => self.modify(bus, abs_y, Cpu::sre),
            0x5C => self.load(bus, abs_x_read, |_, _| {}),
            0x5D => self.load(bus, abs_x_read, Cpu::eor),
            0x5E => self.modify(bus, abs_x, Cpu::lsr),
            0x5F => self.modify(bus, abs_x, Cpu::sre),
            // $60
            0x60 => self.rts(bus),
            0x61 => self.load(bus, ind_x, Cpu::adc),
            0x63 => self.modify(bus, ind_x, Cpu::rra),
            0x64 => self.load(bus, zp, |_, _| {}),
            0x65 => self.load(bus, zp, Cpu::adc),
            0x66 => self.modify(bus, zp, Cpu::ror),
            0x67 => self.modify(bus, zp, Cpu::rra),
            0x68 => self.pull_op(bus, Cpu::load_a),
            0x69 => self.immediate(bus, Cpu::adc),
            0x6A => self.implied(bus, |c| c.a = c.ror(c.a)),
            0x6B => self.immediate(bus, Cpu::arr),
            0x6C => self.jmp_indirect(bus),
            0x6D => self.load(bus, abs, Cpu::adc),
            0x6E => self.modify(bus, abs, Cpu::ror),
            0x6F => self.modify(bus, abs, Cpu::rra),
            // $70
            0x70 => self.branch(bus, self.v),
            0x71 => self.load(bus, ind_y_read, Cpu::adc),
            0x73 => self.modify(bus, ind_y, Cpu::rra),
            0x74 => self.load(bus, zp_x, |_, _| {}),
            0x75 => self.load(bus, zp_x, Cpu::adc),
            0x76 => self.modify(bus, zp_x, Cpu::ror),
            0x77 => self.modify(bus, zp_x, Cpu::rra),
            0x78 => self.implied(bus, |c| c.i = true),
            0x79 => self.load(bus, abs_y_read, Cpu::adc),
            0x7A => self.implied(bus, |_| {}),
            0x7B => self.modify(bus, abs_y, Cpu::rra),
            0x7C => self.load(bus, abs_x_read, |_, _| {}),
            0x7D => self.load(bus, abs_x_read, Cpu::adc),
            0x7E => self.modify(bus, abs_x, Cpu::ror),
            0x7F => self.modify(bus, abs_x, Cpu::rra),
            // $80
            0x80 => self.immediate(bus, |_, _| {}),
            0x81 => self.store(bus, ind_x, |c| c.a),
            0x82 => self.immediate(bus, |_, _| {}),
            0x83 => self.store(bus, ind_x, |c| c.a & c.x),
            0x84 => self.store(bus, zp, |c| c.y),
            0x85 => self.store(bus, zp, |c| c.a),
            0x86 => self.store(bus, zp, |c| c.x),
            0x87 => self.store(bus, zp, |c| c.a & c.x),
            0x88 => self.implied(bus, |c| c.load_y(c.y.wrapping_sub(1))),
            0x89 => self.immediate(bus, |_, _| {}),
            0x8A => self.implied(bus, |c| c.load_a(c.x)),
            0x8B => self.immediate(bus, Cpu::ane),
            0x8C => self.store(bus, abs, |c| c.y),
            0x8D => self.store(bus, abs, |c| c.a),
            0x8E => self.store(bus, abs, |c| c.x),
            0x8F => self.store(bus, abs, |c| c.a & c.x),
            // $90
            0x90 => self.branch(bus, !self.c),
            0x91 => self.store(bus, ind_y, |c| c.a),
            0x93 => self.sha_ind_y(bus),
            0x94 => self.store(bus, zp_x, |c| c.y),
            0x95 => self.store(bus, zp_x, |c| c.a),
            0x96 => self.store(bus, zp_y, |c| c.x),
            0x97 => self.store(bus, zp_y, |c| c.a & c.x),
            0x98 => self.implied(bus, |c| c.load_a(c.y)),
            0x99 => self.store(bus, abs_y, |c| c.a),
            0x9A => self.implied(bus, |c| c.sp = c.x),
            0x9B => self.tas(bus),
            0x9C => self.masked_abs(bus, self.x, self.y),
            0x9D => self.store(bus, abs_x, |c| c.a),
            0x9E => self.masked_abs(bus, self.y, self.x),
            0x9F => self.masked_abs(bus, self.y, self.a & self.x),
            // $A0
            0xA0 => self.immediate(bus, Cpu::load_y),
            0xA1 => self.load(bus, ind_x, Cpu::load_a),
            0xA2 => self.immediate(bus, Cpu::load_x),
            0xA3 => self.load(bus, ind_x, Cpu::lax),
            0xA4 => self.load(bus, zp, Cpu::load_y),
            0xA5 => self.load(bus, zp, Cpu::load_a),
            0xA6 => self.load(bus, zp, Cpu::load_x),
            0xA7 => self.load(bus, zp, Cpu::lax),
            0xA8 => self.implied(bus, |c| c.load_y(c.a)),
            0xA9 => self.immediate(bus, Cpu::load_a),
            0xAA => self.implied(bus, |c| c.load_x(c.a)),
            0xAB => self.immediate(bus, Cpu::lxa),
            0xAC => self.load(bus, abs, Cpu::load_y),
            0xAD => self.load(bus, abs, Cpu::load_a),
            0xAE => self.load(bus, abs, Cpu::load_x),
            0xAF => self.load(bus, abs, Cpu::lax),
            // $B0
            0xB0 => self.branch(bus, self.c),
            0xB1 => self.load(bus, ind_y_read, Cpu::load_a),
            0xB3 => self.load(bus, ind_y_read, Cpu::lax),
            0xB4 => self.load(bus, zp_x, Cpu::load_y),
            0xB5 => self.load(bus, zp_x, Cpu::load_a),
            0xB6 => self.load(bus, zp_y, Cpu::load_x),
            0xB7 => self.load(bus, zp_y, Cpu::lax),
            0xB8 => self.implied(bus, |c| c.v = false),
            0xB9 => self.load(bus, abs_y_read, Cpu::load_a),
            0xBA => self.implied(bus, |c| c.load_x(c.sp)),
            0xBB => self.load(bus, abs_y_read, Cpu::las),
            0xBC => self.load(bus, abs_x_read, Cpu::load_y),
            0xBD => self.load(bus, abs_x_read, Cpu::load_a),
            0xBE => self.load(bus, abs_y_read, Cpu::load_x),
            0xBF => self.load(bus, abs_y_read, Cpu::lax),
            // $C0
            0xC0 => self.immediate(bus, Cpu::cpy),
            0xC1 => self.load(bus, ind_x, Cpu::cmp),
            0xC2 => self.immediate(bus, |_, _| {}),
            0xC3 => self.modify(bus, ind_x, Cpu::dcp),
            0xC4 => self.load(bus, zp, Cpu::cpy),
            0xC5 => self.load(bus, zp, Cpu::cmp),
            0xC6 => self.modify(bus, zp, Cpu::dec),
            0xC7 => self.modify(bus, zp, Cpu::dcp),
            0xC8 => self.implied(bus, |c| c.load_y(c.y.wrapping_add(1))),
            0xC9 => self.immediate(bus, Cpu::cmp),
            0xCA => self.implied(bus, |c| c.load_x(c.x.wrapping_sub(1))),
            0xCB => self.immediate(bus, Cpu::sbx),
            0xCC => self.load(bus, abs, Cpu::cpy),
            0xCD => self.load(bus, abs, Cpu::cmp),
            0xCE => self.modify(bus, abs, Cpu::dec),
            0xCF => self.modify(bus, abs, Cpu::dcp),
            // $D0
            0xD0 => self.branch(bus, self.z != 0),
            0xD1 => self.load(bus, ind_y_read, Cpu::cmp),
            0xD3 => self.modify(bus, ind_y, Cpu::dcp),
            0xD4 => self.load(bus, zp_x, |_, _| {}),
            0xD5 => self.load(bus, zp_x, Cpu::cmp),
            0xD6 => self.modify(bus, zp_x, Cpu::dec),
            0xD7 => self.modify(bus, zp_x, Cpu::dcp),
            0xD8 => self.implied(bus, |c| c.d = false),
            0xD9 => self.load(bus, abs_y_read, Cpu::cmp),
            0xDA => self.implied(bus, |_| {}),
            0xDB => self.modify(bus, abs_y, Cpu::dcp),
            0xDC => self.load(bus, abs_x_read, |_, _| {}),
            0xDD => self.load(bus, abs_x_read, Cpu::cmp),
            0xDE => self.modify(bus, abs_x, Cpu::dec),
            0xDF => self.modify(bus, abs_x, Cpu::dcp),
            // $E0
            0xE0 => self.immediate(bus, Cpu::cpx),
            0xE1 => self.load(bus, ind_x, Cpu::sbc),
            0xE2 => self.immediate(bus, |_, _| {}),
            0xE3 => self.modify(bus, ind_x, Cpu::isc),
            0xE4 => self.load(bus, zp, Cpu::cpx),
            0xE5 => self.load(bus, zp, Cpu::sbc),
            0xE6 => self.modify(bus, zp, Cpu::inc),
            0xE7 => self.modify(bus, zp, Cpu::isc),
            0xE8 => self.implied(bus, |c| c.load_x(c.x.wrapping_add(1))),
            0xE9 => self.immediate(bus, Cpu::sbc),
            0xEA => self.implied(bus, |_| {}),
            0xEB => self.immediate(bus, Cpu::sbc),
            0xEC => self.load(bus, abs, Cpu::cpx),
            0xED => self.load(bus, abs, Cpu::sbc),
            0xEE => self.modify(bus, abs, Cpu::inc),
            0xEF => self.modify(bus, abs, Cpu::isc),
            // $F0
            0xF0 => self.branch(bus, self.z == 0),
            0xF1 => self.load(bus, ind_y_read, Cpu::sbc),
            0xF3 => self.modify(bus, ind_y, Cpu::isc),
            0xF4 => self.load(bus, zp_x, |_, _| {}),
            0xF5 => self.load(bus, zp_x, Cpu::sbc),
            0xF6 => self.modify(bus, zp_x, Cpu::inc),
            0xF7 => self.modify(bus, zp_x, Cpu::isc),
            0xF8 => self.implied(bus, |c| c.d = true),
            0xF9 => self.load(bus, abs_y_read, Cpu::sbc),
            0xFA => self.implied(bus, |_| {}),
            0xFB => self.modify(bus, abs_y, Cpu::isc),
            0xFC => self.load(bus, abs_x_read, |_, _| {}),
            0xFD => self.load(bus, abs_x_read, Cpu::sbc),
            0xFE => self.modify(bus, abs_x, Cpu::inc),
            0xFF => self.modify(bus, abs_x, Cpu::isc),
            0x02 | 0x12 | 0x22 | 0x32 | 0x42 | 0x52 | 0x62 | 0x72 | 0x92 | 0xB2 | 0xD2 | 0xF2 => {
                return Step::Jammed;
            }
        }
        Step::Ran
    }

    /// Reads the next byte in vain, then works on registers alone.
    #[inline(always)]
    fn implied<B: Bus>(&mut self, bus: &mut B, work: impl FnOnce(&mut Cpu)) {
        bus.read(self.pc);
        work(self);
    }

    #[inline(always)]
    fn immediate<B: Bus>(&mut self, bus: &mut B, work: impl FnOnce(&mut Cpu, u8)) {
        let value = self.fetch(bus);
        work(self, value);
    }

    #[inline(always)]
    fn load<B: Bus>(
        &mut self,
        bus: &mut B,
        mode: impl FnOnce(&mut Cpu, &mut B) -> u16,
        work: impl FnOnce(&mut Cpu, u8),
    ) {
        let at = mode(self, bus);
        let value = bus.read(at);
        work(self, value);
    }

    #[inline(always)]
    fn store<B: Bus>(
        &mut self,
        bus: &mut B,
        mode: impl FnOnce(&mut Cpu, &mut B) -> u16,
        value: impl FnOnce(&Cpu) -> u8,
    ) {
        let at = mode(self, bus);
        bus.write(at, value(self));
    }

    /// Read, write back unchanged, write changed: both writes are on the bus.
    #[inline(always)]
    fn modify<B: Bus>(
        &mut self,
        bus: &mut B,
        mode: impl FnOnce(&mut Cpu, &mut B) -> u16,
        work: impl FnOnce(&mut Cpu, u8) -> u8,
    ) {
        let at = mode(self, bus);
        let value = bus.read(at);
        bus.write(at, value);
        let result = work(self, value);
        bus.write(at, result);
    }

    #[inline(always)]
    fn push_op<B: Bus>(&mut self, bus: &mut B, value: impl FnOnce(&Cpu) -> u8) {
        bus.read(self.pc);
        let value = value(self);
        self.push(bus, value);
    }

    #[inline(always)]
    fn pull_op<B: Bus>(&mut self, bus: &mut B, work: impl FnOnce(&mut Cpu, u8)) {
        bus.read(self.pc);
        self.peek_stack(bus);
        let value = self.pull(bus);
        work(self, value);
    }

    #[inline(always)]
    fn masked_abs<B: Bus>(&mut self, bus: &mut B, index: u8, value: u8) {
        let base = abs(self, bus);
        masked_store(bus, base, index, value);
    }

    #[inline(always)]
    fn sha_ind_y<B: Bus>(&mut self, bus: &mut B) {
        let base = ind_y_base(self, bus);
        masked_store(bus, base, self.y, self.a & self.x);
    }

    #[inline(always)]
    fn tas<B: Bus>(&mut self, bus: &mut B) {
        let base = abs(self, bus);
        self.sp = self.a & self.x;
        masked_store(bus, base, self.y, self.sp);
    }
}
