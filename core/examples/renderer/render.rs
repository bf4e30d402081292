//! Three balls under two coloured lights, one light chosen per sample: no `std`, no memory of its own.

use super::scene::{Cone, EYE, LIGHTS, Random, Rgb, SKY, camera, dot, luminance, nearest, unit};
use ratiocv_core::{Draw, Error, Film, Lanes, moments::Accumulate};

/// Adds `spp` samples to every pixel of a film of rows of `width` pixels.
pub fn render<M: Accumulate<Draw<Rgb>>>(
    film: &mut Film<'_, M>,
    width: usize,
    spp: usize,
    random: &mut Random,
) -> Result<(), Error> {
    let pixels = film.accumulators().len();
    for pixel in 0..pixels {
        let direction = camera(pixel % width, pixel / width, width, pixels / width);
        for _ in 0..spp {
            film.add(pixel, sample(EYE, direction, random))?;
        }
    }
    Ok(())
}

/// One sample: f/p and, for each channel j, p_j/p of the light that was chosen.
pub fn sample(from: Rgb, direction: Rgb, random: &mut Random) -> Draw<Rgb> {
    let Some((distance, ball)) = nearest(from, direction) else {
        return Draw::new(SKY, Rgb::ONE); // nothing was chosen, so each p_j/p is 1
    };
    let point = from + direction * Rgb::splat(distance);
    let normal = unit(point - ball.centre);
    // Channel j would choose a light by what it sends here in that channel; the sample goes by luminance.
    let sent = LIGHTS.map(|light| light.colour * Rgb::splat(Cone::of(&light, point).height));
    let both = sent[0] + sent[1];
    let chosen = usize::from(random.number() * luminance(both) >= luminance(sent[0]));
    let p = luminance(sent[chosen]) / luminance(both);
    let h = sent[chosen] / both / Rgb::splat(p);
    let cone = Cone::of(&LIGHTS[chosen], point);
    let direction = cone.direction(random);
    let cosine = dot(normal, direction);
    if cosine <= 0.0 || nearest(point, direction).is_some_and(|(distance, _)| distance < cone.distance) {
        return Draw::new(Rgb::ZERO, h); // the light is not seen, but it was chosen: h stays
    }
    // Albedo/π · radiance · cosine over the density of the direction, 1/(2π · height).
    Draw::new(ball.colour * LIGHTS[chosen].colour * Rgb::splat(2.0 * cone.height * cosine / p), h)
}
