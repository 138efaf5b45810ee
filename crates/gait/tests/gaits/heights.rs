//! Height functions and the area rule.

use gait::{Chain, HeightMaps, Told};
use lie::VectorSpace;

use crate::swimmers::three_links;

fn maps(amplitude: f64, centre: f64) -> [HeightMaps; 2] {
    let motion = |phase: f64| {
        format!("{{ bias = {centre}, amplitude = {amplitude}, frequency = 1, phase = {phase} }}")
    };
    let scene = three_links([&motion(core::f64::consts::FRAC_PI_2), &motion(0.0)]);
    let chain = Chain::new(&scene).expect("a chain");
    let told = Told::new(&scene.model().expect("a model")).expect("a stroke");
    [HeightMaps::of, HeightMaps::of_first_body].map(|of| of(&chain, &told).expect("maps"))
}

fn off(maps: &HeightMaps) -> f64 {
    (maps.by_area - maps.exact).max_magnitude()
}

/// In a plane turns commute: their area rule has no error but that of the quadrature.
#[test]
fn turns_in_a_plane_are_areas() {
    for map in maps(0.5, 0.5) {
        let apart = (map.by_area[2] - map.exact[2]).abs();
        assert!(apart < 1e-9, "{:?} {:?}", map.by_area, map.exact);
        // Found with code independent of this project.
        assert!(
            (map.exact[2] + 0.1914563161795589).abs() < 1e-9,
            "{:?}",
            map.exact
        );
    }
}

#[test]
fn the_least_frame_mends_the_area_rule() {
    for (amplitude, centre) in [(0.5, 0.0), (0.5, 0.5), (1.0, 0.0)] {
        let [least, own] = maps(amplitude, centre);
        println!(
            "{amplitude} about {centre}: {} in the least frame, {} in the first body's, of {:?}",
            off(&least),
            off(&own),
            least.exact
        );
        assert!(off(&least) < 0.5 * off(&own));
    }
}

/// What does not commute is of the third order in the loop's size, and the area of the second.
#[test]
fn small_loops_move_by_their_areas() {
    let [large, small] = [0.2, 0.1].map(|amplitude| off(&maps(amplitude, 0.4)[1]));
    let order = (large / small).log2();
    assert!(order > 2.7, "{order}");
}
