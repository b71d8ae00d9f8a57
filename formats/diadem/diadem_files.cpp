// SPDX-License-Identifier: MIT
#include "formats/diadem/diadem_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <system_error>

#include "formats/bytes/unpack_block.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

std::string in_small_letters(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// What the channels that share the blocks of a file state.
struct DiademBlocks {
  std::int64_t channels = 0;
  std::int64_t last = 0;    ///< greatest place of a channel in a row, from 1
  std::int64_t rows = 0;    ///< values of the longest channel
  std::int64_t stated = 0;  ///< width by line 222; 0 for none
  std::int64_t size = 0;    ///< of a value, bytes; 0 when no channel can be read
};

DiademBlocks blocks_of(const std::vector<const DiademChannel*>& channels, const std::string& path) {
  DiademBlocks blocks;
  for (const DiademChannel* channel : channels) {
    if (!channel->in_blocks) continue;
    ++blocks.channels;
    blocks.last = std::max(blocks.last, channel->first);
    if (!channel->damage.empty()) continue;
    const auto size = static_cast<std::int64_t>(size_of(channel->type));
    if (blocks.size > 0 && blocks.size != size)
      throw Error(
          ErrorCode::input, path,
          fmt::format("stores values of {} and of {} bytes in the blocks of one file, so the place of a "
                      "value is unknown; save the recording with all channels as REAL64",
                      blocks.size, size));
    blocks.size = size;
    blocks.rows = std::max(blocks.rows, channel->values);
    blocks.stated = std::max(blocks.stated, channel->block_width.value_or(0));
  }
  return blocks;
}

}  // namespace

bool is_bare_name(const std::string& name) {
  return name != "." && name != ".." && name.find_first_of("/\\:") == std::string::npos &&
         std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; });
}

std::vector<std::string> data_files_named(const std::string& name, const std::string& header) {
  const fs::path folder = fs::path(header).parent_path();
  std::error_code error;
  const auto is_data = [&](const fs::path& path) {
    return fs::is_regular_file(path, error) && !fs::equivalent(path, header, error);
  };
  if (is_data(folder / name)) return {(folder / name).string()};
  std::vector<std::string> found;
  fs::directory_iterator entry(folder.empty() ? "." : folder, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
    const fs::path other = folder / entry->path().filename();
    if (in_small_letters(other.filename().string()) == in_small_letters(name) && is_data(other))
      found.push_back(other.string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> diadem_data_files(const DiademHeader& header, const std::string& path) {
  std::vector<std::string> files;
  std::set<std::string> seen;
  for (const DiademChannel& channel : header.channels) {
    if (channel.implicit || channel.file.empty() || !is_bare_name(channel.file)) continue;
    if (!seen.insert(channel.file).second) continue;
    for (const std::string& file : data_files_named(channel.file, path))
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  }
  return files;
}

std::int64_t block_width_of(const std::vector<const DiademChannel*>& channels, const DiademFile& file,
                            const std::string& path) {
  const DiademBlocks blocks = blocks_of(channels, path);
  if (blocks.size == 0 || blocks.rows == 0) return blocks.channels;
  const auto fits = [&](std::int64_t width) {
    return file.bytes % (blocks.size * width) == 0 && file.bytes / (blocks.size * width) == blocks.rows;
  };
  std::set<std::int64_t> possible;
  for (const std::int64_t width : {blocks.channels, blocks.stated})
    if (width >= blocks.last) possible.insert(width);
  const std::int64_t by_size = file.bytes / blocks.size / blocks.rows;
  if (possible.empty() && by_size >= blocks.last && fits(by_size)) possible.insert(by_size);
  if (possible.size() > 1) std::erase_if(possible, [&](std::int64_t width) { return !fits(width); });
  if (possible.size() != 1)
    throw Error(ErrorCode::input, path,
                fmt::format("stores {} in blocks of unknown width: line 222 states {} values, a channel is "
                            "number {} of a row, and the data file has {} bytes for {} rows. Copy header and "
                            "data file from the controller again",
                            counted(blocks.channels, "channel"), blocks.stated, blocks.last, file.bytes,
                            blocks.rows));
  const std::int64_t width = *possible.begin();
  if (width * blocks.size > static_cast<std::int64_t>(kLargestBlock))
    throw Error(ErrorCode::input, path,
                fmt::format("has rows of {} values, more than the {} MiB that can be read at once; save the "
                            "channels of the joints alone",
                            width, kLargestBlock >> 20));
  return width;
}

}  // namespace faultline
