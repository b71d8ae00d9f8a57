// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/hdf5/hdf5_dataset.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// The content of a file.
struct Hdf5Tree {
  std::vector<std::string> datasets;  ///< paths from the root, beginning with '/', in their order
  std::string notes;                  ///< text stored by a written log, else empty
  Issues issues;                      ///< groups that cannot be read
};

/// Walks through the groups; links to other places and files are not followed.
Hdf5Tree hdf5_tree(hid_t file);

/// Sets units and names of the fields of a dataset from its attributes and from the item names that pandas
/// stores.
void describe_hdf5_fields(hid_t file, const std::string& path, Hdf5Dataset& dataset);

/// True when the MATLAB attributes of the dataset declare characters or cells.
bool is_text_of_matlab(hid_t dataset);

}  // namespace faultline
