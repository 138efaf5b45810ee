//! The tables.

use std::fmt::Write;

use dvi::laws::{self, LawError};
use dvi::{Integrator, Lagrangian, Variational};
use lie::SO3;
use study::problems::{HeavyTop, Nutation, Problem, Solution};
use study::survey::wrong::{ByHand, Mistake, Rederived};
use study::survey::{LongRun, Method, SurveyError, convergence, long_run, systems};

use super::{DRAWN, Plan, Surveyed, rows};

/// Errors below are rounding, the methods' or the reference's.
const PLATEAU: f64 = 4e-14;

/// Where a method's order is measured, in times of the problem. After a whole period a rule of order 1 that is conjugate to one
/// of order 2 would show that one's order.
const UNTIL: f64 = 0.7;

/// The numbers of steps that show a method's order.
fn ladder(order: u32, plan: Plan) -> [u32; 4] {
    match order {
        0..=1 => [1600, 3200, 6400, 12_800],
        2 => [400, 800, 1600, 3200],
        3..=5 => [100, 200, 400, 800],
        _ => plan.high.map(|n| (UNTIL * f64::from(n)).round() as u32),
    }
}

/// Measures every row on a problem.
pub fn survey<L, X>(problem: &Problem<L, X>, plan: Plan) -> Surveyed
where
    L: Lagrangian + Clone + 'static,
    X: Solution<L::Group>,
{
    let mut text = head(problem, plan);
    let mut drawn = Vec::new();
    for (place, row) in rows::<L>().iter().enumerate() {
        let make = || (row.make)(problem.lagrangian.clone());
        let (line, run) = measure(problem, plan, row.name, make)?;
        text += &line;
        if DRAWN.contains(&place) {
            drawn.push(run);
        }
    }
    Ok((text, drawn))
}

fn head<L: Lagrangian, X>(problem: &Problem<L, X>, plan: Plan) -> String {
    let (h, seconds) = (plan.h(problem), f64::from(plan.times) * problem.time);
    let energy = problem.energy(&problem.start);
    let mut text = format!(
        "{}: {seconds:.0} s = {} times {:.3} s in steps of {h:.4} s; energy {energy:.3} J\n",
        problem.name, plan.times, problem.time
    );
    for (i, named) in problem.symmetries.iter().enumerate() {
        let _ = write!(
            text,
            "{}J{} {}",
            if i == 0 { "  " } else { ", " },
            i + 1,
            named.name
        );
    }
    text += "\n";
    text += &columns(problem.symmetries.len());
    text
}

fn columns(maps: usize) -> String {
    let mut text = format!(
        "  {:<26} {:>8} {:>6} {:>9} {:>10}",
        "method", "declared", "order", "band", "drift/s"
    );
    for i in 1..=maps {
        let _ = write!(text, " {:>8}", format!("dJ{i}"));
    }
    text + &format!(" {:>9} {:>9}\n", "residual", "defect")
}

fn measure<L: Lagrangian, X: Solution<L::Group>>(
    problem: &Problem<L, X>,
    plan: Plan,
    name: &str,
    make: impl Fn() -> Method<L::Group>,
) -> Result<(String, LongRun), SurveyError> {
    let (declared, h) = (make().order(), plan.h(problem));
    let steps = ladder(declared, plan);
    let exact = problem.exact.at(UNTIL * problem.time)?;
    let found = convergence(&make, &problem.start, &exact, &steps, PLATEAU)?;
    let run = long_run(problem, &mut make(), h, plan.steps * plan.times, 7)?;
    let defect = laws::symplectic_defect(&mut make(), &problem.start, h).unwrap_or(f64::NAN);
    let mut line = format!(
        "  {name:<26} {declared:>8} {:>6.2} {:>9.1e} {:>10.1e}",
        found.order, run.band, run.drift
    );
    for change in &run.momenta {
        let _ = write!(line, " {change:>8.1e}");
    }
    let _ = writeln!(line, " {:>9.1e} {defect:>9.1e}", run.residual);
    Ok((line, run))
}

/// The motion of constant velocity, which some methods keep to rounding.
pub fn steady() -> Result<String, SurveyError> {
    const STEPS: u32 = 1000;
    let problem = systems::screw()?;
    let exact = problem.exact.at(10.0 * problem.time)?;
    let mut text = format!(
        "{}, broadside on and turning, a constant velocity: error after ten turns, {:.0} s, in {STEPS} steps\n",
        problem.name, exact.t
    );
    for row in rows() {
        let make = || (row.make)(problem.lagrangian);
        let found = convergence(make, &problem.start, &exact, &[STEPS], 0.0)?;
        let _ = writeln!(text, "  {:<26} {:.1e}", row.name, found.errors[0].1);
    }
    Ok(text)
}

type Top = Problem<HeavyTop, Nutation>;

/// The methods that are wrong on purpose, and what the laws say of them.
pub fn wrong(top: &Top, plan: Plan) -> Result<String, SurveyError> {
    let mut text = format!("{}, wrong on purpose\n{}", top.name, columns(2));
    let mut verdicts = String::new();
    let mut add = |name: &str, make: &dyn Fn() -> Method<SO3>, law| -> Result<(), SurveyError> {
        text += &measure(top, plan, name, make)?.0;
        let _ = writeln!(verdicts, "  {name:<26} {}", verdict(law));
        Ok(())
    };
    for (name, mistake) in [
        ("left by hand, right", Mistake::None),
        ("sign of d_g", Mistake::SignOfDg),
        ("factor 2 of d_f", Mistake::FactorOfDf),
        ("d_g without component 0", Mistake::MissingTerm),
    ] {
        let hand = ByHand(mistake);
        let law = laws::check(&hand, core::slice::from_ref(&top.start), plan.h(top));
        add(name, &|| Method::new(Variational::new(hand)), law)?;
    }
    let right = ByHand(Mistake::None);
    let carried = || Variational::new(right).with_tolerance(LOOSE);
    let rederived = || Rederived::new(right, LOOSE);
    let step = |method: Method<SO3>| solved(method, top, plan);
    add(
        "loose, carried",
        &|| Method::new(carried()),
        step(Method::new(carried())),
    )?;
    add(
        "loose, derived anew",
        &|| Method::new(rederived()),
        step(Method::new(rederived())),
    )?;
    Ok(format!("{text}  the laws say:\n{verdicts}"))
}

/// A tolerance that leaves steps unsolved.
const LOOSE: f64 = 1e-3;

fn solved(mut method: Method<SO3>, top: &Top, plan: Plan) -> Result<laws::Report, LawError> {
    let states = core::slice::from_ref(&top.start);
    laws::check_step(&mut method, &ByHand(Mistake::None), states, plan.h(top))
}

fn verdict(law: Result<laws::Report, LawError>) -> String {
    match law {
        Ok(report) => format!("passed, {} comparisons", report.comparisons),
        Err(LawError::Law(lie::laws::LawError::Violated {
            formula,
            component,
            left,
            right,
            tolerance,
            ..
        })) => format!(
            "{formula}: component {component} is {left:.6e} and {right:.6e}, tolerance {tolerance:.0e}"
        ),
        Err(other) => other.to_string(),
    }
}
