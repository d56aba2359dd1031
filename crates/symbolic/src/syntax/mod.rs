//! Expressions as people write them: lexer, syntax tree with spans, parser, lowering to the graph.
