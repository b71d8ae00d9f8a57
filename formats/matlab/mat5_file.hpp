// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/arrays/array_file.hpp"

namespace faultline {

inline constexpr std::size_t kMatHeaderBytes = 128;

/// Opens the matrices of numbers of a MATLAB file of version 5 (6, 7); those in structures are named by their
/// path, as name.field. Throws Error(input) when it is cut inside its header.
std::unique_ptr<ArrayFile> open_mat5_arrays(const std::string& path);

/// Returns the name of an array in structures of MATLAB: for the output of Simulink and for time series the
/// name of the signal, "q" for "q.signals.values" and "q.Data".
std::string matlab_name(const std::string& path);

}  // namespace faultline
