// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/byte_window.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Reads the columns from the preface of a native log, or from its second copy when the first is damaged,
/// which is told in `issues`, and goes on to the first chunk. Throws Error(input) when none can be read or
/// the file is of a newer version.
std::vector<RawColumn> read_native_preface(ByteWindow& bytes, const std::string& path, Issues& issues);

}  // namespace faultline
