//! Renders plain data as one self-contained HTML page; knows no mechanics.
