//! What is kept of a run for the eye: as many frames as a picture needs.

use articulated_fluid::ArticulatedBody;
use lie::Vec3;
use sim::{Frame, Sample, Watch};

/// The most frames of a recording; at least half as many are kept where there are more.
pub const MOST_FRAMES: usize = 3000;

/// A run for the eye: at most [`MOST_FRAMES`] frames, equally spaced among those added, and the last one.
///
/// Where there are more, every other one goes, as often as needed; so memory does not grow with the run.
#[derive(Clone, Debug)]
pub struct Recording {
    model: ArticulatedBody,
    stills: Vec<Still>,
    /// The last frame, where it is not among them.
    last: Option<Still>,
    /// Frames from one still to the next.
    stride: usize,
    /// Frames added.
    count: usize,
    watch: Option<Watch>,
}

/// What is kept of a frame.
#[derive(Clone, Debug)]
pub(crate) struct Still {
    pub(crate) centres: Vec<Vec3>,
    /// Quaternions $w, x, y, z$.
    pub(crate) attitudes: Vec<[f64; 4]>,
    pub(crate) sample: Sample,
    /// The work of each drive, J.
    pub(crate) work: Vec<f64>,
    /// How far energy, linear and angular momentum are from what the motion keeps.
    pub(crate) departures: [f64; 3],
}

impl Recording {
    /// A recording of a scene's model without frames.
    pub fn new(model: &ArticulatedBody) -> Self {
        Self {
            model: model.clone(),
            stills: vec![],
            last: None,
            stride: 1,
            count: 0,
            watch: None,
        }
    }

    /// Adds the next frame.
    pub fn add(&mut self, frame: &Frame) {
        let watch = *self
            .watch
            .get_or_insert_with(|| Watch::new(&self.model, frame.sample));
        let still = Still::new(frame, &watch);
        self.last = match self.count.is_multiple_of(self.stride) {
            true => {
                self.stills.push(still);
                None
            }
            false => Some(still),
        };
        self.count += 1;
        // With the last frame there is one more.
        if self.stills.len() >= MOST_FRAMES {
            self.thin();
        }
    }

    fn thin(&mut self) {
        let mut number = 0;
        let newest = self.stills.len() - 1;
        self.last = (newest % 2 == 1).then(|| self.stills[newest].clone());
        self.stills.retain(|_| {
            number += 1;
            number % 2 == 1
        });
        self.stride *= 2;
    }

    pub(crate) fn model(&self) -> &ArticulatedBody {
        &self.model
    }

    pub(crate) fn stills(&self) -> impl ExactSizeIterator<Item = &Still> + Clone {
        let all = self.stills.len() + usize::from(self.last.is_some());
        let at = |k: usize| self.stills.get(k).or(self.last.as_ref());
        (0..all).map(move |k| at(k).unwrap_or(&self.stills[0]))
    }

    /// The times of the frames that are kept, s.
    pub fn times(&self) -> impl ExactSizeIterator<Item = f64> + Clone {
        self.stills().map(|still| still.sample.t)
    }
}

impl Still {
    fn new(frame: &Frame, watch: &Watch) -> Self {
        Self {
            centres: frame.bodies.centres.clone(),
            attitudes: frame
                .bodies
                .attitudes
                .iter()
                .map(|r| unit(r.to_quaternion()))
                .collect(),
            sample: frame.sample,
            work: frame.drives.iter().map(|drive| drive.work).collect(),
            departures: watch.departures(&frame.sample),
        }
    }
}

/// What a method leaves of a rotation that does not keep the group, made one.
fn unit(q: [f64; 4]) -> [f64; 4] {
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    match norm.is_normal() {
        true => q.map(|x| x / norm),
        false => [1.0, 0.0, 0.0, 0.0],
    }
}

#[cfg(test)]
mod tests {
    use articulated_fluid::Scene;
    use sim::{Choice, Plan, Schedule, Simulation};

    use super::*;

    fn recorded(frames: usize) -> Vec<f64> {
        let scene = Scene::parse(articulated_fluid::scene::EXAMPLE, "example.toml").unwrap();
        let plan = Plan {
            choice: Choice::default(),
            until: 0.002,
            schedule: Schedule::Steps(1),
            ..Plan::default()
        };
        let mut simulation = Simulation::new(&scene, &plan).unwrap();
        let mut frame = simulation.next().unwrap().unwrap();
        let mut recording = Recording::new(simulation.model());
        for k in 0..frames {
            frame.sample.t = k as f64;
            recording.add(&frame);
        }
        recording.times().collect()
    }

    /// However many frames there are: first and last are kept, the others equally spaced, and not too few.
    #[test]
    fn a_recording_is_thinned_evenly() {
        for frames in [
            1,
            2,
            MOST_FRAMES - 1,
            MOST_FRAMES,
            MOST_FRAMES + 1,
            2 * MOST_FRAMES,
            10_001,
            12_345,
        ] {
            let times = recorded(frames);
            assert_eq!(
                (times[0], times[times.len() - 1]),
                (0.0, (frames - 1) as f64)
            );
            assert!(times.len() <= MOST_FRAMES, "{frames}: {}", times.len());
            assert!(
                times.len() >= frames.min(MOST_FRAMES / 2),
                "{frames}: {}",
                times.len()
            );
            let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
            let (last, others) = steps.split_last().unwrap_or((&0.0, &[]));
            assert!(others.iter().all(|step| *step == others[0]), "{frames}");
            assert!(others.is_empty() || *last <= others[0], "{frames}");
        }
    }
}
