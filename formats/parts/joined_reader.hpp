// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "lib/log/raw_reader.hpp"

namespace faultline {

/// How rows of several files belong together.
enum class JoinBy {
  automatic,  ///< by time where both have one, else by row
  row,        ///< row i of the one is row i of the other
  time,       ///< between the rows of the other that are before and behind, linearly
};

/// The rows of `first` with the columns of the others beside its own; a value that a file lacks for a row is
/// NaN. A column whose name is taken gets the file's name before it; in joins by time the others' times are
/// left out. Throws Error(input) for a join by time of a file without time.
std::unique_ptr<RawReader> join_files(std::unique_ptr<RawReader> first,
                                      std::vector<std::unique_ptr<RawReader>> others, JoinBy by);

/// The rows of several files one after the other; columns are those of the first, found by name in the
/// others.
std::unique_ptr<RawReader> continue_files(std::vector<std::unique_ptr<RawReader>> files);

}  // namespace faultline
