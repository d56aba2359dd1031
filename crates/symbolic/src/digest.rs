//! Structural digests: 128 bits that depend on nothing but the mathematics, so that canonical order is the
//! same in every run, thread and platform.

use crate::node::{Function, Node};
use crate::rational::Rational;
use dashu_base::Sign;
use dashu_int::Word;

const FIRST: u64 = 0x9e37_79b9_7f4a_7c15;
const SECOND: u64 = 0xc2b2_ae3d_27d4_eb4f;

/// Two independent 64-bit mixing lanes.
pub(crate) struct Digest {
    a: u64,
    b: u64,
}

fn mix(state: u64, value: u64, key: u64) -> u64 {
    let product = u128::from(state ^ value).wrapping_mul(u128::from(key) | 1);
    let folded = (product as u64) ^ ((product >> 64) as u64);
    (folded ^ value.rotate_left(29)).wrapping_mul(0xff51_afd7_ed55_8ccd) ^ (folded >> 33)
}

impl Digest {
    pub(crate) fn new(tag: u64) -> Digest {
        let mut digest = Digest {
            a: FIRST,
            b: SECOND,
        };
        digest.word(tag);
        digest
    }

    pub(crate) fn word(&mut self, value: u64) {
        self.a = mix(self.a.wrapping_add(FIRST), value, SECOND);
        self.b = mix(self.b.wrapping_add(SECOND), value, FIRST);
    }

    pub(crate) fn wide(&mut self, value: u128) {
        self.word(value as u64);
        self.word((value >> 64) as u64);
    }

    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        self.word(bytes.len() as u64);
        for chunk in bytes.chunks(8) {
            let mut word = [0u8; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.word(u64::from_le_bytes(word));
        }
    }

    fn rational(&mut self, value: &Rational) {
        let (sign, magnitude) = value.numerator().as_sign_words();
        self.word(u64::from(sign == Sign::Negative));
        self.natural(magnitude);
        self.natural(value.denominator().as_words());
    }

    /// A natural number by its words of the machine, the lowest first; its digest depends on its bytes alone.
    fn natural(&mut self, words: &[Word]) {
        const SIZE: usize = size_of::<Word>();
        let Some(highest) = words.last() else {
            return self.word(0);
        };
        let bytes = words.len() * SIZE - highest.leading_zeros() as usize / 8;
        self.word(bytes as u64);
        for chunk in words.chunks(8 / SIZE) {
            let digits = chunk.iter().rev();
            let join = |sum: u128, &digit: &Word| (sum << Word::BITS) | u128::from(digit);
            self.word(digits.fold(0, join) as u64);
        }
    }

    pub(crate) fn finish(&self) -> u128 {
        (u128::from(self.a) << 64) | u128::from(self.b)
    }
}

fn function_tag(function: Function) -> u64 {
    100 + function as u64
}

/// The digest of a node, given the digests of its children and of its symbol.
pub(crate) fn of_node(
    node: &Node,
    child: impl Fn(crate::node::Expr) -> u128,
    symbol: impl Fn(crate::node::Symbol) -> u128,
) -> u128 {
    let mut digest = match node {
        Node::Number(value) => {
            let mut digest = Digest::new(1);
            digest.rational(value);
            digest
        }
        Node::Pi => Digest::new(2),
        Node::Algebraic(own) => {
            let mut digest = Digest::new(10);
            for coefficient in own.polynomial() {
                digest.rational(&Rational::from(coefficient));
            }
            digest.word(own.place() as u64);
            digest
        }
        Node::Symbol(s) => {
            let mut digest = Digest::new(3);
            digest.wide(symbol(*s));
            digest
        }
        Node::Sum { constant, terms } => {
            let mut digest = Digest::new(4);
            digest.rational(constant);
            for (_, coefficient) in terms.iter() {
                digest.rational(coefficient);
            }
            digest
        }
        Node::Product { coefficient, .. } => {
            let mut digest = Digest::new(5);
            digest.rational(coefficient);
            digest
        }
        Node::Power { .. } => Digest::new(6),
        Node::Apply { function, .. } => Digest::new(function_tag(*function)),
        Node::Matrix { rows, columns, .. } => {
            let mut digest = Digest::new(7);
            digest.word(u64::from(*rows));
            digest.word(u64::from(*columns));
            digest
        }
        Node::Solve { .. } => Digest::new(8),
        Node::Entry { index, .. } => {
            let mut digest = Digest::new(9);
            digest.word(u64::from(*index));
            digest
        }
    };
    node.for_each_child(|c| digest.wide(child(c)));
    digest.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_digested_by_their_bytes() {
        let values = [
            "0",
            "1",
            "-1/2",
            "255/256",
            "-18446744073709551616/3",
            "340282366920938463463374607431768211456",
        ];
        for value in values {
            let value: Rational = value.parse().expect("a rational");
            let (sign, magnitude) = value.numerator().clone().into_parts();
            let mut expected = Digest::new(1);
            expected.word(u64::from(sign == Sign::Negative));
            expected.bytes(&magnitude.to_le_bytes());
            expected.bytes(&value.denominator().to_le_bytes());
            let mut found = Digest::new(1);
            found.rational(&value);
            assert_eq!(found.finish(), expected.finish(), "{value}");
        }
    }
}
