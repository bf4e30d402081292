//! Random numbers, sixteen at a time.

use crate::functions::uniform;
use core::convert::Infallible;
use rand_core::block::{BlockRng, Generator};
use rand_core::{SeedableRng, TryRng};

/// Streams side by side. With 8 of them the compiler unrolls the loop over streams before it could turn
/// it into vector instructions, which takes twice as long per number; 32 gain nothing.
const STREAMS: usize = 16;

/// Sixteen generators xoshiro256++ (Blackman and Vigna 2021) side by side: number i is number ⌊i/16⌋ of
/// stream i mod 16, on any machine and however wide its registers.
///
/// Additions, exclusive ors and rotations alone, the same for every stream: plain loops over arrays that
/// become vector instructions of whatever level the caller is compiled for. Not for cryptography.
///
/// A [`stream`](Self::stream) starts every generator at a place of its own; a seed
/// ([`SeedableRng::from_seed`]) is the state of the first one, the others being 2¹²⁸ numbers apart.
///
/// ```
/// use rand_core::Rng;
/// use ratiocv_simd::Xoshiro16;
/// let (mut one_by_one, mut at_once) = (Xoshiro16::stream(7, 0), Xoshiro16::stream(7, 0));
/// let mut numbers = [0; 100];
/// at_once.fill(&mut numbers);
/// assert!(numbers.iter().all(|number| *number == one_by_one.next_u64()));
/// ```
#[derive(Clone, Debug)]
pub struct Xoshiro16(BlockRng<States>);

/// Word w of the state of stream i is `0[w][i]`.
#[derive(Clone, Debug)]
struct States([[u64; STREAMS]; 4]);

impl States {
    /// The next number of every stream, as `number` sees it.
    #[inline(always)]
    fn next<T>(&mut self, row: &mut [T; STREAMS], number: impl Fn(u64) -> T) {
        let [a, b, c, d] = &mut self.0;
        for i in 0..STREAMS {
            let (mut s0, mut s1, mut s2, mut s3) = (a[i], b[i], c[i], d[i]);
            row[i] = number(s0.wrapping_add(s3).rotate_left(23).wrapping_add(s0));
            let t = s1 << 17;
            s2 ^= s0;
            s3 ^= s1;
            s1 ^= s2;
            s0 ^= s3;
            s2 ^= t;
            s3 = s3.rotate_left(45);
            (a[i], b[i], c[i], d[i]) = (s0, s1, s2, s3);
        }
    }
}

impl Generator for States {
    type Output = [u64; STREAMS];
    #[inline(always)]
    fn generate(&mut self, row: &mut Self::Output) {
        self.next(row, |number| number);
    }
}

/// The next number of SplitMix64 (Steele, Lea and Flood 2014).
fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The state 2¹²⁸ numbers later: the published jump polynomial, applied to `state`.
fn jumped(state: [u64; 4]) -> [u64; 4] {
    const JUMP: [u64; 4] = [0x180e_c6d3_3cfd_0aba, 0xd5a6_1266_f0c9_392c, 0xa958_2618_e03f_c9aa, 0x39ab_dc45_29b1_661c];
    let mut states = States(state.map(|word| [word; STREAMS]));
    let mut later = [0; 4];
    for bit in 0..256 {
        if JUMP[bit / 64] >> (bit % 64) & 1 == 1 {
            for (later, word) in later.iter_mut().zip(&states.0) {
                *later ^= word[0];
            }
        }
        states.next(&mut [(); STREAMS], |_| ());
    }
    later
}

impl Xoshiro16 {
    fn new(states: [[u64; 4]; STREAMS]) -> Self {
        Self(BlockRng::new(States(core::array::from_fn(|word| states.map(|state| state[word])))))
    }

    /// The random stream `index` of `seed`, for a chunk of work or a replicate.
    ///
    /// SplitMix64 spreads the seed's bits over the first word of each of the 16 states and the index's over
    /// the second, one to one, so that two streams never start alike; the other two words mix both. A state
    /// is one of 2²⁵⁶ − 1 on a single cycle: that any two of n random starts come to share numbers within L
    /// steps has a probability of at most n²L/2²⁵⁶ (Vigna 2020), 2⁻¹²⁸ for n = 2⁴⁰ and L = 2⁴⁸.
    pub fn stream(seed: u64, index: u64) -> Self {
        let (mut of_seed, mut of_index) = (seed, !index);
        // Once more, so that the states of one seed are not those of another, shifted.
        let mut of_seed = split_mix(&mut of_seed);
        let mut of_index = split_mix(&mut of_index);
        Self::new(core::array::from_fn(|_| {
            let [first, second] = [split_mix(&mut of_seed), split_mix(&mut of_index)];
            let mut of_both = first.rotate_left(32) ^ second;
            nonzero([first, second, split_mix(&mut of_both), split_mix(&mut of_both)])
        }))
    }

    /// The next numbers, as many as there is room for: those of as many calls of `next_u64`.
    #[inline(always)]
    pub fn fill(&mut self, numbers: &mut [u64]) {
        self.fill_with(numbers, |number| number);
    }

    /// The next numbers, each as [`ratiocv_core::unit_interval`] makes it, to the bit: multiples of 2⁻⁵³ in
    /// [0, 1).
    ///
    /// ```
    /// use ratiocv_core::unit_interval;
    /// use ratiocv_simd::Xoshiro16;
    /// let (mut one_by_one, mut at_once) = (Xoshiro16::stream(7, 0), Xoshiro16::stream(7, 0));
    /// let mut numbers = [0.0; 100];
    /// at_once.fill_unit(&mut numbers);
    /// assert!(numbers.iter().all(|number| *number == unit_interval(&mut one_by_one)));
    /// ```
    #[inline(always)]
    pub fn fill_unit(&mut self, numbers: &mut [f64]) {
        self.fill_with(numbers, uniform::binary64);
    }

    #[inline(always)]
    fn fill_with<T>(&mut self, numbers: &mut [T], of: impl Fn(u64) -> T) {
        // What is left of a row that was begun, whole rows, and the beginning of another.
        let left = self.0.word_offset().wrapping_neg() % STREAMS;
        let (begun, numbers) = numbers.split_at_mut(left.min(numbers.len()));
        begun.iter_mut().for_each(|number| *number = of(self.0.next_word()));
        let (rows, rest) = numbers.as_chunks_mut();
        rows.iter_mut().for_each(|row| self.0.core.next(row, &of));
        rest.iter_mut().for_each(|number| *number = of(self.0.next_word()));
    }
}

/// 0 is the one state that is not on the cycle.
fn nonzero(state: [u64; 4]) -> [u64; 4] {
    let mut zero = 0;
    if state == [0; 4] { core::array::from_fn(|_| split_mix(&mut zero)) } else { state }
}

impl SeedableRng for Xoshiro16 {
    type Seed = [u8; 32];

    /// Stream i starts 2¹²⁸·i numbers after the state that the seed is, in little-endian words.
    fn from_seed(seed: [u8; 32]) -> Self {
        let mut state = nonzero(rand_core::utils::read_words(&seed));
        Self::new(core::array::from_fn(|_| {
            let later = jumped(state);
            core::mem::replace(&mut state, later)
        }))
    }

    /// The seed is spread by SplitMix64, as Blackman and Vigna recommend.
    fn seed_from_u64(mut seed: u64) -> Self {
        let mut bytes = [0; 32];
        bytes.as_chunks_mut().0.iter_mut().for_each(|word| *word = split_mix(&mut seed).to_le_bytes());
        Self::from_seed(bytes)
    }
}

impl TryRng for Xoshiro16 {
    type Error = Infallible;

    /// The upper half of the next number.
    #[inline]
    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok((self.0.next_word() >> 32) as u32)
    }
    #[inline]
    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(self.0.next_word())
    }
    /// Whole numbers, little-endian; what is left of the last one is dropped.
    #[inline]
    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        let (numbers, rest) = bytes.as_chunks_mut();
        self.fill_with(numbers, u64::to_le_bytes);
        self.0.fill_bytes(rest);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_core::Rng;
    use rand_xoshiro::Xoshiro256PlusPlus;

    const N: usize = 1 << 16;

    #[test]
    fn the_first_stream_is_the_published_one() {
        // xoshiro256plusplus.c (Blackman and Vigna) from the state 1, 2, 3, 4.
        let right = [
            41943041,
            58720359,
            3588806011781223,
            3591011842654386,
            9228616714210784205,
            9973669472204895162,
            14011001112246962877,
            12406186145184390807,
            15849039046786891736,
            10450023813501588000,
        ];
        let mut seed = [0; 32];
        [seed[0], seed[8], seed[16], seed[24]] = [1, 2, 3, 4];
        let mut numbers = [0; 10 * STREAMS];
        Xoshiro16::from_seed(seed).fill(&mut numbers);
        for (i, right) in right.into_iter().enumerate() {
            assert_eq!(numbers[STREAMS * i], right, "number {i}");
        }
    }

    #[test]
    fn every_stream_is_a_jump_after_the_one_before() {
        for seed in [0, 1, 0x0123_4567_89ab_cdef, u64::MAX] {
            let mut first = Xoshiro256PlusPlus::seed_from_u64(seed);
            let mut numbers = [0; 50 * STREAMS];
            Xoshiro16::seed_from_u64(seed).fill(&mut numbers);
            for stream in 0..STREAMS {
                let mut right = first.clone();
                for i in 0..50 {
                    assert_eq!(numbers[STREAMS * i + stream], right.next_u64(), "number {i} of stream {stream}");
                }
                first.jump();
            }
        }
    }

    #[test]
    fn a_seed_of_zeros_is_replaced_as_in_rand_xoshiro() {
        let mut zeros = Xoshiro16::from_seed([0; 32]);
        assert_eq!(zeros.next_u64(), Xoshiro256PlusPlus::from_seed([0; 32]).next_u64());
    }

    #[test]
    fn streams_keep_their_numbers() {
        let mut stream = Xoshiro16::stream(1, 2);
        let mut numbers = [0; 2 * STREAMS];
        stream.fill(&mut numbers);
        let states = States(core::array::from_fn(|word| Xoshiro16::stream(1, 2).0.core.0[word]));
        for i in 0..STREAMS {
            let mut seed = [0; 32];
            for (bytes, word) in seed.as_chunks_mut().0.iter_mut().zip(states.0) {
                *bytes = word[i].to_le_bytes();
            }
            let mut right = Xoshiro256PlusPlus::from_seed(seed);
            assert_eq!([numbers[i], numbers[STREAMS + i]], [right.next_u64(), right.next_u64()], "stream {i}");
        }
        assert_eq!([numbers[0], numbers[STREAMS + 3]], [1358789704586183305, 1950931182533658541]);
    }

    #[test]
    fn pieces_of_any_length_are_the_same_numbers() {
        let mut right = Xoshiro16::stream(3, 4);
        let mut pieces = Xoshiro16::stream(3, 4);
        for length in (0..60).chain([33, 1, 64, 15, 17, 16]) {
            let mut numbers = [0; 64];
            pieces.fill(&mut numbers[..length]);
            for number in &numbers[..length] {
                assert_eq!(*number, right.next_u64());
            }
            assert_eq!(pieces.next_u32(), (right.next_u64() >> 32) as u32);
            let mut bytes = [0; 13];
            pieces.fill_bytes(&mut bytes);
            let [first, second] = [right.next_u64().to_le_bytes(), right.next_u64().to_le_bytes()];
            assert_eq!((&bytes[..8], &bytes[8..]), (&first[..], &second[..5]));
        }
    }

    #[test]
    fn neighbouring_seeds_and_indices_share_no_number() {
        let mut seen = [[0; 2 * STREAMS]; 64];
        for (i, numbers) in seen.iter_mut().enumerate() {
            Xoshiro16::stream(i as u64 / 8, i as u64 % 8).fill(numbers);
        }
        let mut sorted = [0; 128 * STREAMS];
        sorted.copy_from_slice(seen.as_flattened());
        sorted.sort_unstable();
        assert!(sorted.windows(2).all(|pair| pair[0] != pair[1]));
    }

    /// H0: every bit of every stream is fair. N = 2¹⁶ numbers, 16·64 counts of ones that are normal about
    /// N/2 with variance N/4; α = 10⁻⁶ for all, so 10⁻⁹ for each: 6.11 standard deviations.
    #[test]
    fn every_bit_of_every_stream_is_fair() {
        let mut streams = Xoshiro16::stream(8, 0);
        let mut ones = [[0_u32; 64]; STREAMS];
        for _ in 0..N {
            let mut row = [0; STREAMS];
            streams.fill(&mut row);
            for (ones, number) in ones.iter_mut().zip(row) {
                for (bit, ones) in ones.iter_mut().enumerate() {
                    *ones += (number >> bit & 1) as u32;
                }
            }
        }
        for (stream, ones) in ones.iter().enumerate() {
            for (bit, ones) in ones.iter().enumerate() {
                let z = (f64::from(*ones) - N as f64 / 2.0) / libm::sqrt(N as f64 / 4.0);
                assert!(z.abs() <= 6.11, "bit {bit} of stream {stream}: {z} standard deviations");
            }
        }
    }

    /// H0: neither two streams of a generator nor two generators of neighbouring indices or seeds are
    /// correlated. N = 2¹⁶ numbers u of each of 3·16 streams; √N times a correlation is standard normal;
    /// 48·47/2 pairs, α = 10⁻⁶ for all, so 8.9·10⁻¹⁰ for each: 6.13.
    #[test]
    fn streams_are_not_correlated() {
        let mut generators = [Xoshiro16::stream(9, 0), Xoshiro16::stream(9, 1), Xoshiro16::stream(10, 0)];
        let mut products = [[0.0; 3 * STREAMS]; 3 * STREAMS];
        for _ in 0..N {
            let mut row = [[0.0; STREAMS]; 3];
            for (generator, row) in generators.iter_mut().zip(&mut row) {
                generator.fill_unit(row);
            }
            let row = row.as_flattened();
            for (products, u) in products.iter_mut().zip(row) {
                for (product, v) in products.iter_mut().zip(row) {
                    *product += (u - 0.5) * (v - 0.5);
                }
            }
        }
        for (i, products) in products.iter().enumerate() {
            for (j, product) in products.iter().enumerate().take(i) {
                // Each factor has variance 1/12.
                let z = product * 12.0 / libm::sqrt(N as f64);
                assert!(z.abs() <= 6.13, "streams {i} and {j}: {z} standard deviations");
            }
        }
    }
}
