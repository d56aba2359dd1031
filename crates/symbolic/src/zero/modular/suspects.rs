//! Which radicals are known to be independent.

use super::super::evaluate::{Run, Stop};
use super::super::program::Operation;
use super::super::ring::Scalars;
use super::Session;
use crate::number::random::Random;

impl Session<'_> {
    /// Looks for each radical for points where it is the first to have no root.
    pub(super) fn find_suspects(&mut self) {
        let radicals = self.program.radicals as usize;
        let chosen = self.program.chosen_radicals();
        if chosen == 0 {
            return;
        }
        // A wrong witness needs a zero of the denominator of a square root of the radicand; k of them are as
        // unlikely as k failures of a trial with the degree of the whole program.
        let (degree, _) = self.bound().worst();
        let each = (60.0 - degree.log2() - f64::from(chosen)).max(10.0);
        let needed = (-self.plan.error_bound_log2 / each).ceil().max(2.0) as u32;
        let mut seen = vec![0_u32; radicals];
        let mut random = Random::stream(self.plan.seed, u64::MAX);
        for _ in 0..(8 * needed) << chosen {
            let done = |(count, &adjoined): (&u32, &bool)| adjoined || *count >= needed;
            if seen.iter().zip(&self.program.adjoined).all(done)
                || self.spent > self.plan.budget / 4
            {
                break;
            }
            let Some((field, point)) = self.draw(&mut random) else {
                break;
            };
            let negative: Vec<bool> = (0..radicals).map(|_| random.next_u64() & 1 == 1).collect();
            let ring = Scalars {
                field,
                negative: &negative,
            };
            let mut run = Run::new(self.program, &point, Vec::new());
            self.spent += self.program.prefix as u64;
            if let Err(Stop::NonSquare(radical)) = run.advance(&ring, self.program.prefix) {
                seen[radical as usize] += 1;
            }
        }
        let open = |(count, &adjoined): (&u32, &bool)| !adjoined && *count < needed;
        let suspects: Vec<bool> = seen.iter().zip(&self.program.adjoined).map(open).collect();
        self.suspects = self.spread(suspects);
    }

    /// A radical whose radicand depends on a suspect is a suspect too: its witnesses were seen for one sign only.
    fn spread(&self, mut suspects: Vec<bool>) -> Vec<u32> {
        let mut tainted = vec![false; self.program.operations.len()];
        for (value, operation) in self.program.operations.iter().enumerate() {
            let mut below = false;
            operation.for_each_operand(|operand| below |= tainted[operand as usize]);
            if let Operation::SquareRoot { radical, .. } = operation {
                let radical = *radical as usize;
                suspects[radical] |= below && !self.program.adjoined[radical];
                below |= suspects[radical];
            }
            tainted[value] = below;
        }
        (0..suspects.len() as u32)
            .filter(|&radical| suspects[radical as usize])
            .collect()
    }
}
