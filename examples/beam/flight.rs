//! A beam thrown into the air: its energy and its momenta over many steps.

use lgvi::dvi::{Gauss, Integrator, Lagrangian, Quadrature, State, Variational};
use lgvi::lie::{LieGroup, Power, SE3, Tangent};

use super::cantilever::line;
use super::model::Beam;
use figure::{Colour, Figure, Panel, Scale};

/// Cut into pieces of 10 cm.
pub const BEAM: Beam = Beam {
    piece: 0.1,
    bends: None,
};
const NODES: usize = 20;

/// Bent by one radian along its length, and turning.
pub fn start(nodes: usize) -> State<Power<SE3>> {
    let step = SE3::cayley(&Tangent([
        0.0,
        0.0,
        1.0 / nodes as f64,
        BEAM.piece,
        0.0,
        0.0,
    ]));
    let mut g = vec![SE3::identity()];
    for i in 1..nodes {
        g.push(g[i - 1].compose(&step));
    }
    let g = Power::new(g);
    let mut xi = g.zero_algebra();
    for (i, xi) in xi.iter_mut().enumerate() {
        xi[4] = 0.2 * (0.3 * i as f64).cos();
    }
    BEAM.state(0.0, g, &xi).expect("one velocity a node")
}

/// Angular and linear momentum in space.
fn momentum(state: &State<Power<SE3>>) -> [f64; 6] {
    let mut of_each = state.g.zero_dual();
    state.g.inverse_coadjoint_into(&state.mu, &mut of_each);
    core::array::from_fn(|k| of_each.iter().map(|mu| mu[k]).sum())
}

pub fn show(steps: u32) -> Result<(), Box<dyn core::error::Error>> {
    println!(
        "{NODES} nodes in free flight, {steps} steps of midpoint, and the same time by gauss-8"
    );
    println!("method    step [s]  energy, worst / first  momenta, worst / largest");
    let midpoint = Variational::new(BEAM.discretise(Quadrature::Midpoint));
    let runs = [
        run("midpoint", Colour::Blue, midpoint, 5e-4, steps)?,
        run(
            "gauss-8",
            Colour::Vermillion,
            Gauss::new::<4>(BEAM.hamiltonian()),
            2e-3,
            steps / 4,
        )?,
    ];
    let titles = [
        "(a) energy error over energy",
        "(b) error of the momenta over the largest",
    ];
    let panels = titles.into_iter().enumerate().map(|(k, title)| Panel {
        title: title.into(),
        x_label: "t [s]".into(),
        y_scale: Scale::Log,
        lines: runs
            .iter()
            .map(|[energy, momenta]| {
                if k == 0 {
                    energy.clone()
                } else {
                    momenta.clone()
                }
            })
            .collect(),
        ..Panel::default()
    });
    let drawn = Figure {
        title: format!("A beam of {NODES} nodes in free flight"),
        columns: 2,
        panels: panels.collect(),
        ..Figure::default()
    }
    .render()?;
    std::fs::create_dir_all("out")?;
    lgvi::sim::file::write("out/flight.png", drawn.png)?;
    println!("drawn to out/flight.png");
    Ok(())
}

/// The errors of energy and momenta over time.
fn run(
    name: &str,
    colour: Colour,
    mut integrator: impl Integrator<Group = Power<SE3>>,
    h: f64,
    steps: u32,
) -> Result<[figure::Line; 2], Box<dyn core::error::Error>> {
    /// Steps between two points of a curve.
    const EVERY: u32 = 100;
    let system = BEAM.hamiltonian();
    let mut state = start(NODES);
    let (energy, momenta) = (system.energy(&state), momentum(&state));
    let largest = momenta.iter().fold(0.0, |max: f64, p| max.max(p.abs()));
    let mut errors = [Vec::new(), Vec::new()];
    for k in 1..=steps {
        integrator.step(&mut state, h)?;
        if k % EVERY != 0 {
            continue;
        }
        let moved = momentum(&state).into_iter().zip(momenta);
        let moved = moved.fold(0.0, |max: f64, (now, then)| max.max((now - then).abs()));
        let off = (system.energy(&state) - energy).abs();
        errors[0].push((state.t, off / energy.abs()));
        errors[1].push((state.t, moved / largest));
    }
    let worst = |points: &[(f64, f64)]| points.iter().fold(0.0, |max: f64, (_, y)| max.max(*y));
    println!(
        "{name:8}  {h:8}  {:21.2e}  {:.2e}",
        worst(&errors[0]),
        worst(&errors[1])
    );
    Ok(errors.map(|points| line(name.into(), colour, points)))
}
