// SPDX-License-Identifier: GPL-3.0-or-later
// Stands for a header of glibc 2.32, for which CGAL looks: older ones cannot tell whether a program
// has one thread.
#pragma once

static const char __libc_single_threaded = 0;
