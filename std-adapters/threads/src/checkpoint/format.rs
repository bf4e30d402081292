//! The bytes of a checkpoint. All numbers are little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | magic |
//! | 8 | length of the file |
//! | 4 | format version |
//! | 4 | number of settings; each is a name and a value, a text its length in 4 bytes and UTF-8 |
//! | 8 a word | what is saved; of a run, number of chunks done, n, and the words ([`Save`](ratiocv_core::moments::Save)) of the merged moments of 2ⁱ chunks for each bit i of n, the largest first |
//! | 4 | CRC-32 of all that precedes |
//!
//! Magic, length and checksum are the same in every version to come.

use crate::error::Fault;

/// Not text: the first byte is no UTF-8.
pub(super) const MAGIC: [u8; 8] = *b"\x8fratiocv";

const VERSION: u32 = 1;

/// Magic, length, version and checksum.
const LEAST: u64 = 24;

/// The file of what `settings` tell from others and `words` say.
pub(super) fn encoded(settings: &[(String, String)], words: &[u64]) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend([0; 8]);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend((settings.len() as u32).to_le_bytes());
    for text in settings.iter().flat_map(|(name, value)| [name, value]) {
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend(text.as_bytes());
    }
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    let length = bytes.len() as u64 + 4;
    bytes[8..16].copy_from_slice(&length.to_le_bytes());
    bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
    bytes
}

/// The words of the file `bytes`, if it has these settings.
pub(super) fn decoded(bytes: &[u8], settings: &[(String, String)]) -> Result<Vec<u64>, Fault> {
    let mut rest = Bytes(checked(bytes)?);
    let version = rest.u32()?;
    if version != VERSION {
        return Err(Fault::Version { file: version, here: VERSION });
    }
    let mut file = Vec::new();
    for _ in 0..rest.u32()? {
        file.push((rest.text()?, rest.text()?));
    }
    same(settings, &file)?;
    let (words, none) = rest.0.as_chunks();
    if !none.is_empty() {
        return Err(Fault::Damaged("it ends within a number"));
    }
    Ok(words.iter().map(|word| u64::from_le_bytes(*word)).collect())
}

/// Whether the settings are the same.
fn same(here: &[(String, String)], file: &[(String, String)]) -> Result<(), Fault> {
    let value = |name: &String, of: &[(String, String)]| {
        of.iter().find(|(other, _)| other == name).map_or_else(|| "not set".to_owned(), |(_, value)| value.clone())
    };
    for (name, _) in here.iter().chain(file) {
        let (here, file) = (value(name, here), value(name, file));
        if here != file {
            return Err(Fault::OtherRun { setting: name.clone(), here, file });
        }
    }
    Ok(())
}

/// What stands between length and checksum, if these are right.
fn checked(bytes: &[u8]) -> Result<&[u8], Fault> {
    let here = bytes.len() as u64;
    if !bytes.starts_with(&MAGIC[..MAGIC.len().min(bytes.len())]) {
        return Err(Fault::Foreign);
    }
    let length = Bytes(bytes.get(8..).unwrap_or_default()).u64().unwrap_or(LEAST).max(LEAST);
    if here < length {
        return Err(Fault::Truncated { bytes: here, of: length });
    }
    if here > length {
        return Err(Fault::Damaged("it is longer than it says"));
    }
    let (contents, checksum) = bytes.split_at(bytes.len() - 4);
    if crc32fast::hash(contents).to_le_bytes() != checksum {
        return Err(Fault::Damaged("its checksum is not that of its contents"));
    }
    Ok(&contents[16..])
}

/// Bytes that are still to be read.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let (taken, rest) = self.0.split_first_chunk().ok_or(Fault::Damaged("its parts are longer than the whole"))?;
        self.0 = rest;
        Ok(*taken)
    }
    fn u32(&mut self) -> Result<u32, Fault> {
        Ok(u32::from_le_bytes(self.take()?))
    }
    fn u64(&mut self) -> Result<u64, Fault> {
        Ok(u64::from_le_bytes(self.take()?))
    }
    fn text(&mut self) -> Result<String, Fault> {
        let length = self.u32()? as usize;
        let (text, rest) =
            self.0.split_at_checked(length).ok_or(Fault::Damaged("its parts are longer than the whole"))?;
        self.0 = rest;
        Ok(String::from_utf8_lossy(text).into_owned())
    }
}
