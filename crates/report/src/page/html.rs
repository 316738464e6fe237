//! The HTML file: data, style and script in one document without external resources.

use pushplan_page::{BODY, SCRIPT, SOLID, STYLE};
use pushplan_three::THREE;

use crate::svg::escape;

use super::data::Data;

/// Placeholder of the top view.
const STAGE: &str = "<figure class=\"stage\" id=\"stage\">";

/// SHA-256 of [`SCRIPT`] and [`STYLE`], base 64, for the content security policy. A test compares
/// the hashes, so that a release needs no hash function.
const SCRIPT_HASH: &str = "ekbDToMbZXuN7wfnZt9j2hWdty4YmkKJNKT9zgg7xFw=";
const STYLE_HASH: &str = "zXSw6BzXcyuVOPIi7jmn9KiwKyXUrtidXTt+/KEBizA=";

/// SHA-256 of [`SOLID`], and of three.js after decompression.
const SOLID_HASH: &str = "VDcg20Zd+pQG9mvqnqIGZoPEsgIuJtaXWiLcWmhqYqg=";
const THREE_HASH: &str = "1DAXuURetgEpYc3wVeanFNbtMNUCQJJKMDFxE8xxJxc=";

/// Views of the table on a page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PageView {
    /// Drawing from above.
    #[default]
    Above,
    /// Drawing from above and an interactive 3-D scene, which adds 200 KB to the page.
    Solid,
}

/// Returns the page as HTML.
pub fn page(data: &Data, view: PageView) -> String {
    // Serialization cannot fail because the data has no maps with unusual keys.
    let json = serde_json::to_string(data).unwrap_or_default();
    let title = escape(&format!("{}: {}", data.task, data.headline));
    // The drawing is a separate image, which the style of the page does not affect.
    let drawing = data
        .drawing
        .as_ref()
        .map(|svg| format!("<img alt=\"{title}\" src=\"data:image/svg+xml,{}\">", in_address(svg)));
    let pictures = if drawing.is_some() { "img-src data:; " } else { "" };
    let body = match drawing {
        Some(drawing) => BODY.replace(STAGE, &format!("{STAGE}{drawing}")),
        None => BODY.to_owned(),
    };
    let (allowed, solid) = match view {
        PageView::Above => (String::new(), String::new()),
        PageView::Solid => (
            format!(" 'sha256-{SOLID_HASH}' 'sha256-{THREE_HASH}'"),
            format!(
                "<script type=\"text/plain\" id=\"three\">{THREE}</script>\n\
                 <script>{SOLID}</script>\n"
            ),
        ),
    };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         script-src 'sha256-{SCRIPT_HASH}'{allowed}; style-src 'sha256-{STYLE_HASH}'; \
         {pictures}base-uri 'none'; form-action 'none'\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n{body}\
         <script type=\"application/json\" id=\"data\">{}</script>\n\
         <script>{SCRIPT}</script>\n{solid}</body>\n</html>\n",
        inert(&json)
    )
}

/// Percent-encodes SVG for a data URL within an attribute.
fn in_address(svg: &str) -> String {
    let mut written = String::with_capacity(svg.len() + svg.len() / 4);
    for letter in svg.chars() {
        match letter {
            '%' => written.push_str("%25"),
            '#' => written.push_str("%23"),
            '"' => written.push_str("%22"),
            '<' => written.push_str("%3C"),
            '>' => written.push_str("%3E"),
            '&' => written.push_str("%26"),
            '\n' => written.push_str("%0A"),
            other => written.push(other),
        }
    }
    written
}

/// Escapes JSON so that it can neither end a script nor start a comment.
fn inert(json: &str) -> String {
    json.replace('<', "\\u003c").replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_ends_the_data() {
        let evil = serde_json::to_string("</script><!--<script>alert('&')\u{2028}").unwrap();
        let inert = inert(&evil);
        assert!(!inert.contains('<') && !inert.contains('\u{2028}'), "{inert}");
        let back: String = serde_json::from_str(&inert).unwrap();
        assert_eq!(back, "</script><!--<script>alert('&')\u{2028}");
    }

    #[test]
    fn the_hashes_are_those_of_script_and_style() {
        use base64::{Engine as _, engine::general_purpose::STANDARD};
        for (name, text, hash) in [
            ("SCRIPT_HASH", SCRIPT, SCRIPT_HASH),
            ("STYLE_HASH", STYLE, STYLE_HASH),
            ("SOLID_HASH", SOLID, SOLID_HASH),
        ] {
            let found = STANDARD.encode(hmac_sha256::Hash::hash(text.as_bytes()));
            assert_eq!(found, hash, "write `const {name}: &str = \"{found}\";`");
        }
    }
}
