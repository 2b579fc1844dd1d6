//! Random drawings for the rasteriser: bytes to the VDU drivers, in a mode, from a seed.
//!
//! What the genuine OS 1.20 makes of some of them is recorded in `tests/rom`
//! (`peers_drawings` records it and tries many more).

use sha2::{Digest, Sha256};
use slowlight_vm::bbc::{Config, Machine};
use slowlight_vm::{Screen, Stop};

/// The modes with pixels.
pub const MODES: [u8; 5] = [0, 1, 2, 4, 5];

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// From 0 up to n, n left out.
    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    fn between(&mut self, low: i64, high: i64) -> i16 {
        (low + self.below((high - low + 1) as u64) as i64) as i16
    }

    fn byte(&mut self) -> u8 {
        self.next() as u8
    }

    /// One of two coordinates: mostly on the screen, or near, seldom anywhere.
    fn coordinate(&mut self, top: i64) -> i16 {
        match self.below(40) {
            0 => self.between(-0x8000, 0x7fff),
            1 | 2 => self.between(-4000, 5000),
            3..10 => self.between(-500, top + 500),
            10..12 => [0, -1, top as i16, top as i16 + 1][self.below(4) as usize],
            _ => self.between(0, top),
        }
    }

    fn words(&mut self, code: u8, list: &[i16]) -> Vec<u8> {
        let words = list.iter().flat_map(|n| n.to_le_bytes());
        [code].into_iter().chain(words).collect()
    }

    fn plot(&mut self) -> Vec<u8> {
        let k = match self.below(20) {
            0..4 => 4,
            4..9 => self.byte() & 31,
            9 => 64 + (self.byte() & 7),
            10..13 => 72 + (self.byte() & 7),
            13..17 => 80 + (self.byte() & 7),
            17..19 => 88 + (self.byte() & 7),
            _ => self.byte(),
        };
        let (x, y) = match k & 4 {
            0 => (self.between(-300, 300), self.between(-300, 300)),
            _ => (self.coordinate(1279), self.coordinate(1023)),
        };
        [vec![25, k], self.words(0, &[x, y])[1..].to_vec()].concat()
    }

    fn window(&mut self) -> Vec<u8> {
        let (a, b) = (self.coordinate(1279), self.coordinate(1279));
        let (c, d) = (self.coordinate(1023), self.coordinate(1023));
        match self.below(8) {
            0 => self.words(24, &[a, c, b, d]),
            _ => self.words(24, &[a.min(b), c.min(d), a.max(b), c.max(d)]),
        }
    }

    fn text(&mut self, mode: u8) -> Vec<u8> {
        let columns = [80, 40, 20, 0, 40, 20][usize::from(mode)];
        let column = |r: &mut Self| r.below(columns) as u8;
        let row = |r: &mut Self| r.below(32) as u8;
        match self.below(12) {
            0 => vec![4],
            1 => vec![5],
            2 => vec![17, self.byte()],
            3 => vec![31, column(self), row(self)],
            4 => {
                let (a, b) = (column(self), column(self));
                let (c, d) = (row(self), row(self));
                vec![28, a.min(b), c.max(d), a.max(b), c.min(d)]
            }
            5 => vec![[12, 30, 13, 127][self.below(4) as usize]],
            6 | 7 => vec![[8, 9, 10, 11][self.below(4) as usize]; 1 + self.below(30) as usize],
            _ => (0..=self.below(50))
                .map(|_| 224 + self.below(3) as u8)
                .collect(),
        }
    }

    fn command(&mut self, mode: u8) -> Vec<u8> {
        match self.below(32) {
            0 => self.window(),
            1 => {
                let list = [self.coordinate(1279), self.coordinate(1023)];
                self.words(29, &list)
            }
            2 => vec![[16, 26, 20][self.below(3) as usize]],
            3..8 => vec![18, self.below(6) as u8, self.byte()],
            8..12 => self.text(mode),
            _ => self.plot(),
        }
    }
}

/// A drawing: its mode and all of its bytes, the mode's change and characters' shapes among them.
pub fn drawing(seed: u64) -> (u8, Vec<u8>) {
    let mut random = Random(seed);
    let mode = MODES[random.below(5) as usize];
    let mut bytes = vec![22, mode];
    for character in 224..227 {
        bytes.extend([23, character]);
        bytes.extend((0..8).map(|_| random.byte()));
    }
    for _ in 0..5 + random.below(16) {
        bytes.extend(random.command(mode));
    }
    (mode, bytes)
}

/// The picture that our machine makes of bytes to the VDU drivers.
pub fn drawn(bytes: &[u8]) -> Screen {
    let lines = bytes.chunks(50).enumerate().map(|(i, part)| {
        let list: Vec<String> = part.iter().map(u8::to_string).collect();
        format!("{}VDU {}\n", i + 1, list.join(","))
    });
    let mut machine = Machine::new(Config::default());
    machine
        .load_text(&lines.collect::<String>())
        .expect("a program");
    let run = machine.run(1_000_000_000, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended, "{bytes:?}");
    run.screen
}

/// The SHA-256 of inks, hex.
pub fn digest(inks: &[u8]) -> String {
    let hash = Sha256::digest(inks);
    hash.iter().map(|b| format!("{b:02x}")).collect()
}

/// The seeds whose drawings OS 1.20's answers are recorded for.
pub const RECORDED: std::ops::Range<u64> = 0..60;

/// Where they are: a digest a line.
pub fn recorded() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rom/drawings.txt")
}

#[test]
fn drawings_are_what_the_operating_system_draws() {
    let text = std::fs::read_to_string(recorded()).expect("recorded digests");
    let mut digests: Vec<&str> = text.lines().collect();
    assert_eq!(digests.len() as u64, RECORDED.end);
    let mut modes = Vec::new();
    for (seed, expected) in RECORDED.zip(&digests) {
        let (mode, bytes) = drawing(seed);
        let screen = drawn(&bytes);
        assert_eq!(digest(&screen.pixels), *expected, "seed {seed}");
        modes.push(mode);
    }
    assert!(MODES.iter().all(|mode| modes.contains(mode)));
    // A few leave nothing but paper.
    digests.sort_unstable();
    digests.dedup();
    assert!(digests.len() > 50, "{}", digests.len());
}
