#![doc = include_str!("../docs/your-own-system.md")]
