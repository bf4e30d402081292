//! Every law on every input that was kept.

use ratiocv_hostile::replay;

macro_rules! laws {
    ($($law:ident)*) => {$(
        #[test]
        fn $law() {
            replay(stringify!($law), ratiocv_hostile::$law);
        }
    )*};
}

laws!(defensive denominators heuristics lanes merges moments paths solve);
