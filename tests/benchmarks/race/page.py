# SPDX-License-Identifier: GPL-3.0-or-later
def write(rows, skipped, path): print(len(rows), skipped)
