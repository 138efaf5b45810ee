//! A clamped beam that a torque at its end bends into a circle.
//!
//! A beam that bends by $M / EI$ everywhere closes where $M = 2 \pi EI / L$. Pieces whose strain is that of the Cayley map bend a little less:
//! the gap falls with the square of their length.

use lgvi::dvi::{
    Context, ContinuousSystem, Force, Integrator, Lagrangian, Quadrature, State, System,
    TracedSystem, Variational,
};
use lgvi::lie::{
    self, Cayley, Cotangent, Jet, LieGroup, Lu, Over, Power, RealGroup, SE3, Scalar, Tangent,
    VectorSpace,
};

use super::model::{Beam, STIFFNESS};
use figure::{Colour, Figure, Line, Marker, Panel, Scale, Style};

type J = <f64 as Scalar>::Jet;

/// m.
const LENGTH: f64 = 1.0;

/// The torque at the end, which is the beam's parameter.
#[derive(Clone, Copy)]
struct Torque;

impl Force for Torque {
    type Group = Power<SE3>;

    fn force<S: Scalar>(
        &self,
        at: Context<S>,
        _: &Power<SE3<S>>,
        _: &Power<Tangent<6, S>>,
        out: &mut Power<Cotangent<6, S>>,
    ) {
        let [torque] = at.parameters();
        if let Some(end) = out.iter_mut().last() {
            end[2] = torque;
        }
    }
}

/// The beam with these strains of its pieces: of the Cayley map, $\epsilon \ell$.
fn strained(pieces: &[Tangent<6>]) -> Power<SE3> {
    let piece = LENGTH / pieces.len() as f64;
    let mut g = Vec::with_capacity(pieces.len());
    let mut last = SE3::identity();
    for strain in pieces {
        let mut c = *strain;
        c[3] += piece;
        last = last.compose(&SE3::cayley(&c));
        g.push(last);
    }
    Power::new(g)
}

fn strains(g: &Power<SE3>) -> Option<Vec<Tangent<6>>> {
    let piece = LENGTH / g.len() as f64;
    let before = core::iter::once(SE3::identity()).chain(g.iter().copied());
    let strain = |(a, b): (SE3, &SE3)| {
        let mut c = a.inverse().compose(b).cayley_inverse().ok()?;
        c[3] -= piece;
        Some(c)
    };
    before.zip(g.iter()).map(strain).collect()
}

/// The beam at rest under a torque, by Newton's method with the derivatives of what is recorded.
///
/// The torque grows by parts, and the strains with it: Newton's method alone would stretch the beam sideways.
fn at_rest(nodes: usize, torque: f64) -> Result<Power<SE3>, Box<dyn core::error::Error>> {
    const PARTS: i32 = 16;
    const TRIES: u32 = 20;
    let piece = LENGTH / nodes as f64;
    let bends = Some([0.0]);
    let bent = Tangent([0.0, 0.0, torque / STIFFNESS[2] * piece, 0.0, 0.0, 0.0]);
    let mut g = strained(&vec![bent * (1.0 / f64::from(PARTS)); nodes]);
    let recorded = TracedSystem::new(&Beam { piece, bends }, &g)?.with_force(&Torque)?;
    for part in 1..=PARTS {
        let torque = torque * f64::from(part) / f64::from(PARTS);
        let system = recorded.clone().with_parameters(&[torque])?;
        // Convergence is quadratic: after a small correction the next would be rounding.
        if !(0..TRIES).any(|_| correct(&system, &mut g) < 1e-7) {
            return Err(format!("no rest is found for {nodes} nodes and {torque} N m").into());
        }
        if part < PARTS {
            let grows = f64::from(part + 1) / f64::from(part);
            let found = strains(&g).ok_or("a piece is bent by half a turn")?;
            g = strained(&found.iter().map(|c| *c * grows).collect::<Vec<_>>());
        }
    }
    Ok(g)
}

/// A correction by Newton's method of where no force is left; its size.
fn correct(system: &TracedSystem<Power<SE3>>, g: &mut Power<SE3>) -> f64 {
    let (dim, still) = (g.zero_dual().dim(), g.lift::<J>());
    let (mut xi, mut tau) = (still.zero_algebra(), still.zero_dual());
    let (mut zeta, mu) = (still.zero_algebra(), still.zero_dual());
    let parameters = system
        .parameters()
        .iter()
        .map(|p| J::constant(*p))
        .collect::<Vec<_>>();
    let (mut slopes, mut work) = (Lu::new(dim), Default::default());
    for first in (0..dim).step_by(lie::JET_DIRECTIONS) {
        lie::seed(&mut zeta, first);
        let there = still.compose(&Over::<Power<SE3>, J>::retract::<Cayley>(&zeta));
        let at = Context::new(J::constant(0.0), &parameters);
        system.velocity_and_force(at, &there, &mu, &mut work, &mut xi, &mut tau);
        for (direction, column) in slopes
            .columns_mut(first)
            .take(lie::JET_DIRECTIONS)
            .enumerate()
        {
            for (i, entry) in column.iter_mut().enumerate() {
                *entry = -tau.get(i).partial(direction);
            }
        }
    }
    slopes.factorise_form();
    let mut step: Vec<f64> = (0..dim).map(|i| tau.get(i).value()).collect();
    slopes.solve(&mut step, |entry| entry);
    let mut zeta = g.zero_algebra();
    zeta.read(&step);
    *g = g.compose(&Power::retract::<Cayley>(&zeta));
    zeta.max_magnitude()
}

/// How far a beam at rest moves in some steps, as a part of its length.
fn drift(g: &Power<SE3>, torque: f64) -> Result<f64, Box<dyn core::error::Error>> {
    let beam = Beam {
        piece: LENGTH / g.len() as f64,
        bends: Some([torque]),
    };
    let mut integrator = Variational::new(beam.discretise(Quadrature::Midpoint).with_force(Torque));
    let mut state = State {
        t: 0.0,
        g: g.clone(),
        mu: g.zero_dual(),
    };
    for _ in 0..100 {
        integrator.step(&mut state, 1e-3)?;
    }
    let moved = g
        .iter()
        .zip(state.g.iter())
        .map(|(a, b)| (a.translation - b.translation).norm());
    Ok(moved.fold(0.0, f64::max) / LENGTH)
}

fn curve(g: &Power<SE3>) -> Vec<(f64, f64)> {
    let places = g.iter().map(|g| (g.translation[0], g.translation[1]));
    core::iter::once((0.0, 0.0)).chain(places).collect()
}

pub fn show() -> Result<(), Box<dyn core::error::Error>> {
    let torque = core::f64::consts::TAU * STIFFNESS[2] / LENGTH;
    println!("a beam of {LENGTH} m, clamped, with {torque:.5} N m at its end");
    println!("     N  gap / length   order  moves in 0.1 s / length");
    let (mut gaps, mut lines, mut last) = (Vec::<(f64, f64)>::new(), Vec::new(), f64::NAN);
    let looks = [
        (10, Colour::Orange),
        (20, Colour::Vermillion),
        (40, Colour::Blue),
        (100, Colour::BluishGreen),
    ];
    for (nodes, colour) in looks {
        let g = at_rest(nodes, torque)?;
        let gap = g.iter().last().map_or(0.0, |end| end.translation.norm()) / LENGTH;
        let order = match gaps.last() {
            Some((before, _)) => (last / gap).ln() / (nodes as f64 / before).ln(),
            None => f64::NAN,
        };
        println!(
            "{nodes:6}  {gap:12.3e}  {order:6.2}  {:.1e}",
            drift(&g, torque)?
        );
        gaps.push((nodes as f64, gap));
        last = gap;
        lines.push(line(format!("{nodes} nodes"), colour, curve(&g)));
    }
    let mut gap = line("gap".into(), Colour::Black, gaps);
    gap.marker = Some(Marker::Circle);
    let drawn = Figure {
        title: "A cantilever bent into a circle by a torque at its end".into(),
        columns: 2,
        plot_height: 640.0,
        panels: vec![
            Panel {
                title: "(a) at rest".into(),
                x_label: "x [m]".into(),
                y_label: "y [m]".into(),
                lines,
                ..Panel::default()
            },
            Panel {
                title: "(b) where it does not close".into(),
                x_label: "nodes".into(),
                x_scale: Scale::Log,
                y_label: "gap / length".into(),
                y_scale: Scale::Log,
                lines: vec![gap],
                ..Panel::default()
            },
        ],
        ..Figure::default()
    }
    .render()?;
    std::fs::create_dir_all("out")?;
    lgvi::sim::file::write("out/cantilever.png", drawn.png)?;
    println!("drawn to out/cantilever.png");
    Ok(())
}

pub fn line(label: String, colour: Colour, points: Vec<(f64, f64)>) -> Line {
    Line {
        label,
        colour,
        style: Style::Solid,
        marker: None,
        points,
    }
}
