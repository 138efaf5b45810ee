//! Steps by what was recorded are those by dual numbers.

use dvi::{
    Composition, DualSystem, FirstVariation, Gauss, Integrator, Lagrangian, Means, Quadrature,
    State, TracedSystem, Variation, Variational,
};
use lie::{RealGroup, VectorSpace};

use crate::beam::{BEAM, Beam, apart, bent};
use crate::by_jets::ByJets;
use crate::means::{Top, top};

/// A step of an integrator, with the variations carried along.
type Step<'a, G> = dyn FnMut(&mut State<G>, &mut [Variation<G>]) -> Means + 'a;

/// The largest distance of states and variations after some steps.
fn far<G: RealGroup>(
    one: &mut Step<'_, G>,
    two: &mut Step<'_, G>,
    start: &State<G>,
    mut columns: Vec<Variation<G>>,
) -> f64 {
    let (mut a, mut b, mut others) = (start.clone(), start.clone(), columns.clone());
    for _ in 0..5 {
        assert_eq!(one(&mut a, &mut columns), Means::Recorded);
        assert_ne!(two(&mut b, &mut others), Means::Recorded);
    }
    let columns = columns.iter().zip(&others).map(|(x, y)| {
        let size = y.eta.max_magnitude() + y.mu.max_magnitude();
        let mut eta = x.eta.clone();
        eta.add_scaled(-1.0, &y.eta);
        let mut mu = x.mu.clone();
        mu.add_scaled(-1.0, &y.mu);
        (eta.max_magnitude() + mu.max_magnitude()) / size
    });
    columns.fold(apart(&a, &b), f64::max)
}

fn agree<L: Lagrangian + Clone + 'static>(lagrangian: &L, start: &State<L::Group>, h: f64) {
    let g = &start.g;
    let mut columns: Vec<_> = Variation::basis(g).into_iter().step_by(5).collect();
    columns.extend(Variation::parameters(lagrangian, g));
    macro_rules! step {
        ($integrator:expr) => {{
            let mut integrator = $integrator;
            move |state: &mut State<L::Group>, columns: &mut [Variation<L::Group>]| {
                integrator.step_varied(state, columns, h).unwrap().means
            }
        }};
    }
    for rule in Quadrature::ALL {
        let discrete = || lagrangian.clone().discretise(rule);
        let far = far(
            &mut step!(Variational::new(discrete())),
            &mut step!(Variational::new(ByJets(discrete()))),
            start,
            columns.clone(),
        );
        assert!(far < TOLERANCE, "{rule:?}: {far:e}");
    }
    let far = far(
        &mut step!(Gauss::new::<3>(lagrangian.clone().hamiltonian())),
        &mut step!(Gauss::new::<3>(DualSystem(lagrangian.clone()))),
        start,
        columns.clone(),
    );
    assert!(far < TOLERANCE, "Gauss: {far:e}");
}

/// Five steps solved to 1e-13 and their derivatives, of a system that is stiff.
const TOLERANCE: f64 = 1e-10;

#[test]
fn of_a_top() {
    agree(&Top, &top(), 0.02);
}

#[test]
fn of_a_beam_and_of_a_ring_with_their_parameters() {
    agree(&BEAM, &bent(3, false), 1e-4);
    agree(&Beam { ring: true, ..BEAM }, &bent(4, true), 1e-4);
}

#[test]
fn of_a_composition() {
    let discrete = BEAM.discretise(Quadrature::LeftPoint);
    let (mut a, mut b) = (bent(3, false), bent(3, false));
    let mut one = Composition::new::<4>(discrete.clone());
    let mut two = Composition::new::<4>(ByJets(discrete));
    for _ in 0..5 {
        assert_eq!(one.step(&mut a, 1e-4).unwrap().means, Means::Recorded);
        two.step(&mut b, 1e-4).unwrap();
    }
    assert!(apart(&a, &b) < TOLERANCE);
}

/// With enough unknowns Newton's matrix is sparse; that of dual numbers is dense.
#[test]
fn of_longer_beams_and_rings_with_a_sparse_matrix() {
    for ring in [false, true] {
        let beam = Beam { ring, ..BEAM };
        let start = bent(9, ring);
        let columns: Vec<_> = Variation::basis(&start.g).into_iter().step_by(17).collect();
        let h = 1e-4;
        let mut one = Variational::new(beam.clone().discretise(Quadrature::Midpoint));
        let mut two = Variational::new(ByJets(beam.discretise(Quadrature::Midpoint)));
        let far = far(
            &mut |state, columns| one.step_varied(state, columns, h).unwrap().means,
            &mut |state, columns| two.step_varied(state, columns, h).unwrap().means,
            &start,
            columns,
        );
        assert!(far < TOLERANCE, "{far:e}");
    }
}

/// By counting: instructions of the program grow as the beam does, and a step takes as many runs of it.
#[test]
fn a_beam_costs_as_much_a_node_however_long_it_is() {
    let costs = |nodes: usize, ring: bool| {
        let (mut state, beam) = (bent(nodes, ring), Beam { ring, ..BEAM });
        let system = TracedSystem::new(&beam, &state.g).unwrap();
        let mut integrator = Variational::new(beam.discretise(Quadrature::Midpoint));
        let report = integrator.step(&mut state, 1e-4).unwrap();
        (system.program().instructions(), report.evaluations)
    };
    for ring in [false, true] {
        let [few, some, many] = [20, 40, 80].map(|nodes| costs(nodes, ring));
        assert!(
            many.0 - some.0 <= 2 * (some.0 - few.0),
            "{few:?} {some:?} {many:?}"
        );
        // Each renewal of the matrix takes the same few colours.
        assert!(many.1 <= 2 * few.1, "{few:?} {some:?} {many:?}");
    }
}
