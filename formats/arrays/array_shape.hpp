// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/arrays/array_file.hpp"

namespace faultline {

using ArrayShape = std::vector<std::int64_t>;

/// Columns of a table at most; no log has more.
inline constexpr std::int64_t kMostArrayColumns = 1 << 14;

/// Without dimensions of one, but a vector of one element stays a vector.
ArrayShape squeezed(const ArrayShape& shape);
double elements(const ArrayShape& shape);

/// "q" (100 x 3), for messages.
std::string array_label(const NamedArray& array);
/// The labels of the first ones, and how many more there are.
std::string listed_arrays(const std::vector<const NamedArray*>& arrays);

/// Why the arrays of a file, of which none is part of a table with rows, are no log.
std::string why_no_table(const std::vector<NamedArray>& arrays);

}  // namespace faultline
