// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "lib/log/raw_reader.hpp"

namespace faultline {

/// How the rows of several files are matched.
enum class JoinBy {
  automatic,  ///< by time if both files have one, else by row
  row,        ///< row i of one file belongs to row i of the other
  time,       ///< linear interpolation between the rows before and after
};

/// Returns the rows of `first` with its columns and those of the others; a value that a file lacks for a row
/// is NaN. A column whose name exists already gets the file's name as prefix; joins by time omit the times of
/// the others. Throws Error(input) for a join by time of a file without time.
std::unique_ptr<RawReader> join_files(std::unique_ptr<RawReader> first,
                                      std::vector<std::unique_ptr<RawReader>> others, JoinBy by);

/// Returns the rows of the files in sequence, with the columns (by name) and units of the first. Throws
/// Error(input) for units of another dimension.
std::unique_ptr<RawReader> continue_files(std::vector<std::unique_ptr<RawReader>> files);

}  // namespace faultline
