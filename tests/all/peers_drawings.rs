//! Our rasteriser against the genuine OS 1.20, under jsbeeb: random drawings, ink by ink.
//!
//! `SLOWLIGHT_DRAWINGS=10000` in the environment says how many; `UPDATE_ROM_VECTORS=1` records the
//! first ones for `drawings`.

use crate::drawings::{RECORDED, digest, drawing, drawn, recorded};
use crate::peers_jsbeeb::{hex, jsbeeb, unhex};
use serde_json::{Value, json};

/// What is drawn without a number in the environment.
const DRAWINGS: u64 = 500;
/// Drawings that differ of which the inks are counted.
const TOLD: usize = 5;

/// What OS 1.20 draws from each seed: digests of the inks, or the inks.
fn rom(seeds: &[u64], inks: bool) -> Vec<String> {
    let drawings: Vec<String> = seeds.iter().map(|seed| hex(&drawing(*seed).1)).collect();
    let result = jsbeeb(&[json!({"drawings": drawings, "inks": inks})]).remove(0);
    let list = result["drawings"].as_array().expect("drawings");
    assert_eq!(list.len(), seeds.len());
    let text = |drawing: &Value| drawing[0].as_str().expect("inks").to_owned();
    list.iter().map(text).collect()
}

fn ours(seed: u64) -> Vec<u8> {
    drawn(&drawing(seed).1).pixels
}

#[test]
fn random_drawings_are_the_roms_to_the_last_ink() {
    let count = std::env::var("SLOWLIGHT_DRAWINGS").ok();
    let count = count.map_or(DRAWINGS, |n| n.parse().expect("a number of drawings"));
    let seeds: Vec<u64> = (RECORDED.end..RECORDED.end + count).collect();
    let digests = rom(&seeds, false);
    let pairs = seeds.iter().zip(digests);
    let different: Vec<u64> = pairs
        .filter(|(seed, rom)| digest(&ours(**seed)) != *rom)
        .map(|(seed, _)| *seed)
        .collect();
    let some = &different[..different.len().min(TOLD)];
    if !some.is_empty() {
        for (seed, inks) in some.iter().zip(rom(some, true)) {
            let (rom, ours) = (unhex(&inks), ours(*seed));
            let apart = rom.iter().zip(&ours).filter(|(a, b)| a != b).count();
            println!(
                "seed {seed}, mode {}: {apart} inks differ",
                drawing(*seed).0
            );
        }
    }
    println!("{count} drawings, {} differ", different.len());
    assert!(different.is_empty(), "{different:?}");
}

#[test]
fn the_recorded_drawings_are_the_roms() {
    let seeds: Vec<u64> = RECORDED.collect();
    let text = rom(&seeds, false).join("\n") + "\n";
    if std::env::var_os("UPDATE_ROM_VECTORS").is_some() {
        std::fs::write(recorded(), &text).expect("a file");
    }
    let kept = std::fs::read_to_string(recorded()).expect("recorded digests");
    assert!(kept == text, "the ROM draws something else");
}
