//! The coefficients of the explicit methods: their order conditions, and the orders of their errors on an exact solution.

use study::baseline::{Pair, Row, Tableau};
use study::survey::slope;

const TABLEAUX: [Tableau; 3] = [Tableau::CLASSICAL, Pair::DP54.tableau, Pair::DP853.tableau];
/// Sums of up to a dozen terms of up to 100.
const ROUNDING: f64 = 1e-13;

fn sum(row: Row, values: &[f64]) -> f64 {
    row.iter().map(|(j, a)| a * values[*j]).sum()
}

/// $A x$.
fn apply(tableau: &Tableau, x: &[f64]) -> Vec<f64> {
    let rows = tableau.rows.iter().map(|row| sum(row, x));
    [0.0].into_iter().chain(rows).collect()
}

/// The nodes $c = A 1$.
fn nodes(tableau: &Tableau) -> Vec<f64> {
    apply(tableau, &vec![1.0; tableau.stages()])
}

fn powers(c: &[f64], k: u32) -> Vec<f64> {
    c.iter().map(|c| c.powi(k as i32)).collect()
}

/// By how much the conditions of an order are missed: of all trees of up to eight vertices with at most one branching vertex beside
/// the root.
fn defects(tableau: &Tableau, order: u32) -> Vec<f64> {
    let c = nodes(tableau);
    let mut defects = Vec::new();
    for k in 0..order {
        // From a bush on a stem of `stem` edges, with `l` leaves at the root: the root has order k + stem + l + 1.
        let (mut x, mut factor) = (powers(&c, k), 1.0);
        for stem in 0..order - k {
            let l = order - 1 - k - stem;
            if stem == 0 && l > 0 {
                // No stem: leaves of the bush and of the root are the same.
                (x, factor) = (apply(tableau, &x), factor / f64::from(k + 1));
                continue;
            }
            let with_leaves: Vec<_> = x.iter().zip(powers(&c, l)).map(|(x, c)| x * c).collect();
            let exact = factor / f64::from(order);
            defects.push(sum(tableau.weights, &with_leaves) - exact);
            x = apply(tableau, &x);
            factor /= f64::from(k + stem + 1);
        }
    }
    defects
}

#[test]
fn order_conditions_hold_up_to_the_order_and_no_further() {
    for tableau in &TABLEAUX {
        for order in 1..=tableau.order {
            let defects = defects(tableau, order);
            assert!(
                defects.iter().all(|defect| defect.abs() < ROUNDING),
                "{order}: {defects:?}"
            );
        }
        let beyond = defects(tableau, tableau.order + 1);
        assert!(beyond.iter().any(|defect| defect.abs() > 1e-6));
    }
}

#[test]
fn nodes_are_those_of_the_literature() {
    let known: [&[(usize, f64)]; 3] = [
        &[(1, 0.5), (2, 0.5), (3, 1.0)],
        &[(1, 0.2), (2, 0.3), (3, 0.8), (4, 8.0 / 9.0), (5, 1.0)],
        &[
            (5, 1.0 / 3.0),
            (6, 0.25),
            (7, 4.0 / 13.0),
            (8, 127.0 / 195.0),
            (9, 0.6),
            (10, 6.0 / 7.0),
            (11, 1.0),
        ],
    ];
    for (tableau, known) in TABLEAUX.iter().zip(known) {
        let c = nodes(tableau);
        for (stage, node) in known {
            assert!(
                (c[*stage] - node).abs() < ROUNDING,
                "{stage}: {}",
                c[*stage]
            );
        }
    }
}

/// An estimate is the difference of two quadratures: of the method's and of one of the estimate's order.
#[test]
fn estimates_vanish_up_to_their_order() {
    for (pair, estimate, order) in [
        (Pair::DP54, Pair::DP54.estimate, 4),
        (Pair::DP853, Pair::DP853.estimate, 5),
        (Pair::DP853, Pair::DP853.second, 3),
    ] {
        let mut c = nodes(&pair.tableau);
        c.push(1.0);
        let moment = |k| sum(estimate, &powers(&c, k));
        assert!((0..order).all(|k| moment(k).abs() < ROUNDING), "{pair}");
        assert!(moment(order).abs() > 1e-5, "{pair}, {}", moment(order));
    }
}

/// Depends on time, and is not linear: $y = (e^{\sin t}, 1 / (1 + t^2))$.
fn rate(t: f64, y: &[f64]) -> [f64; 2] {
    [y[0] * t.cos(), -2.0 * t * y[1] * y[1]]
}

fn exact(t: f64) -> [f64; 2] {
    [t.sin().exp(), 1.0 / (1.0 + t * t)]
}

fn along(y: [f64; 2], h: f64, row: Row, k: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|d| y[d] + h * row.iter().map(|(j, a)| a * k[*j][d]).sum::<f64>())
}

/// The end of a step, and the rates of its stages and there.
fn step(tableau: &Tableau, t: f64, y: [f64; 2], h: f64) -> ([f64; 2], Vec<[f64; 2]>) {
    let (c, mut k) = (nodes(tableau), vec![rate(t, &y)]);
    for (row, c) in tableau.rows.iter().zip(&c[1..]) {
        k.push(rate(t + c * h, &along(y, h, row, &k)));
    }
    let end = along(y, h, tableau.weights, &k);
    k.push(rate(t + h, &end));
    (end, k)
}

fn largest(x: [f64; 2]) -> f64 {
    x[0].abs().max(x[1].abs())
}

fn order(errors: impl Iterator<Item = (f64, f64)>) -> f64 {
    let logs: Vec<_> = errors.map(|(h, error)| (h.ln(), error.ln())).collect();
    slope(&logs)
}

#[test]
fn fixed_steps_show_the_order() {
    for (tableau, steps) in TABLEAUX.iter().zip([20, 40, 5]) {
        let error = |n: u32| {
            let h = 4.0 / f64::from(n);
            let end = (0..n).fold(exact(0.0), |y, i| step(tableau, h * f64::from(i), y, h).0);
            (h, largest([0, 1].map(|d| end[d] - exact(4.0)[d])))
        };
        let order = order([2, 3, 4].into_iter().map(|finer| error(finer * steps)));
        println!("order {}: {order:.2}", tableau.order);
        assert!((order - f64::from(tableau.order)).abs() < 0.4, "{order}");
    }
}

#[test]
fn estimates_of_a_step_show_their_orders() {
    for (pair, estimate, order_of_estimate) in [
        (Pair::DP54, Pair::DP54.estimate, 4.0),
        (Pair::DP853, Pair::DP853.estimate, 5.0),
        (Pair::DP853, Pair::DP853.second, 3.0),
    ] {
        let estimate = |h: f64| {
            // At several times: at one of them a term might vanish.
            let starts = (0..8).map(|i| 0.4 * f64::from(i));
            let sizes = starts.map(|t| {
                let (_, k) = step(&pair.tableau, t, exact(t), h);
                largest(along([0.0; 2], h, estimate, &k))
            });
            (h, sizes.sum::<f64>())
        };
        let order = order([0.02, 0.04, 0.08].into_iter().map(estimate));
        println!("{pair}: {order:.2}");
        // In a step an error of order p is of order p + 1.
        assert!((order - order_of_estimate - 1.0).abs() < 0.2, "{order}");
    }
}
