#![doc = include_str!("../docs/your-own-system.md")]

#[doc = include_str!("../docs/sensitivities.md")]
pub mod sensitivities {}
