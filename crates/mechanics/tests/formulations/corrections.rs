//! Where printed literature is wrong: the corrected statement proved, the printed one refuted. `docs/book/corrections.md` names
//! each test (theory 3, marks [C]; theory 1 §10; theory 2 §7).

mod manifold;
mod rumyantsev;
mod zhao;
