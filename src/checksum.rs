//! A checksum that detects damage to files; it does not prove their origin.

/// Returns the 64-bit FNV-1a checksum (Fowler, Noll and Vo; RFC 9923).
pub fn checksum(bytes: &[u8]) -> u64 {
    extend(0xCBF2_9CE4_8422_2325, bytes)
}

/// Returns the checksum of a text followed by `bytes`, given the checksum `sum` of the text.
pub fn extend(sum: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(sum, |sum, &byte| (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_matches_published_values() {
        assert_eq!(checksum(b""), 0xCBF2_9CE4_8422_2325);
        assert_eq!(checksum(b"a"), 0xAF63_DC4C_8601_EC8C);
        assert_eq!(checksum(b"foobar"), 0x8594_4171_F739_67E8);
        assert_eq!(extend(checksum(b"foo"), b"bar"), checksum(b"foobar"));
    }
}
