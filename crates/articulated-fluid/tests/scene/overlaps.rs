//! The depth of overlaps against spheres, where it is exact, and against planes that separate the bodies.

use articulated_fluid::scene::{Mobility, Overlaps, SceneBody, SceneJoint};
use articulated_fluid::{Ellipsoid, Scene};
use lie::{SO3, Vec3};
use proptest::prelude::*;

use crate::parse;

type Shape = ([f64; 3], [f64; 4]);

/// Two ellipsoids, the second at `centre` from the first.
fn pair(a: Shape, b: Shape, centre: Vec3) -> Scene {
    let body = |name: &str, (axes, attitude): Shape| {
        format!("[[body]]\nname = '{name}'\nsemi_axes = {axes:?}\nattitude = {attitude:?}\n")
    };
    let at_parent = SO3::from_quaternion(a.1).inverse_rotate(centre).0;
    parse(&format!(
        "fluid.density = 1\n{}{}[[joint]]\nparent = 'a'\nchild = 'b'\nat_parent = {at_parent:?}\nat_child = [0, 0, 0]",
        body("a", a),
        body("b", b),
    ))
}

fn depth(scene: &Scene) -> Option<f64> {
    scene.overlaps(1).first.first().map(|overlap| overlap.depth)
}

const ALIGNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

#[test]
fn spheres_overlap_by_the_sum_of_their_radii_less_the_distance() {
    let centre = Vec3([2.0, -1.0, 2.0]) * (1.0 / 3.0);
    for (a, b, distance) in [
        (1.0, 2.0, 2.5),
        (1.0, 2.0, 0.5),
        (3e-9, 1e-9, 3.5e-9),
        (1e6, 1.0, 1e6),
    ] {
        let scene = pair(([a; 3], ALIGNED), ([b; 3], ALIGNED), centre * distance);
        let expected = a + b - distance;
        let found = depth(&scene).expect("an overlap");
        assert!(
            (found - expected).abs() < 1e-14 * (a + b),
            "{found} for {expected}"
        );
    }
}

#[test]
fn what_touches_does_not_overlap() {
    let (a, b) = (([3.0, 1.0, 2.0], ALIGNED), ([1.0, 2.0, 5.0], ALIGNED));
    for (centre, expected) in [
        (4.0, None),
        (4.0 - 1e-10, None),
        (5.0, None),
        (4.0 - 1e-7, Some(1e-7)),
    ] {
        let found = depth(&pair(a, b, Vec3([centre, 0.0, 0.0])));
        assert_eq!(found.is_some(), expected.is_some(), "{centre}");
        assert!((found.unwrap_or(0.0) - expected.unwrap_or(0.0)).abs() < 1e-14);
    }
}

#[test]
fn concentric_ellipsoids_overlap_by_their_smallest_semi_axes() {
    let scene = pair(
        ([3.0, 1.0, 2.0], ALIGNED),
        ([9.0, 8.0, 7.0], ALIGNED),
        Vec3::zero(),
    );
    assert_eq!(depth(&scene), Some(8.0));
}

/// An attitude for each `k`.
fn some_attitude(k: i32) -> [f64; 4] {
    let k = f64::from(k);
    let q = [1.0 + k.sin(), (2.0 * k).cos(), (3.0 * k).sin(), k.cos()];
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / length)
}

#[test]
fn parallel_needles_overlap_as_circles_do() {
    for thin in [1e-2, 1e-4, 1e-6, 1e-8] {
        for k in 0..100 {
            let needle = ([1.0, thin, thin], some_attitude(k));
            let across = SO3::from_quaternion(needle.1).rotate(Vec3([0.0, 1.5 * thin, 0.0]));
            let found = depth(&pair(needle, needle, across)).expect("an overlap");
            assert!(
                (found / (0.5 * thin) - 1.0).abs() < 1e-7,
                "{thin} {k} {found}"
            );
        }
    }
}

/// At right angles and centre on centre, the gap is that of their thin axes.
#[test]
fn crossed_needles_overlap_by_their_thickness() {
    for thin in [1e-2, 1e-4, 1e-6] {
        for k in 0..100 {
            let (a, b) = (([1.0, thin, thin], some_attitude(k)), [thin, 2.0, thin]);
            let across = SO3::from_quaternion(a.1).rotate(Vec3([0.0, 0.0, 1.5 * thin]));
            let found = depth(&pair(a, (b, a.1), across)).expect("an overlap");
            assert!(
                (found / (0.5 * thin) - 1.0).abs() < 1e-7,
                "{thin} {k} {found}"
            );
        }
    }
}

/// Needles at an angle of 0.5 about the third axis, where they touch.
#[test]
fn needles_at_an_angle_overlap_by_their_thickness() {
    for thin in [1e-2, 1e-4, 1e-6] {
        for k in 0..100 {
            let a = SO3::from_quaternion(some_attitude(k));
            let turned = multiplied(some_attitude(k), [0.25_f64.cos(), 0.0, 0.0, 0.25_f64.sin()]);
            let across = a.rotate(Vec3([0.0, 0.0, 1.5 * thin]));
            let axes = [1.0, thin, thin];
            let found = depth(&pair((axes, some_attitude(k)), (axes, turned), across));
            let found = found.expect("an overlap");
            assert!(
                (found / (0.5 * thin) - 1.0).abs() < 1e-7,
                "{thin} {k} {found}"
            );
        }
    }
}

/// The product of quaternions.
fn multiplied([a, b, c, d]: [f64; 4], [w, x, y, z]: [f64; 4]) -> [f64; 4] {
    [
        a * w - b * x - c * y - d * z,
        a * x + b * w + c * z - d * y,
        a * y - b * z + c * w + d * x,
        a * z + b * y - c * x + d * w,
    ]
}

#[test]
fn an_overlap_names_its_bodies() {
    let scene = pair(
        ([3.0, 1.0, 2.0], ALIGNED),
        ([1.0; 3], ALIGNED),
        Vec3([0.0, 1.66, 0.0]),
    );
    let [overlap] = &scene.overlaps(usize::MAX).first[..] else {
        panic!("one overlap");
    };
    assert_eq!(overlap.bodies, [0, 1]);
    assert_eq!(
        overlap.to_string(),
        "bodies \"a\" and \"b\" overlap by 0.34 m along the line of their centres; \
         check the signs of the joint's points"
    );
}

/// Balls of radius 0.6 on a cubic grid of spacing 1 with `n` to the edge, in one chain: each overlaps its neighbours.
#[test]
fn thousands_of_bodies_are_swept() {
    let n = 15;
    let place = |i: usize| {
        let at = [i / (n * n), i / n % n, i % n];
        Vec3(at.map(|x| x as f64))
    };
    let mut text = "fluid.density = 1\n".to_owned();
    for i in 0..n * n * n {
        text += &format!("[[body]]\nname = 'b{i}'\nsemi_axes = [0.6, 0.6, 0.6]\n");
    }
    for i in 1..n * n * n {
        let step = (place(i) - place(i - 1)).0;
        text += &format!(
            "[[joint]]\nparent = 'b{}'\nchild = 'b{i}'\nat_parent = {step:?}\nat_child = [0, 0, 0]\n",
            i - 1
        );
    }
    let scene = parse(&text);
    let start = std::time::Instant::now();
    let Overlaps {
        first: overlaps,
        more: 0,
        is_complete: true,
    } = scene.overlaps(usize::MAX)
    else {
        panic!("all of them");
    };
    println!("{} bodies in {:?}", n * n * n, start.elapsed());
    assert_eq!(overlaps.len(), 3 * n * n * (n - 1));
    assert!(
        overlaps
            .iter()
            .all(|overlap| (overlap.depth - 0.2).abs() < 1e-12)
    );
    assert!(overlaps.is_sorted_by_key(|overlap| overlap.bodies));
}

/// Spheres in one place, or ellipsoids on one joint: each pair is close.
fn star(count: usize, axes: [f64; 3]) -> Scene {
    let shape = Ellipsoid::new(axes).unwrap();
    let body = |i: i32| SceneBody {
        attitude: some_attitude(i),
        ..SceneBody::ellipsoid(&format!("b{i}"), &shape, 1.0, 1.0)
    };
    let joint = |child| SceneJoint {
        name: format!("b{child}"),
        parent: 0,
        child,
        at_parent: [0.0; 3],
        at_child: [-axes[0], 0.0, 0.0],
        mobility: Mobility::default(),
    };
    Scene {
        bodies: (0..count as i32).map(body).collect(),
        joints: (1..count).map(joint).collect(),
        ..parse("fluid.density = 1\nbody = [{ name = 'a', semi_axes = [1, 1, 1] }]")
    }
}

/// The first of them are the first of all, and none is lost in the count.
#[test]
fn a_few_of_many_overlaps_are_told() {
    let scene = star(200, [3.0, 1.0, 2.0]);
    let all = scene.overlaps(usize::MAX);
    assert!(all.is_complete && all.first.len() > 1000);
    for most in [0, 1, 10, all.first.len()] {
        let few = scene.overlaps(most);
        assert_eq!(few.first, all.first[..most]);
        assert_eq!(few.first.len() + few.more, all.first.len());
    }
}

/// A search of all pairs would take minutes, and gigabytes to keep them.
#[test]
fn the_search_ends_where_all_bodies_are_in_one_place() {
    for axes in [[1.0, 1.0, 1.0], [3.0, 1.0, 2.0], [1.0, 1e-3, 1e-3]] {
        let begin = std::time::Instant::now();
        let overlaps = star(20_000, axes).overlaps(10);
        println!("{axes:?} in {:?}: {:?}", begin.elapsed(), overlaps.rest());
        assert!(overlaps.first.len() <= 10 && !overlaps.is_complete);
        // So many pairs are looked at.
        assert!(overlaps.more < 1 << 20, "{}", overlaps.more);
    }
}

/// The support function: how far the ellipsoid extends in the direction `n`.
fn extent((axes, attitude): Shape, n: Vec3) -> f64 {
    let n = SO3::from_quaternion(attitude).inverse_rotate(n);
    Vec3([0, 1, 2].map(|i| axes[i] * n[i])).norm()
}

/// By definition: convex bodies are apart at a distance $s$ along $u$ where a direction $n$ separates them,
/// $s \, u \cdot n > h_A(n) + h_B(n)$; the smallest such $s$. With $u \cdot n = 1$ that is the minimum of a convex function
/// on a plane.
fn touching_distance(a: Shape, b: Shape, u: Vec3) -> f64 {
    let [e, f] = across(u);
    smallest(|x| {
        smallest(|y| {
            let n = u + e * x + f * y;
            extent(a, n) + extent(b, n)
        })
    })
}

/// Two unit vectors at right angles to the unit vector `u` and to each other.
fn across(u: Vec3) -> [Vec3; 2] {
    let axis = [0, 1, 2].map(|i| Vec3([0, 1, 2].map(|j| f64::from(i == j))));
    let far = |a: &&Vec3, b: &&Vec3| u.dot(**a).abs().total_cmp(&u.dot(**b).abs());
    let e = u.cross(*axis.iter().min_by(far).expect("three axes"));
    let e = e * (1.0 / e.norm());
    [e, u.cross(e)]
}

/// The minimum of a convex function by thirds. Semi-axes of 0.3 to 1 have it where $|n| < 2 / 0.6$, so within 4 of zero.
fn smallest(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (-4.0, 4.0);
    for _ in 0..60 {
        let third = (high - low) / 3.0;
        match f(low + third) < f(high - third) {
            true => high -= third,
            false => low += third,
        }
    }
    f(0.5 * (low + high))
}

fn shape() -> impl Strategy<Value = Shape> {
    let axes = prop::array::uniform3(0.3..1.0_f64);
    let attitude = prop::array::uniform4(-1.0..1.0_f64).prop_filter_map("too short", |q| {
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        (length > 0.1).then(|| q.map(|x| x / length))
    });
    (axes, attitude)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_depth_is_that_of_separating_planes(
        a in shape(),
        b in shape(),
        u in prop::array::uniform3(-1.0..1.0_f64),
        distance in 0.05..2.0_f64,
    ) {
        let u = Vec3(u);
        prop_assume!(u.norm() > 0.1);
        let u = u * (1.0 / u.norm());
        let touching = touching_distance(a, b, u);
        match depth(&pair(a, b, u * distance)) {
            // Rounding leaves a flat minimum of 1e-8 across, which the curvature squares.
            Some(depth) => prop_assert!((depth - (touching - distance)).abs() < 1e-12),
            None => prop_assert!(distance > touching * (1.0 - 2e-9)),
        }
    }
}
