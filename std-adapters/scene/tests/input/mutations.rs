//! Files cut short and files with a byte changed: an error or a scene, never a panic.

use ratiocv_scene::{BuiltIn, Description, Leniency};

fn survive(bytes: &[u8]) {
    if let Ok(text) = core::str::from_utf8(bytes) {
        for leniency in [Leniency::Strict, Leniency::Lenient] {
            if let Err(error) = Description::parse(text, "scene.xml", leniency) {
                assert!(error.to_string().starts_with("scene.xml"), "{error}");
                assert!(error.to_string().len() < 2000, "{error}");
            }
        }
    }
}

#[test]
fn files_cut_short() {
    for scene in BuiltIn::ALL {
        for end in (0..scene.xml.trim_end().len()).step_by(17) {
            let bytes = &scene.xml.as_bytes()[..end];
            survive(bytes);
            let text = core::str::from_utf8(bytes).unwrap_or_default();
            assert!(Description::parse(text, "scene.xml", Leniency::Lenient).is_err(), "{} at {end}", scene.name);
        }
    }
}

#[test]
fn files_with_a_byte_changed() {
    // Marsaglia's xorshift, seed 88172645463325252.
    let mut state = 88_172_645_463_325_252_u64;
    let mut random = move |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    for scene in BuiltIn::ALL {
        for _ in 0..400 {
            let mut bytes = scene.xml.as_bytes().to_vec();
            let at = random(bytes.len());
            // Digits, signs and quotes do the most harm.
            bytes[at] = b"0123456789-e.$\"<>/= nax\0"[random(24)];
            survive(&bytes);
        }
    }
}
