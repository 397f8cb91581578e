# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars of the distances between the axis of sampled shapes and the exact one, as `measure.errors` reports them.

The bars are the worst of 5 seeds times 1.5, measured with an independent exact implementation.
"""

# shape -> n -> distances of the output to the axis: mean, 99th percentile, largest; the other
# way round: mean, largest
BARS = {
    "ellipsoid": {
        2000: (4.6e-4, 1.8e-3, 4.1e-3, 1.6e-3, 5.4e-2),
        8000: (1.2e-4, 4.5e-4, 1.6e-3, 5.2e-4, 3.1e-2),
    },
    "oblate": {
        2000: (4.7e-4, 1.8e-3, 5.2e-3, 1.8e-3, 6.2e-2),
        8000: (1.2e-4, 4.6e-4, 1.5e-3, 5.3e-4, 3.5e-2),
    },
    "slab": {
        2000: (1.5e-3, 5.2e-3, 5.2e-2, 1.4e-3, 7.8e-3),
        8000: (3.5e-4, 1.3e-3, 1.4e-2, 3.6e-4, 5.4e-3),
    },
    "shell": {
        2000: (9.0e-3, 3.1e-2, 6.4e-2, 7.7e-3, 3.7e-2),
        8000: (2.3e-3, 7.8e-3, 1.7e-2, 2.2e-3, 1.2e-2),
    },
    "box": {
        2000: (2.6e-3, 1.6e-2, 5.5e-2, 1.2e-2, 1.8e-1),
        8000: (8.2e-4, 6.0e-3, 2.9e-2, 3.2e-3, 9.9e-2),
    },
    "torus": {
        2000: (4.5e-3, 3.3e-2, 6.7e-2, 3.8e-5, 5.9e-4),
        8000: (2.1e-3, 1.4e-2, 3.1e-2, 6.8e-6, 2.3e-4),
    },
    "capsule": {
        2000: (1.6e-3, 7.0e-3, 1.3e-2, 1.1e-5, 1.8e-4),
        8000: (1.5e-3, 7.8e-3, 2.4e-2, 2.5e-6, 8.7e-5),
    },
    "knot": {
        2000: (1.5e-2, 1.3e-1, 2.5e-1, 1.7e-4, 2.3e-3),
        8000: (2.2e-3, 1.3e-2, 3.6e-2, 2.3e-5, 4.9e-4),
    },
}
