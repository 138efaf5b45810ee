//! A trajectory as a CSV table.

use std::io::{self, Write};

use articulated_fluid::{ArticulatedBody, Configuration, Scene};
use dvi::State;
use study::watch::{Sample, attitudes};

/// The columns as text for help; [`Table`] writes them.
pub const COLUMNS: &str = "  t                        time, s
  x,y,z                    mass centre of the first body in the reference frame, m
  NAME.qw,.qx,.qy,.qz      attitude of the body NAME, body to reference frame: a unit quaternion,
                           its sign continuous from row to row
  NAME.wx,.wy,.wz          angular velocity of the body NAME in its own frame, rad/s
  energy                   of bodies and fluid, kinetic and potential, J
  px,py,pz                 linear momentum from the velocities, in the reference frame, kg m/s
  lx,ly,lz                 angular momentum about the origin in the reference frame, kg m^2/s
  orthogonality            largest ||I - R^T R||_F over the bodies";

/// Writes rows to `out`.
pub struct Table<W> {
    out: W,
    line: String,
    attitudes: Vec<[f64; 4]>,
}

impl<W: Write> Table<W> {
    /// Writes the header for the bodies of `scene`.
    pub fn new(mut out: W, scene: &Scene) -> io::Result<Self> {
        write!(out, "t,x,y,z")?;
        for body in &scene.bodies {
            for column in ["qw", "qx", "qy", "qz", "wx", "wy", "wz"] {
                write!(out, ",{}.{column}", body.name)?;
            }
        }
        writeln!(out, ",energy,px,py,pz,lx,ly,lz,orthogonality")?;
        Ok(Self {
            out,
            line: String::new(),
            attitudes: vec![[0.0; 4]; scene.bodies.len()],
        })
    }

    /// Writes the row of a state and its sample.
    pub fn row(
        &mut self,
        model: &ArticulatedBody,
        state: &State<Configuration>,
        sample: &Sample,
    ) -> io::Result<()> {
        let velocity = model.velocity(state).map_err(io::Error::other)?;
        let rates = core::iter::once(&velocity.0).chain(velocity.2.iter());
        self.line.clear();
        push(&mut self.line, &[state.t]);
        push(&mut self.line, &state.g.1.vec3().0);
        let bodies = attitudes(&state.g).zip(rates).zip(&mut self.attitudes);
        for ((attitude, rate), last) in bodies {
            *last = nearer(attitude.to_quaternion(), last);
            push(&mut self.line, last);
            push(&mut self.line, &rate.vec3().0);
        }
        push(&mut self.line, &[sample.energy]);
        push(&mut self.line, &sample.linear.0);
        push(&mut self.line, &sample.angular.0);
        push(&mut self.line, &[sample.orthogonality]);
        self.line.push('\n');
        self.out.write_all(self.line.as_bytes())
    }

    /// What the rows were written to.
    pub fn into_inner(self) -> W {
        self.out
    }
}

/// Appends numbers with all their digits.
fn push(line: &mut String, numbers: &[f64]) {
    for number in numbers {
        if !line.is_empty() {
            line.push(',');
        }
        line.push_str(&format!("{number:.16e}"));
    }
}

/// The one of `q` and `-q`, which are the same attitude, that is nearer to `last`.
fn nearer(q: [f64; 4], last: &[f64; 4]) -> [f64; 4] {
    let dot: f64 = q.iter().zip(last).map(|(a, b)| a * b).sum();
    if dot < 0.0 { q.map(|x| -x) } else { q }
}
