//! What a body is to its parent once all that hangs on it is eliminated: a mass and a force at the joint.
//!
//! A body whose children are eliminated has the momenta
//! $F_i = A u - K \Omega_i + \varphi$ and $r_i = H \Omega_i - K^T u$ with the velocity $u$ of its joint. What the joint leaves free
//! is solved for, and the force on it is $F_i = M^\ast u + f^\ast$: its parent takes over the mass and the force.
//!
//! Each kind of joint is a file that gives [`Link`] three methods: `eliminate` the mass, `eliminate_force`, and `advance` outwards.

mod ball;
mod link;

pub(crate) use link::Link;
