//! The public interface is closed: every type that its signatures and fields need is public, too,
//! and examples and the Python package need nothing else.

use std::collections::{HashMap, HashSet};

use syn::visit::{self, Visit};
use syn::{Attribute, Fields, ImplItem, Item, ItemUse, UseTree, Visibility};

use crate::architecture::reading::{code_of, imports, sources};

/// Item of the core: its module, a folder or file in `src`, and its name.
type Key = (String, String);

/// Source file with its imports by name.
struct File {
    room: String,
    items: Vec<Item>,
    imports: HashMap<String, Option<Key>>,
}

/// Items of the core, and the items that each needs in its public signatures and fields.
struct Core {
    files: Vec<File>,
    needs: HashMap<Key, HashSet<Key>>,
}

impl Core {
    fn read() -> Self {
        let mut files = Vec::new();
        for (path, text) in sources("src") {
            let inner = path.strip_prefix("src").expect("a file below src");
            let room = inner.components().next().expect("a name").as_os_str();
            let room = room.to_string_lossy().trim_end_matches(".rs").to_owned();
            if room == "lib" || path.ends_with("tests.rs") {
                continue;
            }
            let file = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            files.push(File::of(room, file.items));
        }
        let mut core = Self { files, needs: HashMap::new() };
        for file in &core.files {
            for item in file.items.iter().filter(|item| is_public(item)) {
                core.needs.entry((file.room.clone(), name_of(item))).or_default();
            }
        }
        let found: Vec<(Key, HashSet<Key>)> =
            core.files.iter().flat_map(|file| file.needs(&core)).collect();
        for (key, needs) in found {
            core.needs.entry(key).or_default().extend(needs);
        }
        core
    }

    /// Returns the definition of an item, which another module may export again.
    fn definition(&self, key: Key) -> Option<Key> {
        if self.needs.contains_key(&key) {
            return Some(key);
        }
        let mut alike = self.needs.keys().filter(|(_, name)| *name == key.1);
        alike.next().cloned().filter(|_| alike.next().is_none())
    }
}

impl File {
    fn of(room: String, items: Vec<Item>) -> Self {
        let mut all = Vec::new();
        flatten(items, &mut all);
        let mut named = HashMap::new();
        for item in &all {
            if let Item::Use(ItemUse { tree, .. }) = item {
                for (name, path) in leaves(tree) {
                    named.insert(name, key_of(&room, &path));
                }
            }
        }
        Self { room, items: all, imports: named }
    }

    /// Returns the items of this file with their needs.
    fn needs(&self, core: &Core) -> Vec<(Key, HashSet<Key>)> {
        let mut found = Vec::new();
        for item in &self.items {
            let mut named = Named::default();
            let key = match item {
                Item::Impl(block) if block.trait_.is_none() => {
                    let mut own = Named::default();
                    own.visit_type(&block.self_ty);
                    for item in &block.items {
                        named.method(item);
                    }
                    own.0.first().and_then(|path| self.resolve(path, core))
                }
                _ if is_public(item) => {
                    named.definition(item);
                    Some((self.room.clone(), name_of(item)))
                }
                _ => None,
            };
            let needs = named.0.iter().filter_map(|path| self.resolve(path, core));
            found.extend(key.map(|key| (key, needs.collect())));
        }
        found
    }

    /// Returns the item of the core that a path in this file names, if any.
    fn resolve(&self, path: &[String], core: &Core) -> Option<Key> {
        let (first, last) = (path.first()?, path.last()?);
        let direct = path.len() == 1;
        match self.imports.get(first) {
            Some(None) => None,
            Some(Some(key)) if direct => core.definition(key.clone()),
            Some(Some((room, _))) => core.definition((room.clone(), last.clone())),
            None if first == "crate" => core.definition((path.get(1)?.clone(), last.clone())),
            None => {
                let key = (self.room.clone(), if direct { first } else { last }.clone());
                core.needs.contains_key(&key).then_some(key)
            }
        }
    }
}

/// Paths of types in signatures and fields.
#[derive(Default)]
struct Named(Vec<Vec<String>>);

impl Named {
    /// Adds the types that users of an item need.
    fn definition(&mut self, item: &Item) {
        match item {
            Item::Struct(one) => {
                let fields = match &one.fields {
                    Fields::Named(fields) => fields.named.iter().collect(),
                    Fields::Unnamed(fields) => fields.unnamed.iter().collect(),
                    Fields::Unit => Vec::new(),
                };
                for field in fields.into_iter().filter(|field| open(&field.vis)) {
                    self.visit_type(&field.ty);
                }
            }
            Item::Enum(one) => one.variants.iter().for_each(|variant| self.visit_variant(variant)),
            Item::Type(one) => self.visit_type(&one.ty),
            Item::Fn(one) => self.visit_signature(&one.sig),
            Item::Const(one) => self.visit_type(&one.ty),
            Item::Trait(one) => {
                for item in &one.items {
                    if let syn::TraitItem::Fn(method) = item {
                        self.visit_signature(&method.sig);
                    }
                }
            }
            _ => {}
        }
    }

    /// Adds the types in the signature of a public method.
    fn method(&mut self, item: &ImplItem) {
        match item {
            ImplItem::Fn(one) if open(&one.vis) && !hidden(&one.attrs) => {
                self.visit_signature(&one.sig);
            }
            ImplItem::Const(one) if open(&one.vis) => self.visit_type(&one.ty),
            _ => {}
        }
    }
}

impl<'ast> Visit<'ast> for Named {
    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.0.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_attribute(&mut self, _: &'ast Attribute) {}

    fn visit_expr(&mut self, _: &'ast syn::Expr) {}
}

/// Public items, and names of the hidden modules.
fn interface(core: &Core) -> (HashSet<Key>, HashSet<String>) {
    let text = include_str!("../../../src/lib.rs");
    let (mut public, mut closed) = (HashSet::new(), HashSet::from(["internals".to_owned()]));
    let mut items = syn::parse_file(text).expect("the root of the library").items;
    while let Some(item) = items.pop() {
        match item {
            Item::Mod(one) if hidden(&one.attrs) => drop(closed.insert(one.ident.to_string())),
            Item::Mod(one) if one.content.is_some() => {
                items.extend(one.content.into_iter().flat_map(|(_, inner)| inner));
            }
            Item::Mod(one) if open(&one.vis) && one.ident != "internals" => {
                let room = one.ident.to_string();
                public.extend(core.needs.keys().filter(|(own, _)| *own == room).cloned());
            }
            Item::Use(one) if open(&one.vis) => {
                for (_, path) in leaves(&one.tree) {
                    let path: Vec<String> =
                        path.into_iter().filter(|part| part != "crate").collect();
                    let key = (path[0].clone(), path[path.len() - 1].clone());
                    public.extend(core.definition(key));
                }
            }
            _ => {}
        }
    }
    (public, closed)
}

#[test]
fn every_type_that_public_signatures_and_fields_need_is_public() {
    let core = Core::read();
    let (public, _) = interface(&core);
    assert!(public.len() > 150, "{} public items", public.len());
    let mut missing: Vec<String> = Vec::new();
    for key in &public {
        for (room, name) in core.needs.get(key).into_iter().flatten() {
            if !public.contains(&(room.clone(), name.clone())) {
                missing.push(format!("{}::{} needs {room}::{name}", key.0, key.1));
            }
        }
    }
    missing.sort();
    assert!(missing.is_empty(), "export these from src/lib.rs:\n{}", missing.join("\n"));
}

#[test]
fn examples_and_the_python_package_use_public_names_only() {
    let (_, closed) = interface(&Core::read());
    assert!(closed.contains("asset") && closed.contains("solve"), "{closed:?}");
    for (path, text) in ["examples", "crates/python/src"].into_iter().flat_map(sources) {
        let code = code_of(&text);
        let named = imports(&code, "pushplan::").into_iter().find(|name| closed.contains(name));
        assert_eq!(named, None, "{} needs a hidden module", path.display());
    }
}

/// Moves items to `all`, with the items of inner modules except tests.
fn flatten(items: Vec<Item>, all: &mut Vec<Item>) {
    for item in items {
        match item {
            Item::Mod(one) if one.ident == "tests" => {}
            Item::Mod(one) => {
                flatten(one.content.into_iter().flat_map(|(_, items)| items).collect(), all);
            }
            item => all.push(item),
        }
    }
}

/// Returns the names that an import binds, with their paths.
fn leaves(tree: &UseTree) -> Vec<(String, Vec<String>)> {
    match tree {
        UseTree::Path(path) => {
            let below = |(name, mut rest): (String, Vec<String>)| {
                rest.insert(0, path.ident.to_string());
                (name, rest)
            };
            leaves(&path.tree).into_iter().map(below).collect()
        }
        UseTree::Name(name) => vec![(name.ident.to_string(), vec![name.ident.to_string()])],
        UseTree::Rename(one) => vec![(one.rename.to_string(), vec![one.ident.to_string()])],
        UseTree::Group(group) => group.items.iter().flat_map(leaves).collect(),
        UseTree::Glob(_) => Vec::new(),
    }
}

/// Returns the item of the core that an import in `room` names, if it is in the core.
fn key_of(room: &str, path: &[String]) -> Option<Key> {
    let last = path.last()?.clone();
    match path.first()?.as_str() {
        "crate" => Some((path.get(1)?.clone(), last)),
        "super" | "self" => Some((room.to_owned(), last)),
        _ => None,
    }
}

fn is_public(item: &Item) -> bool {
    match item {
        Item::Struct(one) => open(&one.vis),
        Item::Enum(one) => open(&one.vis),
        Item::Trait(one) => open(&one.vis),
        Item::Type(one) => open(&one.vis),
        Item::Fn(one) => open(&one.vis),
        Item::Const(one) => open(&one.vis),
        _ => false,
    }
}

fn name_of(item: &Item) -> String {
    match item {
        Item::Struct(one) => one.ident.to_string(),
        Item::Enum(one) => one.ident.to_string(),
        Item::Trait(one) => one.ident.to_string(),
        Item::Type(one) => one.ident.to_string(),
        Item::Fn(one) => one.sig.ident.to_string(),
        Item::Const(one) => one.ident.to_string(),
        _ => String::new(),
    }
}

fn open(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

/// Returns `true` for `#[doc(hidden)]`.
fn hidden(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let Ok(list) = attribute.meta.require_list() else { return false };
        list.path.is_ident("doc") && list.tokens.to_string() == "hidden"
    })
}
