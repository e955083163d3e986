//! Rows of published against measured; in: figures, out: text and JSON; cost: none.

use std::fmt;

use comfy_table::{ContentArrangement, Table, presets};
use serde::Serialize;

/// One published figure and ours.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Row {
    /// Where it stands in the paper, and what it is.
    pub figure: String,
    /// As printed there; `None` where the paper gives no number.
    pub published: Option<f64>,
    /// Measured here.
    pub ours: f64,
    /// Why they differ, or what ours was measured on.
    pub reason: String,
    /// Digits behind the point, as the paper prints it.
    #[serde(skip)]
    pub digits: usize,
}

impl Row {
    /// Ours less the published one.
    pub fn difference(&self) -> Option<f64> {
        self.published.map(|published| self.ours - published)
    }
}

/// A table of rows.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Figures {
    /// In the paper's order.
    pub rows: Vec<Row>,
}

impl Figures {
    /// Adds a row.
    pub fn add(
        &mut self,
        figure: impl Into<String>,
        published: Option<f64>,
        ours: f64,
        digits: usize,
        reason: impl Into<String>,
    ) {
        self.rows.push(Row { figure: figure.into(), published, ours, reason: reason.into(), digits });
    }

    /// As JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a plain struct of numbers and strings") + "\n"
    }
}

impl fmt::Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = Table::new();
        table.load_preset(presets::UTF8_FULL_CONDENSED);
        table.set_content_arrangement(ContentArrangement::Dynamic);
        if !table.is_tty() {
            table.set_width(150);
        }
        table.set_header(["figure", "published", "ours", "difference", "reason"]);
        for row in &self.rows {
            let digits = row.digits;
            let number =
                |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.digits$}"));
            let difference = row.difference().map_or("-".to_owned(), |value| format!("{value:+.digits$}"));
            table.add_row([
                &row.figure,
                &number(row.published),
                &number(Some(row.ours)),
                &difference,
                &row.reason,
            ]);
        }
        write!(f, "{table}")
    }
}
