//! Arrays as NumPy reads them: a zip archive of `.npy` files, not compressed.

use std::io::{self, Write};

use thiserror::Error;

/// Why an archive cannot be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum NpzError {
    /// Writing failed.
    #[error(transparent)]
    Write(#[from] io::Error),
    /// The format counts bytes with 32 bits.
    #[error("the arrays take more than 4 GiB, which a .npz cannot hold; take fewer samples")]
    TooLarge,
}

/// The version of zip that reads it, and a time that says nothing: 1 January 1980.
const VERSION: u16 = 20;
const DAY: u16 = 0x21;

/// An array: the shape, and the numbers by rows, or text.
pub(crate) enum Array {
    Numbers(Vec<usize>, Vec<f64>),
    Names(Vec<String>),
}

impl Array {
    /// The `.npy` file, version 1.0.
    fn file(&self) -> Vec<u8> {
        let (kind, shape) = match self {
            Self::Numbers(shape, _) => ("<f8".to_owned(), shape.clone()),
            Self::Names(names) => (format!("<U{}", longest(names)), vec![names.len()]),
        };
        let shape: String = shape.iter().map(|length| format!("{length}, ")).collect();
        let shape = shape.trim_end();
        let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
        // Magic, length, header, padding and a line feed fill blocks of 64 bytes.
        let padded = (10 + header.len() + 1).next_multiple_of(64) - 10;
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((padded as u16).to_le_bytes());
        bytes.extend(format!("{header:width$}\n", width = padded - 1).bytes());
        match self {
            Self::Numbers(_, numbers) => bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes())),
            Self::Names(names) => {
                let width = longest(names);
                for name in names {
                    let letters = name.chars().map(u32::from);
                    let padded = letters.chain(core::iter::repeat(0)).take(width);
                    bytes.extend(padded.flat_map(u32::to_le_bytes));
                }
            }
        }
        bytes
    }
}

/// NumPy's shortest texts have one letter.
fn longest(names: &[String]) -> usize {
    let lengths = names.iter().map(|name| name.chars().count());
    lengths.max().unwrap_or(0).max(1)
}

/// Writes the archive.
pub(crate) fn write(out: &mut impl Write, arrays: &[(&str, Array)]) -> Result<(), NpzError> {
    let (mut directory, mut at) = (vec![], 0_u32);
    for (name, array) in arrays {
        let (name, file) = (format!("{name}.npy"), array.file());
        let size = u32::try_from(file.len()).map_err(|_| NpzError::TooLarge)?;
        let entry = entry(&name, size, crc32fast::hash(&file));
        out.write_all(b"PK\x03\x04")?;
        out.write_all(&entry)?;
        out.write_all(name.as_bytes())?;
        out.write_all(&file)?;
        directory.extend(b"PK\x01\x02");
        directory.extend(VERSION.to_le_bytes());
        directory.extend(&entry);
        // No comment, disk 0, no attributes.
        directory.extend([0; 10]);
        directory.extend(at.to_le_bytes());
        directory.extend(name.bytes());
        let length = 4 + entry.len() as u32 + name.len() as u32;
        let next = at.checked_add(length).and_then(|at| at.checked_add(size));
        at = next.ok_or(NpzError::TooLarge)?;
    }
    out.write_all(&directory)?;
    out.write_all(b"PK\x05\x06\0\0\0\0")?;
    let count = (arrays.len() as u16).to_le_bytes();
    out.write_all(&[count, count].concat())?;
    out.write_all(&(directory.len() as u32).to_le_bytes())?;
    out.write_all(&at.to_le_bytes())?;
    out.write_all(&[0; 2])?;
    Ok(())
}

/// What both the file's own header and the directory have: stored, without flags and extra fields.
fn entry(name: &str, size: u32, sum: u32) -> Vec<u8> {
    let shorts = [VERSION, 0, 0, 0, DAY].map(u16::to_le_bytes);
    let longs = [sum, size, size].map(u32::to_le_bytes);
    let lengths = [name.len() as u16, 0].map(u16::to_le_bytes);
    [shorts.concat(), longs.concat(), lengths.concat()].concat()
}
