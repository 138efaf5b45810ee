//! Swimmers to try gaits on.

use std::path::Path;

use articulated_fluid::{ArticulatedBody, Configuration, Evaluation, Scene};
use core::f64::consts::PI;
use dvi::{Context, ContinuousSystem, System};
use lie::{AlgebraOver, DualOver, Scalar};
use proptest::prelude::*;

/// A file of the scenes that states are known of.
pub fn published(name: &str) -> Scene {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../articulated-fluid/tests/swim/scenes");
    Scene::load(&folder.join(name)).expect("a scene")
}

/// Three equal ellipses in a plane, of the density 1, whose connection a published code agrees with: two hinges with a motion each.
///
/// Semi-axes 0.5 and 0.05 m; the left link turns by $-q_1$, the right one by $q_2$.
pub fn three_links([left, right]: [&str; 2]) -> Scene {
    let (a, b, gap): (f64, f64, f64) = (0.5, 0.05, 0.1);
    let mass = PI * a * b;
    let total = [mass + PI * b * b, mass + PI * a * a, 1.0];
    let turning = mass * (a * a + b * b) / 4.0 + PI * (a * a - b * b).powi(2) / 8.0;
    let body = |name: &str| {
        format!(
            "{{ name = '{name}', total_mass = {total:?}, total_inertia = [1, 1, {turning:?}] }}"
        )
    };
    let at = a + gap / 2.0;
    let joint = |child: &str, side: f64, motion: &str| {
        format!(
            "{{ parent = 'middle', child = '{child}', at_parent = [{}, 0, 0], at_child = [{}, 0, 0], type = 'hinge', axis = [0, 0, {side}],
              motion = {motion} }}",
            side * at,
            -side * at,
        )
    };
    let text = format!(
        "fluid.density = 1\nstart.momentum = 'zero'\nbody = [{}, {}, {}]\njoint = [{}, {}]",
        body("middle"),
        body("left"),
        body("right"),
        joint("left", -1.0, left),
        joint("right", 1.0, right),
    );
    Scene::parse(&text, "three-links.toml").expect("a scene")
}

/// A random tree of ellipsoids on prescribed hinges, balls and welds, with its number of coordinates.
pub fn trees() -> impl Strategy<Value = Scene> {
    let body = (0.1..1.0, 0.1..1.0, 0.1..1.0);
    let point = || prop::array::uniform3(-1.0..1.0);
    let joint = (
        0..3,
        0..100_usize,
        (point(), point(), point()),
        prop::array::uniform4(-1.0..1.0),
    );
    (body.clone(), prop::collection::vec((body, joint), 1..5)).prop_filter_map("a joint that moves", |(first, rest)| {
        let semi_axes = |(a, b, c): (f64, f64, f64)| format!("semi_axes = [{a}, {b}, {c}]");
        let mut text = format!("fluid.density = 1\nstart.momentum = 'zero'\n[[body]]\nname = 'b0'\n{}\n", semi_axes(first));
        let mut moves = false;
        for (i, (body, (kind, on, (at_parent, at_child, axis), rest))) in rest.into_iter().enumerate() {
            let motion = match kind {
                0 => "type = 'fixed'".to_owned(),
                1 => format!("type = 'hinge'\naxis = {axis:?}\nmotion = {{ amplitude = 0.6, frequency = 1, phase = {} }}", i as f64),
                _ => format!("motion = {{ bias = [0.1, 0, 0.2], amplitude = {axis:?}, frequency = 1, phase = [0, 1, {i}] }}"),
            };
            moves |= kind != 0;
            let scale = rest.iter().map(|x| x * x).sum::<f64>().sqrt();
            let rest = rest.map(|x| x / scale);
            text += &format!(
                "[[body]]\nname = 'b{n}'\n{}\n[[joint]]\nparent = 'b{}'\nchild = 'b{n}'\nat_parent = {at_parent:?}\nat_child = {at_child:?}\nrest = {rest:?}\n{motion}\n",
                semi_axes(body),
                on % (i + 1),
                n = i + 1,
            );
        }
        moves.then(|| Scene::parse(&text, "tree.toml").unwrap_or_else(|error| panic!("{error}: {text}")))
    })
}

/// A model that is stepped without lanes, which would take minutes to compile here.
pub struct Plain(pub ArticulatedBody);

impl System for Plain {
    type Group = Configuration;

    fn is_driven(&self) -> bool {
        self.0.is_driven()
    }

    fn terms(&self) -> usize {
        self.0.terms()
    }

    fn is_symplectic(&self) -> bool {
        self.0.is_symplectic()
    }
}

impl ContinuousSystem for Plain {
    type Workspace<S: Scalar> = Evaluation<S>;

    fn velocity_and_force<S: Scalar>(
        &self,
        at: Context<S>,
        g: &Configuration<S>,
        mu: &DualOver<Configuration, S>,
        work: &mut Evaluation<S>,
        xi: &mut AlgebraOver<Configuration, S>,
        tau: &mut DualOver<Configuration, S>,
    ) {
        self.0.velocity_and_force(at, g, mu, work, xi, tau);
    }
}
