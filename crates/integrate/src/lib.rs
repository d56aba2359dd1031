//! Time stepping of numeric functions; never sees a symbol.
