//! What is printed with definitions below `where` is read again as the same expression.

use crate::common::model;
use chetaev_symbolic::Expr;

const PLANE: &str = "coordinates = [\"x\", \"y\"]\nparameters = [\"a\", \"b\", \"c\"]\n\
                     lagrangian = \"x'^2 + y'^2\"\n";

/// A sum of so many terms that share one long part, so that the part gets a name.
const LONG: &str = "sin(a x + b y + c)";

#[test]
fn shared_parts_are_read_again() {
    let model = model(PLANE);
    let g = &model.graph;
    let part = |k: usize| format!("cos({LONG}^2 + {k} y {LONG})^{k}");
    let terms: Vec<String> = (2..60)
        .map(|k| format!("{} ({} + {})^3", part(k), part(k + 1), part(k + 2)))
        .collect();
    let e = model.expression(&terms.join(" + ")).unwrap();
    let text = g.text(e);
    assert!(text.contains("\nwhere\n"), "{text}");
    assert_eq!(model.expression(&text).unwrap(), e);
}

#[test]
fn linear_systems_are_read_again() {
    let model = model(PLANE);
    let g = &model.graph;
    let read = |text: &str| model.expression(text).unwrap();
    let entries: Vec<Expr> = ["a", "sin(x)", "cos(y)", "b", "a + c", "x'", "1", "y", "c^2"]
        .map(read)
        .to_vec();
    let rhs: Vec<Expr> = ["x", "0", "a b"].map(read).to_vec();
    let solution = g.solve(&entries, &rhs).unwrap();
    for e in solution
        .iter()
        .copied()
        .chain([g.mul(&[solution[0], solution[2]])])
    {
        let text = g.text(e);
        assert!(text.contains("\nwhere\n"), "{text}");
        assert_eq!(model.expression(&text).unwrap(), e, "{text}");
    }
}

#[test]
fn one_system_may_stand_in_the_coefficients_of_another() {
    let model = model(PLANE);
    let g = &model.graph;
    let one = "w_1 + w_2\nwhere\n  a w_1 + x w_2 = 1\n  y w_1 + b w_2 = c\n";
    let other = format!("{one}  v = w_1^2\n  v z_1 - z_2 = w_2\n  z_1 + a z_2 = 0\n");
    let found = model
        .expression(&other.replace("w_1 + w_2\n", "z_1\n"))
        .unwrap();
    // By hand: w = ((b - c x), (a c - y))/(a b - x y), z_1 = a w_2/(a w_1^2 + 1).
    let w = ["(b - c x)/(a b - x y)", "(a c - y)/(a b - x y)"];
    let byhand = format!("a {}/(a ({})^2 + 1)", w[1], w[0]);
    let byhand = model.expression(&byhand).unwrap();
    for point in [[0.3, 0.7, 1.9, 2.3, 0.4], [1.3, -0.7, 0.9, -2.3, 1.4]] {
        let values = ["x", "y", "a", "b", "c"].map(|name| g.intern_symbol(name, 0));
        let value = |symbol| {
            let at = values.iter().position(|own| *own == symbol)?;
            Some(point[at])
        };
        let both = g.evaluate_f64(&[found, byhand], &value).unwrap();
        assert!((both[0] - both[1]).abs() < 1e-12, "{both:?}");
    }
}

#[test]
fn what_determines_nothing_is_refused() {
    let model = model(PLANE);
    for wrong in [
        "w_1\nwhere\n  a w_1 + x w_2 = 1",
        "w_1\nwhere\n  a w_1^2 + x w_1 = 1",
        "w_1\nwhere\n  a x = 1",
        "w_1\nwhere\n  w_1 = k",
        "w_1 + k\nwhere\n  w_1 = a",
    ] {
        assert!(model.expression(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn variables_of_a_state_are_known_where_they_are_given() {
    let model = model(&format!("{PLANE}[define]\nh = \"x + y\"\n"));
    let g = &model.graph;
    let own = ["w".to_owned(), "h".to_owned()];
    let found = model.expression_in("w' + h", &own).unwrap();
    // What the model defines stays what it says.
    let sum = g.add(&[g.symbol("w", 1), model.expression("x + y").unwrap()]);
    assert_eq!(found, sum);
    let refused = model.expression("w'").unwrap_err();
    assert!(refused.list[0].message.contains("unknown name `w`"));
    // Below `where` too.
    let text = "v + h\nwhere\n  v = w'";
    assert_eq!(model.expression_in(text, &own).unwrap(), sum);
}
