//! Linear equations in state space for other programs: NumPy archive, MATLAB, python-control, LaTeX.

use crate::table::{archive, npy, npy_texts};
use chetaev_symbolic::{Expr, Graph};
use std::fmt::Write as _;

/// Matrices by name, in numbers, with the names of states, inputs and outputs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Matrices {
    /// A, B, C, D, and the parts of second order where there are such, row by row; each with its number of columns.
    pub matrices: Vec<(String, Vec<Vec<f64>>, usize)>,
    /// `states`, `inputs` and `outputs`.
    pub names: Vec<(String, Vec<String>)>,
    /// What they are, in one line.
    pub title: String,
}

impl Matrices {
    /// A NumPy archive with one array for each matrix and for each list of names.
    ///
    /// # Errors
    /// What the archive writer reports.
    pub fn to_npz(&self) -> std::io::Result<Vec<u8>> {
        let matrices = self.matrices.iter();
        let matrices = matrices.map(|(name, rows, columns)| {
            (name.clone(), npy(&[rows.len(), *columns], &rows.concat()))
        });
        let names = self.names.iter();
        let names = names.map(|(name, list)| (name.clone(), npy_texts(list)));
        archive(matrices.chain(names))
    }

    /// A MATLAB file of level 4, which MATLAB, Octave and SciPy read (MathWorks, *MAT-File Format*, § 2): for each matrix a head of five
    /// integers, the name, and the entries column by column; names as a matrix of characters, a row for each.
    pub fn to_mat(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut put = |name: &str,
                       kind: u32,
                       [rows, columns]: [usize; 2],
                       entry: &dyn Fn(usize, usize) -> f64| {
            let head = [kind, rows as u32, columns as u32, 0, name.len() as u32 + 1];
            bytes.extend(head.iter().flat_map(|x| x.to_le_bytes()));
            bytes.extend(name.bytes().chain([0]));
            for c in 0..columns {
                bytes.extend((0..rows).flat_map(|r| entry(r, c).to_le_bytes()));
            }
        };
        for (name, rows, columns) in &self.matrices {
            put(name, 0, [rows.len(), *columns], &|r, c| rows[r][c]);
        }
        for (name, list) in &self.names {
            let list: Vec<Vec<char>> = list.iter().map(|t| t.chars().collect()).collect();
            let width = list.iter().map(Vec::len).max().unwrap_or(0);
            // A text shorter than the longest is filled with spaces.
            put(name, 1, [list.len(), width], &|r, c| {
                f64::from(list[r].get(c).map_or(32, |&own| own as u32))
            });
        }
        bytes
    }

    /// A program in Python that makes a `control.StateSpace` (python-control); with a matrix E, for which that has no place, the arrays alone and
    /// the finite eigenvalues.
    pub fn to_python(&self) -> String {
        let is_descriptor = self.matrices.iter().any(|(name, ..)| name == "E");
        let library = if is_descriptor {
            "import scipy.linalg"
        } else {
            "import control"
        };
        let mut text = format!("# {}\n{library}\nimport numpy as np\n\n", self.title);
        for (name, rows, columns) in &self.matrices {
            let rows: Vec<String> = rows
                .iter()
                .map(|row| {
                    let row: Vec<String> = row.iter().map(|x| format!("{x:?}")).collect();
                    format!("    [{}],\n", row.join(", "))
                })
                .collect();
            let _ = writeln!(
                text,
                "{name} = np.array([\n{}]).reshape({}, {columns})",
                rows.concat(),
                rows.len()
            );
        }
        for (name, list) in &self.names {
            let list: Vec<String> = list.iter().map(|t| format!("{t:?}")).collect();
            let _ = writeln!(text, "{name} = [{}]", list.join(", "));
        }
        text.push_str(if is_descriptor {
            "# Infinite eigenvalues belong to the constraints.\neigenvalues = scipy.linalg.eigvals(A, E)\nfinite = eigenvalues[np.isfinite(eigenvalues)]\n"
        } else {
            "system = control.StateSpace(A, B, C, D, states=states, inputs=inputs, outputs=outputs)\n"
        });
        text
    }
}

/// Matrices of expressions as LaTeX, one displayed equation each.
pub fn latex(g: &Graph, matrices: &[(&str, &[Vec<Expr>])]) -> String {
    let mut text = String::new();
    for (name, rows) in matrices
        .iter()
        .filter(|(_, rows)| rows.iter().any(|row| !row.is_empty()))
    {
        let row = |row: &Vec<Expr>| {
            row.iter()
                .map(|&e| {
                    // Algebraic numbers are polynomials of many digits.
                    let value = g.evaluate_f64(&[e], &|_| None);
                    let value = value.ok().filter(|_| g.holds_algebraic(e));
                    value.map_or_else(|| g.latex(e), |value| format!("{}", value[0]))
                })
                .collect::<Vec<_>>()
                .join(" & ")
        };
        let rows: Vec<String> = rows.iter().map(row).collect();
        let _ = writeln!(
            text,
            "\\[ {name} = \\begin{{pmatrix}} {} \\end{{pmatrix}} \\]",
            rows.join(" \\\\ ")
        );
    }
    text
}
