//! SIMD lanes: every register of this processor computes what a double does, item by item.

use lie::lanes::{self, InstructionSet, Job};
use lie::{Batch, Cayley, DualNumber, Jet, LieGroup, SE3, SO3, Scalar, Tangent, Vec3};

/// Both signs, ties, what rounds, and what is not finite; a prime number of them, so that any two meet in every item.
const NUMBERS: [f64; 13] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.1,
    -7.3,
    1.0 + f64::EPSILON,
    2.5e-3,
    -1e-12,
    3e7,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// A test whose body runs over the scalar of each instruction set, and of the fastest for one number.
macro_rules! on_every_set {
    ($(#[$attribute:meta])* fn $name:ident<$scalar:ident>() $body:block) => {
        $(#[$attribute])*
        #[test]
        fn $name() {
            struct Check;
            impl Job for Check {
                type Output = ();
                fn run<$scalar: Batch<Item = f64>>(self) $body
            }
            for set in InstructionSet::available() {
                println!("{set}");
                lanes::run(set, Check);
            }
            lanes::run_single(Check);
        }
    };
}

fn batch<S: Batch<Item = f64>>(item: impl Fn(usize) -> f64) -> S {
    let mut batch = [S::splat(0.0)];
    let items = S::items_mut(&mut batch).iter_mut();
    items.enumerate().for_each(|(i, x)| *x = item(i));
    batch[0]
}

/// The number in item `i` where the first item has number `first`.
fn number(first: usize, i: usize) -> f64 {
    NUMBERS[(first + i) % NUMBERS.len()]
}

fn numbers<S: Batch<Item = f64>>(first: usize) -> S {
    batch(|i| number(first, i))
}

/// The same bits; one that is not a number has many.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Asserts that `f` of any two numbers is that of two doubles, in every item, within instructions of the set and without.
#[track_caller]
fn agree<S: Batch<Item = f64>>(
    f: impl Fn(S, S) -> S,
    of_doubles: impl Fn(f64, f64) -> f64,
    equal: impl Fn(f64, f64) -> bool,
    name: &str,
) {
    for a in 0..NUMBERS.len() {
        for b in 0..NUMBERS.len() {
            let (x, y) = (numbers(a), numbers(b));
            for found in [f(x, y), S::run(|| f(x, y))] {
                for (i, found) in S::items(&[found]).iter().enumerate() {
                    let (x, y) = (number(a, i), number(b, i));
                    let expected = of_doubles(x, y);
                    assert!(
                        equal(*found, expected),
                        "{name} of {x} and {y}: {found:e}, not {expected:e}"
                    );
                }
            }
        }
    }
}

/// One formula over the batch and over doubles.
macro_rules! agree {
    ($scalar:ident, $equal:expr, $(|$x:ident, $y:ident| $formula:expr),+ $(,)?) => { $(
        agree::<$scalar>(
            |$x: $scalar, $y: $scalar| $formula,
            |$x: f64, $y: f64| $formula,
            $equal,
            stringify!($formula),
        );
    )+ };
}

on_every_set! {
    fn arithmetic_is_that_of_doubles<S>() {
        agree!(
            S,
            same,
            |x, y| x + y,
            |x, y| x - y,
            |x, y| x * y,
            |x, y| x / y,
            |x, y| x % y,
            |x, y| { let mut z = x; z += y; z },
            |x, y| { let mut z = x; z -= y; z },
            |x, y| { let mut z = x; z *= y; z },
            |x, y| { let mut z = x; z /= y; z },
            |x, y| { let mut z = x; z %= y; z },
            |x, _y| -x,
            |x, _y| Scalar::times(x, 0.3),
            |x, _y| Scalar::powi(x, 3),
        );
    }
}

on_every_set! {
    fn functions_are_those_of_doubles<S>() {
        // The square root is rounded rightly by all; the others are the same function, called for each item.
        agree!(
            S,
            same,
            |x, _y| x.sqrt(),
            |x, _y| x.exp(),
            |x, _y| x.ln(),
            |x, _y| x.tanh(),
            |x, y| x.atan2(y),
        );
        // Where a library has one function for both, it may round the last digit otherwise.
        let close = |a: f64, b: f64| same(a, b) || (a - b).abs() <= f64::EPSILON;
        agree!(
            S,
            close,
            |x, _y| x.sin_cos().0,
            |x, _y| x.sin_cos().1,
            |x, _y| x.sin(),
            |x, _y| x.cos(),
        );
    }
}

on_every_set! {
    fn a_product_and_a_sum_are_rounded_once<S>() {
        // A register fuses the two. Else the product, the sum and what they are compared with each have half an epsilon.
        let unfused = if S::ITEMS == 1 { f64::EPSILON } else { 0.0 };
        for z in [-0.1, 3.7, 1e-17, -1.0] {
            let close = |a: f64, b: f64| {
                same(a, b) || b.is_finite() && (a - b).abs() <= unfused * (2.0 * b.abs() + z.abs())
            };
            let (add, subtract) = ("mul_add", "neg_mul_add");
            let third = S::splat(z);
            agree::<S>(|x, y| x.mul_add(y, third), |x, y| x.mul_add(y, z), close, add);
            agree::<S>(|x, y| x.neg_mul_add(y, third), |x, y| (-x).mul_add(y, z), close, subtract);
        }
    }
}

on_every_set! {
    fn select_takes_the_item_that_the_mask_says<S>() {
        let smaller = |x: S, y: S| S::select(x.less(y), x, y);
        // Equal numbers, zeros of both signs and those that are none are not less.
        agree(smaller, |x, y| if x < y { x } else { y }, same, "select");
    }
}

on_every_set! {
    fn magnitudes_are_those_of_the_items<S>() {
        // Zeros of both signs are equal here.
        let equal = |a: f64, b: f64| a == b || a.is_nan() && b.is_nan();
        agree::<S>(|x, _| Batch::abs(x), |x, _| x.abs(), equal, "abs");
        // Which of two is larger is not said where one is not a number.
        let larger = |a: f64, b: f64| b.is_nan() || a == b;
        let max = |x: f64, y: f64| if x.is_nan() || y.is_nan() { f64::NAN } else { x.max(y) };
        agree::<S>(Batch::max, max, larger, "max");
        for first in 0..NUMBERS.len() {
            let sizes: Vec<f64> = (0..S::ITEMS).map(|i| number(first, i).abs()).collect();
            let largest = match sizes.iter().any(|x| x.is_nan()) {
                true => f64::NAN,
                false => sizes.into_iter().fold(0.0, f64::max),
            };
            let found = numbers::<S>(first).magnitude();
            assert!(equal(found, largest), "{found:e}, not {largest:e}");
        }
    }
}

on_every_set! {
    fn the_sum_is_that_of_the_items<S>() {
        for first in 0..NUMBERS.len() {
            let items = (0..S::ITEMS).map(|i| number(first, i));
            let (sum, size) = items.fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()));
            let found = numbers::<S>(first).sum();
            // Half an epsilon for each addition, in either order.
            let rounding = S::ITEMS as f64 * f64::EPSILON * size;
            let close = found == sum || (found - sum).abs() <= rounding && sum.is_finite();
            assert!(close || found.is_nan() && sum.is_nan(), "{found:e}, not {sum:e}");
        }
    }
}

on_every_set! {
    fn items_are_read_as_they_were_written<S>() {
        let mut batches = vec![S::splat(0.7); 3];
        assert_eq!(S::items(&batches), vec![0.7; 3 * S::ITEMS]);
        let written: Vec<f64> = (0..3 * S::ITEMS).map(|i| i as f64 - 2.5).collect();
        S::items_mut(&mut batches).copy_from_slice(&written);
        assert_eq!(S::items(&batches), written);
        // One batch after the other.
        assert_eq!(S::items(&batches[1..2]), &written[S::ITEMS..2 * S::ITEMS]);
        assert!(S::items(&[]).is_empty());
    }
}

on_every_set! {
    fn constants_are_the_same_everywhere<S>() {
        let everywhere = |x: S, expected: f64| S::items(&[x]).iter().all(|x| *x == expected);
        assert!(everywhere(S::zero(), 0.0) && everywhere(S::one(), 1.0));
        assert!(everywhere(S::from_f64(0.3), 0.3) && everywhere(S::splat(0.3), 0.3));
        assert!(everywhere(S::from_real(S::splat(0.3).real()), 0.3));
        for odd in 0..S::ITEMS {
            let x: S = batch(|i| if i == odd { 1e-300 } else { 0.0 });
            assert!(x != S::zero() && !x.is_zero() && x == x, "item {odd}");
            let x: S = batch(|i| if i == odd { f64::NAN } else { 0.0 });
            assert!(x != x, "item {odd}");
        }
        assert!(S::zero().is_zero());
    }
}

#[test]
fn dual_numbers_and_floats_are_batches_of_one() {
    let x = DualNumber::variable(-3.0, 1);
    let y = DualNumber::variable(2.0, 0);
    assert_eq!((Batch::abs(x), Batch::abs(y)), (-x, y));
    assert_eq!((Batch::max(x, y), Batch::max(y, x)), (y, y));
    assert_eq!((x.sum(), <f32 as Batch>::sum(-0.5)), (x, -0.5));
    assert_eq!((DualNumber::<f64>::ITEMS, f32::ITEMS), (1, 1));
}

/// Motions along these velocities: what the integrators are made of.
fn motions<S: Scalar>(x: [S; 12]) -> Vec<S> {
    let [a, b, c, d, e, f, rest @ ..] = x;
    let (xi, eta) = (Tangent([a, b, c, d, e, f]), Tangent(rest));
    let g = SE3::exp(&xi).compose(&SE3::cayley(&eta));
    let turn = SO3::exp(&xi.split().0.into()).compose(&SO3::cayley(&eta.split().0.into()));
    let slow = SE3::<S>::d_left_inv::<Cayley>(&xi, &eta);
    let slower = SO3::<S>::d_left_inv::<Cayley>(&Tangent([a, b, c]), &Tangent([d, e, f]));
    let point = g.act(Vec3([d, e, f]));
    let rows = [turn.matrix(), g.rotation.matrix()].map(|m| m.0.concat());
    [
        rows.concat(),
        point.0.to_vec(),
        slow.0.to_vec(),
        slower.0.to_vec(),
    ]
    .concat()
}

/// The arguments of item `i`: another motion for each.
fn arguments(i: usize) -> [f64; 12] {
    core::array::from_fn(|k| (1.3 * k as f64 + 0.7 * i as f64 + 0.2).sin())
}

fn side_by_side<S: Batch<Item = f64>>() -> [S; 12] {
    core::array::from_fn(|k| batch(|i| arguments(i)[k]))
}

/// A product that is fused is rounded once less: half an epsilon of numbers up to 4, and a few of them follow one another.
/// A single double has the same operations.
fn fused<S: Batch>() -> f64 {
    if S::ITEMS == 1 {
        0.0
    } else {
        8.0 * f64::EPSILON
    }
}

#[track_caller]
fn assert_items<S: Batch<Item = f64>>(found: S, i: usize, expected: f64) {
    let found = S::items(&[found])[i];
    let error = (found - expected).abs();
    assert!(
        error <= fused::<S>(),
        "item {i}: {found:e}, not {expected:e}: {error:e}"
    );
}

on_every_set! {
    fn motions_are_those_of_doubles<S>() {
        let found = S::run(|| motions::<S>(side_by_side()));
        for i in 0..S::ITEMS {
            let expected = motions(arguments(i));
            assert_eq!(found.len(), expected.len());
            for (found, expected) in found.iter().zip(expected) {
                assert_items(*found, i, expected);
            }
        }
    }
}

/// Each argument's derivative, six at a time.
fn derivatives<S: Scalar>(x: [S; 12], first: usize) -> Vec<DualNumber<S>> {
    let seeded = |k: usize| match k.checked_sub(first) {
        Some(d) if d < lie::JET_DIRECTIONS => DualNumber::variable(x[k], d),
        _ => DualNumber::constant(x[k]),
    };
    motions(core::array::from_fn(seeded))
}

on_every_set! {
    fn derivatives_are_those_of_doubles<S>() {
        for first in [0, 6] {
            let found = S::run(|| derivatives::<S>(side_by_side(), first));
            for i in 0..S::ITEMS {
                let expected = derivatives(arguments(i), first);
                for (found, expected) in found.iter().zip(expected) {
                    assert_items(found.value(), i, expected.value());
                    for d in 0..lie::JET_DIRECTIONS {
                        assert_items(found.partial(d), i, expected.partial(d));
                    }
                }
            }
        }
    }
}

/// The items of the scalar that a job is given.
struct Items;

impl Job for Items {
    type Output = usize;
    fn run<S: Batch<Item = f64>>(self) -> usize {
        S::ITEMS
    }
}

#[test]
fn the_widest_set_is_no_wider_than_needed() {
    let items = |set| lanes::run(set, Items);
    let widths = || InstructionSet::available().map(items);
    for wanted in 0..20 {
        let set = InstructionSet::widest(wanted);
        assert!(set.is_available(), "{set}");
        // The narrowest that takes all at once, or the widest.
        let enough = widths().filter(|width| *width >= wanted).min();
        assert_eq!(
            Some(items(set)),
            enough.or(widths().max()),
            "{wanted}: {set}"
        );
    }
}

#[test]
fn a_set_that_the_processor_lacks_falls_back_to_the_baseline() {
    let sets = [
        (InstructionSet::Baseline, 1),
        (InstructionSet::Neon, 2),
        (InstructionSet::Avx2, 4),
        (InstructionSet::Avx512, 8),
    ];
    for (set, width) in sets {
        let available = InstructionSet::available().any(|of| of == set);
        assert_eq!(set.is_available(), available, "{set}");
        let expected = if available { width } else { 1 };
        assert_eq!(lanes::run(set, Items), expected, "{set}");
    }
    // No processor has both.
    assert!(!(InstructionSet::Neon.is_available() && InstructionSet::Avx2.is_available()));
}
