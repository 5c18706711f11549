//! Table 1: every vector in base axes.
