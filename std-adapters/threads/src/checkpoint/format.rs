//! The bytes of a checkpoint. All numbers are little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | magic |
//! | 8 | length of the file |
//! | 4 | format version |
//! | 4 | number of settings; each is a name and a value, a text its length in 4 bytes and UTF-8 |
//! | 8 | number of chunks done, n |
//! | 8 a word | the words ([`Save`]) of the merged moments of 2ⁱ chunks for each bit i of n, the largest first |
//! | 4 | CRC-32 of all that precedes |
//!
//! Magic, length and checksum are the same in every version to come.

use crate::checkpoint::Identity;
use crate::error::Fault;
use crate::integrate::CHUNK;
use crate::merge_tree::MergeTree;
use ratiocv_core::moments::{Moments, Save};

/// Not text: the first byte is no UTF-8.
pub(crate) const MAGIC: [u8; 8] = *b"\x8fratiocv";

const VERSION: u32 = 1;

/// Magic, length, version and checksum.
const LEAST: u64 = 24;

/// The file of a run that got as far as `tree`.
pub(crate) fn encoded<M: Save + Clone>(identity: &Identity, tree: &MergeTree<M>) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend([0; 8]);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend((identity.settings.len() as u32).to_le_bytes());
    for text in identity.settings.iter().flat_map(|(name, value)| [name, value]) {
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend(text.as_bytes());
    }
    bytes.extend(tree.parts().to_le_bytes());
    for moments in tree.subtrees() {
        moments.clone().words(&mut |word| bytes.extend(word.to_le_bytes()));
    }
    let length = bytes.len() as u64 + 4;
    bytes[8..16].copy_from_slice(&length.to_le_bytes());
    bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
    bytes
}

/// How far the run of `identity` got, by the file `bytes`; `empty` makes moments to be filled.
pub(crate) fn decoded<M: Save + Moments>(
    bytes: &[u8],
    identity: &Identity,
    empty: impl Fn() -> M,
) -> Result<MergeTree<M>, Fault> {
    let mut rest = Bytes(checked(bytes)?);
    let version = rest.u32()?;
    if version != VERSION {
        return Err(Fault::Version { file: version, here: VERSION });
    }
    let mut settings = Vec::new();
    for _ in 0..rest.u32()? {
        settings.push((rest.text()?, rest.text()?));
    }
    identity.check(&settings)?;
    let parts = rest.u64()?;
    if parts > identity.draws.div_ceil(CHUNK) {
        return Err(Fault::Damaged("it has more chunks than its run"));
    }
    let (mut subtrees, mut start) = (Vec::new(), 0_u64);
    for bit in (0..u64::BITS).rev().filter(|bit| parts >> bit & 1 == 1) {
        let mut moments = empty();
        let mut all = Ok(());
        moments.words(&mut |word| match rest.u64() {
            Ok(read) => *word = read,
            Err(fault) => all = Err(fault),
        });
        all?;
        let end = identity.draws.min(start.saturating_add(CHUNK.saturating_mul(1 << bit)));
        if moments.count() != end - start {
            return Err(Fault::Damaged("the number of draws is not that of its chunks"));
        }
        subtrees.push(moments);
        start = end;
    }
    let tree = MergeTree::from_subtrees(parts, subtrees).filter(|_| rest.0.is_empty());
    tree.ok_or(Fault::Damaged("there is something after its end"))
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
