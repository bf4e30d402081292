//! One element: its attributes, its parameters by name, the objects within it.

use super::error::Error;
use super::file::{File, shortened};
use super::transform;
use glam::{DAffine3, DVec3};
use roxmltree::Node;

/// An element of a file.
#[derive(Clone, Copy)]
pub(super) struct Element<'a> {
    pub(super) file: &'a File<'a>,
    node: Node<'a, 'a>,
    /// Where it stands: itself, or the `<ref>` to it.
    site: Node<'a, 'a>,
}

impl<'a> Element<'a> {
    pub(super) fn new(file: &'a File<'a>, node: Node<'a, 'a>) -> Self {
        Self { file, node, site: node }
    }

    pub(super) fn tag(self) -> &'a str {
        self.node.tag_name().name()
    }

    /// Its `type`.
    pub(super) fn kind(self) -> Result<String, Error> {
        self.required("type")
    }

    /// The `name` it has where it stands.
    pub(super) fn name(self) -> &'a str {
        self.site.attribute("name").unwrap_or_default()
    }

    /// Something is wrong with it.
    pub(super) fn invalid(self, what: impl Into<String>) -> Error {
        self.file.error(self.node, what, false)
    }

    /// It is outside the subset that is read.
    pub(super) fn unsupported(self, what: impl Into<String>) -> Error {
        self.file.error(self.node, what, true)
    }

    /// Its type is none of `supported`.
    pub(super) fn unsupported_type(self, supported: &str) -> Error {
        self.unsupported(format!("not supported; supported are {supported}"))
    }

    /// In a lenient reading, what is not supported is a warning, and `None`.
    pub(super) fn or_leave_out<T>(self, result: Result<T, Error>, instead: &'static str) -> Result<Option<T>, Error> {
        self.file.or_leave_out(self.node, result, instead)
    }

    /// A warning in any reading.
    pub(super) fn warn(self, what: impl Into<String>, instead: &'static str) {
        self.file.warn(self.node, self.unsupported(what), instead);
    }

    /// An attribute, with `$name` replaced.
    pub(super) fn attribute(self, name: &str) -> Result<Option<String>, Error> {
        self.node.attribute(name).map(|text| self.file.substituted(self.node, text)).transpose()
    }

    /// An attribute that must be there.
    pub(super) fn required(self, name: &str) -> Result<String, Error> {
        self.attribute(name)?.ok_or_else(|| self.invalid(format!("has no attribute {name}")))
    }

    /// That there are no other attributes.
    pub(super) fn only_attributes(self, names: &[&str]) -> Result<(), Error> {
        match self.node.attributes().find(|attribute| !names.contains(&attribute.name())) {
            None => Ok(()),
            Some(other) => Err(self.invalid(format!(
                "unknown attribute \"{}\"; known are {}",
                shortened(other.name()),
                names.join(", ")
            ))),
        }
    }

    /// The elements within it, as they stand.
    pub(super) fn children(self) -> impl Iterator<Item = Self> {
        let file = self.file;
        self.node.children().filter(Node::is_element).map(move |node| Self::new(file, node))
    }

    /// The objects within it that are a `<tag>` or refer to one.
    pub(super) fn objects(self, tag: &'static str) -> Result<Vec<Self>, Error> {
        self.file.ask(self.node, tag);
        let mut objects = Vec::new();
        for child in self.children() {
            let node = if child.tag() == "ref" { self.file.target(child.node)? } else { child.node };
            if !node.has_tag_name(tag) {
                continue;
            }
            self.file.mark(child.node);
            if child.tag() == "ref" {
                child.only_attributes(&["name", "id"])?;
            }
            let object = Self { file: self.file, node, site: child.node };
            object.only_attributes(&["type", "name", "id"])?;
            objects.push(object);
        }
        Ok(objects)
    }

    /// The only `<tag>` within it; further ones are not supported.
    pub(super) fn object(self, tag: &'static str) -> Result<Option<Self>, Error> {
        let objects = self.objects(tag)?;
        for further in objects.iter().skip(1) {
            let error = further.file.error(further.site, format!("a second <{tag}>; one is supported"), true);
            further.or_leave_out(Err::<(), _>(error), "left out")?;
        }
        Ok(objects.first().copied())
    }

    /// The parameter `name`, which must be one of `tags`.
    fn parameter(self, name: &'static str, tags: &[&str]) -> Result<Option<Self>, Error> {
        self.file.ask(self.node, name);
        let mut found: Option<Self> = None;
        for child in self.children().filter(|child| child.node.attribute("name") == Some(name)) {
            if found.is_some() {
                return Err(child.invalid(format!("a second \"{name}\"")));
            }
            self.file.mark(child.node);
            if !tags.contains(&child.tag()) {
                return Err(child.unsupported(format!("\"{name}\" must be given by <{}>", tags.join("> or <"))));
            }
            found = Some(child);
        }
        Ok(found)
    }

    /// The text of a parameter's `value`.
    fn value(self, name: &'static str, tags: &[&str]) -> Result<Option<(Self, String)>, Error> {
        let Some(parameter) = self.parameter(name, tags)? else { return Ok(None) };
        parameter.only_attributes(&["name", "value"])?;
        Ok(Some((parameter, parameter.required("value")?)))
    }

    pub(super) fn string(self, name: &'static str) -> Result<Option<String>, Error> {
        Ok(self.value(name, &["string"])?.map(|(_, text)| text))
    }

    pub(super) fn boolean(self, name: &'static str) -> Result<Option<bool>, Error> {
        let Some((parameter, text)) = self.value(name, &["boolean"])? else { return Ok(None) };
        match text.to_ascii_lowercase().as_str() {
            "true" => Ok(Some(true)),
            "false" => Ok(Some(false)),
            _ => Err(parameter.invalid(format!("\"{}\" must be true or false", shortened(&text)))),
        }
    }

    /// A whole number between `least` and `most`.
    pub(super) fn integer(self, name: &'static str, least: i64, most: i64) -> Result<Option<i64>, Error> {
        let Some((parameter, text)) = self.value(name, &["integer"])? else { return Ok(None) };
        let number = text.trim().parse::<i64>().ok().filter(|number| (least..=most).contains(number));
        let what = || format!("\"{}\" must be a whole number from {least} to {most}", shortened(&text));
        number.map(Some).ok_or_else(|| parameter.invalid(what()))
    }

    /// A number for which `is_right` holds; `needed` says in words what that is.
    pub(super) fn float(
        self,
        name: &'static str,
        is_right: impl Fn(f64) -> bool,
        needed: &str,
    ) -> Result<Option<f64>, Error> {
        let Some((parameter, text)) = self.value(name, &["float", "integer"])? else { return Ok(None) };
        let number = parameter.number(&text)?;
        if !is_right(number) {
            return Err(parameter.invalid(format!("{number} must be {needed}")));
        }
        Ok(Some(number))
    }

    /// A finite number.
    pub(super) fn number(self, text: &str) -> Result<f64, Error> {
        let number = text.trim().parse::<f64>().ok().filter(|number| (*number as f32).is_finite());
        number.ok_or_else(|| self.invalid(format!("\"{}\" must be a finite number", shortened(text))))
    }

    /// Finite numbers, with spaces or commas between them.
    pub(super) fn numbers(self, text: &str) -> Result<Vec<f64>, Error> {
        let words = text.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty());
        words.map(|word| self.number(word)).collect()
    }

    /// One number for all axes, or three.
    pub(super) fn vector(self, text: &str) -> Result<DVec3, Error> {
        match self.numbers(text)?[..] {
            [all] => Ok(DVec3::splat(all)),
            [x, y, z] => Ok(DVec3::new(x, y, z)),
            _ => Err(self.invalid(format!("\"{}\" must be one number or three", shortened(text)))),
        }
    }

    /// A colour: `<rgb>` of three linear numbers or one, or a grey `<float>`. No number is below 0 or above
    /// `most`.
    pub(super) fn color(self, name: &'static str, most: f64) -> Result<Option<DVec3>, Error> {
        let Some(given) = self.parameter(name, &["rgb", "float", "integer", "texture", "spectrum"])? else {
            return Ok(None);
        };
        // Mitsuba's way to say a reflectance above 1: <texture type="srgb"> with "color" and "unbounded".
        if given.tag() == "texture" || given.tag() == "spectrum" {
            if given.attribute("type")?.as_deref() != Some("srgb") {
                return Err(
                    given.unsupported(format!("\"{name}\" must be given by <rgb>, <float> or <texture type=\"srgb\">"))
                );
            }
            given.only_attributes(&["name", "type", "id"])?;
            given.boolean("unbounded")?;
            let color = given.color("color", most)?.ok_or_else(|| given.invalid("has no \"color\""))?;
            given.finish()?;
            return Ok(Some(color));
        }
        given.only_attributes(&["name", "value"])?;
        let text = given.required("value")?;
        if text.trim_start().starts_with('#') {
            return Err(given.invalid(format!(
                "\"{}\": give three linear numbers, such as \"0.2 0.5 0.8\"; sRGB codes are not read",
                shortened(&text)
            )));
        }
        let color = if given.tag() == "rgb" { given.vector(&text)? } else { DVec3::splat(given.number(&text)?) };
        if color.cmplt(DVec3::ZERO).any() {
            return Err(given.invalid(format!("\"{}\": no channel may be negative", shortened(&text))));
        }
        if color.cmpgt(DVec3::splat(most)).any() {
            return Err(given.invalid(format!("\"{}\": no channel may be above {most}", shortened(&text))));
        }
        Ok(Some(color))
    }

    /// A `<point>`, by `x`, `y` and `z` or by `value`.
    pub(super) fn point(self, name: &'static str) -> Result<Option<DVec3>, Error> {
        let Some(point) = self.parameter(name, &["point", "vector"])? else { return Ok(None) };
        point.only_attributes(&["name", "value", "x", "y", "z"])?;
        transform::triple(point, None).map(Some)
    }

    /// A `<transform>`.
    pub(super) fn transform(self, name: &'static str) -> Result<Option<DAffine3>, Error> {
        self.parameter(name, &["transform"])?.map(transform::read).transpose()
    }

    /// That everything within it was read.
    pub(super) fn finish(self) -> Result<(), Error> {
        for child in self.children().filter(|child| !self.file.was_read(child.node)) {
            let what = match self.file.known(self.node) {
                known if known.is_empty() => "unknown here, where nothing is read".to_owned(),
                known => format!("unknown here; known are {known}"),
            };
            child.or_leave_out(Err::<(), _>(child.unsupported(what)), "left out")?;
        }
        Ok(())
    }

    /// Passes over everything within it.
    pub(super) fn pass_over(self) {
        for child in self.children() {
            self.file.mark(child.node);
        }
    }
}
