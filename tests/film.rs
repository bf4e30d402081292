//! A film is its accumulators: the same bits as each of them alone, in tiles, merged, and as packs of pixels.

use ratiocv_core::moments::{Accumulate, Comoments, Merge, Moments, Sums};
use ratiocv_core::{
    ChannelEstimate, Draw, Error, Estimator, Film, Flags, HartleyRoss, Integrals, Lanes, Plain, RatioOfMeans, Reads,
    Spectrum, Tin,
};

type Rgb = Spectrum<f32, 3>;
/// Four pixels side by side.
type Pack = Spectrum<Spectrum<f32, 4>, 3>;

const WIDTH: usize = 5;
const HEIGHT: usize = 3;
const PIXELS: usize = WIDTH * HEIGHT;

/// Entry `channel` of draw `i` of pixel `pixel`: f and h.
fn entry(pixel: usize, i: usize, channel: usize) -> [f32; 2] {
    let salt = ((pixel * 31 + i * 7919 + channel * 104_729) % 1009) as f32 / 1009.0;
    let h = 0.5 + salt;
    [h * (1.0 + channel as f32) + 0.1 * pixel as f32 * salt * salt, h]
}

fn draw(pixel: usize, i: usize) -> Draw<Rgb> {
    let part = |which: usize| Rgb::from_fn(|channel| entry(pixel, i, channel)[which]);
    Draw::new(part(0), part(1))
}

/// The same of the pixels `4 * pack..`, channel by channel.
fn pack(pack: usize, i: usize) -> Draw<Pack> {
    let part = |which: usize| Pack::from_fn(|lane| entry(4 * pack + lane % 4, i, lane / 4)[which]);
    Draw::new(part(0), part(1))
}

fn bits(estimate: ChannelEstimate) -> (u64, u64, Flags) {
    (estimate.value.to_bits(), estimate.std_error.to_bits(), estimate.flags)
}

fn resolved<M: Moments, E: Estimator<M::Channel>>(film: &Film<'_, M>, estimator: &E) -> Vec<(u64, u64, Flags)> {
    let mut all = Vec::new();
    film.resolve_with(
        estimator,
        |_| Integrals::ONE,
        |i, estimate| {
            assert_eq!(i, all.len(), "entries in order");
            all.push(bits(estimate));
        },
    )
    .expect("a good film");
    all
}

/// Draws of pixel `pixel`: none of pixel 3.
fn spp(pixel: usize) -> usize {
    if pixel == 3 { 0 } else { 60 + 11 * pixel }
}

/// One film with all draws, tiles of space, and tiles of draws merged: the laws for one accumulator.
fn obeys<M: Accumulate<Draw<Rgb>> + Merge + Moments<Lanes = Rgb> + Copy, E: Estimator<M::Channel>>(
    estimator: &E,
    empty: M,
) {
    let alone: Vec<M> = (0..PIXELS)
        .map(|pixel| {
            let mut moments = empty;
            (0..spp(pixel)).for_each(|i| moments.add(draw(pixel, i)));
            moments
        })
        .collect();
    let expected: Vec<_> = alone
        .iter()
        .flat_map(|moments| {
            let estimate = estimator.estimate_anyway(moments, &Integrals::ONE);
            (0..3).map(move |channel| bits(estimate.channel(channel)))
        })
        .collect();

    let mut memory = vec![empty; PIXELS];
    let mut film = Film::new(&mut memory);
    for i in 0..spp(PIXELS) {
        for pixel in (0..PIXELS).filter(|pixel| i < spp(*pixel)) {
            film.add(pixel, draw(pixel, i)).expect("a pixel");
        }
    }
    assert_eq!(resolved(&film, estimator), expected, "by index");

    // Tiles of space: rows of the same memory.
    let mut memory = vec![empty; PIXELS];
    for (row, memory) in memory.chunks_mut(WIDTH).enumerate() {
        let mut tile = Film::new(memory);
        for (x, pixel) in (row * WIDTH..).take(WIDTH).enumerate() {
            (0..spp(pixel)).for_each(|i| tile.add(x, draw(pixel, i)).expect("a pixel"));
        }
    }
    assert_eq!(resolved(&Film::new(&mut memory), estimator), expected, "in tiles");

    // Tiles of draws: three films of the whole image, of every third of the draws, merged in order.
    let (mut memory, mut joined) = (vec![empty; PIXELS], vec![empty; PIXELS]);
    let mut film = Film::new(&mut memory);
    for part in 0..3 {
        let mut of_part = vec![empty; PIXELS];
        let mut later = Film::new(&mut of_part);
        for (pixel, joined) in joined.iter_mut().enumerate() {
            let (from, to) = (spp(pixel) * part / 3, spp(pixel) * (part + 1) / 3);
            let draws: Vec<_> = (from..to).map(|i| draw(pixel, i)).collect();
            later.add_batch(pixel, &draws).expect("a pixel");
            let mut moments = empty;
            moments.add_batch(&draws);
            joined.merge(&moments);
        }
        film.merge(&later).expect("the same image");
    }
    assert_eq!(resolved(&film, estimator), resolved(&Film::new(&mut joined), estimator), "merged");
    let counts = film.accumulators().iter().map(Moments::count);
    assert!(counts.eq((0..PIXELS).map(|pixel| spp(pixel) as u64)));
}

#[test]
fn a_film_is_its_accumulators() {
    obeys(&RatioOfMeans, Sums::default());
    obeys(&Tin, Comoments::default());
    obeys(&HartleyRoss, HartleyRoss.error_bar(&Integrals::ONE));
    let defensive = HartleyRoss.defensive(0.25).expect("a weight");
    obeys(&defensive, defensive.error_bar(&Integrals::ONE));
}

#[test]
fn packs_of_pixels_resolve_to_the_same_interleaved_image() {
    // 15 pixels in 4 packs of 4: one to spare.
    let (mut pixels, mut packs) = ([Comoments::<Rgb>::default(); PIXELS], [Comoments::<Pack>::default(); 4]);
    let (mut film, mut packed) =
        (Film::new(&mut pixels), Film::of_packs(&mut packs, PIXELS, 3).expect("4 packs hold 15 pixels"));
    for i in 0..100 {
        (0..PIXELS).for_each(|pixel| film.add(pixel, draw(pixel, i)).expect("a pixel"));
        (0..4).for_each(|index| packed.add(index, pack(index, i)).expect("a pack"));
    }
    assert_eq!((film.image_len(), packed.image_len()), (45, 45));
    assert_eq!(resolved(&film, &Tin), resolved(&packed, &Tin));
    let mut images = [[0.0_f32; 45]; 2];
    film.resolve(&RatioOfMeans, &Integrals::ONE, &mut images[0]).expect("an image of 45 entries");
    packed.resolve(&RatioOfMeans, &Integrals::ONE, &mut images[1]).expect("an image of 45 entries");
    assert_eq!(images[0], images[1]);
    // Pixel 7, blue.
    let blue: Vec<_> = (0..100).map(|i| entry(7, i, 2)).collect();
    let [f, h] = [0, 1].map(|k| blue.iter().map(|entry| f64::from(entry[k])).sum::<f64>());
    let error = (f64::from(images[0][7 * 3 + 2]) - f / h).abs();
    assert!(error <= 1e-6, "{error}");
}

#[test]
fn one_lane_of_many_pixels_and_many_wavelengths_of_one() {
    type Eight = Spectrum<f64, 8>;
    let numbers = |i: usize| Eight::from_fn(|lane| (i + lane) as f64);
    let image = |channels: usize, pixels: usize| {
        let mut memory = [Sums::<Eight>::default(); 2];
        let mut film = Film::of_packs(&mut memory, pixels, channels).expect("it fits");
        film.add(0, Draw::new(numbers(0), Eight::ONE)).expect("a pack");
        film.add(1, Draw::new(numbers(8), Eight::ONE)).expect("a pack");
        let mut image = vec![f64::NAN; channels * pixels];
        film.resolve(&Plain, &Integrals::ONE, &mut image).expect("the right size");
        image
    };
    let counting = |n: usize| (0..n).map(|i| i as f64).collect::<Vec<_>>();
    assert_eq!(image(1, 16), counting(16)); // sixteen grey pixels
    assert_eq!(image(1, 11), counting(11)); // and eleven
    assert_eq!(image(8, 2), counting(16)); // two pixels of eight wavelengths
    assert_eq!(image(2, 7), [0, 4, 1, 5, 2, 6, 3, 7, 8, 12, 9, 13, 10, 14].map(f64::from));
}

#[test]
fn a_pixel_without_draws_is_flagged_and_alone() {
    let mut memory = [Comoments::<Rgb>::default(); 3];
    let mut film = Film::new(&mut memory);
    film.add_batch(0, &[draw(0, 0), draw(0, 1), draw(0, 2)]).expect("a pixel");
    film.add(2, draw(2, 0)).expect("a pixel");
    // Tin needs two draws: one falls back to the ratio of means.
    let all = resolved(&film, &Tin);
    assert!(all[..3].iter().all(|(value, _, flags)| f64::from_bits(*value).is_finite() && !flags.fell_back()));
    assert!(all[3..6].iter().all(|(value, error, flags)| {
        f64::from_bits(*value).is_nan() && f64::from_bits(*error).is_nan() && flags.contains(Flags::EMPTY)
    }));
    assert!(
        all[6..]
            .iter()
            .all(|(value, _, flags)| { f64::from_bits(*value).is_finite() && flags.contains(Flags::ONE_SAMPLE) })
    );
}

#[test]
fn what_does_not_fit_is_an_error_and_changes_nothing() {
    let mut memory = [Sums::<Rgb>::default(); 4];
    let mut other = [Sums::<Rgb>::default(); 5];
    let mut film = Film::new(&mut memory);
    let no_such = Error::NoSuchAccumulator { index: 4, accumulators: 4 };
    assert_eq!(film.add(4, draw(0, 0)), Err(no_such));
    assert_eq!(film.add_batch(4, &[draw(0, 0)]), Err(no_such));
    assert!(no_such.to_string().contains("accumulator 4 in a film of 4"));
    let mut later = Film::new(&mut other);
    later.add(0, draw(0, 0)).expect("a pixel");
    let error = film.merge(&later).unwrap_err();
    assert_eq!(error, Error::FilmSize { what: "the pixels of a film to be merged", needed: 4, got: 5 });
    let mut short = [7.0_f32; 11];
    let error = film.resolve(&Plain, &Integrals::ONE, &mut short).unwrap_err();
    assert_eq!(error, Error::FilmSize { what: "image", needed: 12, got: 11 });
    assert!(error.to_string().starts_with("image: 11, and must be 12"));
    assert_eq!(short, [7.0; 11]);
    assert!(film.accumulators().iter().all(|moments| moments.count() == 0));

    let mut packs = [Sums::<Pack>::default(); 2];
    for (pixels, channels) in [(4, 3), (9, 3), (8, 5), (8, 0), (8, 24)] {
        assert!(Film::of_packs(&mut packs, pixels, channels).is_err(), "{pixels} pixels of {channels} channels");
    }
    assert!(Film::of_packs(&mut packs, 5, 3).is_ok());
    // The same memory as pixels of other channels is another image.
    let mut twins = packs;
    let mut rgb = Film::of_packs(&mut packs, 8, 3).expect("8 pixels");
    let six = Film::of_packs(&mut twins, 4, 6).expect("4 pixels");
    assert!(rgb.merge(&six).is_err());
}

#[test]
fn ratios_on_another_auxiliary_are_an_error() {
    let defensive = HartleyRoss.defensive(0.25).expect("a weight");
    let mut memory = [defensive.value(&Integrals::<Rgb>::ONE); 2];
    let mut film = Film::new(&mut memory);
    film.add_batch(1, &[draw(0, 0), draw(0, 1)]).expect("a pixel");
    let mut image = [0.0_f32; 6];
    let error = film.resolve(&HartleyRoss, &Integrals::ONE, &mut image).unwrap_err();
    assert_eq!(error, Error::OtherAuxiliary { estimator: "hartley_ross", channel: 0 });
    assert!(film.resolve(&defensive, &Integrals::ONE, &mut image).is_ok());
    assert!(image[..3].iter().all(|x| x.is_nan()) && image[3..].iter().all(|x| x.is_finite()));
}

#[test]
fn no_pixels_and_no_channels_are_no_image() {
    fn nothing<V: Lanes>(accumulators: usize) {
        let mut memory = vec![Sums::<V>::default(); accumulators];
        let film = Film::new(&mut memory);
        assert_eq!(film.image_len(), 0);
        assert!(film.resolve(&Plain, &Integrals::ONE, &mut [0.0_f32; 0]).is_ok());
    }
    nothing::<f64>(0);
    nothing::<Spectrum<f32, 0>>(3);
}
