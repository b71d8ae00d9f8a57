// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/arrays/array_file.hpp"

namespace faultline {

/// Converts the path of a dataset to the name that MATLAB shows; MATLAB stores matrices transposed.
using MatlabNaming = std::string (*)(const std::string& path);

/// Opens the datasets; `matlab` is null for an ordinary file.
std::unique_ptr<ArrayFile> open_hdf5_arrays(const std::string& path, MatlabNaming matlab);

}  // namespace faultline
