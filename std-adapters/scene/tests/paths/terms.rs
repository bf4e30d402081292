//! Pairs of the terms that paths did not come to.

use crate::{RATIO, Rgb, built, scene};
use ratiocv_core::moments::{Accumulate, Merge, Sums};
use ratiocv_core::{Defensive, Draw, Estimator, Integrals, RatioOfMeans, Reads, Spectrum};
use ratiocv_scene::{BLOCK, Pixel, Samples, Scene};

/// In the middle of the ball of a furnace scene, at its rim, and beside it.
const PIXELS: [[u32; 2]; 3] = [[64, 64], [64, 19], [2, 3]];

/// S4e has light where a path ends, and nowhere else.
#[test]
fn paths_that_end_leave_their_h_in_all_deeper_terms() {
    let scene = scene("S4e", RATIO);
    let mut samples = Samples::new(&scene);
    let mut distinct = Vec::new();
    for (block, pixel) in (0..9).map(|i| (i / 3, PIXELS[i as usize % 3])) {
        scene.trace(pixel, block, BLOCK, 5, &mut samples);
        distinct.push(samples.distinct());
        for i in 0..BLOCK {
            let pairs = || (0..scene.terms().len() - 1).map(|term| samples.pairs(term)[i]);
            // Deeper light is in the last term.
            let Some(end) = pairs().position(|pair| pair.f != Spectrum([0.0; 3])) else { continue };
            let h = pairs().nth(end).expect("it was found").h[0];
            assert!(pairs().skip(end + 1).all(|pair| pair == Draw::new(Spectrum([0.0; 3]), h)), "{pixel:?}, {i}");
        }
    }
    assert_eq!((scene.terms().len(), &distinct[..3]), (8, &[8, 8, 2][..]));
}

#[test]
fn the_sky_is_what_it_is() {
    for (name, paired) in [("S4e", true), ("S4g", false)] {
        let scene = scene(name, RATIO);
        let mut samples = Samples::new(&scene);
        scene.trace([2, 3], 0, 13, 1, &mut samples);
        assert_eq!((samples.count(), samples.plain().len()), (13, 13));
        let (sky, nothing) = (Spectrum([1.0; 3]), Spectrum([0.0; 3]));
        assert!(samples.plain().iter().all(|draw| draw.f == if paired { nothing } else { sky }), "{name}");
        for term in 0..scene.terms().len() {
            let f = if paired && term == 0 { sky } else { nothing };
            assert_eq!(samples.pairs(term), [Draw::new(f, sky); 13], "{name}, term {term}");
        }
        assert_eq!(samples.pairs(scene.terms().len()), []);
    }
}

/// The moments of each term by themselves, whether a path came to it or not.
fn by_term(scene: &Scene<Rgb>, blocks: &[Samples<Rgb>]) -> Vec<Sums<Rgb>> {
    let mut terms = vec![Sums::default(); scene.terms().len()];
    for samples in blocks {
        for (term, moments) in terms.iter_mut().enumerate() {
            moments.add_batch(samples.pairs(term));
        }
    }
    terms
}

#[test]
fn a_pixel_keeps_what_each_term_alone_would_keep() {
    type Ours = Defensive<RatioOfMeans>;
    let estimator: Ours = RatioOfMeans.defensive(0.01).expect("a weight");
    let scene = Scene::<Rgb>::new(&built("S4e"), &RATIO).expect("a sound scene");
    let traced = |pixel, block| {
        let mut samples = Samples::new(&scene);
        scene.trace(pixel, block, BLOCK, 5, &mut samples);
        samples
    };
    let [deep, rim, sky] = PIXELS;
    for blocks in [[deep, sky, rim], [sky, rim, deep], [rim, deep, sky], [sky, sky, rim]] {
        let blocks: Vec<_> = (0..3).map(|i| traced(blocks[i], i as u64)).collect();
        // One pixel of three blocks, and one of one block to which one of two is merged.
        let empty = estimator.value(&Integrals::ONE);
        let [mut one, mut first, mut rest] = [(); 3].map(|()| Pixel::new(scene.terms().len(), empty, false));
        blocks.iter().for_each(|samples| one.add(samples));
        first.add(&blocks[0]);
        blocks[1..].iter().for_each(|samples| rest.add(samples));
        first.merge(&rest);
        let mut merged = by_term(&scene, &blocks[..1]);
        merged.iter_mut().zip(by_term(&scene, &blocks[1..])).for_each(|(first, rest)| first.merge(&rest));
        for (pixel, terms) in [(&mut one, by_term(&scene, &blocks)), (&mut first, merged)] {
            let estimates = terms.iter().map(|term| estimator.estimate_anyway(term, &Integrals::ONE).value);
            let right =
                estimates.fold([0.0; 3], |sum, value| core::array::from_fn(|channel| sum[channel] + value[channel]));
            assert_eq!(pixel.estimate(&estimator, &[]).value, right);
            // A file has all terms, and reading it gives all of them moments of their own.
            let mut words = Vec::new();
            pixel.words(&mut |word| words.push(*word));
            assert_eq!(pixel.estimate(&estimator, &[]).value, right);
            let mut read = Pixel::new(scene.terms().len(), empty, false);
            let mut rest = words.iter();
            read.words(&mut |word| *word = *rest.next().expect("as many words"));
            assert!(rest.next().is_none());
            assert_eq!(read.estimate(&estimator, &[]).value, right);
        }
    }
}
