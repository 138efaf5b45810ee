//! Where methods fail: every class by a real run, every wall, what a parameter does to a scene, and the grid's bounds.

use std::time::Duration;

use articulated_fluid::Scene;
use study::contender::Contender;
use study::stability::{
    Class, Grid, Map, Outcome, Pace, Parameter, ParameterError, UnknownParameter, Wall, csv,
    picture,
};

const PAPER: &str = include_str!("../../../../scenes/fish-chain.toml");
const SEMI_AXES: &str = include_str!("../../../../scenes/fish-chain-from-semi-axes.toml");
const FROM_REST: &str = include_str!("../../../../scenes/hard/from-rest.toml");
/// It turns steadily at 0.5 rad/s.
const TOP: &str = "
    [fluid]
    density = 0
    [[body]]
    name = 'top'
    semi_axes = [2, 2, 1]
    mass = 1
    angular_velocity = [0, 0, 0.5]
";

fn scene(text: &str) -> Scene {
    Scene::parse(text, "scene.toml").unwrap()
}

fn pace(seconds: u64) -> Pace<'static> {
    Pace {
        budget: Duration::from_secs(seconds),
        stop: &|| false,
        done: &|| (),
    }
}

fn map(
    text: &str,
    (parameter, values): (Parameter, &[f64]),
    names: &[&str],
    steps: &[f64],
    until: f64,
) -> Map {
    let methods: Vec<Contender> = names.iter().map(|name| name.parse().unwrap()).collect();
    let grid = Grid::new(parameter, values, &methods, steps, until);
    Map::new(&scene(text), grid, &pace(600)).unwrap()
}

/// A method on a scene as it is.
fn single(text: &str, name: &str, h: f64, until: f64) -> Map {
    map(text, (Parameter::Spin, &[1.0]), &[name], &[h], until)
}

fn outcome(text: &str, name: &str, h: f64, until: f64) -> Outcome {
    single(text, name, h, until).cell(0, 0, 0).clone()
}

#[test]
fn every_class_is_one_of_a_real_run() {
    for (name, h, until, class) in [
        ("lgvi", 0.05, 50.0, Class::Good),
        ("gauss-2", 0.1, 50.0, Class::Good),
        ("composition-2", 0.25, 60.0, Class::EnergyBand),
        ("rk4", 0.08, 400.0, Class::EnergyDrift),
        ("rk4", 0.04, 100.0, Class::GroupLeft),
        ("rkmk4", 0.04, 100.0, Class::MomentumLost),
        ("lgvi", 1.0, 10.0, Class::Refused),
        ("rk4", 1e60, 1e60, Class::NonFinite),
    ] {
        let found = outcome(PAPER, name, h, until);
        assert_eq!(found.class, class, "{name} {h}: {found:?}");
        assert_eq!(
            found.failure.is_some(),
            matches!(class, Class::Refused | Class::NonFinite)
        );
        assert_eq!(found.refused_at.is_some(), class == Class::Refused);
        let reached = matches!(
            class,
            Class::Good | Class::EnergyDrift | Class::GroupLeft | Class::MomentumLost
        );
        assert_eq!(found.t >= 0.999 * until, reached, "{name} {h}: {found:?}");
    }
}

/// The first step's error is as large as its energy, which is no energy of the motion to compare it with.
#[test]
fn a_start_from_rest_is_judged_by_the_motion_that_follows() {
    let found = outcome(FROM_REST, "lgvi", 1e-3, 4.0);
    assert_eq!(found.class, Class::Good, "{found:?}");
    let energy = found.energy.unwrap();
    assert!(energy > 1e-5 && energy < 0.01, "{found:?}");
}

#[test]
fn a_steady_turn_in_long_steps_is_silently_wrong() {
    // Two half steps of sin(theta) = h omega / 2 keep all there is to keep.
    let turned = |h: f64| 2.0 * (0.25 * h).asin();
    for (h, class) in [(2.6, Class::Good), (3.995, Class::SilentlyWrong)] {
        let found = outcome(TOP, "composition-2", h, 80.0);
        let angle = found.attitude.unwrap();
        assert_eq!(found.class, class, "{found:?}");
        assert!((turned(h) - 0.5 * h - angle).abs() < 1e-6, "{found:?}");
        assert!(found.energy.unwrap() < 1e-12 && found.momentum.unwrap() < 1e-12);
    }
    let wall = single(TOP, "composition-2", 3.995, 80.0).limit(0, 0).wall;
    assert_eq!(wall, Wall::Wrong);
}

#[test]
fn the_equation_of_a_steady_turn_ends_where_the_sine_does() {
    // sin(theta) = h omega has no solution beyond h = 2 s.
    let names = ["lgvi"];
    let map = map(
        TOP,
        (Parameter::Spin, &[1.0, 2.0]),
        &names,
        &[0.4, 0.9, 1.9, 2.5],
        50.0,
    );
    for (value, (step, next)) in [(Some(1.9), Some(3)), (Some(0.9), Some(2))]
        .into_iter()
        .enumerate()
    {
        let limit = map.limit(0, value);
        assert_eq!((limit.step, limit.next), (step, next), "{limit:?}");
        let Wall::Equation { ends } = limit.wall else {
            panic!("{limit:?}");
        };
        let exact = 2.0 / map.grid.values[value];
        assert!((0.99..=1.0).contains(&(ends / exact)), "{ends} {exact}");
    }
}

#[test]
fn walls_are_told_apart_and_luck_is_no_limit() {
    let names = ["lgvi", "composition-2", "rk4", "gauss-4"];
    let map = map(
        PAPER,
        (Parameter::Spin, &[1.0]),
        &names,
        &[0.25, 0.05],
        60.0,
    );
    assert_eq!(map.grid.steps, [0.05, 0.25]);
    let wall = |method| map.limit(method, 0).wall;
    assert!(
        matches!(wall(0), Wall::Equation { ends } if (0.1..0.25).contains(&ends)),
        "{:?}",
        wall(0)
    );
    assert_eq!(wall(1), Wall::Dynamics(Class::EnergyBand));
    assert_eq!(wall(2), Wall::Structure(Class::GroupLeft));
    assert_eq!(
        (map.limit(0, 0).step, map.limit(2, 0).step),
        (Some(0.05), None)
    );

    let table = csv(&map);
    let columns = |line: &str| line.split('"').next().unwrap().matches(',').count();
    assert_eq!(table.lines().count(), map.grid.len() + 1);
    assert!(table.lines().all(|line| columns(line) == 14), "{table}");
    assert!(table.contains("equation,\"step"), "{table}");

    let drawn = picture(&map, "a map");
    assert_eq!((drawn.maps.len(), drawn.kinds.len()), (4, 8));
    assert!(drawn.maps.iter().all(|tiles| tiles.kinds.len() == 2));
    let svg = drawn.render().unwrap().svg;
    assert!(svg.contains("composition-2") && svg.contains("silently wrong"));
}

#[test]
fn without_forces_a_faster_start_is_another_unit_of_time() {
    // By two, which changes no digit of a number.
    let one = map(
        PAPER,
        (Parameter::Spin, &[1.0]),
        &["lgvi", "rk4"],
        &[0.1],
        40.0,
    );
    let two = map(
        PAPER,
        (Parameter::Spin, &[2.0]),
        &["lgvi", "rk4"],
        &[0.05],
        20.0,
    );
    for method in 0..2 {
        let (one, two) = (one.cell(method, 0, 0), two.cell(method, 0, 0));
        assert_eq!(one.class, two.class);
        assert!((one.energy.unwrap() / two.energy.unwrap() - 1.0).abs() < 1e-6);
        assert_eq!(one.t, 2.0 * two.t);
    }
}

#[test]
fn what_has_no_time_is_marked_and_not_dropped() {
    let methods = [
        "lgvi".parse().unwrap(),
        "dp853".parse().unwrap(),
        "lgvi".parse().unwrap(),
    ];
    let grid = Grid::new(
        Parameter::Spin,
        &[2.0, 1.0, 2.0],
        &methods,
        &[0.01, 1.0],
        1e9,
    );
    // One that chooses its steps has no place, and what is there twice counts once.
    assert_eq!(
        (grid.methods.len(), grid.values.as_slice()),
        (1, &[1.0, 2.0][..])
    );
    assert_eq!((grid.len(), grid.is_empty()), (4, false));
    let done = std::sync::atomic::AtomicUsize::new(0);
    let pace = Pace {
        budget: Duration::from_millis(200),
        stop: &|| false,
        done: &|| {
            done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        },
    };
    let map = Map::new(&scene(PAPER), grid, &pace).unwrap();
    assert_eq!(done.load(std::sync::atomic::Ordering::Relaxed), 4);
    assert_eq!(
        (map.count(Class::NotRun), map.count(Class::Refused)),
        (2, 2)
    );
    assert_eq!(map.limit(0, 0).wall, Wall::Unknown);
    assert_eq!(picture(&map, "").kinds.len(), 9);

    let stopped = Pace {
        stop: &|| true,
        ..pace
    };
    let map = Map::new(&scene(PAPER), map.grid, &stopped).unwrap();
    assert_eq!(map.count(Class::NotRun), 4);
}

#[test]
fn a_parameter_changes_what_it_says() {
    let original = scene(SEMI_AXES);
    for parameter in Parameter::all() {
        assert_eq!(parameter.name().parse(), Ok(parameter));
        let same = parameter.vary(&original, 1.0).unwrap();
        match parameter {
            Parameter::Stiffness => assert_eq!(same.joints[1].mobility.stiffness, 1.0),
            _ => {
                for (a, b) in same.bodies.iter().zip(&original.bodies) {
                    let entries = a
                        .total_mass
                        .as_flattened()
                        .iter()
                        .zip(b.total_mass.as_flattened());
                    assert!(
                        entries.clone().all(|(a, b)| (a - b).abs() < 1e-12),
                        "{parameter}"
                    );
                }
            }
        }
    }

    let long = Parameter::Aspect.vary(&original, 2.0).unwrap();
    assert_eq!(long.bodies[0].semi_axes(), Some([16.0, 1.5, 2.0]));
    assert_eq!(
        (long.joints[0].at_parent, long.joints[0].at_child),
        ([17.6, 0.0, 0.0], [-11.0, 0.0, 0.0])
    );
    // Twice the mass, and ever less added to it along the axis.
    let along = |scene: &Scene| scene.bodies[0].total_mass[0][0];
    assert!((1.9..2.0).contains(&(along(&long) / along(&original))));

    let heavy = Parameter::MassRatio.vary(&original, 3.0).unwrap();
    assert_eq!(heavy.bodies[0], original.bodies[0]);
    assert_eq!(
        heavy.bodies[2].total_inertia[1][1],
        3.0 * original.bodies[2].total_inertia[1][1]
    );

    let fast = Parameter::Spin.vary(&original, 0.5).unwrap();
    assert_eq!(fast.bodies[0].angular_velocity, [0.1, 0.05, 0.25]);
}

#[test]
fn a_scene_that_cannot_be_varied_so_says_why() {
    let matrices = Parameter::Aspect.vary(&scene(PAPER), 2.0);
    let error = matrices.unwrap_err();
    assert_eq!(
        error,
        ParameterError::NotAnEllipsoid {
            body: "head".into()
        }
    );
    assert!(error.to_string().contains("semi_axes"), "{error}");
    for parameter in [Parameter::MassRatio, Parameter::Stiffness] {
        let alone = parameter.vary(&scene(TOP), 2.0).unwrap_err();
        assert_eq!(alone, ParameterError::NoTail { parameter });
    }
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Parameter::Spin.vary(&scene(TOP), value);
        assert!(
            matches!(refused, Err(ParameterError::Value { .. })),
            "{value}"
        );
    }
    let huge = Parameter::Aspect.vary(&scene(SEMI_AXES), 1e200);
    assert!(
        matches!(huge, Err(ParameterError::Ellipsoid { .. })),
        "{huge:?}"
    );
    let overflows = Parameter::MassRatio.problem(&scene(PAPER), 1e308, 1.0);
    assert!(
        matches!(overflows, Err(ParameterError::Model { .. })),
        "{overflows:?}"
    );
    let unknown = "length".parse::<Parameter>().unwrap_err();
    assert_eq!(
        unknown,
        UnknownParameter {
            name: "length".into()
        }
    );
    assert!(unknown.to_string().contains("mass-ratio"), "{unknown}");
}
