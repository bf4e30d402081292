//! The head of a table whose columns are estimators.

use crate::MethodReport;
use core::fmt::Write;

/// Two rows: groups above estimators, which are sorted by group. After the problem come columns named `others`.
pub(super) fn headings(methods: &[&MethodReport], others: &[&str]) -> String {
    let mut groups = String::from("<th class=\"stick\" rowspan=\"2\">problem</th>");
    for other in others {
        let _ = write!(groups, "<th rowspan=\"2\">{other}</th>");
    }
    let mut names = String::new();
    for group in methods.chunk_by(|a, b| a.method.group() == b.method.group()) {
        let title = group[0].method.group().title();
        let _ = write!(groups, "<th class=\"group\" colspan=\"{}\">{title}</th>", group.len());
        for method in group {
            let _ = write!(names, "<th>{}</th>", method.method.id().replace('_', "<br>"));
        }
    }
    format!("<tr>{groups}</tr><tr>{names}</tr>")
}
