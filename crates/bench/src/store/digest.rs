//! Digests of files in a manifest.

use pushplan::checksum::checksum;

/// Returns a digest of a file's bytes: 64 bits, hexadecimal.
pub fn digest(bytes: &[u8]) -> String {
    format!("{:016x}", checksum(bytes))
}
