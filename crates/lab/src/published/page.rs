//! Pages with places for tables.

use super::fingerprint::Fingerprint;
use super::place::Place;
use super::table::Published;

/// Comment at the end of a place.
const END: &str = "<!-- end -->";

/// Comment at the beginning of a place.
fn begin(name: &str) -> String {
    format!("<!-- table {name} -->\n")
}

/// Parts of a page before, in and after the place of a table.
fn parts<'a>(page: &'a str, name: &str) -> Option<(&'a str, &'a str, &'a str)> {
    let begin = begin(name);
    let start = page.find(&begin)? + begin.len();
    let end = start + page[start..].find(END)?;
    Some((&page[..start], &page[start..end], &page[end..]))
}

/// Returns the place of a table on a page.
pub fn place(page: &str, name: &str) -> Option<Place> {
    Place::read(parts(page, name)?.1)
}

/// Returns a page with another content of a place; `None` if it has no such place.
pub fn recorded(page: &str, name: &str, place: &Place) -> Option<String> {
    let (before, _, after) = parts(page, name)?;
    Some(format!("{before}{}{after}", place.text()))
}

/// Returns a page on which the table has the mark that it deserves today; `None` if it has no place
/// for the table.
pub fn marked(page: &str, table: &Published, now: &Fingerprint) -> Option<String> {
    let place = place(page, table.name)?;
    let stale = place.judge(table, now);
    recorded(page, table.name, &Place { stale, ..place })
}
