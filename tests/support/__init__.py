"""What the tests and benchmarks share: shapes with known axes, meshes, oracles, measures."""
