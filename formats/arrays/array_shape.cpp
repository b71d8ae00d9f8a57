// SPDX-License-Identifier: MIT
#include "formats/arrays/array_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostTold = 8;  ///< arrays that a message lists by name

/// Returns the shape as text, such as 100 x 3.
std::string shape_text(const ArrayShape& shape) {
  std::string text;
  for (const std::int64_t size : shape) text += (text.empty() ? "" : " x ") + std::to_string(size);
  return text;
}

}  // namespace

ArrayShape squeezed(const ArrayShape& shape) {
  ArrayShape kept;
  for (const std::int64_t size : shape)
    if (size != 1) kept.push_back(size);
  if (kept.empty() && !shape.empty()) kept.push_back(1);
  return kept;
}

double elements(const ArrayShape& shape) {
  double count = 1.0;
  for (const std::int64_t size : shape) count *= static_cast<double>(size);
  return count;
}

std::string array_label(const NamedArray& array) {
  const std::string name =
      array.name.empty() ? "the array" : "\"" + shortened(array.name, kLongestName) + "\"";
  return name + " (" + shape_text(array.shape) + ")";
}

std::string listed_arrays(const std::vector<const NamedArray*>& arrays) {
  std::string names;
  for (std::size_t i = 0; i < std::min(kMostTold, arrays.size()); ++i)
    names += (i > 0 ? ", " : "") + array_label(*arrays[i]);
  if (arrays.size() > kMostTold) names += fmt::format(" and {} more", arrays.size() - kMostTold);
  return names;
}

std::string why_no_table(const std::vector<NamedArray>& arrays) {
  std::vector<const NamedArray*> pointers;
  for (const NamedArray& array : arrays) pointers.push_back(&array);
  const auto all = [&](auto holds) { return std::all_of(arrays.begin(), arrays.end(), holds); };
  const auto is_deep = [](const NamedArray& array) { return squeezed(array.shape).size() > 2; };
  const auto is_empty = [](const NamedArray& array) { return elements(array.shape) == 0.0; };
  const auto is_wide = [](const NamedArray& array) {
    const ArrayShape shape = squeezed(array.shape);
    return shape.size() > 2 || (shape.size() == 2 && std::min(shape[0], shape[1]) > kMostArrayColumns);
  };
  const std::string found = "; it holds " + listed_arrays(pointers);
  if (all([&](const NamedArray& array) { return is_empty(array) || is_deep(array); }) && !all(is_deep))
    return "has no rows: its arrays are empty, so nothing was recorded" + found;
  if (all(is_deep))
    return "holds no table: its arrays have three dimensions or more, but a log needs a vector of times "
           "and a matrix of positions (rows x joints)" +
           found;
  if (all([&](const NamedArray& array) { return array.unwritten || is_deep(array) || is_empty(array); }))
    return "has space for rows, but none was written: the recorder stopped before it stored the first rows" +
           found;
  if (all(is_wide))
    return fmt::format(
               "holds no table of a log: such a table has at most {} columns and one row for each time",
               kMostArrayColumns) +
           found;
  return "is cut before its first row; nothing can be read from it" + found;
}

}  // namespace faultline
