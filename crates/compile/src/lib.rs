//! Equations to numeric functions: the flat program and the interpreter.
