use crate::fitted;
use crate::ladder::{self, CORRELATED, INTEGRAL_OF_CORRELATED, run};
use ratiocv_core::{Dependent, Difference, Flags, Mickey, OptimalDefensive, RatioOfMeans, Regression};

const REGRESSION: Regression = Regression { dependent: Dependent::MinimumNorm, shrink: true };
const RATIO: OptimalDefensive = OptimalDefensive { estimator: RatioOfMeans, regression: REGRESSION, floor: 0.01 };
const MICKEY: OptimalDefensive<Mickey> = OptimalDefensive { estimator: Mickey, regression: REGRESSION, floor: 0.01 };

mod ratio {
    use super::*;

    ladder::ladder! {
        RATIO,
        one draw 5.0,
        by hand {
            // F̂ = 107/12 and a = 35/18·4/F̂ = 280/321: x̄′ = 41/321 + 280/321·5/8 = 216/321, so that
            // 6·321/216 is F̂ again: the difference, as a ratio. Its coefficient, β̂, has its error.
            let (value, std_error) = (107.0 / 12.0, (73.0_f64 / 144.0).sqrt());
            ladder::by_hand(RATIO, &CORRELATED, INTEGRAL_OF_CORRELATED, value, std_error);
            ladder::defended(RATIO, &CORRELATED, INTEGRAL_OF_CORRELATED);
        },
        at 1e9 fitted::difference_at_1e9
    }
}

mod mickey {
    use super::*;

    ladder::ladder! {
        MICKEY,
        one draw 5.0,
        by hand {
            // Leave-one-out on x′ = (41 + 70h)/321: 724151619/81087809, in rational arithmetic.
            let (value, std_error) = (724_151_619.0 / 81_087_809.0, (73.0_f64 / 144.0).sqrt());
            ladder::by_hand(MICKEY, &CORRELATED, INTEGRAL_OF_CORRELATED, value, std_error);
            ladder::defended(MICKEY, &CORRELATED, INTEGRAL_OF_CORRELATED);
        },
        at 1e9 fitted::difference_at_1e9
    }
}

/// f = 2h needs the whole weight on h; the floor keeps 1 % on the proposal.
#[test]
fn proportional() {
    let without_floor = OptimalDefensive { floor: 0.0, ..RATIO };
    ladder::proportional(without_floor);
    let draws: Vec<_> = (0..200).map(|i| f64::from(i * i % 37) / 16.0 + 0.25).map(|h| (2.0 * h, h)).collect();
    let floored = run(RATIO, &draws, 3.0);
    let mean_h = draws.iter().map(|d| d.1).sum::<f64>() / 200.0;
    let by_hand = 2.0 * mean_h / (0.01 + 0.99 * mean_h / 3.0);
    assert!((floored.value - by_hand).abs() <= 1e-14 && floored.flags.contains(Flags::ALPHA), "{floored:?}");
}

/// Outside 0 ≤ a ≤ 1 the clamp acts, and says so; where it does not, the ratio is the difference.
#[test]
fn weights_are_clamped() {
    let unshrunk = Regression { shrink: false, ..REGRESSION };
    let ratio = OptimalDefensive { regression: unshrunk, ..RATIO };
    let difference = Difference { regression: unshrunk };
    // Falling f: a < 0 becomes 0, the plain mean.
    let falling = CORRELATED.map(|(f, h)| (20.0 - f, h));
    let clamped = run(ratio, &falling, 4.0);
    assert!(clamped.value == 14.0 && clamped.flags.contains(Flags::ALPHA), "{clamped:?}");
    // β̂ = 2, F̂ = ȳ + 3: a = 8/F̂. ȳ = 4: 8/7 becomes 0.99; ȳ = 5.1: 8/8.1 is left alone.
    let steep = run(ratio, &CORRELATED.map(|(f, h)| (f - 2.0, h)), 4.0);
    let by_hand = 4.0 / (0.01 + 0.99 * 2.5 / 4.0);
    assert!((steep.value - by_hand).abs() <= 1e-14 && steep.flags.contains(Flags::ALPHA), "{steep:?}");
    let inside = CORRELATED.map(|(f, h)| (f - 0.9, h));
    let (ours, right) = (run(ratio, &inside, 4.0), run(difference, &inside, 4.0));
    assert!((ours.value - right.value).abs() <= 1e-14 && (ours.std_error - right.std_error).abs() <= 1e-14);
    assert!(!ours.flags.contains(Flags::ALPHA), "{ours:?}");
}
