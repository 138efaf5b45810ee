//! The order of instructions: equal operations one after the other, as far as what they read allows.

use std::collections::HashMap;

use crate::instruction::{Instruction, Op};

/// How many instructions are put in order together: more make longer runs, and more numbers alive at a time.
const WINDOW: usize = 256;

/// The same instructions in an order where operations change seldom, and each follows what it reads.
///
/// A run of one operation is a loop without a decision in it, over numbers that mostly do not need one another.
pub(crate) fn schedule(instructions: &[Instruction]) -> Vec<Instruction> {
    let windows = instructions.chunks(WINDOW);
    windows
        .flat_map(|window| Window::new(window).order())
        .collect()
}

struct Window<'a> {
    instructions: &'a [Instruction],
    /// How many instructions of the window each still waits for.
    waits: Vec<usize>,
    /// Which of them wait for each.
    next: Vec<Vec<usize>>,
    /// Those that wait for none, of each operation.
    ready: Vec<(Op, Vec<usize>)>,
}

impl<'a> Window<'a> {
    fn new(instructions: &'a [Instruction]) -> Self {
        let mut window = Self {
            instructions,
            waits: vec![0; instructions.len()],
            next: vec![Vec::new(); instructions.len()],
            ready: Vec::new(),
        };
        let mut makers: HashMap<u32, usize> = HashMap::new();
        for (i, instruction) in instructions.iter().enumerate() {
            for read in instruction.reads() {
                if let Some(maker) = makers.get(read) {
                    window.next[*maker].push(i);
                    window.waits[i] += 1;
                }
            }
            let mut instruction = *instruction;
            makers.extend(instruction.result().map(|result| (*result, i)));
            makers.extend(instruction.second().map(|second| (*second, i)));
            if window.waits[i] == 0 {
                window.add(i);
            }
        }
        window
    }

    fn add(&mut self, i: usize) {
        let op = self.instructions[i].op;
        match self.ready.iter_mut().find(|(of, _)| *of == op) {
            Some((_, ready)) => ready.push(i),
            None => self.ready.push((op, vec![i])),
        }
    }

    /// Takes all of the operation that most are ready of, and so on.
    fn order(mut self) -> Vec<Instruction> {
        let mut order = Vec::with_capacity(self.instructions.len());
        while let Some(most) = (0..self.ready.len()).max_by_key(|k| self.ready[*k].1.len()) {
            if self.ready[most].1.is_empty() {
                break;
            }
            while !self.ready[most].1.is_empty() {
                for i in core::mem::take(&mut self.ready[most].1) {
                    order.push(self.instructions[i]);
                    for next in core::mem::take(&mut self.next[i]) {
                        self.waits[next] -= 1;
                        if self.waits[next] == 0 {
                            self.add(next);
                        }
                    }
                }
            }
        }
        order
    }
}
