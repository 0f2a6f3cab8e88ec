// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// Returns the sum of a histogram, in eight parts. Throws std::invalid_argument with the argument's name unless it is finite and not
/// empty, has no negative number, and its sum is finite and above 0.
double require_histogram_sum(VectorRef histogram, const char* name);

}  // namespace tricue
