//! Slots of memory: one is used again once its number has been read for the last time.

use std::collections::HashMap;

use crate::instruction::Instruction;

/// The slots that the numbers alive have, by the names of the numbers.
pub(crate) struct Slots {
    /// How often a number is still to be read.
    reads: HashMap<u32, usize>,
    of: HashMap<u32, u32>,
    free: Vec<u32>,
    count: u32,
}

impl Slots {
    /// For these instructions.
    pub(crate) fn new(instructions: &[Instruction]) -> Self {
        let mut reads = HashMap::new();
        for name in instructions.iter().flat_map(|i| i.reads()).copied() {
            *reads.entry(name).or_default() += 1;
        }
        Self {
            reads,
            of: HashMap::new(),
            free: Vec::new(),
            count: 0,
        }
    }

    /// How many slots are needed.
    pub(crate) fn count(&self) -> usize {
        self.count as usize
    }

    /// Whether a number is read at all.
    pub(crate) fn is_read(&self, name: u32) -> bool {
        self.reads.contains_key(&name)
    }

    /// The slot of a number that has one.
    fn of(&self, name: u32) -> u32 {
        self.of[&name]
    }

    /// Gives a number a slot.
    pub(crate) fn place(&mut self, name: u32) -> u32 {
        let slot = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.of.insert(name, slot);
        slot
    }

    /// Renames numbers to slots: what an instruction writes may take the place of what it reads.
    pub(crate) fn assign(&mut self, instruction: Instruction) -> Instruction {
        let mut placed = instruction.renamed(|x| self.of(x));
        instruction.reads().iter().for_each(|x| self.read(*x));
        if let Some(result) = placed.result() {
            *result = self.place(*result);
        }
        if let Some(second) = placed.second() {
            *second = self.place(*second);
        }
        placed
    }

    fn read(&mut self, name: u32) {
        if let Some(left) = self.reads.get_mut(&name) {
            *left -= 1;
            if *left == 0 {
                self.free.extend(self.of.get(&name));
            }
        }
    }
}
