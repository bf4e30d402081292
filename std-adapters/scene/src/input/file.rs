//! A scene file as a tree of elements: `<default>`, ids and references are resolved here, and what was read is
//! kept account of, so that what nobody asked for can be named.

use super::Leniency;
use super::element::Element;
use super::error::{Error, Warning};
use crate::planted::planted;
use core::cell::RefCell;
use roxmltree::{Document, Node, NodeId, ParsingOptions};
use std::collections::{HashMap, HashSet};

/// Elements nested deeper than this are no scene.
const DEEPEST: usize = 32;

/// Nodes of a tree: a scene of this size is a mistake, or an attack on memory.
const MOST_NODES: u32 = 1 << 24;

/// A file that is being read.
pub(super) struct File<'a> {
    tree: &'a Document<'a>,
    name: &'a str,
    leniency: Leniency,
    line_starts: Vec<usize>,
    defaults: HashMap<&'a str, (String, u32)>,
    ids: HashMap<&'a str, Node<'a, 'a>>,
    read: RefCell<HashSet<u32>>,
    known: RefCell<HashMap<u32, Vec<&'static str>>>,
    warnings: RefCell<Vec<Warning>>,
    warned: RefCell<HashSet<(u32, String)>>,
}

/// The tree of `text`; entities and other document types are refused by the parser.
pub(super) fn tree<'a>(text: &'a str, name: &str) -> Result<Document<'a>, Error> {
    let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| {
        let place = error.pos();
        Error {
            position: Some((place.row as usize, place.col as usize)),
            ..Error::of_file(name, format_args!("not well-formed XML: {error}"))
        }
    })
}

impl<'a> File<'a> {
    pub(super) fn new(tree: &'a Document<'a>, name: &'a str, leniency: Leniency) -> Result<Self, Error> {
        let ends = tree.input_text().bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at + 1);
        let mut file = Self {
            tree,
            name,
            leniency,
            line_starts: core::iter::once(0).chain(ends).collect(),
            defaults: HashMap::new(),
            ids: HashMap::new(),
            read: RefCell::default(),
            known: RefCell::default(),
            warnings: RefCell::default(),
            warned: RefCell::default(),
        };
        file.check_nesting()?;
        file.note_ids()?;
        file.note_defaults()?;
        file.check_references()?;
        Ok(file)
    }

    /// The outermost element.
    pub(super) fn root(&'a self) -> Element<'a> {
        Element::new(self, self.tree.root_element())
    }

    /// The file's name, as it was given.
    pub(super) fn name(&self) -> &'a str {
        self.name
    }

    /// The warnings so far.
    pub(super) fn take_warnings(&self) -> Vec<Warning> {
        self.warnings.take()
    }

    fn elements(&self) -> impl Iterator<Item = Node<'a, 'a>> + use<'a> {
        self.tree.descendants().filter(Node::is_element)
    }

    fn check_nesting(&self) -> Result<(), Error> {
        let mut depths: HashMap<u32, usize> = HashMap::new();
        for node in self.elements() {
            let depth = node.parent().and_then(|parent| depths.get(&parent.id().get())).map_or(0, |depth| depth + 1);
            if depth > DEEPEST {
                return Err(self.error(node, format!("elements are nested more than {DEEPEST} deep"), false));
            }
            depths.insert(node.id().get(), depth);
        }
        Ok(())
    }

    fn note_ids(&mut self) -> Result<(), Error> {
        for node in self.elements().filter(|node| !node.has_tag_name("ref")) {
            let Some(id) = node.attribute("id") else { continue };
            if let Some(first) = self.ids.insert(id, node) {
                let (line, _) = self.position(first.range().start);
                return Err(self.error(
                    node,
                    format!("the id \"{}\" is that of line {line} already", shortened(id)),
                    false,
                ));
            }
        }
        Ok(())
    }

    /// The first of several defaults of one name holds, so that what a program gives beforehand wins.
    fn note_defaults(&mut self) -> Result<(), Error> {
        for node in self.elements().filter(|node| node.has_tag_name("default")) {
            let element = Element::new(self, node);
            element.only_attributes(&["name", "value"])?;
            let value = element.required("value")?;
            let Some(name) = node.attribute("name").filter(|name| !name.is_empty()) else {
                return Err(element.invalid("needs a name"));
            };
            self.read.borrow_mut().insert(node.id().get());
            self.defaults.entry(name).or_insert((value, node.id().get()));
        }
        Ok(())
    }

    /// Every reference has an element, and no element refers to itself by way of others.
    fn check_references(&self) -> Result<(), Error> {
        // An element needs those that the references within it name.
        let mut needs: HashMap<u32, Vec<Node<'a, 'a>>> = HashMap::new();
        for reference in self.elements().filter(|node| node.has_tag_name("ref")) {
            let target = self.target(reference)?;
            for holder in reference.ancestors().filter(|node| node.has_attribute("id") && *node != reference) {
                needs.entry(holder.id().get()).or_default().push(target);
            }
        }
        // What needs nothing that is unresolved is resolved: repeat until nothing changes. Each element is
        // visited once for every reference to it.
        let mut users: HashMap<u32, Vec<u32>> = HashMap::new();
        let mut open: HashMap<u32, usize> = HashMap::new();
        for (&user, targets) in &needs {
            open.insert(user, targets.len());
            for target in targets {
                users.entry(target.id().get()).or_default().push(user);
            }
        }
        let mut resolved: Vec<u32> =
            self.ids.values().map(|node| node.id().get()).filter(|id| !open.contains_key(id)).collect();
        while let Some(id) = resolved.pop() {
            for user in users.remove(&id).unwrap_or_default() {
                if let Some(left) = open.get_mut(&user) {
                    *left -= 1;
                    if *left == 0 {
                        open.remove(&user);
                        resolved.push(user);
                    }
                }
            }
        }
        let Some(mut at) = open.keys().min().and_then(|id| self.tree.get_node(NodeId::new(*id))) else { return Ok(()) };
        // Follow what is left until it comes round.
        let mut trail: Vec<Node<'a, 'a>> = Vec::new();
        let mut steps: HashMap<u32, usize> = HashMap::new();
        let start = loop {
            if let Some(start) = steps.insert(at.id().get(), trail.len()) {
                break start;
            }
            trail.push(at);
            let Some(next) = needs[&at.id().get()].iter().find(|next| open.contains_key(&next.id().get())) else {
                break 0;
            };
            at = *next;
        };
        let mut names: Vec<String> =
            trail[start..].iter().chain([&at]).filter_map(|node| node.attribute("id")).map(shortened).collect();
        if names.len() > 8 {
            names.splice(4..names.len() - 4, ["…".to_owned()]);
        }
        Err(self.error(at, format!("references go in a circle: {}", names.join(" -> ")), false))
    }

    /// What a `<ref>` refers to.
    pub(super) fn target(&self, reference: Node<'a, 'a>) -> Result<Node<'a, 'a>, Error> {
        let id = reference.attribute("id").unwrap_or_default();
        let found = self.ids.get(id).copied();
        found.ok_or_else(|| {
            self.error(reference, format!("there is no element with the id \"{}\"", shortened(id)), false)
        })
    }

    /// `text` with every `$name` replaced by the `<default>` of that name, which must stand before `node`.
    pub(super) fn substituted(&self, node: Node<'a, 'a>, text: &str) -> Result<String, Error> {
        let mut result = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('$') {
            result.push_str(before);
            let word = after.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(after.len());
            // The longest name that fits, as "1$a" may be followed by letters.
            let fits = (1..=word)
                .rev()
                .filter(|end| planted!("scene_text": after.is_char_boundary(*end), true))
                .find_map(|end| {
                    let (value, defined) = self.defaults.get(&after[..end])?;
                    (*defined < node.id().get()).then_some((value, end))
                });
            let Some((value, end)) = fits else {
                let what = format!(
                    "nothing before this line defines ${}; <default name=\"…\" value=\"…\"/> does",
                    &after[..word]
                );
                return Err(self.error(node, what, false));
            };
            result.push_str(value);
            rest = &after[end..];
        }
        result.push_str(rest);
        Ok(result)
    }

    fn position(&self, offset: usize) -> (usize, usize) {
        let line = self.line_starts.partition_point(|start| *start <= offset);
        (line, offset - self.line_starts[line - 1] + 1)
    }

    /// Something wrong with `node`.
    pub(super) fn error(&self, node: Node<'a, 'a>, what: impl Into<String>, unsupported: bool) -> Error {
        let mut path: Vec<String> = node.ancestors().filter(Node::is_element).take(4).map(label).collect();
        if path.len() > 1 && node.ancestors().filter(Node::is_element).count() <= 4 {
            path.pop(); // <scene>, which says nothing
        }
        path.reverse();
        Error {
            file: self.name.to_owned(),
            position: Some(self.position(node.range().start)),
            element: path.join("/"),
            what: what.into(),
            unsupported,
        }
    }

    /// Notes that `node` was read.
    pub(super) fn mark(&self, node: Node<'a, 'a>) {
        self.read.borrow_mut().insert(node.id().get());
    }

    /// Notes that `node` may hold something called `name`.
    pub(super) fn ask(&self, node: Node<'a, 'a>, name: &'static str) {
        let mut known = self.known.borrow_mut();
        let names = known.entry(node.id().get()).or_default();
        if !names.contains(&name) {
            names.push(name);
        }
    }

    /// What was asked of `node`, for messages.
    pub(super) fn known(&self, node: Node<'a, 'a>) -> String {
        self.known.borrow().get(&node.id().get()).map_or_else(String::new, |names| names.join(", "))
    }

    /// Whether somebody read `node`.
    pub(super) fn was_read(&self, node: Node<'a, 'a>) -> bool {
        self.read.borrow().contains(&node.id().get())
    }

    /// Warns, once for each element and message.
    pub(super) fn warn(&self, node: Node<'a, 'a>, error: Error, instead: &'static str) {
        if self.warned.borrow_mut().insert((node.id().get(), error.what.clone())) {
            self.warnings.borrow_mut().push(Warning { error, instead });
        }
    }

    /// A lenient reading turns what is not supported into a warning and `None`; anything else that is wrong
    /// stays an error.
    pub(super) fn or_leave_out<T>(
        &self,
        node: Node<'a, 'a>,
        result: Result<T, Error>,
        instead: &'static str,
    ) -> Result<Option<T>, Error> {
        match result {
            Err(error) if error.unsupported && self.leniency == Leniency::Lenient => {
                self.warn(node, error, instead);
                Ok(None)
            }
            result => result.map(Some),
        }
    }
}

/// An element as messages name it.
fn label(node: Node<'_, '_>) -> String {
    let mut label = format!("<{}", shortened(node.tag_name().name()));
    for name in ["type", "name", "id"] {
        if let Some(value) = node.attribute(name) {
            label += &format!(" {name}=\"{}\"", shortened(value));
        }
    }
    label + ">"
}

/// At most 40 characters of `text`.
pub(super) fn shortened(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
