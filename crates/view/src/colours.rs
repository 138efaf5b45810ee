//! Colours of bodies that colour-blind readers can tell apart: those of M. Okabe and K. Ito.

/// Of the first body.
const HEAD: [u8; 3] = [0xe6, 0x9f, 0x00];
/// Of the limbs on it.
const LIMBS: [[u8; 3]; 6] = [
    [0x00, 0x72, 0xb2],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xd5, 0x5e, 0x00],
    [0x56, 0xb4, 0xe9],
    [0xf0, 0xe4, 0x42],
];
/// What they fade to, and how far.
const PALE: [f64; 3] = [0.92, 0.95, 0.97];
const FADE: f64 = 0.62;

/// The head has a colour of its own, each limb another one, which fades outwards; sRGB, 0 to 1.
pub(crate) fn colours(parents: &[Option<usize>]) -> Vec<[f64; 3]> {
    // Limb and depth of each body.
    let mut places: Vec<(usize, usize)> = vec![];
    let mut limbs = 0;
    for parent in parents {
        places.push(match parent {
            None => (0, 0),
            Some(0) => {
                limbs += 1;
                (limbs, 1)
            }
            Some(parent) => (places[*parent].0, places[*parent].1 + 1),
        });
    }
    let deepest = places.iter().map(|(_, depth)| *depth).max().unwrap_or(0);
    let colour = |&(limb, depth): &(usize, usize)| match limb {
        0 => HEAD.map(part),
        limb => {
            let own = LIMBS[(limb - 1) % LIMBS.len()].map(part);
            let faded = FADE * (depth - 1) as f64 / deepest as f64;
            [0, 1, 2].map(|k| own[k] + (PALE[k] - own[k]) * faded)
        }
    };
    places.iter().map(colour).collect()
}

fn part(byte: u8) -> f64 {
    f64::from(byte) / 255.0
}
