# SPDX-License-Identifier: GPL-3.0-or-later
"""The laboratory: benchmarks, races, trials, mutations and pictures. It measures the product and gates nothing."""
