//! A net of rigid nodes that falls into its own hanging shape, by its Lagrangian alone, and what its steps cost.
//!
//! `cargo run --release --example net` draws `out/net.png`.
//!
//! Two corners are held. Neighbours are held together by springs against extension and shear, $\frac k2 |x_j - x_i - R_i e|^2$, and against bending,
//! $\frac\kappa2 (3 - \operatorname{tr} R_i^T R_j)$. Elimination on a lattice fills in: a step grows faster than its nodes.

use std::time::Instant;

use figure::{Colour, Figure, Line, Panel, Style};
use lgvi::dvi::{
    Context, Integrator, Lagrangian, Quadrature, State, StepError, System, Variational,
};
use lgvi::lie::{LieGroup, Power, SE3, SO3, Scalar, Tangent, Vec3};

/// Square, with so many nodes along a side.
#[derive(Clone, Copy)]
struct Net {
    side: usize,
}

/// m, from corner to corner.
const SIDE: f64 = 1.0;
/// kg, of all nodes; m, of a node's radius of gyration beside the distance of two.
const MASS: f64 = 0.5;
const GYRATION: f64 = 0.3;
/// N/m and N m, of a thread between two nodes; of the springs that hold a corner, N/m.
const STRETCH: f64 = 200.0;
const BEND: f64 = 0.01;
const HOLD: f64 = 1e4;
/// N/kg.
const GRAVITY: f64 = 9.81;

impl Net {
    fn distance(self) -> f64 {
        SIDE / (self.side - 1) as f64
    }

    fn place(self, i: usize) -> Vec3 {
        let [row, column] = [i / self.side, i % self.side].map(|k| k as f64 * self.distance());
        Vec3([row, column, 0.0])
    }

    /// Neighbours, with what leads from one to the other.
    fn threads(self) -> impl Iterator<Item = (usize, usize, Vec3)> {
        let side = self.side;
        let [along, across] = [
            Vec3([0.0, self.distance(), 0.0]),
            Vec3([self.distance(), 0.0, 0.0]),
        ];
        (0..side * side).flat_map(move |i| {
            let next = (i % side + 1 < side).then_some((i, i + 1, along));
            let below = (i + side < side * side).then_some((i, i + side, across));
            next.into_iter().chain(below)
        })
    }
}

impl System for Net {
    type Group = Power<SE3>;
}

impl Lagrangian for Net {
    fn value<S: Scalar>(&self, _: Context<S>, g: &Power<SE3<S>>, xi: &Power<Tangent<6, S>>) -> S {
        let sum = |sum: S, term: S| sum + term;
        let mass = MASS / (self.side * self.side) as f64;
        let inertia = mass * (GYRATION * self.distance()).powi(2);
        let kinetic = xi.iter().map(|xi| {
            let (omega, v) = xi.split();
            omega.dot(omega).times(inertia) + v.dot(v).times(mass)
        });
        let weight = g
            .iter()
            .map(|g| g.translation[2].times(2.0 * mass * GRAVITY));
        let threads = self.threads().map(|(i, j, e)| {
            let (a, b) = (&g[i], &g[j]);
            let apart = b.translation - a.translation - a.rotation.rotate(e.lift());
            let (p, r) = (a.rotation.matrix(), b.rotation.matrix());
            let trace = (0..3).map(|k| p.row(k).dot(r.row(k))).fold(S::zero(), sum);
            apart.dot(apart).times(STRETCH) + (S::from_f64(3.0) - trace).times(BEND)
        });
        let held = [0, self.side - 1].map(|i| {
            let off = g[i].translation - self.place(i).lift();
            off.dot(off).times(HOLD)
        });
        let potential = weight.chain(threads).chain(held).fold(S::zero(), sum);
        (kinetic.fold(S::zero(), sum) - potential).times(0.5)
    }
}

/// Flat and at rest.
fn start(net: Net) -> State<Power<SE3>> {
    let nodes = (0..net.side * net.side).map(|i| SE3::new(SO3::identity(), net.place(i)));
    let g = Power::new(nodes.collect());
    let mu = g.zero_dual();
    State { t: 0.0, g, mu }
}

/// The threads as one line, seen from the side: width and height.
fn outline(net: Net, state: &State<Power<SE3>>, colour: Colour) -> Line {
    let seen = |i: usize| {
        let [x, y, z] = state.g[i].translation.0;
        (y + 0.35 * x, z - 0.2 * x)
    };
    let gap = (f64::NAN, f64::NAN);
    let points = net.threads().flat_map(|(i, j, _)| [seen(i), seen(j), gap]);
    Line {
        label: format!("{:.1} s", state.t),
        colour,
        style: Style::Solid,
        marker: None,
        points: points.collect(),
    }
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    const H: f64 = 2e-3;
    println!("a net of N x N nodes, steps of {H} s by the midpoint rule; times in milliseconds");
    println!(
        "   N  first step  later step  a node  evaluations  energy error / weight x side  derivatives"
    );
    for side in [4, 8, 16] {
        let net = Net { side };
        let mut integrator = Variational::new(net.discretise(Quadrature::Midpoint));
        let mut state = start(net);
        let clock = Instant::now();
        let means = integrator.step(&mut state, H)?.means;
        let first = clock.elapsed().as_secs_f64();
        let (energy, clock) = (net.hamiltonian(), Instant::now());
        let (before, mut evaluations) = (energy.energy(&state), 0);
        const STEPS: u32 = 100;
        for _ in 0..STEPS {
            evaluations += integrator.step(&mut state, H)?.evaluations;
        }
        let later = clock.elapsed().as_secs_f64() / f64::from(STEPS);
        let off = (energy.energy(&state) - before).abs() / (MASS * GRAVITY * SIDE);
        let [first, later, each] = [first, later, later / (side * side) as f64].map(|t| t * 1e3);
        println!(
            "{side:4}  {first:10.1}  {later:10.2}  {each:6.3}  {:11.1}  {off:29.1e}  {means}",
            f64::from(evaluations) / f64::from(STEPS)
        );
    }
    draw()
}

/// The net at some times of its fall.
fn draw() -> Result<(), Box<dyn core::error::Error>> {
    let net = Net { side: 16 };
    let mut integrator = Variational::new(net.discretise(Quadrature::Midpoint));
    let mut state = start(net);
    let mut lines = Vec::new();
    for (until, colour) in [
        (0.0, Colour::Black),
        (0.2, Colour::Blue),
        (0.4, Colour::Vermillion),
    ] {
        run(&mut integrator, &mut state, until)?;
        lines.push(outline(net, &state, colour));
    }
    let panel = Panel {
        title: "held at two corners".into(),
        x_label: "y + 0.35 x [m]".into(),
        y_label: "z - 0.2 x [m]".into(),
        lines,
        ..Panel::default()
    };
    let drawn = Figure {
        title: "A net of 16 x 16 rigid nodes falls".into(),
        plot_height: 900.0,
        panels: vec![panel],
        ..Figure::default()
    }
    .render()?;
    std::fs::create_dir_all("out")?;
    lgvi::sim::file::write("out/net.png", drawn.png)?;
    println!("drawn to out/net.png");
    Ok(())
}

fn run(
    integrator: &mut impl Integrator<Group = Power<SE3>>,
    state: &mut State<Power<SE3>>,
    until: f64,
) -> Result<(), StepError> {
    const H: f64 = 2e-3;
    while state.t < until - 0.5 * H {
        integrator.step(state, H)?;
    }
    Ok(())
}
