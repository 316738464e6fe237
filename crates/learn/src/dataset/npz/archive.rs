//! Writing of arrays as `.npy` and `.npz`.
//!
//! The format is NumPy's version 1.0
//! (<https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>): a header with one
//! Python literal, then the numbers. Existing crates depend on a parser of Python literals and
//! compressors in C, which this module avoids with twenty lines.

use std::io::{Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// Numbers in row-major order.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Numbers {
    /// `float64`.
    Floats(Vec<f64>),
    /// `int64`.
    Integers(Vec<i64>),
    /// `bool`.
    Flags(Vec<bool>),
    /// `bytes`, padded to the longest text.
    Texts(Vec<String>),
}

/// Named array.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Array {
    pub name: &'static str,
    pub shape: Vec<usize>,
    pub numbers: Numbers,
}

impl Array {
    /// Returns the array as a `.npy` file.
    pub fn npy(&self) -> Vec<u8> {
        let (kind, body) = match &self.numbers {
            Numbers::Floats(all) => {
                ("<f8".to_owned(), all.iter().flat_map(|one| one.to_le_bytes()).collect())
            }
            Numbers::Integers(all) => {
                ("<i8".to_owned(), all.iter().flat_map(|one| one.to_le_bytes()).collect())
            }
            Numbers::Flags(all) => {
                ("|b1".to_owned(), all.iter().map(|one| u8::from(*one)).collect())
            }
            Numbers::Texts(all) => {
                let longest = all.iter().map(String::len).max().unwrap_or(0).max(1);
                let padded = |text: &String| {
                    let mut bytes = text.clone().into_bytes();
                    bytes.resize(longest, 0);
                    bytes
                };
                (format!("|S{longest}"), all.iter().flat_map(padded).collect::<Vec<u8>>())
            }
        };
        let sizes: String = self.shape.iter().map(|size| format!("{size}, ")).collect();
        let mut header =
            format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({sizes}), }}");
        // The numbers start at a multiple of 64 bytes; ten bytes precede the header.
        let length = (header.len() + 1 + 10).next_multiple_of(64) - 10;
        header = format!("{header:<width$}\n", width = length - 1);
        let count = u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes();
        [&b"\x93NUMPY\x01\x00"[..], &count, header.as_bytes(), &body].concat()
    }
}

/// Returns arrays as a `.npz` file. Equal arrays yield equal bytes.
pub(super) fn npz(arrays: &[Array]) -> zip::result::ZipResult<Vec<u8>> {
    let mut file = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644)
        .large_file(true);
    for array in arrays {
        file.start_file(format!("{}.npy", array.name), options)?;
        file.write_all(&array.npy())?;
    }
    Ok(file.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_one_line_and_numbers_begin_at_a_multiple_of_64_bytes() {
        let array = |shape: &[usize], numbers| Array { name: "a", shape: shape.to_vec(), numbers };
        let npy = array(&[1, 2], Numbers::Floats(vec![1.0, -0.5])).npy();
        assert_eq!(&npy[..10], b"\x93NUMPY\x01\x00\x76\x00");
        let header = std::str::from_utf8(&npy[10..128]).unwrap();
        let written = "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 2, ), }";
        assert_eq!(header.trim_end_matches(' ').trim_end(), written);
        assert_eq!((header.ends_with(" \n"), npy.len()), (true, 128 + 16));
        let texts = array(&[2], Numbers::Texts(vec!["ab".into(), "c".into()])).npy();
        assert!(texts.ends_with(b"abc\0"));
    }
}
