//! Mutations of the structure of a file: keys, lists and numbers.
//!
//! A file is converted to a tree, mutated, and written in flow style, which is YAML and, if its
//! tokens are, JSON. Most mutations therefore pass the parser and reach the rules.

use std::fmt::Write;

use serde_json::Value as Json;

use crate::random::Random;

/// A value whose scalars are kept as written.
#[derive(Clone, Debug)]
pub enum Tree {
    Map(Vec<(String, Tree)>),
    List(Vec<Tree>),
    Scalar(String),
}

/// Scalars that rules and arithmetic may not expect.
const EXTREMES: [&str; 44] = [
    ".nan",
    ".inf",
    "-.inf",
    "1e999",
    "-1e999",
    "1.7976931348623157e308",
    "5e-324",
    "-0.0",
    "0",
    "1",
    "-1",
    "1e-9",
    "1e-4",
    "0.001",
    "0.0009999",
    "10",
    "10.0001",
    "1e6",
    "1000001",
    "1e12",
    "64",
    "65",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "18446744073709551616",
    "-9223372036854775808",
    "0x7fffffffffffffff",
    "true",
    "null",
    "~",
    "\"\"",
    "[]",
    "{}",
    "\"\\u0000\"",
    "\"\u{e9}\u{65e5}\u{672c}\"",
    "\"NaN\"",
    "NaN",
    "360",
    "-360",
    "170",
    "0.05",
    "2",
    "all",
];

impl Tree {
    /// Returns the tree of a parsed file.
    pub fn of(value: &Json) -> Self {
        match value {
            Json::Object(map) => {
                Tree::Map(map.iter().map(|(key, value)| (key.clone(), Tree::of(value))).collect())
            }
            Json::Array(list) => Tree::List(list.iter().map(Tree::of).collect()),
            scalar => Tree::Scalar(scalar.to_string()),
        }
    }

    /// Returns the text in flow style.
    pub fn write(&self) -> String {
        let mut text = String::new();
        self.write_to(&mut text);
        text
    }

    fn write_to(&self, text: &mut String) {
        match self {
            Tree::Scalar(scalar) => text.push_str(scalar),
            Tree::List(list) => {
                text.push('[');
                for (k, item) in list.iter().enumerate() {
                    text.push_str(if k > 0 { ", " } else { "" });
                    item.write_to(text);
                }
                text.push(']');
            }
            Tree::Map(pairs) => {
                text.push('{');
                for (k, (key, value)) in pairs.iter().enumerate() {
                    text.push_str(if k > 0 { ",\n" } else { "" });
                    let _ = write!(text, "{}: ", Json::String(key.clone()));
                    value.write_to(text);
                }
                text.push('}');
            }
        }
    }

    /// Makes one to four changes, at random places.
    pub fn spoil(&mut self, random: &mut Random) {
        for _ in 0..=random.below(4) {
            let donor = self.at(random.below(self.count())).clone();
            // Scalars are most of the nodes, so keys and lists get their own turn.
            let place = if random.once_in(3) { self.branch(random) } else { None };
            let place = place.unwrap_or_else(|| random.below(self.count()));
            self.at_mut(place).change(donor, random);
        }
    }

    fn change(&mut self, donor: Tree, random: &mut Random) {
        if random.once_in(12) {
            *self = donor;
            return;
        }
        if random.once_in(40) {
            let deep = *random.pick(&[1, 2, 30, 150, 1000]);
            for _ in 0..deep {
                let inner = std::mem::replace(self, Tree::List(Vec::new()));
                *self = Tree::List(vec![inner]);
            }
            return;
        }
        match self {
            Tree::Scalar(scalar) => *scalar = spoiled(scalar, random),
            Tree::List(list) => change_list(list, random),
            Tree::Map(pairs) => change_map(pairs, random),
        }
    }

    /// Returns the number of nodes.
    fn count(&self) -> usize {
        1 + match self {
            Tree::Scalar(_) => 0,
            Tree::List(list) => list.iter().map(Tree::count).sum(),
            Tree::Map(pairs) => pairs.iter().map(|(_, value)| value.count()).sum(),
        }
    }

    /// Returns the index of a random list or map.
    fn branch(&self, random: &mut Random) -> Option<usize> {
        let mut branches = Vec::new();
        self.find_branches(&mut 0, &mut branches);
        (!branches.is_empty()).then(|| *random.pick(&branches))
    }

    fn find_branches(&self, next: &mut usize, found: &mut Vec<usize>) {
        if !matches!(self, Tree::Scalar(_)) {
            found.push(*next);
        }
        *next += 1;
        self.children().for_each(|child| child.find_branches(next, found));
    }

    /// Returns node `index` in the order of writing.
    fn at(&self, index: usize) -> &Tree {
        let mut left = index;
        let mut node = self;
        'down: while left > 0 {
            left -= 1;
            for child in node.children() {
                let count = child.count();
                if left < count {
                    node = child;
                    continue 'down;
                }
                left -= count;
            }
            break;
        }
        node
    }

    fn children(&self) -> Box<dyn Iterator<Item = &Tree> + '_> {
        match self {
            Tree::Scalar(_) => Box::new(std::iter::empty()),
            Tree::List(list) => Box::new(list.iter()),
            Tree::Map(pairs) => Box::new(pairs.iter().map(|(_, value)| value)),
        }
    }

    fn at_mut(&mut self, index: usize) -> &mut Tree {
        if index == 0 {
            return self;
        }
        let mut left = index - 1;
        let mut child = 0;
        for (k, node) in self.children().enumerate() {
            let count = node.count();
            if left < count {
                child = k;
                break;
            }
            left -= count;
        }
        match self {
            Tree::List(list) => list[child].at_mut(left),
            Tree::Map(pairs) => pairs[child].1.at_mut(left),
            scalar => scalar,
        }
    }
}

fn spoiled(scalar: &str, random: &mut Random) -> String {
    let number: Option<f64> = scalar.parse().ok();
    match (number, random.below(3)) {
        // Small changes usually satisfy the rules and reach deepest.
        (Some(number), 0 | 1) => {
            let factor =
                *random.pick(&[-1.0, 0.0, 0.5, 0.99, 1.0 + 1e-9, 1.01, 1.5, 2.0, 10.0, 0.1]);
            let step = *random.pick(&[0.0, 0.0, 1e-9, 1e-3, -1e-3, 0.1, 1.0]);
            let value = number * factor + step;
            if number.fract() == 0.0 && value.fract() == 0.0 {
                format!("{value:.0}")
            } else {
                format!("{value:?}")
            }
        }
        _ => (*random.pick(&EXTREMES)).to_owned(),
    }
}

fn change_list(list: &mut Vec<Tree>, random: &mut Random) {
    let k = if list.is_empty() { 0 } else { random.below(list.len()) };
    match random.below(5) {
        _ if list.is_empty() => list.push(Tree::Scalar((*random.pick(&EXTREMES)).to_owned())),
        0 => {
            list.remove(k);
        }
        1 => {
            let item = list[k].clone();
            let times = *random.pick(&[1, 1, 1, 2, 8, 64, 70]);
            list.splice(k..k, std::iter::repeat_n(item, times));
        }
        2 => {
            let other = random.below(list.len());
            list.swap(k, other);
        }
        3 => list.truncate(k),
        _ => list.reverse(),
    }
}

fn change_map(pairs: &mut Vec<(String, Tree)>, random: &mut Random) {
    if pairs.is_empty() {
        pairs.push(("x".into(), Tree::Scalar("1".into())));
        return;
    }
    let (k, other) = (random.below(pairs.len()), random.below(pairs.len()));
    match random.below(6) {
        0 => {
            pairs.remove(k);
        }
        1 => {
            let pair = pairs[k].clone();
            pairs.push(pair);
        }
        2 => {
            let value = pairs[other].1.clone();
            pairs[k].1 = value;
        }
        3 => pairs[k].0 = pairs[other].0.clone(),
        4 => pairs.swap(k, other),
        _ => {
            let mut letters: Vec<char> = pairs[k].0.chars().collect();
            if letters.is_empty() || random.once_in(4) {
                letters.push(*random.pick(&['s', '\u{0}', '\u{65e5}', ' ', ':', '"', '\n']));
            } else {
                letters.remove(random.below(letters.len()));
            }
            pairs[k].0 = letters.into_iter().collect();
        }
    }
}
