//! Laws of the ring, of the gcd and of factorisation on generated polynomials. Products are planted, never recomputed
//! by the code under test; identities are checked by evaluation at integers.

use dashu_base::Sign;
use dashu_int::IBig;

use super::{Budget, Meter, Monomial, Polynomial, RationalFunction, TooLarge};
use crate::number::random::Random;
use crate::rational::ratio;

fn meter() -> Meter {
    Meter::new(Budget::PROOF)
}

fn polynomial(random: &mut Random, generators: usize, terms: usize, degree: u64) -> Polynomial {
    let term = |random: &mut Random| {
        let exponents: Vec<u16> = (0..generators)
            .map(|_| random.below(degree + 1) as u16)
            .collect();
        (
            Monomial::from_exponents(&exponents),
            IBig::from(random.between(-9, 9)),
        )
    };
    Polynomial::from_terms((0..terms).map(|_| term(random)).collect())
}

fn nonzero(random: &mut Random, generators: usize, terms: usize, degree: u64) -> Polynomial {
    loop {
        let p = polynomial(random, generators, terms, degree);
        if !p.is_constant() {
            return p;
        }
    }
}

fn point(random: &mut Random, generators: usize) -> Vec<IBig> {
    (0..generators)
        .map(|_| IBig::from(random.between(-50, 50)))
        .collect()
}

fn x(i: usize) -> Polynomial {
    Polynomial::generator(i)
}

fn int(n: i64) -> Polynomial {
    Polynomial::constant(n)
}

fn product(factors: &[&Polynomial]) -> Polynomial {
    factors
        .iter()
        .fold(Polynomial::one(), |p, f| p.mul(f, &meter()).unwrap())
}

/// Monomials against their vectors of exponents, short and long, with the largest exponents.
#[test]
fn monomials_are_their_exponents() {
    let mut random = Random::new(5);
    let draw = |random: &mut Random| -> Vec<u16> {
        let length = random.below(40) as usize;
        let exponent = |random: &mut Random| match random.below(4) {
            0 => 0,
            1 => random.below(3) as u16,
            2 => 32_767,
            _ => random.below(32_768) as u16,
        };
        (0..length).map(|_| exponent(random)).collect()
    };
    let padded = |v: &[u16]| [v, &[0; 40]].concat()[..40].to_vec();
    for _ in 0..3000 {
        let (a, b) = (draw(&mut random), draw(&mut random));
        let (m, n) = (Monomial::from_exponents(&a), Monomial::from_exponents(&b));
        let (a, b) = (padded(&a), padded(&b));
        let pairs = || a.iter().zip(&b);
        let exponents = |m: &Monomial| padded(&m.exponents());
        assert_eq!(exponents(&m), a);
        let sum: Vec<u16> = pairs().map(|(x, y)| x + y).collect();
        let product = m.product(&n);
        assert_eq!(exponents(&product), sum);
        assert_eq!(product.quotient(&n), Some(m.clone()));
        let divides = pairs().all(|(x, y)| x >= y);
        assert_eq!(m.quotient(&n).is_some(), divides, "{m:?} by {n:?}");
        let least: Vec<u16> = pairs().map(|(x, y)| *x.min(y)).collect();
        assert_eq!(exponents(&m.gcd(&n)), least);
        let degree = |v: &[u16]| v.iter().map(|&e| u32::from(e)).sum::<u32>();
        assert_eq!(m.gcd(&n).degree(), degree(&least));
        assert_eq!(m.cmp(&n), degree(&a).cmp(&degree(&b)).then(a.cmp(&b)));
        let (place, exponent) = (random.below(40) as usize, random.below(9) as u16);
        let mut changed = a.clone();
        changed[place] = exponent;
        assert_eq!(
            m.with_exponent(place, exponent),
            Monomial::from_exponents(&changed)
        );
        assert_eq!(m.with_exponent(place, exponent).degree(), degree(&changed));
        let nonzero = |(k, &e): (usize, &u16)| (e != 0).then_some((k, e));
        let listed: Vec<(usize, u16)> = a.iter().enumerate().filter_map(nonzero).collect();
        assert_eq!(m.iter().collect::<Vec<_>>(), listed);
        assert_eq!(m.extent(), listed.last().map_or(0, |(k, _)| k + 1));
    }
}

#[test]
fn ring_operations_agree_with_evaluation() {
    let mut random = Random::new(1);
    for _ in 0..100 {
        let (a, b, c) = (
            polynomial(&mut random, 4, 8, 3),
            polynomial(&mut random, 4, 6, 3),
            polynomial(&mut random, 4, 4, 2),
        );
        let at = point(&mut random, 4);
        let value = |p: &Polynomial| p.evaluate(&at);
        assert_eq!(value(&a.add(&b)), value(&a) + value(&b));
        assert_eq!(value(&a.sub(&b)), value(&a) - value(&b));
        assert_eq!(value(&a.mul(&b, &meter()).unwrap()), value(&a) * value(&b));
        assert_eq!(
            value(&a.pow(3, &meter()).unwrap()),
            value(&a) * value(&a) * value(&a)
        );
        let substituted = a.substitute(1, &c, &meter()).unwrap();
        let mut moved = at.clone();
        moved[1] = value(&c);
        assert_eq!(value(&substituted), a.evaluate(&moved));
        assert!(a.sub(&a).is_zero());
    }
}

#[test]
fn derivative_obeys_the_product_rule() {
    let mut random = Random::new(2);
    for _ in 0..50 {
        let (a, b) = (
            polynomial(&mut random, 3, 6, 4),
            polynomial(&mut random, 3, 6, 4),
        );
        let left = a.mul(&b, &meter()).unwrap().derivative(1);
        let right = product(&[&a.derivative(1), &b]).add(&product(&[&a, &b.derivative(1)]));
        assert_eq!(left, right);
    }
}

#[test]
fn coefficients_reassemble_the_polynomial() {
    let mut random = Random::new(3);
    for _ in 0..50 {
        let a = polynomial(&mut random, 5, 12, 3);
        let sum = |parts: Vec<(Monomial, Polynomial)>| {
            parts.iter().fold(Polynomial::zero(), |sum, (m, c)| {
                sum.add(&product(&[&Polynomial::term(m.clone(), IBig::ONE), c]))
            })
        };
        assert_eq!(sum(a.coefficients(&[1, 3])), a);
        let single = a
            .coefficients_in(2)
            .into_iter()
            .map(|(e, c)| (Monomial::power(2, e), c));
        assert_eq!(sum(single.collect()), a);
    }
}

#[test]
fn exact_division_inverts_multiplication_and_refuses_otherwise() {
    let mut random = Random::new(4);
    for _ in 0..100 {
        let (a, b) = (nonzero(&mut random, 4, 7, 3), nonzero(&mut random, 4, 5, 3));
        let ab = product(&[&a, &b]);
        assert_eq!(ab.exact_quotient(&b, &meter()).unwrap(), Some(a.clone()));
        assert_eq!(ab.add(&int(1)).exact_quotient(&b, &meter()).unwrap(), None);
    }
    assert_eq!(
        x(0).exact_quotient(&Polynomial::zero(), &meter()).unwrap(),
        None
    );
    assert_eq!(x(0).exact_quotient(&int(2), &meter()).unwrap(), None);
}

#[test]
fn pseudo_remainder_vanishes_exactly_at_multiples() {
    let f = x(0).mul(&x(1), &meter()).unwrap().add(&x(2));
    let multiple = product(&[&f, &x(0).add(&x(2))]);
    assert!(multiple
        .pseudo_remainder(&f, 0, &meter())
        .unwrap()
        .is_zero());
    let rest = multiple
        .add(&int(3))
        .pseudo_remainder(&f, 0, &meter())
        .unwrap();
    assert!(!rest.is_zero() && rest.degree_in(0) == 0);
}

/// The planted factor divides the gcd, the gcd divides both, and the cofactors are coprime.
fn check_gcd(a: &Polynomial, b: &Polynomial, planted: &Polynomial) {
    let m = meter();
    let (pa, pb) = (product(&[a, planted]), product(&[b, planted]));
    let gcd = pa.gcd(&pb, &m).unwrap();
    assert!(
        gcd.exact_quotient(planted, &m).unwrap().is_some(),
        "{planted:?} does not divide {gcd:?}"
    );
    let ca = pa
        .exact_quotient(&gcd, &m)
        .unwrap()
        .expect("divides the first");
    let cb = pb
        .exact_quotient(&gcd, &m)
        .unwrap()
        .expect("divides the second");
    assert!(ca.gcd(&cb, &m).unwrap().is_one());
    assert!(!gcd.is_negative());
}

#[test]
fn gcd_contains_planted_factors() {
    let mut random = Random::new(5);
    for generators in 1..=4 {
        for _ in 0..40 {
            let a = nonzero(&mut random, generators, 5, 2);
            let b = nonzero(&mut random, generators, 6, 2);
            check_gcd(&a, &b, &nonzero(&mut random, generators, 4, 2));
        }
    }
}

#[test]
fn gcd_in_many_generators_is_sparse() {
    let mut random = Random::new(6);
    for _ in 0..10 {
        let a = nonzero(&mut random, 10, 8, 1);
        let b = nonzero(&mut random, 10, 8, 1);
        check_gcd(&a, &b, &nonzero(&mut random, 10, 8, 1));
    }
}

#[test]
fn gcd_with_long_coefficients_needs_several_primes() {
    let long = IBig::from(10).pow(60) + IBig::from(7);
    let planted = x(0)
        .mul(&x(1), &meter())
        .unwrap()
        .scale(&long)
        .add(&x(2))
        .add(&int(3));
    let a = x(0).add(&x(1)).add(&int(1));
    let b = x(0).sub(&x(2)).add(&int(5));
    check_gcd(&a, &b, &planted);
    let gcd = product(&[&a, &planted])
        .gcd(&product(&[&b, &planted]), &meter())
        .unwrap();
    assert_eq!(gcd, planted);
}

#[test]
fn gcd_of_coprime_polynomials_is_their_common_content() {
    let a = product(&[&int(6), &x(0), &x(1).add(&x(2))]);
    let b = product(&[&int(4), &x(0), &x(1).sub(&x(2))]);
    assert_eq!(a.gcd(&b, &meter()).unwrap(), product(&[&int(2), &x(0)]));
    assert_eq!(Polynomial::zero().gcd(&a.neg(), &meter()).unwrap(), a);
}

#[test]
fn factorization_finds_contents_powers_and_differences_of_squares() {
    let m = meter();
    let (a, b) = (x(0).add(&x(1)), x(2).mul(&x(1), &m).unwrap().add(&int(1)));
    let squares = product(&[&x(0), &x(0)]).sub(&product(&[&x(3), &x(3)]));
    let p = product(&[&int(-12), &x(4), &x(4), &a, &a, &a, &b, &squares]);
    let found = p.factorize(&m).unwrap();
    assert_eq!(found.content, IBig::from(-12));
    let expected = [
        (x(4), 2),
        (a, 3),
        (x(0).add(&x(3)), 1),
        (x(0).sub(&x(3)), 1),
        (b, 1),
    ];
    assert_eq!(found.factors.len(), expected.len(), "{found:?}");
    for factor in expected {
        assert!(
            found.factors.contains(&factor),
            "{factor:?} missing from {found:?}"
        );
    }
}

#[test]
fn factorization_multiplies_back() {
    let mut random = Random::new(7);
    for _ in 0..40 {
        let (a, b, c) = (
            nonzero(&mut random, 3, 3, 2),
            nonzero(&mut random, 3, 3, 1),
            nonzero(&mut random, 3, 2, 1),
        );
        let p = product(&[&a, &b, &b, &c, &c, &c]);
        let found = p.factorize(&meter()).unwrap();
        let mut back = Polynomial::constant(found.content.clone());
        for (factor, multiplicity) in &found.factors {
            assert!(!factor.is_constant() && !factor.is_negative());
            back = product(&[&back, &factor.pow(*multiplicity, &meter()).unwrap()]);
        }
        assert_eq!(back, p);
    }
}

#[test]
fn products_of_three_come_apart_into_irreducible_factors() {
    let m = meter();
    // x0² + x1² - x2², x2 - 3 x0 - 4 x1, a quadric with a leading coefficient in other generators, and 4 x0⁴ + x1⁴, a product of two.
    let square = |p: &Polynomial| p.mul(p, &m).unwrap();
    let cone = square(&x(0)).add(&square(&x(1))).sub(&square(&x(2)));
    let plane = x(2)
        .sub(&x(0).scale(&IBig::from(3)))
        .sub(&x(1).scale(&IBig::from(4)));
    let other = product(&[&x(3).add(&x(1)), &square(&x(0))])
        .add(&product(&[&x(3), &x(4), &square(&x(2))]))
        .add(&int(7));
    let sophie = [-2, 2].map(|n| {
        let mixed = product(&[&int(n), &x(0), &x(1)]);
        square(&x(0))
            .scale(&IBig::from(2))
            .add(&mixed)
            .add(&square(&x(1)))
    });
    let all = [cone, plane, other, sophie[0].clone(), sophie[1].clone()];
    for i in 0..all.len() {
        for j in 0..i {
            for k in 0..j {
                let p = product(&[&all[i], &all[j], &all[k]]);
                let found = p.irreducible_factors(&m).unwrap();
                assert_eq!(found.len(), 3, "{found:?}");
                for factor in [&all[i], &all[j], &all[k]] {
                    let is_it = |p: &Polynomial| *p == *factor || p.neg() == *factor;
                    assert!(found.iter().any(|(p, n)| *n == 1 && is_it(p)), "{factor:?}");
                }
            }
        }
    }
}

/// Factors of one generator whose coefficients are longer than any prime used: (10³⁰ x² + 7 x − 10²⁵)(x − 1)(3 x³ + 10⁴⁰), and the
/// irreducible x⁴ + 2·3⁸⁰ (x + 1), by Eisenstein's criterion at 2.
#[test]
fn long_coefficients_hide_no_factor() {
    let m = meter();
    let ten = |n: usize| Polynomial::constant(IBig::from(10).pow(n));
    let power = |n: u32| x(0).pow(n, &m).unwrap();
    let quadratic = product(&[&ten(30), &power(2)])
        .add(&x(0).scale(&IBig::from(7)))
        .sub(&ten(25));
    let cubic = power(3).scale(&IBig::from(3)).add(&ten(40));
    let linear = x(0).sub(&int(1));
    let all = [linear, quadratic, cubic];
    let found = product(&[&all[0], &all[1], &all[2]])
        .irreducible_factors(&m)
        .unwrap();
    assert_eq!(found, all.map(|p| (p, 1)).to_vec());
    let odd = IBig::from(3).pow(80) * IBig::from(2);
    let eisenstein = power(4)
        .add(&x(0).scale(&odd))
        .add(&Polynomial::constant(odd));
    let found = eisenstein.irreducible_factors(&m).unwrap();
    assert_eq!(found, vec![(eisenstein, 1)]);
}

#[test]
fn irreducible_polynomials_stay_and_random_products_come_apart() {
    let m = meter();
    // x⁴ + 1 and x⁴ - 10 x² + 1 factor modulo every prime; made homogeneous they have no factors of degree one.
    let power = |g: usize, n: u32| x(g).pow(n, &m).unwrap();
    let quartics = [
        power(0, 4).add(&power(1, 4)),
        power(0, 4)
            .sub(&product(&[&int(10), &power(0, 2), &power(1, 2)]))
            .add(&power(1, 4)),
        power(0, 3).add(&power(1, 3)).add(&power(2, 3)),
        product(&[&x(3), &power(1, 3)]).sub(&power(0, 3)),
    ];
    for p in quartics {
        assert_eq!(p.irreducible_factors(&m).unwrap(), vec![(p, 1)]);
    }
    let mut random = Random::new(11);
    for _ in 0..30 {
        let pair = [0, 1].map(|_| nonzero(&mut random, 4, 5, 3).primitive_part());
        let p = product(&[&pair[0], &pair[1]]);
        let found = p.irreducible_factors(&m).unwrap();
        let back = found.iter().fold(int(1), |all, (f, n)| {
            product(&[&all, &f.pow(*n, &m).unwrap()])
        });
        assert!(back == p.primitive_part() || back.neg() == p.primitive_part());
        // No factor has a non-trivial greatest common divisor with one of the pair.
        for (factor, _) in &found {
            for own in &pair {
                let common = factor.gcd(own, &m).unwrap();
                let is_whole = common == *factor || common.neg() == *factor;
                assert!(common.is_constant() || is_whole, "{factor:?} and {own:?}");
            }
        }
    }
}

#[test]
fn square_roots_are_recognised() {
    let mut random = Random::new(8);
    for _ in 0..50 {
        let a = nonzero(&mut random, 4, 6, 3);
        let square = product(&[&a, &a]);
        let root = square.square_root(&meter()).unwrap().expect("a square");
        assert!(root == a || root == a.neg());
        assert_eq!(square.add(&int(1)).square_root(&meter()).unwrap(), None);
        assert_eq!(square.neg().square_root(&meter()).unwrap(), None);
    }
    assert_eq!(int(8).square_root(&meter()).unwrap(), None);
}

#[test]
fn rational_functions_form_a_field() {
    let mut random = Random::new(9);
    let m = meter();
    let rational = |random: &mut Random| {
        let (n, d) = (nonzero(random, 3, 4, 2), nonzero(random, 3, 3, 1));
        RationalFunction::new(n, d, &m)
            .unwrap()
            .expect("the denominator is not zero")
    };
    for _ in 0..40 {
        let (a, b, c) = (
            rational(&mut random),
            rational(&mut random),
            rational(&mut random),
        );
        let sum = a.add(&b, &m).unwrap();
        let left = sum.mul(&c, &m).unwrap();
        let right = a
            .mul(&c, &m)
            .unwrap()
            .add(&b.mul(&c, &m).unwrap(), &m)
            .unwrap();
        assert_eq!(left, right);
        assert_eq!(sum.sub(&b, &m).unwrap(), a);
        assert_eq!(a.mul(&b, &m).unwrap().div(&b, &m).unwrap(), Some(a.clone()));
        assert_eq!(
            a.pow(-2, &m)
                .unwrap()
                .unwrap()
                .mul(&a.pow(2, &m).unwrap().unwrap(), &m)
                .unwrap(),
            RationalFunction::one()
        );
        assert_eq!(
            a.denominator().leading_term().unwrap().1.sign(),
            Sign::Positive
        );
    }
}

#[test]
fn rational_constants_are_in_lowest_terms() {
    let m = meter();
    let half = RationalFunction::constant(&ratio(1, 2).unwrap());
    let third = RationalFunction::constant(&ratio(-1, 3).unwrap());
    assert_eq!(half.add(&third, &m).unwrap().as_rational(), ratio(1, 6));
    assert_eq!(half.mul(&third, &m).unwrap().as_rational(), ratio(-1, 6));
    assert_eq!(
        RationalFunction::zero().div(&half, &m).unwrap(),
        Some(RationalFunction::zero())
    );
    assert_eq!(half.div(&RationalFunction::zero(), &m).unwrap(), None);
}

#[test]
fn budgets_stop_growth() {
    let small = Budget {
        terms: 10,
        degree: 20,
        bits: 64,
        work: 10_000,
    };
    let sum = (0..6).fold(int(1), |sum, i| sum.add(&x(i)));
    assert_eq!(
        sum.pow(4, &Meter::new(small)),
        Err(TooLarge::Terms { limit: 10 })
    );
    assert_eq!(
        x(0).pow(21, &Meter::new(small)),
        Err(TooLarge::Degree { limit: 20 })
    );
    assert_eq!(
        int(3).pow(1_000_000, &Meter::new(small)),
        Err(TooLarge::Bits { limit: 64 })
    );
    let roomy = Budget {
        terms: 100_000,
        ..small
    };
    assert_eq!(
        sum.pow(8, &Meter::new(roomy)),
        Err(TooLarge::Work { limit: 10_000 })
    );
}
