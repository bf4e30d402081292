//! The table as a page: one file, nothing loaded from elsewhere.

use crate::cases::{SECTIONS, Section};
use crate::table::{HEADER, Table, cells};
use core::fmt::Write;

const STYLE: &str = include_str!("page.css");

impl Table {
    /// The page.
    pub fn page(&self) -> String {
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>ratiocv: stiff cases</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<h1>Stiff cases</h1>\n\
             <p>{}. Each row is run on scalars, arrays and packs, draw by draw, in a batch and merged in a tree, in the \
             middle of channels whose bits must not change; shown is the run with the fewest digits. The textbook's \
             formula is in the precision of the draws.</p>\n",
            self.summary()
        );
        for Section { name: section, title, .. } in SECTIONS {
            let rows: Vec<_> = self.rows.iter().filter(|row| row.section == *section).collect();
            if rows.is_empty() {
                continue;
            }
            let header: String = HEADER.iter().map(|name| format!("<th>{name}</th>")).collect();
            // Writing to a String cannot fail.
            let _ = writeln!(
                page,
                "<h2>{section}. {title}</h2>\n<div class=\"scroll\"><table>\n<thead><tr>{header}</tr></thead>\n<tbody>"
            );
            for row in rows {
                let cell = |(column, text): (usize, String)| {
                    let (class, text) = match column {
                        2 => ("wrap", text),
                        4..=8 => ("number", text),
                        10 if row.passes() => ("ok", text),
                        10 => ("bad", format!("{text}: {}", row.broken.as_deref().unwrap_or_default())),
                        _ => ("", text),
                    };
                    format!("<td class=\"{class}\">{}</td>", escaped(&text))
                };
                let _ = writeln!(page, "<tr>{}</tr>", cells(row).into_iter().enumerate().map(cell).collect::<String>());
            }
            page.push_str("</tbody></table></div>\n");
        }
        page.push_str("</body>\n</html>\n");
        page
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
