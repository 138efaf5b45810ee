//! What can be wrong with a scene file.

use thiserror::Error;

/// The longest text of a scene, in bytes: that of a hundred thousand bodies. To read a text takes up to fifty times its memory.
pub const MOST_BYTES: usize = 16_000_000;

/// Why a file is no scene; displayed like a compiler's message.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file cannot be read, or is not UTF-8.
    #[error("{file}: cannot be read: {source}")]
    Io {
        /// The file's name.
        file: String,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// The text is longer than a scene is.
    #[error(
        "{file}: larger than {} MB, the most that a scene may have; expected a scene as text", MOST_BYTES / 1_000_000
    )]
    TooLarge {
        /// The file's name.
        file: String,
    },
    /// The text is no TOML, or no valid scene.
    #[error("{file}:{line}:{column}: {key}: {message}")]
    Invalid {
        /// The file's name.
        file: String,
        /// Line of the key, from 1; of the table's header if the key is missing.
        line: usize,
        /// Column of the key in characters, from 1.
        column: usize,
        /// The key as a dotted path such as `body.semi_axes`.
        key: String,
        /// What is wrong and what is expected.
        message: String,
    },
}
