//! States in a machine's memory: where a program has them, and what they are.

use slowlight_compiler::backend::mos6502::vcs;
use slowlight_compiler::backend::{bbc, jack, mos6502};
use slowlight_compiler::ir::graph::ParamId;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::targets::{Language, System};
use slowlight_routine::log::model::Log;
use slowlight_routine::{Bits, Format, Value};

/// A state's bits at the start.
pub fn bits_of(plan: &Plan, id: ParamId) -> Bits {
    plan.params.get(id.0 as usize).map_or(0, |p| p.bits)
}

/// Where a program has its states.
pub enum Places {
    /// In the scene's object.
    Hack(Vec<jack::Held>),
    /// At addresses.
    Mos6502(Vec<mos6502::Held>),
    /// In variables of BASIC.
    Bbc(Vec<bbc::Held>),
}

/// How often a program looks at the keyboard behind a picture: once, or once for each key where
/// the machine's system is asked for one at a time.
pub fn looks(plan: &Plan) -> u64 {
    let one_by_one = match plan.target.system {
        System::BbcBasic | System::Agon | System::BasicV | System::BbcCode => true,
        System::Hack | System::Plain6502 | System::C64 | System::Vcs => false,
    };
    match one_by_one {
        true => plan.graph.buttons().count().max(1) as u64,
        false => 1,
    }
}

impl Places {
    /// Those of a plan's program.
    pub fn of(plan: &Plan) -> Places {
        match plan.target.system.language() {
            Language::Assembly => Places::Mos6502(match plan.target.system {
                System::Vcs => vcs::cartridge(plan)
                    .map(|made| made.states)
                    .unwrap_or_default(),
                _ => mos6502::held(plan),
            }),
            Language::Jack => Places::Hack(jack::held(plan)),
            Language::Basic => Places::Bbc(bbc::held(plan)),
        }
    }

    /// A state's bits, if it is in memory, and if the memory is such; what of them the program
    /// never reads is as it should be.
    pub fn held(
        &self,
        plan: &Plan,
        (id, should): (ParamId, Bits),
        memory: &[i16],
    ) -> Option<Option<Bits>> {
        match self {
            Places::Hack(all) => {
                let held = all.iter().find(|held| held.state == id)?;
                Some(on_hack(plan, *held, memory))
            }
            Places::Mos6502(all) => {
                let held = all.iter().find(|held| held.state == id)?;
                Some(on_6502(plan, *held, should, memory))
            }
            Places::Bbc(all) => {
                let held = all.iter().find(|held| held.state == id)?;
                Some(in_basic(plan, held, memory))
            }
        }
    }
}

/// A state's bits among the variables of BASIC: of each the length of its name, the name, and
/// its bits in four words, the highest first.
fn in_basic(plan: &Plan, held: &bbc::Held, told: &[i16]) -> Option<Bits> {
    const WORDS: usize = 4;
    let mut rest = told;
    while let [length, behind @ ..] = rest {
        let (name, behind) = behind.split_at_checked(usize::try_from(*length).ok()?)?;
        let (words, behind) = behind.split_at_checked(WORDS)?;
        let is_it = || name.iter().copied().eq(held.name.bytes().map(i16::from));
        if is_it() {
            let shifted = |bits: u64, word: &i16| bits << 16 | u64::from(*word as u16);
            let bits = words.iter().fold(0, shifted);
            return Some(match plan.param_format(held.state) {
                Format::Bool => Bits::from(bits != 0),
                Format::Real40 => bits,
                whole => (plan.runtime.encode)(Value::Int(bits as i32), whole),
            });
        }
        rest = behind;
    }
    None
}

/// A state's bits in a 6502's memory, low byte first.
fn on_6502(plan: &Plan, held: mos6502::Held, should: Bits, memory: &[i16]) -> Option<Bits> {
    let from = usize::from(held.address);
    let bytes = memory.get(from..from + usize::from(held.bytes))?;
    let mut bits = 0;
    for (k, (byte, should)) in bytes.iter().zip(should.to_le_bytes()).enumerate() {
        let byte = match held.read >> k & 1 {
            0 => should,
            _ => *byte as u8,
        };
        bits |= u64::from(byte) << (8 * k);
    }
    let upper = 64 - 8 * u32::from(held.bytes);
    let signed = (bits << upper) as i64 >> upper;
    Some(match plan.param_format(held.state) {
        Format::Bool => Bits::from(bits != 0),
        Format::Log { .. } | Format::Real40 => bits,
        _ => signed as Bits,
    })
}

/// A state's bits in the Hack's memory, where `this` is the scene's object.
fn on_hack(plan: &Plan, held: jack::Held, memory: &[i16]) -> Option<Bits> {
    const THIS: usize = 3;
    let at = |address: usize| memory.get(address).copied();
    let object = usize::from(at(THIS)? as u16);
    let word = at(object + held.word)?;
    let format = plan.param_format(held.state);
    Some(match format {
        Format::Bool => Bits::from(word != 0),
        Format::Log { .. } => {
            let plus = match held.sign {
                Some(sign) => at(object + sign)? != 0,
                None => Log::from_bits(bits_of(plan, held.state)).plus,
            };
            Bits::from(word as u16) | Bits::from(!plus) << 16
        }
        real if real.is_object() => {
            let from = usize::from(word as u16);
            let words = (0..usize::from(real.words())).map(|k| at(from + k));
            words
                .collect::<Option<Vec<i16>>>()?
                .into_iter()
                .fold(0, |bits, word| bits << 16 | Bits::from(word as u16))
        }
        _ => i64::from(word) as Bits,
    })
}
