// SPDX-License-Identifier: GPL-3.0-or-later
// A computation ends without a result in three ways. Messages are one sentence: expected, found,
// what to do.
#pragma once

#include <stdexcept>
#include <string>

namespace medial {

// An argument has the wrong shape, range or value.
struct InvalidInputError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// The points are valid but span no volume.
struct DegenerateInputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Progress::cancel was called.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("The computation was cancelled.") {}
};

}  // namespace medial
