//! Mutations without knowledge of the format: bits, bytes and ranges of bytes.

use crate::random::Random;
use crate::snippets::SNIPPETS;

/// Returns `input` with one to four mutations.
pub fn damaged(input: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = input.to_vec();
    for _ in 0..=random.below(4) {
        damage(&mut bytes, other, random);
    }
    bytes
}

fn damage(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    let at = random.below(bytes.len() + 1);
    let end = (at + 1 + random.below(24)).min(bytes.len());
    match random.below(8) {
        0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
        1 if at < bytes.len() => bytes[at] = random.byte(),
        2 => {
            let count = 1 + random.below(8);
            let new: Vec<u8> = (0..count).map(|_| random.byte()).collect();
            bytes.splice(at..at, new);
        }
        3 => {
            bytes.drain(at..end);
        }
        4 => {
            let piece = bytes[at..end].to_vec();
            for _ in 0..=random.below(20) {
                bytes.splice(at..at, piece.iter().copied());
            }
        }
        5 => bytes.truncate(at),
        6 if !other.is_empty() => {
            let from = random.below(other.len());
            let to = (from + 1 + random.below(64)).min(other.len());
            bytes.splice(at..end, other[from..to].iter().copied());
        }
        _ => {
            bytes.splice(at..end, random.pick(&SNIPPETS).bytes());
        }
    }
}
