//! In which order the factors of products are multiplied, so that several products share what they have in common: of all
//! pairs of factors the one that most products contain is multiplied first, then the next, where a pair that was multiplied is
//! a factor like the others (Breuer 1969).

use chetaev_symbolic::{Expr, Graph, Node};
use rustc_hash::{FxHashMap, FxHashSet};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// What is multiplied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Element {
    /// A factor as it stands in a product.
    Factor(Expr),
    /// The product of two elements, by their indices.
    Pair(u32, u32),
}

/// The order of multiplication of products.
#[derive(Debug, Default)]
pub(crate) struct Pairs {
    elements: Vec<Element>,
    products: FxHashMap<Expr, Vec<u32>>,
}

impl Pairs {
    /// For all products below the roots, as far as `is_factor` takes their factors into account.
    pub(crate) fn new(graph: &Graph, roots: &[Expr], is_factor: impl Fn(Expr) -> bool) -> Pairs {
        let mut known: FxHashMap<Expr, u32> = FxHashMap::default();
        let mut elements = Vec::new();
        let (mut products, mut lists) = (Vec::new(), Vec::new());
        for e in graph.reachable(roots) {
            let Node::Product { factors, .. } = graph.node(e) else {
                continue;
            };
            let mut index = |factor: Expr| {
                *known.entry(factor).or_insert_with(|| {
                    elements.push(Element::Factor(factor));
                    elements.len() as u32 - 1
                })
            };
            let own = factors.iter().filter(|&&factor| is_factor(factor));
            let mut list: Vec<u32> = own.map(|&factor| index(factor)).collect();
            if list.len() > 1 {
                list.sort_unstable();
                products.push(e);
                lists.push(list);
            }
        }
        Occurrences::of(&lists).extract(&mut elements, &mut lists);
        Pairs {
            elements,
            products: products.into_iter().zip(lists).collect(),
        }
    }

    /// What is left to be multiplied of a product; `None` where there are no two factors.
    pub(crate) fn of_product(&self, product: Expr) -> Option<&[u32]> {
        self.products.get(&product).map(Vec::as_slice)
    }

    /// An element.
    pub(crate) fn element(&self, index: u32) -> Element {
        self.elements[index as usize]
    }
}

type Pair = (u32, u32);

/// Pairs are not looked for in longer products.
const LONGEST: usize = 24;

/// In which lists each pair occurs.
struct Occurrences {
    places: FxHashMap<Pair, FxHashSet<u32>>,
    /// With numbers of places as they once were; the first pair among equals comes first.
    heap: BinaryHeap<(usize, Reverse<Pair>)>,
}

impl Occurrences {
    fn of(lists: &[Vec<u32>]) -> Occurrences {
        let mut places: FxHashMap<Pair, FxHashSet<u32>> = FxHashMap::default();
        let short = lists.iter().enumerate();
        for (place, list) in short.filter(|(_, list)| list.len() <= LONGEST) {
            for (i, &a) in list.iter().enumerate() {
                for &b in &list[i + 1..] {
                    places.entry((a, b)).or_default().insert(place as u32);
                }
            }
        }
        let several = places.iter().filter(|(_, places)| places.len() > 1);
        let heap = several.map(|(&pair, places)| (places.len(), Reverse(pair)));
        Occurrences {
            heap: heap.collect(),
            places,
        }
    }

    /// Replaces pairs by elements of their own as long as one occurs twice.
    fn extract(mut self, elements: &mut Vec<Element>, lists: &mut [Vec<u32>]) {
        while let Some((count, Reverse(pair))) = self.heap.pop() {
            let now = self.places.get(&pair).map_or(0, FxHashSet::len);
            if now < count {
                if now > 1 {
                    self.heap.push((now, Reverse(pair)));
                }
                continue;
            }
            let new = elements.len() as u32;
            elements.push(Element::Pair(pair.0, pair.1));
            let places = self.places.remove(&pair).unwrap_or_default();
            let mut places: Vec<u32> = places.into_iter().collect();
            places.sort_unstable();
            let mut touched: Vec<Pair> = Vec::new();
            for place in places {
                let list = &mut lists[place as usize];
                self.replace(pair, new, place, list);
                touched.extend(
                    list.iter()
                        .filter(|&&own| own != new)
                        .map(|&own| (own, new)),
                );
            }
            touched.sort_unstable();
            touched.dedup();
            for pair in touched {
                let count = self.places.get(&pair).map_or(0, FxHashSet::len);
                if count > 1 {
                    self.heap.push((count, Reverse(pair)));
                }
            }
        }
    }

    /// Puts `new` in the place of both elements of a pair in one list.
    fn replace(&mut self, pair: Pair, new: u32, place: u32, list: &mut Vec<u32>) {
        list.retain(|own| ![pair.0, pair.1].contains(own));
        for &other in list.iter() {
            for gone in [pair.0, pair.1] {
                if let Some(places) = self.places.get_mut(&(gone.min(other), gone.max(other))) {
                    places.remove(&place);
                }
            }
            self.places.entry((other, new)).or_default().insert(place);
        }
        list.push(new);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_most_products_share_is_multiplied_first() {
        let g = Graph::new();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| g.symbol(name, 0));
        let products = [&[a, b, c][..], &[a, c, d], &[a, b, c, d]].map(|factors| g.mul(factors));
        let pairs = Pairs::new(&g, &products, |_| true);
        // a c, then (a c) b, (a c) d and (a c b) d: four multiplications instead of seven.
        let made = pairs.elements.iter();
        let made = made.filter(|own| matches!(own, Element::Pair(..))).count();
        let left = products.iter().filter_map(|&p| pairs.of_product(p));
        let left: usize = left.map(|elements| elements.len() - 1).sum();
        assert_eq!((made, left), (2, 2));
        let first = pairs.elements.iter().find_map(|own| match own {
            Element::Pair(one, other) => Some([*one, *other].map(|index| pairs.element(index))),
            Element::Factor(_) => None,
        });
        let first = first.unwrap();
        assert!([a, c]
            .map(Element::Factor)
            .iter()
            .all(|e| first.contains(e)));
    }
}
