//! The scenes that come with the crate.

use super::{Error, Leniency};
use crate::Description;

/// A scene that comes with the crate.
///
/// ```
/// use ratiocv_scene::{BuiltIn, Description};
/// for scene in BuiltIn::ALL {
///     println!("{:4} {}", scene.name, scene.about);
///     assert_eq!(Description::built_in(scene.name)?.size, [128, 128]);
/// }
/// # Ok::<(), ratiocv_scene::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuiltIn {
    /// Its name.
    pub name: &'static str,
    /// What it shows, in a line.
    pub about: &'static str,
    /// Its file.
    pub xml: &'static str,
}

/// The scenes, from the files named after them.
macro_rules! scenes {
    ($($name:literal, $file:literal, $about:literal;)*) => {
        &[$(BuiltIn { name: $name, about: $about, xml: include_str!(concat!("../../scenes/", $file)) }),*]
    };
}

impl BuiltIn {
    /// All of them.
    pub const ALL: &'static [Self] = scenes! {
        "S1", "s1.xml", "Three small coloured lights on a ball and a floor, direct light";
        "S1b", "s1b.xml", "S1 with larger lights";
        "S1k", "s1k.xml", "S1 with 24 coloured lights, invisible to the camera";
        "S2", "s2.xml", "A room with two conductor balls, rough by channel, and a small light; three bounces";
        "S2w", "s2w.xml", "S2 with a wide light";
        "S3", "s3.xml", "A cube of coloured fog above a floor, scattered once";
        "S3m", "s3m.xml", "S3, scattered up to five times";
        "S4a", "s4a.xml", "A white ball in a white furnace: every pixel is 1";
        "S4b", "s4b.xml", "A coloured ball in a coloured furnace: reflectance times light";
        "S4c", "s4c.xml", "Inside a glowing sphere, four bounces: a geometric sum";
        "S4d", "s4d.xml", "A ball that absorbs, in a white furnace: Beer's law";
        "S4e", "s4e.xml", "A ball that scatters and absorbs nothing, in a white furnace: every pixel is 1";
        "S4f", "s4f.xml", "S1 without the ball: known in closed form";
        "S4g", "s4g.xml", "A conductor ball, rough by channel, in a white furnace: its albedo";
    };

    /// The one of that name, in upper or lower case.
    pub fn named(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().find(|scene| scene.name.eq_ignore_ascii_case(name))
    }
}

impl Description {
    /// The [built-in](BuiltIn) scene of that name, in upper or lower case.
    ///
    /// # Errors
    /// There is none; the error lists those that there are.
    ///
    /// ```
    /// use ratiocv_scene::Description;
    /// assert_eq!(Description::built_in("s1")?.shapes.len(), 5);
    /// let error = Description::built_in("S5").unwrap_err();
    /// assert!(error.to_string().contains("S4f, S4g"));
    /// # Ok::<(), ratiocv_scene::Error>(())
    /// ```
    pub fn built_in(name: &str) -> Result<Self, Error> {
        let scene = BuiltIn::named(name).ok_or_else(|| {
            let names: Vec<&str> = BuiltIn::ALL.iter().map(|scene| scene.name).collect();
            Error::of_file(name, format_args!("no such built-in scene; there are {}", names.join(", ")))
        })?;
        Ok(Self::parse(scene.xml, scene.name, Leniency::Strict)?.0)
    }
}
