//! Renders a picture with 16 samples per pixel and prints it as PPM:
//! `cargo run --release -p ratiocv-core --example renderer > balls.ppm`.
//! `render.rs` is the renderer; the crate's page on embedding explains it.

#[allow(missing_docs, unreachable_pub, reason = "to be read as it is, and included elsewhere")]
mod render;
#[allow(missing_docs, unreachable_pub, reason = "as above")]
mod scene;

use ratiocv_core::{Error, Film, Integrals, RatioOfMeans, Reads, moments::Sums};
use render::render;
use scene::{Random, Rgb};

const WIDTH: usize = 96;
const HEIGHT: usize = 64;

fn main() -> Result<(), Error> {
    let mut memory = vec![Sums::<Rgb>::default(); WIDTH * HEIGHT];
    let mut film = Film::new(&mut memory);
    render(&mut film, WIDTH, 16, &mut Random(1))?;
    let mut image = vec![0.0_f32; film.image_len()];
    film.resolve(&RatioOfMeans.defensive(0.01)?, &Integrals::ONE, &mut image)?;

    // Tone mapping comes last, once per pixel.
    println!("P3\n{WIDTH} {HEIGHT}\n255");
    for pixel in image.chunks(3) {
        let [r, g, b] = core::array::from_fn(|channel| (libm::powf(pixel[channel].min(1.0), 1.0 / 2.2) * 255.0) as u8);
        println!("{r} {g} {b}");
    }
    Ok(())
}
