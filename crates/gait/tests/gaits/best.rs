//! The best strokes of a swimmer whose best ones are known.

use gait::{Effort, Fourier, Limits, Objective, Search, Stroke, WAY, net_motion};
use lie::{LieGroup, SE3, Tangent};

use crate::swimmers::three_links;

const ANY: Limits = Limits {
    angle: 2.0,
    rate: f64::INFINITY,
};

fn search() -> Search {
    let motion = "{ amplitude = 0.5, frequency = 1, phase = 0 }";
    Search::new(&three_links([motion; 2]), Objective::AdvancePerLength, ANY).expect("a search")
}

/// $q_1 = r \cos t$, $q_2 = r \cos (t - \varphi)$.
fn ellipse(r: f64, phase: f64) -> Fourier {
    let (sin, cos) = phase.sin_cos();
    let coefficients = vec![0.0, r, 0.0, 0.0, r * cos, r * sin];
    Fourier::new(1.0, 1, coefficients).expect("a stroke")
}

/// By golden sections.
fn best_of(of: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> (f64, f64) {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    for _ in 0..60 {
        let step = RATIO * (high - low);
        match of(high - step) > of(low + step) {
            true => high = low + step,
            false => low = high - step,
        }
    }
    (0.5 * (low + high), of(0.5 * (low + high)))
}

/// Found with code independent of this project: r = 1.0501, and the ratio to its digits.
#[test]
fn the_best_circle_is_that_which_is_known() {
    let search = search();
    // The objective of a search is by a coarser rule, which is 3e-9 off.
    let ratio = |r: f64| {
        let circle = ellipse(r, core::f64::consts::FRAC_PI_2);
        let net = net_motion(search.chain(), &circle).expect("a motion");
        net.translation.norm()
            / Effort::Length
                .of(search.chain(), &circle, 128)
                .expect("a length")
    };
    let (r, best) = best_of(ratio, [0.5, 1.5]);
    assert!((r - 1.0501).abs() < 5e-5, "{r}");
    assert!((best - 0.715573154).abs() < 5e-10, "{best}");
}

/// The distance in a stroke is that after so many strokes as lead along the way, where these are a whole number.
#[test]
fn the_distance_is_that_of_strokes_in_a_row() {
    let search = search();
    let way = WAY * search.chain().gyration();
    for (n, turn) in [(4, 0.3), (30, 0.05), (30, 0.0), (400, 0.004)] {
        let screw = |size: f64| {
            Tangent([
                0.2 * turn,
                0.1 * turn,
                turn,
                0.9 * size,
                -0.3 * size,
                0.1 * size,
            ])
        };
        let far = |size: f64| SE3::exp(&screw(size)).translation.norm();
        let step = way / f64::from(n);
        let size = (0..60).fold(step, |size, _| size * step / far(size));
        let g = SE3::exp(&screw(size));
        let end = (0..n).fold(SE3::identity(), |all: SE3, _| all.compose(&g));
        let expected = end.translation.norm() / f64::from(n);
        let found = Objective::Advance.gain(search.chain(), &g);
        // Rounding of the strokes in a row.
        assert!(
            (found - expected).abs() < 1e-12 * way,
            "{n}: {found} {expected}"
        );
    }
}

/// The best ellipse of the family $r$, $\varphi$, found without a gradient.
#[test]
fn the_best_ellipse_lies_between_the_best_circle_and_the_best_of_one_harmonic() {
    let search = search();
    let ratio = |r: f64, phase: f64| {
        let value = Objective::AdvancePerLength.of(search.chain(), &ellipse(r, phase));
        value.expect("a ratio")
    };
    let of_phase = |phase: f64| best_of(|r| ratio(r, phase), [0.5, 1.5]);
    let (phase, best) = best_of(|phase| of_phase(phase).1, [0.8, 2.2]);
    let (r, _) = of_phase(phase);
    println!("r = {r:.6}, phase = {phase:.6}: {best:.9}");
    let free = search
        .improve(&ellipse(r, phase), &|| true)
        .expect("an evaluation")
        .expect("a stroke");
    println!("free, with a bias: {:.9}", free.value);
    assert!(best > 0.715573154 && best <= free.value, "{best}");
}

/// Between the times at which a search looks at them, too.
#[test]
fn angles_and_rates_are_within_their_limits_at_all_times() {
    let motion = "{ amplitude = 0.5, frequency = 1, phase = 0 }";
    for (angle, rate) in [(0.7, f64::INFINITY), (2.0, 5.0), (0.7, 4.0)] {
        let limits = Limits { angle, rate };
        let scene = three_links([motion; 2]);
        let search = Search::new(&scene, Objective::Advance, limits).expect("a search");
        for order in [1, 2, 5] {
            let start = Fourier::fit(&ellipse(0.5, 1.4), order).expect("a stroke");
            let found = search.improve(&start, &|| true).expect("an evaluation");
            let stroke = found.expect("a stroke").stroke;
            let largest = |k: u32| {
                let shapes = (0..4096).map(|i| stroke.derivative(f64::from(i) / 4096.0, k));
                shapes.flatten().fold(0.0, |m: f64, x| m.max(x.abs()))
            };
            let nearest = (largest(0) / angle).max(largest(1) / rate);
            assert!(nearest < 1.0 + 1e-6, "{order}: {nearest}");
            assert!(
                nearest > 0.98,
                "a limit is what ends it: {order}: {nearest}"
            );
        }
    }
}

/// Each family holds the one before.
#[test]
fn more_harmonics_are_better() {
    let search = search();
    let circle = 0.715573154;
    let mut before = circle;
    for order in [1, 3] {
        let start = Fourier::fit(&ellipse(1.0, 1.4), order).expect("a stroke");
        let found = search
            .improve(&start, &|| true)
            .expect("an evaluation")
            .expect("a stroke");
        println!(
            "order {order}: {} by {} evaluations: {:?}",
            found.value,
            found.evaluations,
            found.stroke.coefficients()
        );
        assert!(found.value >= before, "{}", found.value);
        let (value, gradient) = Objective::AdvancePerLength
            .with_gradient(search.chain(), &found.stroke)
            .expect("a gradient");
        let size = gradient.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!(size < 1e-3 * value, "no way leads further: {size}");
        before = found.value;
    }
}

/// A search that is to stop at once gives the start, where it is within the limits.
#[test]
fn a_search_that_is_stopped_gives_the_best_so_far() {
    let search = search();
    let start = ellipse(0.8, 1.4);
    let asked = core::cell::Cell::new(0);
    let go_on = || {
        asked.set(asked.get() + 1);
        asked.get() < 4
    };
    let found = search
        .improve(&start, &go_on)
        .expect("an evaluation")
        .expect("a stroke");
    let own = Objective::AdvancePerLength
        .of(search.chain(), &start)
        .expect("a ratio");
    assert!(found.value >= own && found.evaluations <= 4, "{found:?}");
}
