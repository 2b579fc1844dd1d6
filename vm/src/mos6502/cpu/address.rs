//! Addressing modes: each answers the operand's address and makes the dummy
//! reads that the processor makes on the way.
//!
//! An index is added to the low byte first; the high byte follows one cycle
//! later if there was a carry. In that cycle the processor reads from the
//! address without the carry. Instructions that only read skip the cycle where
//! there is no carry (the modes named `_read`); those that write never do.

use super::{Bus, Cpu};

#[inline(always)]
pub(super) fn zp<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    u16::from(cpu.fetch(bus))
}

#[inline(always)]
fn zp_indexed<B: Bus>(cpu: &mut Cpu, bus: &mut B, index: u8) -> u16 {
    let base = cpu.fetch(bus);
    bus.read(u16::from(base));
    u16::from(base.wrapping_add(index))
}

#[inline(always)]
pub(super) fn zp_x<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    zp_indexed(cpu, bus, cpu.x)
}

#[inline(always)]
pub(super) fn zp_y<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    zp_indexed(cpu, bus, cpu.y)
}

#[inline(always)]
pub(super) fn abs<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    let lo = cpu.fetch(bus);
    let hi = cpu.fetch(bus);
    u16::from_le_bytes([lo, hi])
}

/// The address before the carry into its high byte.
#[inline(always)]
fn without_carry(base: u16, sum: u16) -> u16 {
    (base & 0xFF00) | (sum & 0x00FF)
}

#[inline(always)]
fn index_read<B: Bus>(bus: &mut B, base: u16, index: u8) -> u16 {
    let sum = base.wrapping_add(u16::from(index));
    let early = without_carry(base, sum);
    if early != sum {
        bus.read(early);
    }
    sum
}

#[inline(always)]
fn index_write<B: Bus>(bus: &mut B, base: u16, index: u8) -> u16 {
    let sum = base.wrapping_add(u16::from(index));
    bus.read(without_carry(base, sum));
    sum
}

#[inline(always)]
pub(super) fn abs_x_read<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    let base = abs(cpu, bus);
    index_read(bus, base, cpu.x)
}

#[inline(always)]
pub(super) fn abs_y_read<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    let base = abs(cpu, bus);
    index_read(bus, base, cpu.y)
}

#[inline(always)]
pub(super) fn abs_x<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    let base = abs(cpu, bus);
    index_write(bus, base, cpu.x)
}

#[inline(always)]
pub(super) fn abs_y<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    let base = abs(cpu, bus);
    index_write(bus, base, cpu.y)
}

/// The two bytes at a zero-page address, the second from the same page.
#[inline(always)]
fn pointer<B: Bus>(bus: &mut B, at: u8) -> u16 {
    let lo = bus.read(u16::from(at));
    let hi = bus.read(u16::from(at.wrapping_add(1)));
    u16::from_le_bytes([lo, hi])
}

#[inline(always)]
pub(super) fn ind_x<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    let at = cpu.fetch(bus);
    bus.read(u16::from(at));
    pointer(bus, at.wrapping_add(cpu.x))
}

#[inline(always)]
pub(super) fn ind_y_base<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    let at = cpu.fetch(bus);
    pointer(bus, at)
}

#[inline(always)]
pub(super) fn ind_y_read<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    let base = ind_y_base(cpu, bus);
    index_read(bus, base, cpu.y)
}

#[inline(always)]
pub(super) fn ind_y<B: Bus>(cpu: &mut Cpu, bus: &mut B) -> u16 {
    let base = ind_y_base(cpu, bus);
    index_write(bus, base, cpu.y)
}

/// The operand's address for the unstable stores, and what their value is
/// masked with: the base's high byte plus one. Where the index carries, the
/// masked value also becomes the address's high byte.
#[inline(always)]
pub(super) fn masked_store<B: Bus>(bus: &mut B, base: u16, index: u8, value: u8) {
    let sum = index_write(bus, base, index);
    let stored = value & (base.to_be_bytes()[0]).wrapping_add(1);
    let [hi, lo] = sum.to_be_bytes();
    let hi = if hi == base.to_be_bytes()[0] {
        hi
    } else {
        stored
    };
    bus.write(u16::from_be_bytes([hi, lo]), stored);
}
