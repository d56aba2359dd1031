//! Printers of expressions: text, LaTeX, MathML, SymPy.
