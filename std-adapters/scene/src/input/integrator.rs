//! `<integrator>`: how long paths may be.

use super::element::Element;
use super::error::Error;

/// What is read of an integrator.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Depths {
    pub(super) longest: Option<u32>,
    pub(super) roulette: Option<u32>,
}

/// Of `scene`.
pub(super) fn read(scene: Element<'_>) -> Result<Depths, Error> {
    let Some(element) = scene.object("integrator")? else { return Ok(Depths::default()) };
    Ok(element.or_leave_out(integrator(element), "left out; paths have any length")?.unwrap_or_default())
}

fn integrator(element: Element<'_>) -> Result<Depths, Error> {
    if !["path", "volpath", "volpathmis"].contains(&element.kind()?.as_str()) {
        return Err(element.unsupported_type("path, volpath, volpathmis"));
    }
    let most = i64::from(u32::MAX);
    let longest = match element.integer("max_depth", -1, most)? {
        Some(0) => return Err(element.invalid("max_depth 0 leaves a black image; it must be -1 (no limit) or above 0")),
        given => given.filter(|depth| *depth > 0).map(|depth| depth as u32),
    };
    let roulette = element.integer("rr_depth", 1, most)?.map(|depth| depth as u32);
    element.finish()?;
    // Where no path reaches it, there is no roulette.
    let roulette = roulette.filter(|depth| longest.is_none_or(|longest| *depth < longest));
    Ok(Depths { longest, roulette })
}
