//! Draws of the peaks, many at a time.

use ratiocv_simd::functions::Elementary;

/// Rows of `N` numbers, one for each of `M` channels.
pub type Rows<T, const M: usize, const N: usize> = [[T; N]; M];

/// The draws of [`Peaks`](crate::problems::Peaks) from the same uniform numbers, in `f64` to 10⁻¹¹ the same
/// draws, as loops over samples that become vector instructions.
///
/// On each axis, in terms of E = e^((x − ½)/s), a = e^((c − ½)/s) and E₀, E₁ at the ends of \[0, 1\]:
/// - the logistic distribution function about c is E/(E + a), so that the share u of what of it lies in
///   \[0, 1\] ends at E = n/d with v = κu, κ = (E₀ + a)/(E₁ + a), d = (1 − u) + v and n = E₀(1 − u) + E₁v;
/// - its density is proportional to Ea/(E + a)² = nda/(n + ad)²;
/// - −50(x − c)² is −50s²(ln(n/d) − ln a)².
///
/// So a draw takes four logarithms, three exponentials and one division more: all three densities are
/// brought to a common denominator, and f/g = f·(3/Σp) to the same.
#[derive(Clone, Copy, Debug)]
pub struct PeaksBlock<T> {
    /// E₀ and E₁.
    ends: [T; 2],
    /// Of each centre and axis: a, ln a and κ.
    odds: Rows<T, 3, 4>,
    log_odds: Rows<T, 3, 4>,
    kappa: Rows<T, 3, 4>,
    /// The densities' constants: Πa/(s·mass).
    weight: [T; 3],
    /// −50s².
    exponent: T,
}

impl<T: Elementary> PeaksBlock<T> {
    /// About `centres`: logistic densities of scale `scale`, peaks exp(−`sharpness`·|x − c|²).
    pub(super) fn new(centres: [[f64; 4]; 3], scale: f64, sharpness: f64) -> Self {
        let ends = [libm::exp(-0.5 / scale), libm::exp(0.5 / scale)];
        let log_odds = centres.map(|centre| centre.map(|c| (c - 0.5) / scale));
        let odds = log_odds.map(|centre| centre.map(libm::exp));
        let kappa = odds.map(|centre| centre.map(|a| (ends[0] + a) / (ends[1] + a)));
        let mass = |a| ends[1] / (ends[1] + a) - ends[0] / (ends[0] + a);
        let weight = odds.map(|centre| centre.into_iter().fold(1.0, |product, a| product * (a / (scale * mass(a)))));
        let rounded = |rows: [[f64; 4]; 3]| rows.map(|row| row.map(T::from_f64));
        Self {
            ends: ends.map(T::from_f64),
            odds: rounded(odds),
            log_odds: rounded(log_odds),
            kappa: rounded(kappa),
            weight: weight.map(T::from_f64),
            exponent: T::from_f64(-sharpness * scale * scale),
        }
    }

    /// f/g and h/g of `N` draws: draw i takes the i-th of each of the five rows of `uniforms`, in \[0, 1).
    ///
    /// Any `N` gives the same bits.
    #[inline(always)]
    pub fn draws<const N: usize>(&self, uniforms: &Rows<T, 5, N>, f: &mut Rows<T, 3, N>, h: &mut Rows<T, 3, N>) {
        // Stage by stage: each loop is short enough for several of its turns to be under way at once.
        let mut ratios = [[[T::ZERO; N]; 2]; 4];
        self.quantiles(uniforms, &mut ratios);
        self.peaks(&ratios, f);
        self.over_pdf(&ratios, f, h);
    }

    /// n and d of E on each axis.
    #[inline(always)]
    fn quantiles<const N: usize>(&self, uniforms: &Rows<T, 5, N>, ratios: &mut [Rows<T, 2, N>; 4]) {
        let [choice, uniforms @ ..] = uniforms;
        let (two, three) = (T::from_f64(2.0), T::from_f64(3.0));
        for (axis, [n, d]) in ratios.iter_mut().enumerate() {
            // Differences, that a mask can leave out: cheaper than a choice between two numbers.
            let [first, second, third] = [self.kappa[0][axis], self.kappa[1][axis], self.kappa[2][axis]];
            let (second, third) = (second - first, third - second);
            for i in 0..N {
                let component = choice[i] * three;
                let to_second = if component >= T::ONE { second } else { T::ZERO };
                let to_third = if component >= two { third } else { T::ZERO };
                let (u, v) = (T::ONE - uniforms[axis][i], (first + to_second + to_third) * uniforms[axis][i]);
                n[i] = self.ends[0] * u + self.ends[1] * v;
                d[i] = u + v;
            }
        }
    }

    /// f.
    #[inline(always)]
    fn peaks<const N: usize>(&self, ratios: &[Rows<T, 2, N>; 4], f: &mut Rows<T, 3, N>) {
        let mut log = [[T::ZERO; N]; 4];
        for (log, [n, d]) in log.iter_mut().zip(ratios) {
            *log = *n;
            T::logarithms_of_ratios(log, d);
        }
        for (f, centre) in f.iter_mut().zip(&self.log_odds) {
            for i in 0..N {
                let distance = |axis: usize| log[axis][i] - centre[axis];
                let square = |axis: usize| distance(axis) * distance(axis);
                f[i] = self.exponent * ((square(0) + square(1)) + (square(2) + square(3)));
            }
            T::exponentials(f);
        }
    }

    /// f/g from f, and h/g.
    #[inline(always)]
    fn over_pdf<const N: usize>(&self, ratios: &[Rows<T, 2, N>; 4], f: &mut Rows<T, 3, N>, h: &mut Rows<T, 3, N>) {
        let three = T::from_f64(3.0);
        for i in 0..N {
            // p_k = weight_k·nd/below_k², over the common denominator (below_0·below_1·below_2)².
            let [[n0, d0], [n1, d1], [n2, d2], [n3, d3]] = ratios;
            let (n, d) = ([n0[i], n1[i], n2[i], n3[i]], [d0[i], d1[i], d2[i], d3[i]]);
            let nd = ((n[0] * d[0]) * (n[1] * d[1])) * ((n[2] * d[2]) * (n[3] * d[3]));
            let mut below = [T::ZERO; 3];
            for (below, a) in below.iter_mut().zip(&self.odds) {
                let sum = |axis: usize| n[axis] + a[axis] * d[axis];
                *below = (sum(0) * sum(1)) * (sum(2) * sum(3));
            }
            let others = [below[1] * below[2], below[0] * below[2], below[0] * below[1]];
            let all = others[0] * below[0];
            let mut shares = self.weight;
            for k in 0..3 {
                shares[k] = shares[k] * (others[k] * others[k]);
            }
            let over = three / (nd * ((shares[0] + shares[1]) + shares[2]));
            for k in 0..3 {
                f[k][i] = f[k][i] * (over * (all * all));
                h[k][i] = shares[k] * (over * nd);
            }
        }
    }
}
