//! Loads on scenes with a published or a closed answer.

use articulated_fluid::Scene;
use dvi::{Gauss, Integrator, State};
use lie::{Mat3, SO3, Vec3};

fn end(
    text: &str,
    until: f64,
    h: f64,
) -> (
    articulated_fluid::ArticulatedBody,
    State<articulated_fluid::Configuration>,
) {
    let scene = Scene::parse(text, "scene.toml").unwrap_or_else(|error| panic!("{error}"));
    let (model, mut state) = (
        scene.model().expect("a model"),
        scene.initial_state().expect("a state"),
    );
    let mut integrator = Gauss::new::<4>(model.clone());
    for k in 1..=(until / h).round() as u32 {
        integrator.step(&mut state, h).expect("a step");
        state.t = f64::from(k) * h;
    }
    (model, state)
}

/// The heavy top of M. Géradin, A. Cardona, as in the examples of Exudyn (J. Gerstmayr): its quaternion at 0.2 s is told there as
/// 0.70828, 0.43878, 0.54573, 0.0894.
#[test]
fn the_heavy_top_is_where_exudyn_has_it() {
    let text = "
        gravity = [0, 0, -9.81]
        fluid.density = 0
        body = [{ name = 'top', mass = 15, inertia = [0.234375, 0.46875, 0.234375], angular_velocity = [0, 150, -4.61538] }]
        joint = [{ parent = 'world', child = 'top', at_parent = [0, 0, 0], at_child = [0, -1, 0] }]
    ";
    let (model, state) = end(text, 0.2, 2e-4);
    let attitude = model.attitudes(state.t, &state.g).expect("a state")[0];
    let q = SO3::to_quaternion(&attitude);
    let told = [0.70828, 0.43878, 0.54573, 0.0894];
    // The sign of the vector part is that of the inverse rotation there.
    let inverse = [q[0], -q[1], -q[2], -q[3]];
    let off = inverse.iter().zip(told).map(|(q, told)| (q - told).abs());
    // The digits that are told.
    assert!(off.fold(0.0, f64::max) < 1e-5, "{q:?}");
}

/// Weight less buoyancy is drag: $v = \sqrt{(m - \rho V) g / q}$.
#[test]
fn a_falling_sphere_comes_to_its_terminal_velocity() {
    let text = "
        gravity = [0, 0, -9.81]
        fluid.density = 1000
        body = [{ name = 'ball', semi_axes = [0.1, 0.1, 0.1], mass = 6, drag = { quadratic = [7, 7, 7] } }]
    ";
    let (model, state) = end(text, 20.0, 0.02);
    let volume = 4.0 / 3.0 * core::f64::consts::PI * 1e-3;
    let terminal = ((6.0 - 1000.0 * volume) * 9.81 / 7.0).sqrt();
    let xi = model.velocity(&state).expect("a state");
    let speed = -xi.1[0][2];
    assert!(
        (speed - terminal).abs() < 1e-9 * terminal,
        "{speed} {terminal}"
    );
}

/// N. E. Leonard, *Stability of a bottom-heavy underwater vehicle*, Automatica 33 (1997): a neutral vehicle has its
/// buoyancy above its mass centre, and goes straight along its axis. The fluid would turn it from that. It goes on while the righting moment
/// outweighs the fluid's: with the momentum kept, $m g l > m_1 (m_3 - m_1) U^2 / m_3$.
#[test]
fn a_bottom_heavy_vehicle_is_stable_up_to_its_speed() {
    let scene = |l: f64, speed: f64| {
        format!(
        "
        gravity = [0, 0, -9.81]
        fluid.density = 1000
        start.velocity = [{speed}, 0, 0]
        body = [{{ name = 'vehicle', semi_axes = [0.6, 0.2, 0.15], buoyancy_at = [0, 0, {l}], attitude = {{ axis = [0, 1, 0], angle = 1e-6 }} }}]
        "
    )
    };
    let (l, any) = (
        0.01,
        Scene::parse(&scene(0.01, 1.0), "vehicle.toml").expect("a scene"),
    );
    let body = &any.bodies[0];
    let [m1, m3] = [body.total_mass[0][0], body.total_mass[2][2]];
    let righting = body.mass().expect("known") * 9.81 * l;
    let fastest = (righting * m3 / (m1 * (m3 - m1))).sqrt();
    let turned = |speed: f64| {
        let (model, state) = end(&scene(l, speed), 200.0, 0.05);
        let r = model.attitudes(state.t, &state.g).expect("a state")[0];
        (*r.matrix() - lie::Mat3::identity()).frobenius()
    };
    let (slower, faster) = (turned(0.98 * fastest), turned(1.02 * fastest));
    println!("{fastest} m/s: {slower:e} rad below, {faster:e} rad above");
    assert!(slower < 1e-4 && faster > 1e-2, "{slower:e} {faster:e}");
}

/// D. G. Murri, E. B. Jackson, R. O. Shelton, *Check-cases for verification of 6-degree-of-freedom flight vehicle simulations*,
/// NASA/TM-2015-218675: atmospheric case 2, a brick that tumbles without drag. Its rates after 30 s are 12.6183907757, -17.3974747619
/// and 31.1195888868 deg/s.
#[test]
fn a_tumbling_brick_turns_as_nasa_s() {
    // Slug ft² in kg m².
    let unit = 1.355_817_948_331_4;
    let inertia = [0.001_894_220, 0.006_211_019, 0.007_194_665].map(|i| unit * i);
    let rates = [10.0_f64, 20.0, 30.0].map(f64::to_radians);
    let text = format!(
        "fluid.density = 0\nbody = [{{ name = 'brick', mass = 2.268, inertia = {inertia:?}, angular_velocity = {rates:?} }}]"
    );
    let (model, state) = end(&text, 30.0, 0.05);
    let xi = model.velocity(&state).expect("a state");
    let told = [12.618_390_775_7, -17.397_474_761_9, 31.119_588_886_8];
    let off = [0, 1, 2].map(|i| (xi.0[0][i].to_degrees() - told[i]).abs());
    println!("off by {off:?} deg/s");
    // Its tools agree to about so many digits.
    assert!(off.iter().all(|off| *off < 1e-8), "{off:?}");
}

/// The equations of T. I. Fossen and T. Prestero about the vehicle's origin, stepped by Runge and Kutta's method.
struct Remus {
    /// About the origin, velocities first.
    inverse: Vec<Vec<f64>>,
    matrix: Vec<Vec<f64>>,
}

/// $R$, $x$ of the origin, $V$ and $\Omega$.
type Motion = [Vec3; 6];

impl Remus {
    const MASS: f64 = 30.48;
    const G: Vec3 = Vec3([0.0, 0.0, 0.0196]);

    fn new() -> Self {
        let mut matrix = vec![vec![0.0; 6]; 6];
        let added = [0.93, 35.5, 35.5, 0.0704, 4.88, 4.88];
        let own = [Self::MASS, Self::MASS, Self::MASS, 0.177, 3.45, 3.45];
        (0..6).for_each(|i| matrix[i][i] = added[i] + own[i]);
        let mut couple = |i: usize, j: usize, x: f64| {
            matrix[i][j] += x;
            matrix[j][i] += x;
        };
        couple(1, 5, -1.93);
        couple(2, 4, 1.93);
        let lever = Self::G.hat() * -Self::MASS;
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            couple(i, 3 + j, lever[(i, j)]);
        }
        let unit = |i: usize| (0..6).map(|j| f64::from(u8::from(i == j))).collect();
        let columns = (0..6).map(|i| solve(matrix.clone(), unit(i)));
        let inverse = columns.collect();
        Self { inverse, matrix }
    }

    fn times(a: &[Vec<f64>], [v, w]: [Vec3; 2]) -> [Vec3; 2] {
        let x = [v.0, w.0].concat();
        let row = |i: usize| a[i].iter().zip(&x).map(|(a, x)| a * x).sum();
        [
            Vec3([row(0), row(1), row(2)]),
            Vec3([row(3), row(4), row(5)]),
        ]
    }

    fn rate(&self, [a, b, c, _, v, w]: &Motion) -> Motion {
        let r = Mat3([a.0, b.0, c.0]);
        let [p, h] = Self::times(&self.matrix, [*v, *w]);
        // At the mass centre: drag, whose axes are the body's, and the weight.
        let at_g = *v + w.cross(Self::G);
        let smooth = |x: f64| (x * x + 1e-4).sqrt() - 0.01;
        let drag = |d: [f64; 3], x: Vec3, size: fn(f64) -> f64| {
            Vec3([0, 1, 2].map(|i| -d[i] * size(x[i]) * x[i]))
        };
        let down = r.transpose() * Vec3([0.0, 0.0, -9.81]);
        let on_g = drag([1.62, 131.0, 131.0], at_g, smooth) + down * Self::MASS;
        let thrust = Vec3([3.86, 0.0, 0.0]);
        let buoyancy = down * (-306.0 / 9.81);
        let force = on_g + thrust + buoyancy;
        let moment = Self::G.cross(on_g)
            + Vec3([-0.72, 0.0, 0.0]).cross(thrust)
            + drag([0.13, 188.0, 94.0], *w, f64::abs);
        let rates = [p.cross(*w) + force, h.cross(*w) + p.cross(*v) + moment];
        let [v_rate, w_rate] = Self::times(&self.inverse, rates);
        let turning = r * w.hat();
        let rows = [0, 1, 2].map(|i| turning.row(i));
        [rows[0], rows[1], rows[2], r * *v, v_rate, w_rate]
    }

    fn step(&self, y: &Motion, h: f64) -> Motion {
        let ahead = |k: &Motion, h: f64| core::array::from_fn(|i| y[i] + k[i] * h);
        let first = self.rate(y);
        let second = self.rate(&ahead(&first, 0.5 * h));
        let third = self.rate(&ahead(&second, 0.5 * h));
        let fourth = self.rate(&ahead(&third, h));
        let sum = |i: usize| first[i] + (second[i] + third[i]) * 2.0 + fourth[i];
        core::array::from_fn(|i| y[i] + sum(i) * (h / 6.0))
    }
}

/// Gauss and Jordan's elimination.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    for k in 0..b.len() {
        let pivot = (k..b.len()).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs()));
        let pivot = pivot.expect("a row");
        a.swap(k, pivot);
        b.swap(k, pivot);
        let (row, right) = (a[k].clone(), b[k]);
        for i in (0..b.len()).filter(|i| *i != k) {
            let factor = a[i][k] / row[k];
            a[i].iter_mut()
                .zip(&row)
                .for_each(|(a, r)| *a -= factor * r);
            b[i] -= factor * right;
        }
    }
    (0..b.len()).map(|k| b[k] / a[k][k]).collect()
}

/// The scene about the mass centre, and the tables' equations about the origin.
#[test]
fn remus_moves_as_by_prestero_s_equations() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/loads/remus.toml");
    let text = std::fs::read_to_string(path).expect("the scene");
    let text = text + "angular_velocity = [0.3, -0.1, 0.4]\n";
    let (until, h) = (20.0, 1e-3);
    let (model, state) = end(&text, until, 0.02);
    let remus = Remus::new();
    let r = Mat3::diagonal([1.0, -1.0, -1.0]);
    let (origin, w) = (r * -Remus::G, Vec3([0.3, -0.1, 0.4]));
    let v = -w.cross(Remus::G);
    let mut motion = [r.row(0), r.row(1), r.row(2), origin, v, w];
    for _ in 0..(until / h).round() as u32 {
        motion = remus.step(&motion, h);
    }
    let [a, b, c, x, _, w] = motion;
    let told = Mat3([a.0, b.0, c.0]);
    let found = *model.attitudes(state.t, &state.g).expect("a state")[0].matrix();
    let at_g = x + told * Remus::G;
    let centre = model.centre_positions(state.t, &state.g).expect("a state")[0];
    let rates = model.velocity(&state).expect("a state").0[0].vec3();
    let off = [
        (found - told).frobenius(),
        (centre - at_g).norm(),
        (rates - w).norm(),
    ];
    println!("after {until} s at {centre:?}: off by {off:?}");
    // The error of the method of order 4, and the digits of the scene's volume.
    assert!(off.iter().all(|off| *off < 1e-8), "{off:?}");
    assert!(centre.norm() > 5.0, "it goes somewhere");
}

/// Straight ahead, neutral and level: the table's 1.54 m/s.
#[test]
fn remus_comes_to_its_speed() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/loads/remus.toml");
    let text = std::fs::read_to_string(path).expect("the scene");
    let straight = text
        .replace("gravity = [0, 0, -9.81]", "gravity = [0, 0, 0]")
        .replace("at = [-0.72, 0, -0.0196]", "at = [-0.72, 0, 0]");
    let couples = straight.replace("-0.018228", "0");
    let (model, state) = end(&couples, 200.0, 0.1);
    let speed = model.velocity(&state).expect("a state").1[0].vec3().norm();
    println!("{speed} m/s");
    // Smoothed below 0.01 m/s.
    assert!((speed - (3.86_f64 / 1.62).sqrt()).abs() < 0.006, "{speed}");
}
