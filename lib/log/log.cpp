// SPDX-License-Identifier: MIT
#include "lib/log/log.hpp"

#include "lib/log/log_channels.hpp"

namespace faultline {

void resize_like(Log& log, const Log& like, int rows) {
  for_each_column(log, like,
                  [&](std::vector<double>& mine, const std::vector<double>&) { mine.resize(rows); });
}

Log slice(const Log& log, int begin, int end) {
  Log part;
  part.first_row = log.first_row + begin;
  for_each_column(part, log, [&](std::vector<double>& mine, const std::vector<double>& all) {
    mine.assign(all.begin() + begin, all.begin() + end);
  });
  return part;
}

void append(Log& log, const Log& more) {
  if (log.rows() == 0) log.first_row = more.first_row;
  for_each_column(log, more, [](std::vector<double>& mine, const std::vector<double>& next) {
    mine.insert(mine.end(), next.begin(), next.end());
  });
}

}  // namespace faultline
