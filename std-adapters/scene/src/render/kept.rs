//! Renders in files.

use crate::colour::Colour;
use crate::description::Description;
use crate::render::RenderError;
use crate::render::frame::Frame;
use crate::render::method::{OnPixel, Term};
use crate::render::work::Work;
use ratiocv_threads::{CheckpointFile, Fault};
use std::path::Path;

impl<C: Colour, E: OnPixel<C>> Work<'_, C, E> {
    /// A new frame, or the one that is to be resumed.
    pub(super) fn frame(&self) -> Result<Frame<C, E::Term>, RenderError> {
        let mut frame = match &self.render.resume {
            Some(path) => self.loaded(path, self.render.seed)?,
            None => self.nothing(),
        };
        for (path, seed) in &self.render.merge {
            if *seed == self.render.seed {
                let needed = "another than this render's: the same samples twice are no more than once";
                return Err(RenderError::Setting { setting: "the seed of what is merged", needed });
            }
            frame.merge(&self.loaded(path, *seed)?)?;
        }
        Ok(frame)
    }

    fn nothing(&self) -> Frame<C, E::Term> {
        Frame::new(self.scene.size(), self.scene.terms().len(), self.estimator.empty(), self.errors())
    }

    /// The frame in the file `path`, of this render with `seed`.
    fn loaded(&self, path: &Path, seed: u64) -> Result<Frame<C, E::Term>, RenderError> {
        let (mut frame, file) = (self.nothing(), self.file(path, seed));
        let Some(words) = file.load()? else {
            let source = std::io::Error::from(std::io::ErrorKind::NotFound);
            return Err(file.error(Fault::Io { doing: "read it", source }).into());
        };
        let mut rest = words.iter();
        let mut complete = true;
        frame.words(&mut |word| match rest.next() {
            Some(saved) => *word = *saved,
            None => complete = false,
        });
        if !complete || rest.len() > 0 {
            return Err(file.error(Fault::Damaged("it does not hold the numbers of this image")).into());
        }
        Ok(frame)
    }

    /// A file of this render with `seed`: what decides the bits of its samples.
    pub(super) fn file(&self, path: &Path, seed: u64) -> CheckpointFile {
        let render = self.render;
        let unlimited = Description { samples: 0, ..render.description.clone() };
        let settings = [
            ("the version of ratiocv", env!("CARGO_PKG_VERSION").to_owned()),
            ("the scene", format!("{:08x}", crc32fast::hash(format!("{unlimited:?}").as_bytes()))),
            ("the sampling of lights", format!("{:?}", render.effective_options())),
            ("the estimator", render.method.name().to_owned()),
            ("the defensive weight", format!("{:?}", render.method.weight())),
            ("the seed", seed.to_string()),
            ("samples in a block", self.block().to_string()),
            ("error bars", self.errors().to_string()),
        ];
        CheckpointFile::new(path, settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}

/// Every number of the frame.
pub(super) fn words<C: Colour, M: Term<C>>(frame: &mut Frame<C, M>) -> Vec<u64> {
    let mut words = Vec::new();
    frame.words(&mut |word| words.push(*word));
    words
}
