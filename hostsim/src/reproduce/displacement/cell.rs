//! One published cell beside ours; in: both, out: a row; cost: none.

use serde::Serialize;

/// A cell of a table.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Cell {
    /// "Table 4".
    pub table: &'static str,
    /// Map's name.
    pub map: String,
    /// The table's row.
    pub row: String,
    /// Its column: the view.
    pub view: &'static str,
    /// As printed; `None` where the print has none or cannot be read.
    pub published: Option<f64>,
    /// What an independent study measured, rounded to a digit.
    pub study: Option<f64>,
    /// The device's.
    pub ours: f64,
    /// The oracle's f64 traversal of the same rays.
    pub f64_traversal: Option<f64>,
    /// Ours less the nearest number that would be printed so: printed figures are truncated (P20).
    pub error: Option<f64>,
    /// The same, of the printed figure.
    pub error_percent: Option<f64>,
    /// Another reading or setting than that of the printed row.
    pub another: bool,
    /// Why they differ, or what this is.
    pub reason: String,
}

/// What a printed figure stands for beyond itself (P20).
const TRUNCATED: f64 = 0.1;

/// A difference with no reason of its own; [`LEGEND`] says what is known of it.
const UNEXPLAINED: &str = "*";

/// What the tables' columns and marks mean.
pub const LEGEND: &str = "published: as the paper prints it, truncated (P20), so an error of 0 is a figure of ours inside \
    [published, published + 0.1), and any other is counted from the nearer end. study: an independent double-precision study of \
    the same views. f64: our oracle's traversal of the same rays in double precision. *: the paper's camera and code are known \
    only in part.";

/// Ours less the nearest number in `printed..printed + 0.1`.
pub fn error(printed: f64, ours: f64) -> f64 {
    if ours < printed { ours - printed } else { (ours - (printed + TRUNCATED)).max(0.0) }
}

impl Cell {
    /// A cell; NaN as the published figure means that there is none.
    pub fn new(
        table: &'static str,
        (map, row, view): (&str, &str, &'static str),
        published: f64,
        study: Option<f64>,
        (ours, f64_traversal): (f64, Option<f64>),
    ) -> Self {
        let published = Some(published).filter(|figure| !figure.is_nan());
        let error = published.map(|figure| error(figure, ours));
        let error_percent = error.zip(published).map(|(error, figure)| 100.0 * error / figure);
        let (map, row) = (map.to_owned(), row.to_owned());
        let mut cell = Self {
            table,
            map,
            row,
            view,
            published,
            study,
            ours,
            f64_traversal,
            error,
            error_percent,
            another: false,
            reason: String::new(),
        };
        cell.reason = cell.why();
        cell
    }

    /// Makes it another reading or setting of the printed row.
    pub fn another(&mut self) {
        self.another = true;
        self.reason = match (self.row.contains("(c2)"), self.row.contains("P19")) {
            (true, _) => "another reading of the flag (P5)".to_owned(),
            (_, true) if self.error == Some(0.0) => "the same: what the printed row fits".to_owned(),
            (_, true) => "what the printed row fits".to_owned(),
            _ => self.why(),
        };
    }

    /// What is known of the difference.
    fn why(&self) -> String {
        let Some(error) = self.error else {
            let beyond = self.row.contains("P22");
            return if beyond { "beyond the paper" } else { "not printed, or lost in print" }.to_owned();
        };
        if error == 0.0 {
            return "the same".to_owned();
        }
        let oddity = match (self.map.as_str(), self.row.as_str()) {
            ("rocks", "[12]") if (self.table, self.view) == ("Table 4", "oblique") => "19.0 or 19.6 in print",
            ("wall", "(b)") => "print fits n = 4: see that row (P19)",
            ("bump" | "dent", "(a)") => "print fits a finer grid: see that row (P19)",
            (_, "(c2)") if self.view != "grazing" => "the rule is not printed: see its readings (P5)",
            _ if self.view == "grazing" => "the view is a fit, not published",
            _ => UNEXPLAINED,
        };
        oddity.to_owned()
    }

    /// As a line of a table.
    pub fn line(&self) -> [String; 9] {
        let number = |figure: Option<f64>, digits: usize| {
            figure.map_or("-".to_owned(), |figure| format!("{figure:.digits$}"))
        };
        let error = self.error.map_or("-".to_owned(), |error| match error {
            0.0 => "0".to_owned(),
            error => format!("{error:+.2}"),
        });
        [
            self.map.clone(),
            self.row.clone(),
            self.view.to_owned(),
            number(self.published, 1),
            number(self.study, 1),
            number(Some(self.ours), 2),
            number(self.f64_traversal, 2),
            error,
            self.reason.clone(),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn print_is_truncated() {
        assert_eq!(error(9.5, 9.57), 0.0);
        assert!((error(9.5, 9.45) + 0.05).abs() < 1e-9);
        assert!((error(9.5, 9.65) - 0.05).abs() < 1e-9);
        let lost = Cell::new("Table 4", ("four", "a+b+c1", "grazing"), f64::NAN, None, (15.1, None));
        assert_eq!((lost.published, lost.error), (None, None));
        let rocks = |table| Cell::new(table, ("rocks", "[12]", "oblique"), 19.6, None, (19.2, None)).reason;
        assert!(rocks("Table 4").contains("19.0") && rocks("Table 2") == UNEXPLAINED);
        let wall = Cell::new("Table 4", ("wall", "(b)", "front"), 4.1, None, (5.6, None));
        assert!(wall.reason.contains("P19") && wall.error_percent.is_some_and(|error| error > 30.0));
    }
}
