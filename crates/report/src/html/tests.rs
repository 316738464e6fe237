//! Tests of `html`.

use super::super::{BarChart, Chart, Figure, Section};
use super::*;

const EVIL: &str = "</td><script src=\"https://example.org/x.js\">alert('&')</script>";

#[test]
fn no_name_breaks_out_of_the_page_and_nothing_is_loaded() {
    let mut table = Table::new([(EVIL, Align::Left), ("error", Align::Right)]);
    table.row([EVIL, "1"]);
    let chart = Chart { title: EVIL.to_owned(), ..Chart::default() };
    let bars =
        BarChart { title: EVIL.to_owned(), groups: vec![EVIL.into()], ..BarChart::default() };
    let figures = vec![
        Figure::chart("one", chart.clone()),
        Figure::chart("other", chart),
        Figure::bars("bars", bars),
    ];
    let lines = vec![EVIL.to_owned()];
    let section = Section { title: EVIL.to_owned(), table: table.clone(), lines, figures };
    let document = Document {
        title: EVIL.to_owned(),
        notes: vec![EVIL.to_owned()],
        sections: vec![section],
        rows: table,
        ..Document::default()
    };
    let page = document.to_html();
    assert!(!page.contains("<script") && !page.contains("src=\""), "{page}");
    assert_eq!(page.matches("<td").count(), 4);
    // Clip path identifiers are global to the page, so each chart needs its own.
    for k in 1..=2 {
        assert_eq!(page.matches(&format!("id=\"plot-{k}\"")).count(), 1);
        assert_eq!(page.matches(&format!("url(#plot-{k})")).count(), 1);
    }
}

#[test]
fn the_same_report_in_words() {
    let mut table = Table::new([("tool", Align::Left), ("error", Align::Right)]);
    table.row(["hook, long", "3.1"]).row(["say \"stick\"", "12"]);
    let section = Section { title: "Errors".into(), table: table.clone(), ..Section::default() };
    let document = Document {
        title: "Two tools".into(),
        notes: vec!["Of one run.".into()],
        sections: vec![section],
        rows: table,
        ..Document::default()
    };
    insta::assert_snapshot!(document.to_text(), @r#"
    Two tools

    Of one run.

    Errors:

    tool         error
    hook, long     3.1
    say "stick"     12
    "#);
    assert!(document.to_markdown().starts_with("## Two tools\n\nOf one run.\n\nErrors:\n\n| tool"));
    assert_eq!(document.to_csv(), "tool,error\n\"hook, long\",3.1\n\"say \"\"stick\"\"\",12\n");
}
