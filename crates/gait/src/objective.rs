//! What a stroke is best by.

use lie::{Cotangent, Jet, LieGroup, RealGroup, SE3, Scalar, Tangent, Vec3};

use crate::chain::Chain;
use crate::effort::Effort;
use crate::error::GaitError;
use crate::gradient::net_with_gradient;
use crate::net::{net_motion, path};
use crate::stroke::Fourier;

/// The way over which the distance counts, in radii of gyration: about ten lengths of a slender swimmer. One that turns comes less far.
pub const WAY: f64 = 30.0;

/// Parts of the period in which the net motion of a stroke is found.
fn parts(stroke: &Fourier) -> usize {
    (8 * stroke.order()).max(32)
}

/// Times at which its effort is: several in the shortest wave.
fn samples(stroke: &Fourier) -> usize {
    (32 * (stroke.order() + 1)).max(64)
}

/// What the best stroke has most of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// The distance in a stroke, m: after so many strokes as lead along a [`WAY`], over their number.
    Advance,
    /// That over the [length](Effort::Length) of the stroke, kg^-1/2.
    AdvancePerLength,
    /// That over the [positive work](Effort::Work) of the stroke, m/J.
    AdvancePerWork,
    /// The turn of a stroke, rad, up to a half turn.
    Turn,
}

impl Objective {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::Advance,
        Self::AdvancePerLength,
        Self::AdvancePerWork,
        Self::Turn,
    ];

    /// Its name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Advance => "advance",
            Self::AdvancePerLength => "advance-per-length",
            Self::AdvancePerWork => "advance-per-work",
            Self::Turn => "turn",
        }
    }

    /// The one of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|of| of.name() == name)
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Advance => "m",
            Self::AdvancePerLength => "kg^-1/2",
            Self::AdvancePerWork => "m/J",
            Self::Turn => "rad",
        }
    }

    fn effort(self) -> Option<Effort> {
        match self {
            Self::Advance | Self::Turn => None,
            Self::AdvancePerLength => Some(Effort::Length),
            Self::AdvancePerWork => Some(Effort::Work),
        }
    }

    /// What a stroke without momentum has of it.
    ///
    /// # Errors
    /// [`GaitError::Shape`], and [`GaitError::Still`] where an effort is asked for and nothing moves.
    pub fn of(self, chain: &Chain, stroke: &Fourier) -> Result<f64, GaitError> {
        let g = path(chain, stroke, parts(stroke))?[parts(stroke)];
        let gained = self.gain(chain, &g);
        match self.effort() {
            None => Ok(gained),
            Some(effort) => over(gained, effort.of(chain, stroke, samples(stroke))?),
        }
    }

    /// The same by rules so fine that finer ones change it by less than a part in a million.
    pub(crate) fn finely(self, chain: &Chain, stroke: &Fourier) -> Result<f64, GaitError> {
        let gained = self.gain(chain, &net_motion(chain, stroke)?);
        match self.effort() {
            None => Ok(gained),
            Some(effort) => over(gained, effort.of(chain, stroke, 16 * samples(stroke))?),
        }
    }

    /// The same with its gradient in the coefficients.
    ///
    /// # Errors
    /// [`GaitError::Shape`].
    pub fn with_gradient(
        self,
        chain: &Chain,
        stroke: &Fourier,
    ) -> Result<(f64, Vec<f64>), GaitError> {
        self.of_motion(
            chain,
            stroke,
            net_with_gradient(chain, stroke, parts(stroke))?,
        )
    }

    /// The same of a net motion that is known with its derivatives.
    pub(crate) fn of_motion(
        self,
        chain: &Chain,
        stroke: &Fourier,
        (g, motions): (SE3, Vec<Tangent<6>>),
    ) -> Result<(f64, Vec<f64>), GaitError> {
        let (gained, slope) = self.gain_with_slope(chain, &g);
        let slopes = motions.iter().map(|motion| slope.pair(motion));
        let Some(effort) = self.effort() else {
            return Ok((gained, slopes.collect()));
        };
        let (spent, costs) = effort.with_gradient(chain, stroke, samples(stroke))?;
        let value = over(gained, spent)?;
        let slopes = slopes.zip(costs);
        let slopes = slopes.map(|(slope, cost)| (slope - value * cost) / spent);
        Ok((value, slopes.collect()))
    }

    /// What a chain gains by a net motion: the distance in a stroke, m, or the turn, rad.
    pub fn gain(self, chain: &Chain, g: &SE3) -> f64 {
        self.gain_with_slope(chain, g).0
    }

    /// The same, and its derivative by $g^{-1} \delta g$.
    fn gain_with_slope(self, chain: &Chain, g: &SE3) -> (f64, Cotangent<6>) {
        match self {
            Self::Turn => {
                let turning = g.rotation.log().unwrap_or_else(|e| e.representative).vec3();
                let turn = turning.norm();
                let axis = turning * (1.0 / turn.max(f64::MIN_POSITIVE));
                (turn, (axis, Vec3::zero()).into())
            }
            _ => distance(g, WAY * chain.gyration()),
        }
    }
}

/// A gain over an effort, of a stroke that moves.
fn over(gained: f64, spent: f64) -> Result<f64, GaitError> {
    match spent > 0.0 {
        true => Ok(gained / spent),
        false => Err(GaitError::Still),
    }
}

/// $|d_n| / n$ of $g^n = \exp(n \log g)$ with $n |d_1|$ the way; and its derivative by $g^{-1} \delta g$.
fn distance(g: &SE3, way: f64) -> (f64, Cotangent<6>) {
    type J = <f64 as Scalar>::Jet;
    // A stroke that leads nowhere has a distance too.
    let size = |x: Vec3<J>, least: f64| (x.norm_squared() + J::constant(least * least)).sqrt();
    let change = Tangent(core::array::from_fn(|k| J::variable(0.0, k)));
    let g = g.lift::<J>().compose(&SE3::exp(&change));
    let strokes = J::constant(way) / size(g.translation, 1e-9 * way);
    let screw = g.log().unwrap_or_else(|e| e.representative);
    let end = SE3::exp(&(screw * strokes));
    let found = size(end.translation, 1e-9 * way) / strokes;
    let slope = core::array::from_fn(|k| found.partial(k));
    (found.value(), Cotangent(slope))
}
