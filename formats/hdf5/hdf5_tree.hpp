// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/hdf5/hdf5_dataset.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// What a file holds.
struct Hdf5Tree {
  std::vector<std::string> datasets;  ///< paths from the root, beginning with '/', in their order
  std::string notes;                  ///< of a log that was written
  Issues issues;                      ///< groups that cannot be read
};

/// Links to other places and files are not followed.
Hdf5Tree hdf5_tree(hid_t file);

/// Gives the fields of a dataset the units and names that its attributes tell, and what pandas keeps beside
/// it.
void describe_hdf5_fields(hid_t file, const std::string& path, Hdf5Dataset& dataset);

/// Whether MATLAB says that these numbers are characters.
bool is_text_of_matlab(hid_t dataset);

}  // namespace faultline
