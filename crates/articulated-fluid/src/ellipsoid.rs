//! The ellipsoid in a perfect fluid: volume, own inertia, added mass and added inertia.
//!
//! An ellipsoid of semi-axes $a, b, c$ along its body axes moves in a fluid of density $\rho$
//! that is incompressible, without friction and without circulation, and at rest at infinity.
//! The fluid's kinetic energy is then a quadratic form of the body's velocity, diagonal in
//! the body's axes: the *added* mass and inertia. All of it follows from the shape factors
//!
//! $$
//! \alpha_i = abc \int_0^\infty \frac{d\lambda}
//! {(a_i^2+\lambda)\sqrt{(a^2+\lambda)(b^2+\lambda)(c^2+\lambda)}}
//! = \tfrac23\, abc\, R_D(a_j^2, a_k^2, a_i^2),
//! \qquad \alpha_1+\alpha_2+\alpha_3 = 2 ,
//! $$
//!
//! with Carlson's integral $R_D$.
//!
//! Source: H. Lamb, *Hydrodynamics*, 6th ed. (1932), §§ 114, 115 and 373;
//! [DLMF § 19.16](https://dlmf.nist.gov/19.16) for $R_D$.

use std::f64::consts::PI;

use thiserror::Error;

/// Below this $|b^2-c^2|/(b^2+c^2)$ a section counts as a circle: its square is rounding.
const ROUND_SECTION: f64 = 1e-8;

/// A solid ellipsoid, centred at the origin of its body frame with the semi-axes along $x, y, z$.
///
/// ```
/// use articulated_fluid::ellipsoid::Ellipsoid;
///
/// let ball = Ellipsoid::new([1.0, 1.0, 1.0])?;
/// let displaced = ball.neutral_mass(1000.0);
/// assert!((ball.added_mass(1000.0)[0] - displaced / 2.0).abs() < 1e-12 * displaced);
/// # Ok::<(), articulated_fluid::ellipsoid::EllipsoidError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    semi_axes: [f64; 3],
    shape_factors: [f64; 3],
}

/// Why three numbers are no ellipsoid.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum EllipsoidError {
    /// A semi-axis is NaN, infinite, zero or negative.
    #[error(
        "the semi-axis along {} is {value:?}; expected a finite number > 0, in m",
        ["x", "y", "z"].get(*axis).unwrap_or(&"?")
    )]
    NotPositive {
        /// Index of the semi-axis: 0, 1, 2 for $x, y, z$.
        axis: usize,
        /// The value given, m.
        value: f64,
    },
    /// The volume or the second moments of volume over- or underflow.
    #[error(
        "the volume of semi-axes {semi_axes:?} is out of range; expected lengths between about \
         1e-60 and 1e60, in m"
    )]
    OutOfRange {
        /// The values given, m.
        semi_axes: [f64; 3],
    },
    /// The semi-axes are so unequal that the shape factors cannot be computed.
    #[error("semi-axes {semi_axes:?} are too unequal; expected ratios below 1e150")]
    TooUnequal {
        /// The values given, m.
        semi_axes: [f64; 3],
    },
}

impl Ellipsoid {
    /// The ellipsoid with these semi-axes, m, along the body's $x, y, z$.
    ///
    /// # Errors
    ///
    /// [`EllipsoidError::NotPositive`] unless each is finite and $> 0$.
    /// [`EllipsoidError::OutOfRange`] if $abc$ or $abc a_i^2$ is no normal number.
    /// [`EllipsoidError::TooUnequal`] if a shape factor or a squared ratio of axes is no normal
    /// number (ratios above $10^{150}$ or so).
    pub fn new(semi_axes: [f64; 3]) -> Result<Self, EllipsoidError> {
        check_positive(semi_axes)?;
        check_range(semi_axes)?;
        let shape_factors =
            shape_factors(semi_axes).ok_or(EllipsoidError::TooUnequal { semi_axes })?;
        Ok(Self {
            semi_axes,
            shape_factors,
        })
    }

    /// The semi-axes $a, b, c$, m.
    pub fn semi_axes(&self) -> [f64; 3] {
        self.semi_axes
    }

    /// The shape factors $\alpha_i$, without unit: positive, with the sum 2.
    ///
    /// Lamb (1932), § 114: there $\alpha_0, \beta_0, \gamma_0$.
    pub fn shape_factors(&self) -> [f64; 3] {
        self.shape_factors
    }

    /// The volume $V = \tfrac43\pi abc$, m³.
    pub fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * product(self.semi_axes)
    }

    /// The mass $\rho V$ of the displaced fluid, kg: a body of this mass neither sinks nor rises.
    ///
    /// `density` is $\rho \ge 0$, kg/m³.
    pub fn neutral_mass(&self, density: f64) -> f64 {
        density * self.volume()
    }

    /// The inertia of the uniform solid of this `mass` about its centre, kg m², diagonal:
    ///
    /// $$ \tfrac m5 (b^2+c^2), \quad \tfrac m5 (c^2+a^2), \quad \tfrac m5 (a^2+b^2). $$
    pub fn dry_inertia(&self, mass: f64) -> [f64; 3] {
        let [a, b, c] = self.semi_axes;
        [(b, c), (c, a), (a, b)].map(|(y, z)| mass / 5.0 * (y * y + z * z))
    }

    /// The added mass, kg, diagonal:
    ///
    /// $$ m_i = \frac{\alpha_i}{2-\alpha_i} \rho V = \frac{\alpha_i}{\alpha_j+\alpha_k} \rho V. $$
    ///
    /// The second form keeps its digits for a disc, where $\alpha_i \to 2$. `density` is
    /// $\rho \ge 0$, kg/m³. Source: Lamb (1932), § 114.
    pub fn added_mass(&self, density: f64) -> [f64; 3] {
        let [alpha, beta, gamma] = self.shape_factors;
        let displaced = self.neutral_mass(density);
        [
            alpha / (beta + gamma),
            beta / (gamma + alpha),
            gamma / (alpha + beta),
        ]
        .map(|factor| factor * displaced)
    }

    /// The added inertia about the centre, kg m², diagonal; about the first axis
    ///
    /// $$
    /// J_1 = \frac{\rho V}5\,
    /// \frac{(b^2-c^2)^2(\gamma-\beta)}{2(b^2-c^2)+(b^2+c^2)(\beta-\gamma)}
    /// = \frac{\rho V}5\,\frac{(b^2-c^2)(\gamma-\beta)}{\alpha+2\mu},
    /// \qquad \mu = \frac{b^2\beta-c^2\gamma}{b^2-c^2} ,
    /// $$
    ///
    /// with $\alpha_i = (\alpha,\beta,\gamma)$. The second form, by $\alpha+\beta+\gamma=2$, is
    /// a quotient of positive terms: $\mu$ and $(\gamma-\beta)/(b^2-c^2)$ are integrals of
    /// positive functions.
    ///
    /// Accuracy: with $\delta = |b^2-c^2|/(b^2+c^2)$ and $x = \tfrac12(b^2+c^2)\,
    /// (\gamma-\beta)/(b^2-c^2)$ this is
    ///
    /// $$ J_1 = \frac{\rho V}5(b^2+c^2) \delta^2 \frac{x}{1-x}, \qquad 0 < x < 1 , $$
    ///
    /// and $x \le \tfrac12$ where $\delta \to 0$. The difference quotients lose a factor
    /// $1/\delta$, so the relative error is a few $\varepsilon/\delta$. For small
    /// $\delta$ the absolute error is a few $\varepsilon\delta$ of the inertia
    /// $\tfrac{\rho V}5(b^2+c^2)$ of the displaced fluid. Below $\delta = 10^{-8}$, where
    /// $J_1$ itself is below $\varepsilon$ of that inertia, 0 is returned.
    ///
    /// `density` is $\rho \ge 0$, kg/m³. Source: Lamb (1932), § 115.
    pub fn added_inertia(&self, density: f64) -> [f64; 3] {
        let [a, b, c] = self.semi_axes;
        let [alpha, beta, gamma] = self.shape_factors;
        let displaced = self.neutral_mass(density);
        [
            displaced / 5.0 * gyration([b, c], [alpha, beta, gamma]),
            displaced / 5.0 * gyration([c, a], [beta, gamma, alpha]),
            displaced / 5.0 * gyration([a, b], [gamma, alpha, beta]),
        ]
    }
}

/// $(b^2-c^2)(\gamma-\beta)/(\alpha+2\mu)$, m², see [`Ellipsoid::added_inertia`].
fn gyration([b, c]: [f64; 2], [alpha, beta, gamma]: [f64; 3]) -> f64 {
    let difference = (b - c) * (b + c);
    if difference.abs() < ROUND_SECTION * (b * b + c * c) {
        return 0.0;
    }
    let mu = (b * b * beta - c * c * gamma) / difference;
    difference * ((gamma - beta) / (alpha + 2.0 * mu))
}

/// $\alpha_i = \tfrac23 abc R_D(a_j^2, a_k^2, a_i^2)$ of the axes over the longest; `None` if
/// out of range.
fn shape_factors(semi_axes: [f64; 3]) -> Option<[f64; 3]> {
    let longest = semi_axes.into_iter().fold(0.0, f64::max);
    let axes = semi_axes.map(|axis| axis / longest);
    let squares = axes.map(|axis| axis * axis);
    if !squares.iter().all(|square| square.is_normal()) {
        return None;
    }
    let [a, b, c] = squares;
    let factor = |x: f64, y: f64, z: f64| {
        // Sorted, so that a permutation of the axes permutes the result to the last bit.
        let integral = ellip::elliprd(x.min(y), x.max(y), z).ok()?;
        let alpha = 2.0 / 3.0 * product(axes) * integral;
        alpha.is_normal().then_some(alpha)
    };
    Some([factor(b, c, a)?, factor(c, a, b)?, factor(a, b, c)?])
}

fn check_positive(semi_axes: [f64; 3]) -> Result<(), EllipsoidError> {
    for (axis, value) in semi_axes.into_iter().enumerate() {
        if !(value.is_finite() && value > 0.0) {
            return Err(EllipsoidError::NotPositive { axis, value });
        }
    }
    Ok(())
}

fn check_range(semi_axes: [f64; 3]) -> Result<(), EllipsoidError> {
    let volume = product(semi_axes);
    let representable = |axis: f64| (axis * axis).is_normal() && (axis * axis * volume).is_normal();
    if volume.is_normal() && semi_axes.into_iter().all(representable) {
        Ok(())
    } else {
        Err(EllipsoidError::OutOfRange { semi_axes })
    }
}

fn product([a, b, c]: [f64; 3]) -> f64 {
    a * b * c
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const EPS: f64 = f64::EPSILON;

    fn ellipsoid(semi_axes: [f64; 3]) -> Ellipsoid {
        Ellipsoid::new(semi_axes).expect("an ellipsoid")
    }

    #[track_caller]
    fn assert_close(actual: f64, expected: f64, tolerance: f64) {
        let error = (actual - expected).abs();
        assert!(
            error <= tolerance * expected.abs(),
            "{actual:e} is not {expected:e}: off by {error:e}"
        );
    }

    /// $\int_0^\infty f(\lambda) d\lambda$ by the trapezoid rule in $\ln\lambda$, which
    /// converges exponentially for these integrands.
    fn quadrature(scale: f64, f: impl Fn(f64) -> f64) -> f64 {
        const STEP: f64 = 1.0 / 16.0;
        (-1600..=1600)
            .map(|i| scale * (f64::from(i) * STEP).exp())
            .map(|lambda| STEP * lambda * f(lambda))
            .sum()
    }

    fn root([a, b, c]: [f64; 3], lambda: f64) -> f64 {
        ((a * a + lambda) * (b * b + lambda) * (c * c + lambda)).sqrt()
    }

    fn shape_factors_by_quadrature(axes: [f64; 3]) -> [f64; 3] {
        axes.map(|axis| {
            let square = axis * axis;
            let integrand = |lambda| 1.0 / ((square + lambda) * root(axes, lambda));
            product(axes) * quadrature(square, integrand)
        })
    }

    /// The added inertia about the first axis over that of the displaced fluid, from
    /// $\kappa = abc\int d\lambda/((b^2+\lambda)(c^2+\lambda)\Delta)$ and
    /// $\mu = abc\int\lambda d\lambda/((b^2+\lambda)(c^2+\lambda)\Delta)$: no difference
    /// but $b^2-c^2$ itself.
    fn relative_inertia_by_quadrature(axes: [f64; 3]) -> f64 {
        let [_, b, c] = axes;
        let weight = |l: f64| product(axes) / ((b * b + l) * (c * c + l) * root(axes, l));
        let kappa = quadrature(b * c, weight);
        let mu = quadrature(b * c, |l| l * weight(l));
        let difference = (b - c) * (b + c);
        let alpha = shape_factors_by_quadrature(axes)[0];
        difference * difference * kappa / (alpha + 2.0 * mu) / (b * b + c * c)
    }

    fn relative_inertia(axes: [f64; 3]) -> f64 {
        let body = ellipsoid(axes);
        body.added_inertia(1.0)[0] / body.dry_inertia(body.neutral_mass(1.0))[0]
    }

    #[test]
    fn the_printed_table_of_lee_leok_and_mcclamroch() {
        let density = 1.0 / (32.0 * PI);
        let rounded = |x: f64| (x * 1e4).round() / 1e4;
        let totals = |semi_axes| {
            let body = ellipsoid(semi_axes);
            let mass = body.neutral_mass(density);
            let (dry, added) = (body.dry_inertia(mass), body.added_inertia(density));
            let masses = body.added_mass(density).map(|m| rounded(m + mass));
            (mass, masses, [0, 1, 2].map(|i| rounded(dry[i] + added[i])))
        };
        let (mass, masses, inertia) = totals([8.0, 1.5, 2.0]);
        assert_close(mass, 1.0, 4.0 * EPS);
        assert_eq!(masses, [1.0659, 2.1696, 1.6641]);
        assert_eq!(inertia, [1.3480, 20.1500, 25.3276]);
        let (mass, masses, inertia) = totals([5.0, 0.8, 1.5]);
        assert_close(mass, 0.25, 4.0 * EPS);
        assert_eq!(masses, [0.2664, 0.6551, 0.3677]);
        assert_eq!(inertia, [0.1961, 1.7889, 2.9210]);
    }

    #[test]
    fn a_sphere_drags_half_its_displaced_mass_and_no_inertia() {
        for radius in [1e-40, 0.3, 7.0, 1e40] {
            let ball = ellipsoid([radius; 3]);
            let half = ball.neutral_mass(1.2) / 2.0;
            for mass in ball.added_mass(1.2) {
                assert_close(mass, half, 4.0 * EPS);
            }
            assert_eq!(ball.added_inertia(1.2), [0.0; 3]);
        }
    }

    #[test]
    fn prolate_spheroids_agree_with_the_closed_form() {
        for ratio in [0.01_f64, 0.1, 0.5, 0.7] {
            let squared = 1.0 - ratio * ratio;
            let e = squared.sqrt();
            let log = 2.0 * e.atanh();
            let along = 2.0 * (1.0 - squared) / e.powi(3) * (log / 2.0 - e);
            let across = 1.0 / squared - (1.0 - squared) / (2.0 * e.powi(3)) * log;
            let factors = ellipsoid([3.0, 3.0 * ratio, 3.0 * ratio]).shape_factors();
            assert_close(factors[0], along, 1e-13);
            assert_close(factors[1], across, 1e-13);
            assert_close(factors[2], across, 1e-13);
        }
    }

    #[test]
    fn oblate_spheroids_agree_with_the_closed_form() {
        for ratio in [0.01_f64, 0.1, 0.5, 0.7] {
            let squared = 1.0 - ratio * ratio;
            let e = squared.sqrt();
            let along = 2.0 / squared * (1.0 - ratio / e * ratio.acos());
            let across = ratio / e.powi(3) * ratio.acos() - ratio * ratio / squared;
            let factors = ellipsoid([5.0 * ratio, 5.0, 5.0]).shape_factors();
            assert_close(factors[0], along, 1e-13);
            assert_close(factors[1], across, 1e-13);
            assert_close(factors[2], across, 1e-13);
        }
    }

    #[test]
    fn a_thin_disc_tends_to_the_classical_values() {
        let (radius, density) = (2.0_f64, 1.5);
        let disc = ellipsoid([radius, radius, 1e-9 * radius]);
        let broadside = 8.0 / 3.0 * density * radius.powi(3);
        let tumbling = 16.0 / 45.0 * density * radius.powi(5);
        assert_close(disc.added_mass(density)[2], broadside, 1e-8);
        assert_close(disc.added_inertia(density)[0], tumbling, 1e-8);
        assert_close(disc.added_inertia(density)[1], tumbling, 1e-8);
        assert_eq!(disc.added_inertia(density)[2], 0.0);
    }

    #[test]
    fn a_needle_drags_its_own_mass_across_and_hardly_any_along() {
        let needle = ellipsoid([100.0, 1.0, 1.0]);
        let mass = needle.neutral_mass(1.0);
        let [along, across, _] = needle.added_mass(1.0).map(|added| added / mass);
        assert_close(along, 1e-4 * (200.0_f64.ln() - 1.0), 1e-3);
        assert_close(across, 1.0, 1e-3);
    }

    #[test]
    fn generic_axes_agree_with_quadrature() {
        for axes in [
            [8.0, 1.5, 2.0],
            [1.0, 2.0, 3.0],
            [0.01, 1.0, 0.3],
            [100.0, 1.0, 1.5],
            [1e-4, 1.0, 2.0],
            [1e4, 1.0, 2.0],
        ] {
            let body = ellipsoid(axes);
            let expected = shape_factors_by_quadrature(axes);
            for (actual, expected) in body.shape_factors().into_iter().zip(expected) {
                assert_close(actual, expected, 1e-13);
            }
            let expected = relative_inertia_by_quadrature(axes);
            assert_close(relative_inertia(axes), expected, 1e-13);
        }
    }

    #[test]
    fn a_thin_disc_keeps_its_digits() {
        let axes = [1.0, 1.0, 1e-4];
        let inertia = ellipsoid(axes).added_inertia(1.0)[0];
        let displaced = 4.0 / 3.0 * PI * 1e-4 / 5.0 * (1.0 + 1e-8);
        let expected = displaced * relative_inertia_by_quadrature(axes);
        assert_close(inertia, expected, 1e-13);
    }

    #[test]
    fn the_added_inertia_is_continuous_where_a_section_becomes_a_circle() {
        for a in [0.01, 0.5, 1.0, 1.7, 100.0] {
            for exponent in 1..=32 {
                let axes = [a, 1.0, 1.0 + 10.0_f64.powf(-f64::from(exponent) / 2.0)];
                let error = relative_inertia(axes) - relative_inertia_by_quadrature(axes);
                assert!(error.abs() < 2.0 * EPS, "{axes:?}: off by {error:e}");
            }
        }
    }

    #[test]
    fn no_positive_finite_axis_no_ellipsoid() {
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for axis in 0..3 {
                let mut semi_axes = [1.0; 3];
                semi_axes[axis] = value;
                let error = Ellipsoid::new(semi_axes).expect_err("no ellipsoid");
                let EllipsoidError::NotPositive { axis: found, .. } = error else {
                    panic!("{error}");
                };
                assert_eq!(found, axis);
            }
        }
    }

    #[test]
    fn extreme_axes_are_computed_or_refused() {
        for semi_axes in [[1e200; 3], [1e-200; 3], [1.0, 1.0, 1e-200]] {
            let error = Ellipsoid::new(semi_axes).expect_err("out of range");
            assert_eq!(error, EllipsoidError::OutOfRange { semi_axes });
        }
        let semi_axes = [1e-120, 1e40, 1e40];
        let error = Ellipsoid::new(semi_axes).expect_err("too unequal");
        assert_eq!(error, EllipsoidError::TooUnequal { semi_axes });
        let sum: f64 = ellipsoid([1.0, 1e-12, 1e-30]).shape_factors().iter().sum();
        assert_close(sum, 2.0, 8.0 * EPS);
    }

    fn axis() -> impl Strategy<Value = f64> {
        (-4.0..4.0_f64).prop_map(|exponent| 10.0_f64.powf(exponent))
    }

    proptest! {
        #[test]
        fn the_shape_factors_sum_to_two(axes in [axis(), axis(), axis()]) {
            let sum: f64 = ellipsoid(axes).shape_factors().iter().sum();
            prop_assert!((sum - 2.0).abs() < 8.0 * EPS, "{sum}");
        }

        #[test]
        fn everything_is_finite_and_not_negative(axes in [axis(), axis(), axis()]) {
            let body = ellipsoid(axes);
            for value in body.added_mass(1e3).into_iter().chain(body.added_inertia(1e3)) {
                prop_assert!(value.is_finite() && value >= 0.0, "{value}");
            }
        }

        #[test]
        fn axes_that_nearly_agree_add_no_negative_inertia(
            a in axis(), b in axis(), exponent in -16.0..-1.0_f64,
        ) {
            let body = ellipsoid([a, b, b * (1.0 + 10.0_f64.powf(exponent))]);
            prop_assert!(body.added_inertia(1.0)[0] >= 0.0);
        }

        #[test]
        fn a_permutation_of_the_axes_permutes_the_results(axes in [axis(), axis(), axis()]) {
            for order in [[1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]] {
                let permuted = |values: [f64; 3]| order.map(|i: usize| values[i]);
                let (body, other) = (ellipsoid(axes), ellipsoid(permuted(axes)));
                prop_assert_eq!(other.shape_factors(), permuted(body.shape_factors()));
                for (actual, expected) in [
                    (other.added_mass(2.0), permuted(body.added_mass(2.0))),
                    (other.added_inertia(2.0), permuted(body.added_inertia(2.0))),
                    (other.dry_inertia(2.0), permuted(body.dry_inertia(2.0))),
                ] {
                    for (x, y) in actual.into_iter().zip(expected) {
                        prop_assert!((x - y).abs() <= 8.0 * EPS * y);
                    }
                }
            }
        }

        #[test]
        fn masses_scale_with_the_cube_and_inertias_with_the_fifth_power(
            axes in [axis(), axis(), axis()], power in -20..20_i32,
        ) {
            // By a power of two, so that the scaling itself does not round.
            let scale = 2.0_f64.powi(power);
            let (body, scaled) = (ellipsoid(axes), ellipsoid(axes.map(|a| scale * a)));
            let masses = body.added_mass(3.0).map(|m| m * scale.powi(3));
            let inertias = body.added_inertia(3.0).map(|j| j * scale.powi(5));
            prop_assert_eq!(scaled.added_mass(3.0), masses);
            prop_assert_eq!(scaled.added_inertia(3.0), inertias);
            prop_assert_eq!(body.added_mass(6.0), body.added_mass(3.0).map(|m| 2.0 * m));
        }
    }
}
