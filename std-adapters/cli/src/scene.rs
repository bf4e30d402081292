//! Scenes and threads from the command line.

use crate::fault::Fault;
use core::num::NonZeroUsize;
use ratiocv_scene::{BuiltIn, Description, Leniency};
use std::io::Write;
use std::path::Path;

/// The scene of a file or a built-in one, and its name; warnings to `notes`.
///
/// # Errors
/// What is wrong with it, and where.
pub fn read(scene: &str, lenient: bool, notes: &mut dyn Write) -> Result<(String, Description), Fault> {
    let leniency = if lenient { Leniency::Lenient } else { Leniency::Strict };
    let built_in = BuiltIn::named(scene).filter(|_| !Path::new(scene).exists());
    let name = built_in.map_or(scene, |scene| scene.name).to_owned();
    let (description, warnings) = match built_in {
        Some(built_in) => Description::parse(built_in.xml, built_in.name, leniency),
        None => Description::read(Path::new(scene), leniency),
    }
    .map_err(|error| {
        let remedy = if error.is_unsupported() {
            "--lenient leaves out what is not supported"
        } else if Path::new(scene).exists() {
            "correct the scene file; the built-in scenes are examples (ratiocv list)"
        } else {
            "give a scene file, or a built-in scene (ratiocv list)"
        };
        Fault::data(error.to_string(), remedy)
    })?;
    for warning in warnings {
        // A closed stderr is no reason to stop.
        let _ = writeln!(notes, "warning: {warning}");
    }
    Ok((name, description))
}

/// Renders on so many threads from now on, if a number is given.
pub fn use_threads(threads: Option<NonZeroUsize>) {
    if let Some(threads) = threads {
        // Of this process, which renders once; a pool that is there already stays.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build_global();
    }
}
