//! A contender as it is serialised: by what is known of it.

use serde::{Serialize, Serializer};

use super::Contender;

impl Serialize for Contender {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Object {
            name: &'static str,
            description: String,
            order: u32,
            keeps_structure: bool,
        }
        let object = Object {
            name: self.name(),
            description: self.description(),
            order: self.order(),
            keeps_structure: self.keeps_structure(),
        };
        object.serialize(serializer)
    }
}
