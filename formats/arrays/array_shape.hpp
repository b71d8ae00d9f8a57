// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/arrays/array_file.hpp"

namespace faultline {

using ArrayShape = std::vector<std::int64_t>;

/// Upper limit of the columns of a table; no log has more.
inline constexpr std::int64_t kMostArrayColumns = 1 << 14;

/// Returns the shape without dimensions of one, except that a vector of one element stays a vector.
ArrayShape squeezed(const ArrayShape& shape);
double elements(const ArrayShape& shape);

/// Returns the name and shape, such as "q" (100 x 3), for messages.
std::string array_label(const NamedArray& array);
/// Returns the labels of the first arrays and the number of further ones.
std::string listed_arrays(const std::vector<const NamedArray*>& arrays);

/// Returns the reason why the arrays of a file are no log, if none is part of a table with rows.
std::string why_no_table(const std::vector<NamedArray>& arrays);

}  // namespace faultline
