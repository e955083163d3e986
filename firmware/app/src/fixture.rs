//! A job in a file, for programs without a scene. In: the file's bytes. Out: hit points, index table and photons.
//! Cost: one pass for the digest; elements are decoded as they are asked for, nothing is copied.
//!
//! The file is little-endian 32-bit words, numbers as f32 bits: one file serves every device format.
//!
//! | words | hold |
//! |---|---|
//! | 16 | the header: magic, version, width, height, emitted, α, R², hit points, index entries, photons, digest (low, high), 0 … |
//! | 10 a hit point | position, normal, colour, pixel |
//! | 1 an entry | hit-point number |
//! | 11 a photon | position, normal, flux, p_addr, n |
//!
//! The digest is [`fnv1a64`] of all words but itself.

use core::fmt;

use lucerna_driver::{HitPoint, Photon};

/// "LCNJ" in the file's first bytes.
pub const MAGIC: u32 = u32::from_le_bytes(*b"LCNJ");
/// Of the layout above.
pub const VERSION: u32 = 1;
/// Words of the header.
pub const HEADER_WORDS: usize = 16;
/// Words of a hit point.
pub const HIT_POINT_WORDS: usize = 10;
/// Words of a photon.
pub const PHOTON_WORDS: usize = 11;
/// Where the digest is in the header.
const DIGEST: core::ops::Range<usize> = 10..12;

/// A word as in the file.
type Word = [u8; 4];

/// The 64-bit FNV-1a digest of words, each as its four bytes, lowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fnv1a64(u64);

impl Fnv1a64 {
    /// Of no words.
    pub const EMPTY: Self = Self(0xcbf2_9ce4_8422_2325);

    /// With one more word.
    pub fn with(self, word: u32) -> Self {
        let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        Self(word.to_le_bytes().into_iter().fold(self.0, step))
    }

    /// The digest.
    pub const fn value(self) -> u64 {
        self.0
    }
}

/// The digest of words at hand.
pub fn fnv1a64(words: impl IntoIterator<Item = u32>) -> u64 {
    words.into_iter().fold(Fnv1a64::EMPTY, Fnv1a64::with).value()
}

/// What the job is, besides its records.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Header {
    /// Of the picture.
    pub width: u32,
    /// Of the picture.
    pub height: u32,
    /// Photons emitted, N_emitted.
    pub emitted: u32,
    /// The fraction of new photons kept, α.
    pub alpha: f32,
    /// Every hit point's R² at the beginning.
    pub radius_squared: f32,
    /// Number of hit points.
    pub hit_points: u32,
    /// Number of entries of the index table.
    pub index_entries: u32,
    /// Number of photons.
    pub photons: u32,
}

impl Header {
    /// The header's words before it has a digest.
    pub fn words(&self) -> [u32; HEADER_WORDS] {
        let mut words = [0; HEADER_WORDS];
        let fields = [
            MAGIC,
            VERSION,
            self.width,
            self.height,
            self.emitted,
            self.alpha.to_bits(),
            self.radius_squared.to_bits(),
            self.hit_points,
            self.index_entries,
            self.photons,
        ];
        words[..fields.len()].copy_from_slice(&fields);
        words
    }

    /// Words of the file; `None` if that is more than fits an address.
    fn file_words(&self) -> Option<usize> {
        let of = |count: u32, words: usize| (count as usize).checked_mul(words);
        HEADER_WORDS
            .checked_add(of(self.hit_points, HIT_POINT_WORDS)?)?
            .checked_add(self.index_entries as usize)?
            .checked_add(of(self.photons, PHOTON_WORDS)?)
    }
}

/// Puts the digest into a file's words: the writer's last step. A file shorter than a header is left alone.
pub fn seal(file: &mut [u32]) {
    let digest = fnv1a64(undigested(file.iter().copied()));
    if let Some(place) = file.get_mut(DIGEST) {
        place.copy_from_slice(&[digest as u32, (digest >> 32) as u32]);
    }
}

fn undigested(words: impl Iterator<Item = u32>) -> impl Iterator<Item = u32> {
    words.enumerate().filter(|(number, _)| !DIGEST.contains(number)).map(|(_, word)| word)
}

/// A checked file.
#[derive(Clone, Copy, Debug)]
pub struct Fixture<'a> {
    header: Header,
    hit_points: &'a [[Word; HIT_POINT_WORDS]],
    index: &'a [Word],
    photons: &'a [[Word; PHOTON_WORDS]],
}

impl<'a> Fixture<'a> {
    /// Checks magic, version, length, digest, and that the sizes make a picture. What the records refer to is
    /// checked by the driver and the device, as for any job.
    ///
    /// # Errors
    /// A [`FixtureError`].
    pub fn new(bytes: &'a [u8]) -> Result<Self, FixtureError> {
        let (file, rest) = bytes.as_chunks::<4>();
        let (head, body) = file.split_first_chunk::<HEADER_WORDS>().ok_or(FixtureError::Length)?;
        let [
            magic,
            version,
            width,
            height,
            emitted,
            alpha,
            radius_squared,
            hits,
            entries,
            photons,
            low,
            high,
            ..,
        ] = head.map(u32::from_le_bytes);
        if magic != MAGIC {
            return Err(FixtureError::Magic);
        }
        if version != VERSION {
            return Err(FixtureError::Version(version));
        }
        let header = Header {
            width,
            height,
            emitted,
            alpha: f32::from_bits(alpha),
            radius_squared: f32::from_bits(radius_squared),
            hit_points: hits,
            index_entries: entries,
            photons,
        };
        if !rest.is_empty() || header.file_words() != Some(file.len()) {
            return Err(FixtureError::Length);
        }
        let digest = fnv1a64(undigested(file.iter().map(|word| u32::from_le_bytes(*word))));
        if digest != u64::from(high) << 32 | u64::from(low) {
            return Err(FixtureError::Digest);
        }
        if width.checked_mul(height).is_none_or(|pixels| pixels == 0) {
            return Err(FixtureError::Size);
        }
        // `file_words` has shown that all three are there.
        let (hit_points, body) = body.split_at(hits as usize * HIT_POINT_WORDS);
        let (index, photons) = body.split_at(entries as usize);
        Ok(Self { header, hit_points: hit_points.as_chunks().0, index, photons: photons.as_chunks().0 })
    }

    /// The sizes and constants.
    pub const fn header(&self) -> &Header {
        &self.header
    }

    /// Width times height.
    pub const fn pixels(&self) -> u32 {
        self.header.width * self.header.height
    }

    /// The hit points, untouched by photons.
    pub fn hit_points(&self) -> impl ExactSizeIterator<Item = HitPoint> + use<'a> {
        let radius_squared = self.header.radius_squared;
        self.hit_points.iter().map(move |words| {
            let [position @ .., nx, ny, nz, r, g, b, pixel] = words.map(u32::from_le_bytes);
            HitPoint {
                position: position.map(f32::from_bits),
                normal: [nx, ny, nz].map(f32::from_bits),
                colour: [r, g, b].map(f32::from_bits),
                flux: [0.0; 3],
                radius_squared,
                photons: 0.0,
                pixel,
            }
        })
    }

    /// The index table.
    pub fn index(&self) -> impl ExactSizeIterator<Item = u32> + use<'a> {
        self.index.iter().map(|word| u32::from_le_bytes(*word))
    }

    /// The photons, in the order of their emission.
    pub fn photons(&self) -> impl ExactSizeIterator<Item = Photon> + use<'a> {
        self.photons.iter().map(|words| {
            let [position @ .., nx, ny, nz, r, g, b, p_addr, n] = words.map(u32::from_le_bytes);
            Photon {
                position: position.map(f32::from_bits),
                normal: [nx, ny, nz].map(f32::from_bits),
                flux: [r, g, b].map(f32::from_bits),
                p_addr,
                n,
            }
        })
    }
}

/// Why bytes are no fixture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FixtureError {
    /// They do not begin with [`MAGIC`].
    Magic,
    /// Another [`VERSION`].
    Version(u32),
    /// More or fewer bytes than the header's counts make.
    Length,
    /// The digest is not that of the words.
    Digest,
    /// Width times height is 0 or does not fit 32 bits.
    Size,
}

impl fmt::Display for FixtureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Magic => f.write_str("not a Lucerna job: write one with `hostsim fixture`"),
            Self::Version(version) => {
                write!(f, "a job of format {version}, not {VERSION}: write it again with `hostsim fixture`")
            }
            Self::Length => f.write_str("the job's length is not what its header says: it was cut or joined"),
            Self::Digest => f.write_str("the job's digest is wrong: it was damaged on its way"),
            Self::Size => f.write_str("the job's picture has no pixels, or too many for 32 bits"),
        }
    }
}

impl core::error::Error for FixtureError {}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    const HEADER: Header = Header {
        width: 2,
        height: 1,
        emitted: 5,
        alpha: 0.7,
        radius_squared: 0.25,
        hit_points: 1,
        index_entries: 2,
        photons: 1,
    };

    fn bytes(edit: impl FnOnce(&mut Vec<u32>), after: impl FnOnce(&mut Vec<u32>)) -> Vec<u8> {
        let mut file = HEADER.words().to_vec();
        file.extend((1..=9).map(|x| (x as f32).to_bits()));
        file.push(1);
        file.extend([0, 0]);
        file.extend((11..=19).map(|x| (x as f32).to_bits()));
        file.extend([0, 2]);
        edit(&mut file);
        seal(&mut file);
        after(&mut file);
        file.into_iter().flat_map(u32::to_le_bytes).collect()
    }

    #[test]
    fn a_sealed_file_reads_back() {
        let bytes = bytes(|_| {}, |_| {});
        let fixture = Fixture::new(&bytes).unwrap();
        assert_eq!((*fixture.header(), fixture.pixels()), (HEADER, 2));
        let hit = fixture.hit_points().next().unwrap();
        assert_eq!((hit.position, hit.normal), ([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]));
        assert_eq!((hit.colour, hit.pixel, hit.radius_squared), ([7.0, 8.0, 9.0], 1, 0.25));
        assert_eq!(fixture.index().collect::<Vec<_>>(), [0, 0]);
        let photon = fixture.photons().next().unwrap();
        assert_eq!((photon.position, photon.normal), ([11.0, 12.0, 13.0], [14.0, 15.0, 16.0]));
        assert_eq!((photon.flux, photon.p_addr, photon.n), ([17.0, 18.0, 19.0], 0, 2));
    }

    #[test]
    fn every_damage_is_told() {
        let error = |bytes: &[u8]| Fixture::new(bytes).map(|_| ()).unwrap_err();
        let good = bytes(|_| {}, |_| {});
        assert_eq!(error(&[]), FixtureError::Length);
        assert_eq!(error(&good[..good.len() - 4]), FixtureError::Length);
        assert_eq!(error(&good[..good.len() - 1]), FixtureError::Length);
        assert_eq!(error(&bytes(|file| file[0] += 1, |_| {})), FixtureError::Magic);
        assert_eq!(error(&bytes(|file| file[1] = 2, |_| {})), FixtureError::Version(2));
        assert_eq!(error(&bytes(|file| file[7] = u32::MAX, |_| {})), FixtureError::Length);
        assert_eq!(error(&bytes(|file| file[2] = 0, |_| {})), FixtureError::Size);
        assert_eq!(error(&bytes(|file| (file[2], file[3]) = (1 << 16, 1 << 16), |_| {})), FixtureError::Size);
        for word in 2..good.len() / 4 {
            let damaged = bytes(|_| {}, |file| file[word] ^= 1 << (word % 32));
            assert!(matches!(error(&damaged), FixtureError::Digest | FixtureError::Length), "word {word}");
        }
    }
}
