//! The laws of scenes on a few random ones; `cargo run --release -p lgvi-study --example laws` tries more.

#[path = "../../examples/laws/change.rs"]
mod change;
#[path = "../../examples/laws/law.rs"]
pub mod law;
#[path = "../../examples/laws/random.rs"]
mod random;

use sim::Method;

use law::Law;

/// Of each law, for every method.
const CASES: u64 = 4;

#[test]
fn how_a_scene_is_described_changes_nothing_of_its_motion() {
    let (mut tried, mut broken) = (0, vec![]);
    for (law, name) in Law::ALL {
        for (method, case) in Method::all().flat_map(|m| (0..CASES).map(move |case| (m, case))) {
            let scene = random::scene(1, case);
            if let Some((holds, difference)) = law::holds(law, method, (&scene, case)) {
                tried += 1;
                if !holds {
                    broken.push(format!("{name}, {method}, case {case}: {difference:.1e}"));
                }
            }
        }
    }
    println!("{tried} cases");
    assert!(tried > 300, "{tried}");
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}
