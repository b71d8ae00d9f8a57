// SPDX-License-Identifier: MIT
#include <algorithm>

#include "apps/suggestion/robot_guess.hpp"
#include "formats/open_log.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostColumns = 256;
constexpr std::size_t kMostRows = 60000;
constexpr std::size_t kMostValues = 4'000'000;
constexpr int kBlockRows = 4096;

}  // namespace

std::size_t RawExcerpt::rows() const {
  std::size_t rows = 0;
  for (const auto& column : values) rows = std::max(rows, column.size());
  return rows;
}

RawExcerpt raw_excerpt(const std::string& path) {
  const auto reader = open_raw(path, false);
  RawExcerpt excerpt;
  excerpt.path = path;
  excerpt.canonical = reader->canonical();
  excerpt.columns = reader->columns();
  const std::size_t all = excerpt.columns.size(), taken = std::min(all, kMostColumns);
  excerpt.columns.resize(taken);
  const std::size_t most = std::min(kMostRows, kMostValues / std::max<std::size_t>(taken, 1));
  std::vector<bool> wanted(all, false);
  std::fill_n(wanted.begin(), taken, true);
  reader->want(wanted);
  excerpt.values.resize(taken);
  RawBlock block;
  while (excerpt.rows() < most && reader->next(block, kBlockRows))
    for (std::size_t c = 0; c < taken; ++c)
      excerpt.values[c].insert(excerpt.values[c].end(), block.columns[c].begin(), block.columns[c].end());
  return excerpt;
}

}  // namespace faultline
