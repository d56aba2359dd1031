//! Where a first integral is searched.
//!
//! First integrals, densities of invariant measures, Jacobi's last multiplier and integrating factors are one idea (Darboux, Bull.
//! Sci. Math. 2 (1878); Prelle and Singer, Trans. AMS 279 (1983); Goriely, *Integrability and Nonintegrability of Dynamical
//! Systems*, 2001, ch. 2): polynomials P in the functions that occur with `X P = K P`, X being the field of the motion, and linear
//! relations with constant coefficients among their cofactors K:
//!
//! - `Σ e_i K_i + Σ c_j X h_j = 0`: `Π P_i^{e_i} exp(Σ c_j h_j)` is a first integral; with h = t one that contains the time.
//! - `Σ e_i K_i + Σ c_j X h_j = -div X`: it is the density of an invariant measure.
//! - Of complex conjugate P the arguments are such h: their rates are the imaginary parts of the cofactors.
//!
//! What is asked, in which order, and where it is decided:
//!
//! 1. [`motion`]: the field X̄ on the constraint manifold, for any system; [`flow`] the same in independent variables.
//! 2. `polynomial_field`: X as a polynomial field in letters, the variables and the functions of them that occur.
//! 3. [`darboux`]: the pairs (P, K), part by closed part of the variables, degree by degree, as far as the counted work allows. Of
//!    each degree `extactic` finds all of them modulo a prime, from `orbit`s as power series; `continuation` and [`lift`] give
//!    their coefficients as functions of the constants.
//! 4. [`factors`]: the real functions among them for a system, once for all claims.
//! 5. [`ansatz`]: linear relations with constant coefficients among functions on the manifold, `constants` being what may
//!    stand in the coefficients. The claims of `geometry` ask it for the relations above and prove each with the zero test.
//! 6. [`unknowns`]: stated forms with unknown constants and functions.
//!
//! Nothing that is found modulo a prime is believed: the claim that uses it proves it, or leaves it.

mod algebraic;
pub mod ansatz;
pub mod constants;
mod continuation;
pub mod darboux;
mod extactic;
pub mod factors;
pub mod flow;
pub mod lift;
pub mod motion;
mod orbit;
mod polynomial_field;
pub mod unknowns;
