//! What a map says, as text.

use std::path::PathBuf;

use sim::number::{decimal, three_digits};
use study::stability::{Class, Limit, Map, Outcome, Wall};

use crate::cli::print::{self, one_line};
use crate::cli::scene::Loaded;

/// The map and what follows from it.
pub struct Report<'a> {
    pub loaded: &'a Loaded,
    pub map: &'a Map,
    pub title: String,
    /// What it took.
    pub seconds: f64,
    pub files: &'a [PathBuf],
}

impl Report<'_> {
    /// The table, what ends the good steps of each method, the counts and the files.
    pub fn text(&self) -> String {
        let grid = &self.map.grid;
        let mut text = format!(
            "{}\n\nThe largest good step, s, and what ends there, by {} ({})\n\n{}",
            self.title,
            grid.parameter,
            grid.parameter.description(),
            print::columns(&self.table()),
        );
        text += self.unjudged();
        let own = self.own();
        for method in 0..grid.methods.len() {
            if let Some(cause) = self.cause(method, own) {
                let (name, parameter) = (grid.methods[method], grid.parameter);
                let value = decimal(grid.values[own]);
                text += &format!("{name}, {parameter} {value}: {cause}\n");
            }
        }
        if self.is_cut_short() {
            text += "shorter steps had no time for some methods, which count as good there: give a longer --budget\n";
        }
        let files = self.files.iter().map(|file| file.display().to_string());
        let files: Vec<_> = files.collect();
        text += &format!(
            "\n{} in {:.0} s\nwritten: {}\n",
            self.counts(),
            self.seconds,
            one_line(&files.join(", "))
        );
        text
    }

    /// What the motion does not keep.
    fn unjudged(&self) -> &'static str {
        let model = &self.loaded.smallest.model;
        match (model.keeps_energy(), model.keeps_momentum()) {
            (true, true) => "\n",
            (false, true) => "\nenergy is not judged: what moves as told does work\n\n",
            (true, false) => "\nmomenta are not judged: the first body hangs on the world\n\n",
            (false, false) => {
                "\nenergy and momenta are not judged: what moves as told does work, and the first body hangs on the world\n\n"
            }
        }
    }

    fn table(&self) -> Vec<Vec<String>> {
        let grid = &self.map.grid;
        let head =
            core::iter::once("method".to_owned()).chain(grid.values.iter().copied().map(decimal));
        let row = |method: usize| {
            let limit = move |value| {
                let Limit { step, wall, .. } = self.map.limit(method, value);
                let step = step.map_or_else(|| "none:".to_owned(), decimal);
                match wall {
                    Wall::None => format!("{step} or more"),
                    wall => format!("{step} {}", wall.name()),
                }
            };
            let limits = (0..grid.values.len()).map(limit);
            core::iter::once(grid.methods[method].to_string()).chain(limits)
        };
        let rows = (0..grid.methods.len()).map(|method| row(method).collect());
        core::iter::once(head.collect()).chain(rows).collect()
    }

    /// Whether a limit leaves out steps that had no time.
    fn is_cut_short(&self) -> bool {
        let grid = &self.map.grid;
        let mut limits = (0..grid.methods.len())
            .flat_map(|method| (0..grid.values.len()).map(move |value| (method, value)));
        limits.any(|(method, value)| self.map.limit(method, value).untried > 0)
    }

    /// The index of the value that is nearest to the scene's own, of a stiffness to 1 N m, unless there is the scene itself, with 0.
    fn own(&self) -> usize {
        let values = self.map.grid.values.iter().enumerate();
        let distance = |value: &f64| if *value == 0.0 { 0.0 } else { value.ln().abs() };
        let own = values.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
        own.map_or(0, |(index, _)| index)
    }

    /// What the first step that is not good came to, and which wall that is.
    pub fn cause(&self, method: usize, value: usize) -> Option<String> {
        let limit = self.map.limit(method, value);
        let next = limit.next?;
        let (h, outcome) = (
            self.map.grid.steps[next],
            self.map.cell(method, value, next),
        );
        let what = match outcome.class {
            Class::NotRun if !outcome.had_no_time() => {
                "there was no reference to compare with".to_owned()
            }
            _ => what(outcome),
        };
        let what = format!("in steps of {} s {what}", decimal(h));
        Some(match limit.wall {
            Wall::Solver => format!(
                "{what}; the solver's wall: made longer bit by bit, shorter steps lead to a solution"
            ),
            Wall::Equation { ends: 0.0 } => {
                format!("{what}; the equation's wall: not even much shorter steps were solved")
            }
            Wall::Equation { ends } => {
                let ends = three_digits(ends);
                format!("{what}; the equation's wall: beyond {ends} s no solution was found")
            }
            Wall::Dynamics(_) => format!("{what}; the dynamics' wall"),
            _ => what,
        })
    }

    fn counts(&self) -> String {
        let counts = Class::ALL.map(|class| (class, self.map.count(class)));
        let some = counts.into_iter().filter(|(_, count)| *count > 0);
        let some: Vec<_> = some
            .map(|(class, count)| format!("{count} {class}"))
            .collect();
        format!("{} runs: {}", self.map.grid.len(), some.join(", "))
    }
}

fn what(outcome: &Outcome) -> String {
    let percent = |x: Option<f64>| format!("{:.1} %", 100.0 * x.unwrap_or(f64::INFINITY));
    let t = three_digits(outcome.t);
    match outcome.class {
        Class::EnergyBand => format!(
            "the energy is off by {} at t = {t} s",
            percent(outcome.energy)
        ),
        Class::EnergyDrift => format!("the energy drifts by {}", percent(outcome.drift)),
        Class::MomentumLost => {
            let error = outcome.momentum.unwrap_or(f64::INFINITY);
            format!("a momentum is off by {error:.0e}")
        }
        Class::GroupLeft => format!(
            "attitudes are off the group by {:.0e}",
            outcome.orthogonality
        ),
        Class::Refused => format!("a step is refused at t = {t} s"),
        Class::NonFinite => format!("a number is not finite after t = {t} s"),
        Class::SilentlyWrong => {
            let angle = outcome.attitude.unwrap_or(f64::INFINITY);
            format!("all is kept, but attitudes are off by {angle:.1} rad")
        }
        Class::NotRun => "it had no time".to_owned(),
        Class::Good => "all is good".to_owned(),
    }
}
