//! Where printed literature is wrong: the corrected statement proved, the printed one refuted. `docs/book/corrections.md` names
//! each test (T3, marks [C]; T1 §10; T2 §7).

mod manifold;
mod rumyantsev;
mod zhao;
