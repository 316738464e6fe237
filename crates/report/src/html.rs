//! Reports as self-contained HTML pages, with inline styles and charts and all text escaped.

use std::fmt::Write;

use super::document::{Document, Drawing};
use super::svg::escape;
use super::table::{Align, Table};

/// Style sheet for screen and print, light and dark.
const STYLE: &str = "\
:root{color-scheme:light dark}\
body{font:15px/1.5 Inter,'Segoe UI','Helvetica Neue',Arial,'DejaVu Sans',sans-serif;\
max-width:62rem;margin:2rem auto;padding:0 1rem}\
h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}\
.wide{overflow-x:auto}\
table{border-collapse:collapse;font-variant-numeric:tabular-nums}\
th,td{padding:.25rem .7rem;border-bottom:1px solid #8884;text-align:left;white-space:nowrap}\
.n{text-align:right}\
figure{margin:1rem 0}svg{max-width:100%;height:auto}\
details{margin-top:2rem}";

/// Returns the page. Its content security policy forbids all external resources, which also guards
/// against bugs here.
pub(super) fn page(document: &Document) -> String {
    let title = escape(&document.title);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src 'unsafe-inline'\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
    );
    for note in &document.notes {
        let _ = writeln!(out, "<p>{}</p>", escape(note));
    }
    let mut charts = 0;
    for section in &document.sections {
        if !section.title.is_empty() {
            let _ = writeln!(out, "<h2>{}</h2>", escape(&section.title));
        }
        table(&mut out, &section.table);
        for line in &section.lines {
            let _ = writeln!(out, "<p>{}</p>", escape(line));
        }
        for figure in &section.figures {
            charts += 1;
            let svg = match &figure.drawing {
                Drawing::Chart(chart) => chart.to_svg_with_id(&format!("plot-{charts}")),
                Drawing::Bars(_) | Drawing::Svg(_) => figure.to_svg(),
            };
            let _ = writeln!(out, "<figure>\n{svg}</figure>");
        }
    }
    if !document.rows.is_empty() {
        out.push_str("<details><summary>All rows</summary>\n");
        table(&mut out, &document.rows);
        out.push_str("</details>\n");
    }
    out.push_str("</body>\n</html>\n");
    out
}

fn table(out: &mut String, table: &Table) {
    if table.is_empty() {
        return;
    }
    out.push_str("<div class=\"wide\"><table>\n");
    let class = |align: Align| if align == Align::Right { " class=\"n\"" } else { "" };
    let mut row = |tag: &str, cells: &[String]| {
        out.push_str("<tr>");
        for (cell, (_, align)) in cells.iter().zip(table.columns()) {
            let _ = write!(out, "<{tag}{}>{}</{tag}>", class(*align), escape(cell));
        }
        out.push_str("</tr>\n");
    };
    let names: Vec<String> = table.columns().iter().map(|(name, _)| name.clone()).collect();
    row("th", &names);
    table.rows().iter().for_each(|cells| row("td", cells));
    out.push_str("</table></div>\n");
}

#[cfg(test)]
mod tests;
