//! A geometrically exact beam (Simo–Reissner) of rigid nodes on SE(3), by its Lagrangian alone.
//!
//! | command | what it shows |
//! |---|---|
//! | `cargo run --release --example beam -- costs` | what steps cost, from 5 nodes to 320 |
//! | `cargo run --release --example beam -- cantilever` | a clamped beam that an end moment bends into a circle: how far it is from closing, by the mesh |
//! | `cargo run --release --example beam -- flight [STEPS]` | energy and momenta of a beam thrown into the air, over 100000 steps |
//!
//! The last two draw `out/cantilever.png` and `out/flight.png`.

mod by_hand;
mod cantilever;
mod costs;
mod flight;
mod model;

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    match (arguments.next().as_deref(), arguments.next()) {
        (Some("costs"), None) => costs::print(),
        (Some("cantilever"), None) => cantilever::show(),
        (Some("flight"), steps) => flight::show(steps.map_or(Ok(100_000), |n| n.parse())?),
        _ => Err("say what to show: costs, cantilever or flight [STEPS]".into()),
    }
}
