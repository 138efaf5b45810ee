//! What a scene is run with: the scene itself, the time, the method or the accuracy.

use std::path::PathBuf;

use sim::{Choice, Method, Plan, Schedule, SimError, Simulation};

use super::args;
use super::error::CliError;
use super::print;
use super::progress;
use super::scene::Loaded;

/// Options that every command that runs a scene has.
#[derive(clap::Args)]
pub struct Settings {
    /// The scene, a TOML file [default: three bodies, from Lee, Leok & McClamroch (2009)]
    #[arg(value_name = "SCENE")]
    pub scene: Option<PathBuf>,
    /// Simulated time, in seconds
    #[arg(long, value_name = "SECONDS", default_value = "100", value_parser = args::seconds, allow_hyphen_values = true)]
    pub until: f64,
    /// The integrator; see `lgvi methods` [default: lgvi for the paper's scene; with a --step lgvi or composition-2; else as --accuracy 1e-6 chooses]
    #[arg(long, value_name = "NAME", value_parser = args::method())]
    pub method: Option<Method>,
    /// Step size, in seconds; a little shorter where whole steps would not end at --until [default: the method's, as the scene's motion asks for]
    #[arg(long, value_name = "SECONDS", value_parser = args::seconds, allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// Let a rehearsal choose Gauss collocation's stages and step: the attitudes' error, in radians, and the position's, in metres, until the end
    #[arg(long, value_name = "ERROR", value_parser = args::accuracy, allow_hyphen_values = true, conflicts_with_all = ["method", "step"])]
    pub accuracy: Option<f64>,
    /// Take no reduction: all coordinates are unknowns and all terms are computed; see `lgvi inspect`
    #[arg(long)]
    pub full: bool,
}

impl Settings {
    fn plan(&self, choice: Choice, schedule: Schedule, estimate: bool) -> Plan {
        Plan {
            choice,
            until: self.until,
            schedule,
            full: self.full,
            estimate,
        }
    }

    /// What was asked for; none where that is left open.
    pub fn choice(&self, loaded: &Loaded) -> Option<Choice> {
        let (method, step) = (self.method, self.step);
        // By an unsymmetric method of order 1 a stroke that leads nowhere seems to swim.
        let keeps_energy = loaded.smallest.model.keeps_energy();
        let unless_asked = || match keeps_energy {
            true => Method::default(),
            false => DRIVEN.parse().unwrap_or_default(),
        };
        let fixed = || Choice::Method {
            method: method.unwrap_or_else(unless_asked),
            step,
        };
        let is_fixed = method.is_some() || step.is_some();
        let accuracy = self.accuracy.map(Choice::Accuracy);
        accuracy.or_else(|| is_fixed.then(fixed))
    }

    /// The run at t = 0, after the rehearsals of an accuracy.
    pub fn simulation(
        &self,
        loaded: &Loaded,
        schedule: Schedule,
        estimate: bool,
    ) -> Result<Simulation, CliError> {
        let _spinner = progress::waiting("choosing stages and step");
        let begin = |choice| Simulation::new(&loaded.scene, &self.plan(choice, schedule, estimate));
        match self.choice(loaded) {
            Some(choice) => Ok(begin(choice)?),
            None if loaded.is_papers() => Ok(begin(Choice::default())?),
            None => match begin(Choice::Accuracy(DEFAULT_ACCURACY)) {
                Err(error @ SimError::AccuracyOutOfReach { .. }) => {
                    print::warning(&format!("{error}; taking {FALLBACK} instead"));
                    let method: Result<Method, _> = FALLBACK.parse();
                    Ok(begin(method.unwrap_or_default().into())?)
                }
                begun => Ok(begun?),
            },
        }
    }
}

/// What a scene other than the paper's is run at where nothing is asked for, rad and m.
const DEFAULT_ACCURACY: f64 = 1e-6;
/// What steps a scene that moves as told where only a step is asked for.
const DRIVEN: &str = "composition-2";
/// What it is run with where rounding grows beyond that.
const FALLBACK: &str = "gauss-6";
