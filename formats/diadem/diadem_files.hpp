// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/diadem/diadem_header.hpp"

namespace faultline {

/// A data file beside the header.
struct DiademFile {
  std::string path;
  std::int64_t bytes = 0;
};

/// Whether the name is that of a file in the folder of the header, not a path.
bool is_bare_name(const std::string& name);

/// Returns the regular files with this bare name in the folder of the header at `header`: the one that is
/// equal to it, else those that differ in capitals only. The header itself is none.
std::vector<std::string> data_files_named(const std::string& name, const std::string& header);

/// Returns the paths of the data files that the header at `path` names and that exist, in its order; not
/// those whose names lead out of the folder.
std::vector<std::string> diadem_data_files(const DiademHeader& header, const std::string& path);

/// Returns the number of values in a row of a file that stores its channels in blocks: one a channel, unless
/// line 222 or the size of the file contradicts. `channels` are those of the file. Throws Error(input),
/// naming the header at `path`, when the width is unknown or too large.
std::int64_t block_width_of(const std::vector<const DiademChannel*>& channels, const DiademFile& file,
                            const std::string& path);

}  // namespace faultline
