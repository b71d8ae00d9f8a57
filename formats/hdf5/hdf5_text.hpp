// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/hdf5/hdf5_library.hpp"

namespace faultline {

/// The texts of the first of these attributes that the object has, one or a list; empty when it has none.
std::vector<std::string> hdf5_attribute(hid_t object, const std::vector<std::string>& names);

/// The texts that a dataset of texts holds; empty when it holds something else.
std::vector<std::string> hdf5_texts(hid_t dataset);

}  // namespace faultline
