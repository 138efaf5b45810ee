//! What a chart says, as text.

use std::path::PathBuf;

use sim::number::{decimal, three_digits};
use study::contender::{Contender, Control, Problem};
use study::work_precision::{Choice, Curve, Reference, cheapest};

use crate::cli::print::{self, one_line};
use crate::cli::scene::Loaded;

/// Attitude errors that one may ask for, rad.
const ERRORS: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];

/// The chart and what follows from it.
pub struct Report<'a> {
    pub loaded: &'a Loaded,
    pub problem: &'a Problem,
    pub reference: &'a Reference,
    pub curves: &'a [Curve],
    pub rows: Vec<Row>,
    pub files: &'a [PathBuf],
}

/// What to take for an error.
pub struct Row {
    /// rad.
    pub error: f64,
    pub cheapest: Option<Choice>,
    /// Among the methods that keep the structure.
    pub keeping: Option<Choice>,
    pub dp853: Option<Choice>,
}

impl<'a> Report<'a> {
    pub fn new(
        loaded: &'a Loaded,
        problem: &'a Problem,
        reference: &'a Reference,
        curves: &'a [Curve],
        files: &'a [PathBuf],
    ) -> Self {
        let only = |keep: fn(Contender) -> bool, error| {
            cheapest(curves.iter().filter(|curve| keep(curve.contender)), error)
        };
        let known = ERRORS
            .into_iter()
            .filter(|error| *error >= reference.attitude);
        let row = |error| Row {
            error,
            cheapest: only(|_| true, error),
            keeping: only(Contender::keeps_structure, error),
            dp853: only(|contender| contender.name() == "dp853", error),
        };
        Self {
            loaded,
            problem,
            reference,
            curves,
            rows: known.map(row).collect(),
            files,
        }
    }

    /// The table, the reference, the failures and the files.
    pub fn text(&self) -> String {
        let until = self.problem.until;
        let header = [
            "attitude error",
            "cheapest",
            "with",
            "time",
            "of dp853's",
            "keeping the structure",
            "with",
            "time",
            "of dp853's",
        ]
        .map(str::to_owned);
        let rows = self.rows.iter().map(|row| self.row(row));
        let table: Vec<_> = core::iter::once(header).chain(rows).collect();
        let title = self.loaded.scene.title.as_deref();
        let mut text = format!(
            "{}, {} s\n\n{}\n{}\n",
            one_line(title.unwrap_or(&self.loaded.file)),
            decimal(until),
            print::columns(&table),
            self.reference.describe(until),
        );
        if self.rows.len() < ERRORS.len() {
            text += "Errors below the reference's own are not known, and have no row.\n";
        }
        for curve in self.curves {
            if let Some(failures) = curve.failures(until) {
                text += &format!("failed: {failures}\n");
            }
        }
        let files: Vec<_> = self
            .files
            .iter()
            .map(|file| file.display().to_string())
            .collect();
        text + &format!("\nwritten: {}\n", one_line(&files.join(", ")))
    }

    fn row(&self, row: &Row) -> [String; 9] {
        let choice = |choice: &Option<Choice>| match choice {
            None => ["not reached", "", "", ""].map(str::to_owned),
            Some(choice) => [
                choice.contender.to_string(),
                self.setting(choice),
                milliseconds(choice),
                ratio(choice, row.dp853.as_ref())
                    .map_or_else(|| "-".to_owned(), |r| format!("{r:.2}")),
            ],
        };
        let ([a, b, c, d], [e, f, g, h]) = (choice(&row.cheapest), choice(&row.keeping));
        [format!("{:.0e} rad", row.error), a, b, c, d, e, f, g, h]
    }

    fn setting(&self, choice: &Choice) -> String {
        let value = choice.setting.value(self.problem.until);
        match choice.setting.control() {
            Control::Step => format!("h = {} s", three_digits(value)),
            Control::Tolerance => format!("tolerance {value:e}"),
            Control::Accuracy => format!("accuracy {value:e}"),
        }
    }
}

fn milliseconds(choice: &Choice) -> String {
    format!("{} ms", three_digits(1e3 * choice.time().as_secs_f64()))
}

/// The time in parts of that of dp853.
pub fn ratio(choice: &Choice, dp853: Option<&Choice>) -> Option<f64> {
    let ratio = choice.time().as_secs_f64() / dp853?.time().as_secs_f64();
    ratio.is_finite().then_some(ratio)
}
