//! A small report, as text and files.

use crate::catalogue::Method;
use crate::problems::Problem;
use crate::{Options, Report, TableOptions, run};
use std::sync::OnceLock;

/// Of every estimator on two problems.
fn report() -> &'static Report {
    static REPORT: OnceLock<Report> = OnceLock::new();
    REPORT.get_or_init(|| {
        let problems = ["well-correlated", "three-lights"].iter().filter_map(|id| Problem::from_id(id)).collect();
        let options =
            Options { problems, seed: 3, budget_seconds: 1.0, quick: true, exhibits: false, ..Options::default() };
        run(&options, &()).unwrap()
    })
}

fn share(problem: usize, id: &str, draws: u64) -> f64 {
    let method = report().problems[problem].methods.iter().find(|method| method.method.id() == id).unwrap();
    method.points.iter().find(|point| point.draws == draws).unwrap().coverage.unwrap().share
}

/// The ids that begin the lines of the tables of problems; lines with few words are wrapped cells.
fn rows(table: &str) -> Vec<&'static str> {
    let first = |line: &str| {
        let id = Method::from_id(line.split_whitespace().next()?).map(Method::id);
        id.filter(|_| line.split_whitespace().count() > 8)
    };
    let (problems, _) = table.split_once("\nerror, time: ").unwrap();
    problems.lines().filter_map(first).collect()
}

#[test]
fn intervals_of_the_mean_cover_and_those_of_an_inconsistent_estimator_miss() {
    // 256 draws of a smooth integrand: 0.95 to within 0.005, and four standard errors (alpha = 6e-5) of 2314
    // replicates, 0.0181.
    assert_eq!(report().problems[0].methods[0].points[7].replicates, 2314);
    for id in ["mc", "ratio", "mickey"] {
        let share = share(0, id, 256);
        assert!((share - 0.95).abs() <= 0.0231, "{id}: {share}");
    }
    // A bias of many standard errors.
    assert!(share(0, "mean_of_ratios", 256) <= 0.02);
    // Sixteen draws seldom find the light that is rarely chosen.
    assert!(share(1, "ratio", 16) <= 0.5);
}

#[test]
fn intervals_are_judged_after_16_64_and_256_draws() {
    for method in report().problems.iter().flat_map(|problem| &problem.methods) {
        for point in &method.points {
            assert_eq!(point.coverage.is_some(), [16, 64, 256].contains(&point.draws));
            assert!(point.channels.iter().all(|channel| channel.coverage.is_some() == point.coverage.is_some()));
        }
    }
}

#[test]
fn the_worst_channel_is_no_better_than_all() {
    for method in &report().problems[1].methods {
        for point in method.points.iter().filter(|point| point.coverage.is_some()) {
            let (channel, worst) = point.worst_coverage().unwrap();
            assert!(worst.share <= point.coverage.unwrap().share);
            assert_eq!(point.channels[channel].coverage.map(|coverage| coverage.share), Some(worst.share));
        }
    }
}

#[test]
fn the_short_table_has_plain_and_the_best_of_each_group() {
    let short = report().table(TableOptions::default());
    let all = report().table(TableOptions { all: true, ..TableOptions::default() });
    assert_eq!(rows(&all).len(), 2 * Method::all().count());
    let rows = rows(&short);
    let groups: Vec<_> = rows.iter().filter_map(|id| Method::from_id(id)).map(Method::group).collect();
    let (first, second) = groups.split_at(groups.len() / 2);
    assert_eq!(first, second);
    assert!(first.len() >= 3 && first.is_sorted_by(|a, b| a < b), "{first:?}");
    assert_eq!(rows.iter().filter(|id| **id == "mc").count(), 2);
    assert!(!rows.contains(&"mean_of_ratios"));
    for line in short.lines().chain(all.lines()) {
        assert!(line.chars().count() <= 110, "too wide: {line}");
    }
}

#[test]
fn the_best_is_bold_if_asked_for() {
    let plain = report().table(TableOptions { all: true, bold: false });
    assert!(!plain.contains('\u{1b}'));
    let bold = report().table(TableOptions { all: true, bold: true });
    let styled: Vec<_> = bold.lines().filter(|line| line.contains("\u{1b}[1m")).collect();
    assert_eq!(styled.len(), 2, "one row of each problem: {styled:?}");
}

#[test]
fn poor_error_bars_are_listed_with_their_flags() {
    let table = report().table(TableOptions::default());
    let (_, poor) = table.split_once("Error bars to be wary of").unwrap();
    assert!(poor.lines().any(|line| line.contains("three-lights") && line.contains("16")), "{poor}");
    assert!(!poor.contains("well-correlated") && !poor.contains("mean_of_ratios"), "{poor}");
}

#[test]
fn files_have_the_shares() {
    let csv = super::csv::csv(report()).unwrap();
    let mut lines = csv::Reader::from_reader(csv.as_bytes());
    let head = lines.headers().unwrap().clone();
    let column = |name: &str| head.iter().position(|column| column == name).unwrap();
    let [draws, share, error, without] = ["draws", "coverage", "coverage_std_error", "without_interval"].map(column);
    for line in lines.records().map(Result::unwrap) {
        let judged = ["16", "64", "256"].contains(&&line[draws]);
        for at in [share, error, without] {
            assert_eq!(!line[at].is_empty(), judged, "{line:?}");
        }
    }
    let json: serde_json::Value = serde_json::from_str(&super::json::json(report()).unwrap()).unwrap();
    let points = &json["problems"][1]["estimators"][1]["points"];
    assert!(points[0]["all"]["coverage"].is_null());
    assert_eq!(points[3]["all"]["coverage"]["share"].as_f64(), Some(self::share(1, "ratio", 16)));
    assert!(points[3]["channels"][2]["coverage"]["missed_flagged"].is_number());
}

#[test]
fn the_page_has_a_cell_for_each_estimator_and_size() {
    let page = super::page::page(report());
    let (_, section) = page.split_once("Do the error bars mean what they say?").unwrap();
    let cells = section.matches("<td class=\"c-").count();
    assert_eq!(cells, 2 * 3 * Method::all().count());
    assert!(section.contains("<b>three-lights</b>"));
}
