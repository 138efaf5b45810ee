//! `lgvi methods`: the integrators that `lgvi run` offers.

use sim::Method;
use sim::method::Evaluation;
use sim::number::decimal;

use super::error::CliError;
use super::print;

/// List the integrators: order, symmetry, default step, cost.
///
/// Every method keeps the configuration on its group, the symplectic form, and the linear and angular momentum to
/// rounding. They differ in order, in symmetry and in cost.
#[derive(clap::Args)]
#[command(after_long_help = AFTER_LONG_HELP)]
pub struct Args {
    /// Print a JSON array with one object a method
    #[arg(long)]
    json: bool,
}

const AFTER_LONG_HELP: &str = "\
Examples:
  lgvi methods
  lgvi methods --json | jq -r '.[] | select(.symmetric) | .name'
  lgvi run --method gauss-4";

const NOTES: &str = "
symmetric     a step of -h undoes a step of h
symplectic    the symplectic form is kept, and the energy's error bounded
default step  of lgvi run without --step; it suits the motion of the built-in scene
evaluations   in a default step there, about; Newton's matrices come on top, and are kept over steps
  d           of the discrete Lagrangian's derivatives, at a step or substep
  c           of the continuous model's velocity and force, at a stage
All of them keep the group, the symplectic form and the momentum maps; the symmetric ones reversibility too.
";

/// Prints the methods.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let text = match args.json {
        true => print::json(&Method::all().collect::<Vec<_>>())?,
        false => table(),
    };
    print::stdout(&text)
}

fn table() -> String {
    let header = [
        "method",
        "order",
        "symmetric",
        "symplectic",
        "default step",
        "evaluations",
        "what it is",
    ]
    .map(str::to_owned);
    let rows: Vec<_> = core::iter::once(header)
        .chain(Method::all().map(row))
        .collect();
    print::columns(&rows) + NOTES
}

fn row(method: Method) -> [String; 7] {
    let yes = |holds: bool| if holds { "yes" } else { "no" }.to_owned();
    let kind = match method.evaluation() {
        Evaluation::VelocityAndForce => "c",
        _ => "d",
    };
    [
        method.name().to_owned(),
        method.order().to_string(),
        yes(method.is_symmetric()),
        yes(method.is_symplectic()),
        format!("{} s", decimal(method.default_step())),
        format!("{} {kind}", method.evaluations_per_step()),
        method.description().to_owned(),
    ]
}
