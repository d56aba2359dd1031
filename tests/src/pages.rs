//! The equations that `derive` prints, held against a book twice: the text is exactly the one reviewed, and what it says is
//! proved equal to the book's own equation, typed in as the book has it.

use crate::places::scratch;
use crate::program::{run, text};
use crate::studied::{gallery_path, loaded};
use chetaev::mechanics::{Manifold, Prover, System};
use chetaev::model::{load, Model, ModelBuilder, NoFiles, Style};
use chetaev::symbolic::Expr;
use std::path::PathBuf;

/// Heading of the intermediate objects: the only group of which a page may show a part.
const OBJECTS: &str = "objects";

/// An equation as a book states it; the value vanishes.
#[derive(Clone, Copy, Debug)]
pub enum Book {
    /// The expression.
    Value(&'static str),
    /// The time derivative of the first plus the second.
    Rate(&'static str, &'static str),
}
/// All equations of one group, or some of the intermediate objects: as printed, and as in the book.
#[derive(Clone, Copy, Debug)]
pub struct Page {
    /// A name of the gallery, or the text of a model.
    pub model: &'static str,
    /// Name of the formulation.
    pub formulation: &'static str,
    /// Heading.
    pub group: &'static str,
    /// Names that the formulation brings with it: momenta, quasi-velocities, objects.
    pub names: &'static [&'static str],
    /// Printed lines with the equations of the book.
    pub equations: &'static [(&'static str, Book)],
}

impl Page {
    fn path(&self) -> PathBuf {
        if !self.model.contains('\n') {
            return gallery_path(&format!("{}/model.toml", self.model));
        }
        let statement = load("model.toml", self.model, &NoFiles, &[]);
        let name = statement.model.expect("the statement is right").name;
        let folder = scratch(&format!(
            "textbook-{name}-{}-{}",
            self.formulation,
            self.group.replace(' ', "-")
        ));
        let path = folder.join("model.toml");
        std::fs::write(&path, self.model).expect("a scratch file");
        path
    }

    /// The page is printed as reviewed, and is proved equal to the book.
    ///
    /// # Panics
    /// Where it is not.
    pub fn check(&self) {
        let path = self.path();
        let reviewed: Vec<&str> = self.equations.iter().map(|(line, _)| *line).collect();
        let mut printed = printed(text(&path), self.formulation, self.group);
        if self.group == OBJECTS {
            let wanted = |line: &String| reviewed.iter().any(|r| name_of(r) == name_of(line));
            printed.retain(wanted);
        }
        assert_eq!(printed, reviewed, "{}: {}", self.model, self.formulation);
        let stated = loaded(&path, &[]).model.expect("the model is right");
        let reader = match self.names {
            [] => stated,
            names => reader(&stated, names),
        };
        let system = System::from_model(&reader).expect("the model is regular");
        for (line, book) in self.equations {
            let (left, right) = line.split_once(" = ").expect("an equation");
            let g = &reader.graph;
            let found = g.sub(read(&reader, left), read(&reader, right));
            let stated = match book {
                Book::Value(value) => read(&reader, value),
                Book::Rate(rate, rest) => {
                    let rate = reader.total_derivative(read(&reader, rate));
                    g.add(&[rate, read(&reader, rest)])
                }
            };
            let difference = [g.sub(found, stated)];
            let verdict =
                Prover::default().identity(&system, &difference, &Manifold::default(), "");
            assert_eq!(verdict.word(), "proved", "{}: {line}", self.model);
        }
    }
}

/// What an object is called.
fn name_of(line: &str) -> &str {
    line.split(" = ").next().unwrap_or(line)
}

/// A model whose only use is to read formulas: all names of the formulation are functions of the time.
fn reader(model: &Model, names: &[&str]) -> Model {
    let coordinates: Vec<String> = model.coordinates.iter().map(|c| c.name.clone()).collect();
    let all: Vec<String> = coordinates
        .into_iter()
        .chain(names.iter().map(|n| unreserved(n)))
        .collect();
    let squares: Vec<String> = all.iter().map(|q| format!("{q}'^2")).collect();
    let mut builder = ModelBuilder::new("reader")
        .coordinates(&all)
        .lagrangian(&squares.join(" + "));
    for parameter in &model.parameters {
        builder = builder
            .symbolic_parameter(&parameter.name)
            .assumption(&format!("{} > 0", parameter.name));
    }
    for name in names.iter().filter(|n| **n == "h") {
        builder = builder.assumption(&format!("{name} > 0"));
    }
    let loaded = builder.build();
    let diagnostics = loaded.diagnostics.render(Style::Plain);
    loaded.model.unwrap_or_else(|| panic!("{diagnostics}"))
}

/// Names of multipliers belong to constraints, and the reader has none.
fn unreserved(formula: &str) -> String {
    formula
        .replace("lambda_", "reaction_")
        .replace("kappa_", "extremal_")
}

fn read(model: &Model, formula: &str) -> Expr {
    let formula = match model.constraints.is_empty() {
        true => unreserved(formula),
        false => formula.to_owned(),
    };
    model
        .expression(&formula)
        .unwrap_or_else(|d| panic!("{}", d.render(Style::Plain)))
}

/// The lines of a group of a formulation, as the command prints them, without their general form.
fn printed(model: &str, formulation: &str, group: &str) -> Vec<String> {
    let finished = run(&["derive", model, "--formulation", formulation]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let heading = format!("{group}:");
    let lines = finished.out.lines();
    let after = lines.skip_while(|&line| line != heading).skip(1);
    after
        .skip_while(|line| line.starts_with('['))
        .take_while(|line| line.contains(" = "))
        .map(str::to_owned)
        .collect()
}
