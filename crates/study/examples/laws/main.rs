//! Laws that hold for every scene and every method. What is called a metre changes nothing of a motion. Nor does where, how fast, how
//! turned and in which order the scene is described.
//!
//! `cargo run --release -p lgvi-study --example laws -- [CASES] [SEED]`, by default 100 and 1. For each method and law: the cases that hold of
//! those that were tried, and the largest difference of attitudes, rad. A case whose step is refused in both descriptions holds.

mod change;
mod law;
mod random;

use std::process::ExitCode;

use sim::Method;

use law::Law;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).map(|text| text.parse::<u64>());
    let mut next = |default| arguments.next().unwrap_or(Ok(default));
    let (Ok(cases), Ok(seed)) = (next(100), next(1)) else {
        eprintln!("usage: laws [CASES] [SEED]");
        return ExitCode::from(2);
    };
    let mut broken = 0;
    println!(
        "held / tried (largest difference, rad); a step of the method's own, {} of them",
        law::STEPS
    );
    for (law, name) in Law::ALL {
        println!("\n{name}");
        for method in Method::all() {
            let (mut tried, mut held, mut worst) = (0, 0, 0.0_f64);
            for case in 0..cases {
                let scene = random::scene(seed, case);
                if let Some((holds, difference)) = law::holds(law, method, (&scene, case)) {
                    (tried, held) = (tried + 1, held + u32::from(holds));
                    worst = worst.max(difference);
                    if !holds {
                        println!("    {method}: case {case} differs by {difference:.1e}");
                    }
                }
            }
            broken += tried - held;
            println!("  {:14} {held:>5} / {tried:<5} {worst:.1e}", method.name());
        }
    }
    ExitCode::from(u8::from(broken > 0))
}
