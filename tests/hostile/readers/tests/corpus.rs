//! Every reader on every input that was kept.

use ratiocv_hostile::replay;

macro_rules! laws {
    ($($law:ident)*) => {$(
        #[test]
        fn $law() {
            replay(stringify!($law), ratiocv_hostile_readers::$law);
        }
    )*};
}

laws!(checkpoint csv scene);
