//! Channels counted at run time have the bits of `Spectrum<_, M>`, for numbers of either side of what changes, pieces and kernels.

use core::cell::RefCell;
use core::fmt::Debug;
use ratiocv_core::moments::{
    Accumulate, Blocked, Comoments, Mean, Merge, RatioVariance, Slices, State, Sums, Takes, Variance,
};
use ratiocv_core::{ChannelEstimate, Draw, Error, Estimator, Flags, Integrals, Lanes, Sample, Scalar, Spectrum};

/// Not an estimator: writes down the moments of each channel, every bit of them.
#[derive(Default)]
struct Probe(RefCell<Vec<String>>);

impl<S: Debug, const K: usize> Estimator<S, K> for Probe {
    fn check(&self, _: &Sample<'_, S>, _: &[f64; K]) -> Result<(), Error> {
        Ok(())
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, _: &[f64; K]) -> ChannelEstimate {
        self.0.borrow_mut().push(format!("{} {}: {:?}", sample.channel, sample.count, sample.moments));
        ChannelEstimate { value: 0.0, std_error: 0.0, flags: Flags::NONE }
    }
}

/// Entry `i` of a long list of numbers with ties and zeros, h in 0.25..2, f of either sign.
fn number<S: Scalar>(i: usize) -> [S; 2] {
    let random = (i as u64).wrapping_add(0x9e37_79b9).wrapping_mul(0xd134_2543_de82_ef95) >> 20;
    let [a, b] = [random & 0xffff, random >> 16 & 0xffff].map(|bits| bits as f64 / 65536.0);
    let f = if i.is_multiple_of(13) { 0.0 } else { 5.0 * b - 1.0 + a };
    let h = if i.is_multiple_of(11) { 1.0 } else { 0.25 + 1.75 * a };
    [S::from_f64(f), S::from_f64(h)]
}

fn list<S: Scalar>(which: usize, length: usize) -> Vec<S> {
    (0..length).map(|i| number::<S>(i)[which]).collect()
}

/// Draws of each call: 1 is `add`, a 0 is a merge with what was not seen yet, the rest `add_batch`.
const CALLS: [&[usize]; 5] = [&[1300], &[2, 1, 1, 64, 1, 130, 63], &[1, 67, 64], &[70, 0, 200, 1], &[3]];

/// The integral of a channel.
fn integral(channel: usize) -> f64 {
    1.0 + channel as f64 / 8.0
}

/// What the accumulator of `M` channels knows after `calls`.
fn reference<V, B, const K: usize>(empty: Blocked<V, B>, calls: &[usize]) -> Vec<String>
where
    V: Lanes,
    B: Takes<Draw<V, K>>,
    <B::State as State>::Channel: Debug,
{
    let total: usize = calls.iter().sum();
    let (f, h) = (list::<V::Scalar>(0, total * V::LANES), list::<V::Scalar>(1, total * V::LANES));
    let lanes = |entries: &[V::Scalar], draw: usize| V::from_fn(|i| entries[draw * V::LANES + i]);
    let draws: Vec<_> =
        (0..total).map(|i| Draw::<V, K> { f: lanes(&f, i), h: core::array::from_fn(|_| lanes(&h, i)) }).collect();
    let (mut moments, mut earlier, mut first) = (empty, None, 0);
    for draws_in_call in calls {
        let draws = &draws[first..first + draws_in_call];
        first += draws_in_call;
        match draws {
            [] => earlier = Some(core::mem::replace(&mut moments, empty)),
            [draw] => moments.add(*draw),
            draws => moments.add_batch(draws),
        }
    }
    if let Some(mut earlier) = earlier {
        earlier.merge(&moments);
        moments = earlier;
    }
    let probe = Probe::default();
    Estimator::<_, 1>::estimate_anyway(&probe, &moments, &Integrals::ONE);
    probe.0.into_inner()
}

/// The same of slices with pieces of `V`.
fn in_pieces<V, B, const K: usize>(
    empty: impl Fn(usize) -> Blocked<V, B>,
    channels: usize,
    calls: &[usize],
) -> Vec<String>
where
    V: Lanes,
    B: Takes<Draw<V, K>>,
    <B::State as State>::Channel: Debug,
{
    let total: usize = calls.iter().sum();
    let (f, h) = (list::<V::Scalar>(0, total * channels), list::<V::Scalar>(1, total * channels));
    let new = || (0..channels.div_ceil(V::LANES)).map(&empty).collect::<Vec<_>>();
    let (mut memory, mut earlier, mut first) = (new(), None, 0);
    for draws in calls {
        if *draws == 0 {
            earlier = Some(core::mem::replace(&mut memory, new()));
        }
        let mut moments = Slices::new(&mut memory, channels).expect("enough memory");
        let range = first * channels..(first + draws) * channels;
        first += draws;
        let (f, h) = (&f[range.clone()], [&h[range]; K]);
        if *draws == 1 { moments.add(f, h) } else { moments.add_batch(f, h) }.expect("whole rows");
    }
    if let Some(mut earlier) = earlier {
        let mut before = Slices::new(&mut earlier, channels).expect("enough memory");
        before.merge(&Slices::new(&mut memory, channels).expect("enough memory")).expect("as many channels");
        memory = earlier;
    }
    let moments = Slices::new(&mut memory, channels).expect("enough memory");
    let (probe, mut seen) = (Probe::default(), 0);
    moments
        .estimate(
            &probe,
            |_| [1.0],
            |channel, _| {
                assert_eq!(channel, seen, "channels in order");
                seen += 1;
            },
        )
        .expect("a probe");
    assert_eq!((seen, moments.channels()), (channels, channels));
    assert!(channels == 0 || moments.count() == total as u64);
    probe.0.into_inner()
}

/// `$body` for every number of channels.
macro_rules! for_every {
    ($check:ident for $($m:literal)*) => { $($check::<$m>();)* };
}

/// One kernel of `Spectrum<f32, M>` and its pieces of 16 and of 8 lanes.
macro_rules! kernel {
    ($name:ident, $moments:ident) => {
        fn $name<const M: usize>() {
            for calls in CALLS {
                let expected = reference::<_, _, 1>($moments::<Spectrum<f32, M>>::default(), calls);
                let sixteen = in_pieces::<Spectrum<f32, 16>, _, 1>(|_| $moments::default(), M, calls);
                assert!(sixteen == expected, "{M} channels, {calls:?}\n{sixteen:#?}\n{expected:#?}");
                let eight = in_pieces::<Spectrum<f32, 8>, _, 1>(|_| $moments::default(), M, calls);
                assert!(eight == expected, "{M} channels, {calls:?}\n{eight:#?}\n{expected:#?}");
            }
        }
    };
}

kernel!(sums, Sums);
kernel!(comoments, Comoments);

#[test]
fn any_number_of_channels_has_the_bits_of_that_spectrum() {
    for_every! { sums for 0 1 2 3 7 8 9 15 16 17 31 63 70 }
}

#[test]
fn so_have_comoments() {
    for_every! { comoments for 1 3 12 17 24 }
}

/// Other kernels, auxiliaries, scalars and widths of pieces.
macro_rules! same {
    ($m:literal channels, $k:literal auxiliaries, $reference:expr; $($piece:ty => $empty:expr),* $(,)?) => {
        for calls in CALLS {
            let expected = reference::<_, _, $k>($reference, calls);
            $({
                let pieces = in_pieces::<$piece, _, $k>($empty, $m, calls);
                assert!(pieces == expected, "{} channels, {calls:?}, {}", $m, stringify!($piece));
            })*
        }
    };
}

#[test]
fn so_have_pieces_of_any_width() {
    same! { 21 channels, 1 auxiliaries, Comoments::<Spectrum<f64, 21>>::default();
        f64 => |_| Comoments::default(),
        Spectrum<f64, 3> => |_| Comoments::default(),
        Spectrum<Spectrum<f64, 4>, 2> => |_| Comoments::default(),
        Spectrum<f64, 24> => |_| Comoments::default(),
    }
}

#[test]
fn so_have_other_kernels() {
    same! { 19 channels, 2 auxiliaries, Comoments::<Spectrum<f32, 19>, 2>::default();
    Spectrum<f32, 8> => |_| Comoments::default() }
    same! { 6 channels, 0 auxiliaries, Mean::<Spectrum<f32, 6>, 0>::default();
    Spectrum<f32, 16> => |_| Mean::default() }
    same! { 67 channels, 0 auxiliaries, Variance::<Spectrum<f32, 67>, 0>::default();
    Spectrum<f32, 8> => |_| Variance::default() }
    same! { 3 channels, 1 auxiliaries, RatioVariance::<Spectrum<f32, 3>>::default();
    Spectrum<f32, 16> => |_| RatioVariance::default() }
    let empty = |piece| {
        let integrals = Integrals::of_piece(37, piece, |channel| [integral(channel)]);
        RatioVariance::<Spectrum<f32, 8>>::defensive(0.25, &integrals).expect("a weight")
    };
    let integrals = Integrals::new([Spectrum::from_fn(integral)]);
    let whole = RatioVariance::<Spectrum<f32, 37>>::defensive(0.25, &integrals).expect("a weight");
    same! { 37 channels, 1 auxiliaries, whole; Spectrum<f32, 8> => empty }
}
