//! Tests of `chart`.

use super::*;

#[test]
fn ticks_are_round_numbers() {
    let labels = |range: Range, log| -> Vec<String> {
        range.ticks(log).into_iter().map(|(_, label)| label).collect()
    };
    assert_eq!(labels(Range { low: 0.0, high: 11.0 }, false), ["0", "2", "4", "6", "8", "10"]);
    assert_eq!(labels(Range { low: -3.0, high: 1.0 }, true), ["0.001", "0.01", "0.1", "1", "10"]);
}

#[test]
fn points_that_cannot_be_shown_are_left_out() {
    let points = vec![[1.0, 1.0], [2.0, f64::NAN], [3.0, 0.0], [4.0, 10.0]];
    let series = Series { name: "a".into(), points, mark: Mark::Dots, labels: Vec::new() };
    let empty = Series { name: "b".into(), points: vec![[1.0, 0.0]], ..series.clone() };
    let chart = Chart { y: Axis::log("loss"), series: vec![series, empty], ..Chart::default() };
    let svg = chart.to_svg();
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    assert!(svg.contains(">a<") && !svg.contains(">b<"));
    // Two points of the series and one in the legend.
    assert_eq!(svg.matches("<circle").count(), 3);
}

#[test]
fn an_empty_chart_is_still_a_chart() {
    assert!(Chart::default().to_svg().ends_with("</svg>\n"));
}

#[test]
fn a_long_legend_takes_more_lines_and_later_series_are_dashed() {
    let chart = |count: usize| Chart {
        series: (0..count)
            .map(|k| Series {
                name: format!("a series with a long name, {k}"),
                points: vec![[0.0, k as f64], [1.0, 1.0]],
                mark: Mark::Line,
                labels: Vec::new(),
            })
            .collect(),
        ..Chart::default()
    };
    assert!(!chart(7).to_svg().contains("stroke-dasharray"));
    assert!(chart(9).to_svg().contains("stroke-dasharray"));
    let lines = |count: usize| {
        let places = chart(count).legend();
        let last = places.last().expect("a series").1.y;
        assert!(places.iter().all(|(_, place)| place.x < SIZE.x));
        last / LEGEND_LINE
    };
    assert_eq!((lines(1), lines(9)), (0.0, 4.0));
}
