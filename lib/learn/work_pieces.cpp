// SPDX-License-Identifier: MIT
#include "lib/learn/work_pieces.hpp"

#include <cstdint>
#include <utility>

namespace faultline {
namespace {

constexpr double kFewestOfAll = 0.15;       // share of the rows: with less, the robot is identified from all
constexpr std::int64_t kFewestRows = 1000;  // rows of all logs together: fewer do not identify a robot
constexpr double kSpare_s = 0.05;           // margin between a change of the level and the rows used

/// A time range without a work piece.
struct EmptyTimes {
  double begin_s = 0.0, end_s = 0.0;
};

std::vector<EmptyTimes> empty_times(const PieceTimes& piece) {
  std::vector<EmptyTimes> out;
  const auto rows = static_cast<int>(piece.path.size());
  for (int k = 0; k < rows; ++k) {
    if (piece.path[k] != 0) continue;
    const int first = k;
    while (k + 1 < rows && piece.path[k + 1] == 0) ++k;
    out.push_back({piece.time_s[first] + (first > 0 ? kSpare_s : -kSpare_s),
                   piece.time_s[k] + (k + 1 < rows ? -kSpare_s : kSpare_s)});
  }
  return out;
}

/// The number of rows of a log, and its rows without a work piece.
struct EmptyRows {
  std::int64_t all = 0;
  std::vector<RowRange> empty;
};

EmptyRows rows_within(LogSource& log, const std::vector<EmptyTimes>& times) {
  EmptyRows out;
  std::size_t next = 0;
  bool is_open = false;
  log.rewind();
  for (Log segment; log.next(segment);)
    for (int k = 0; k < segment.rows(); ++k, ++out.all) {
      const double t = segment.time[k];
      while (next < times.size() && t > times[next].end_s) {
        ++next;
        is_open = false;
      }
      const bool is_empty = next < times.size() && t >= times[next].begin_s;
      if (!is_empty) continue;
      if (!is_open) out.empty.push_back({out.all, out.all});
      is_open = true;
      out.empty.back().end = out.all + 1;
    }
  return out;
}

}  // namespace

std::vector<std::vector<RowRange>> rows_without_work_piece(std::span<LogSource* const> logs,
                                                           const FittedDays& days) {
  if (!(days.model.piece_kg > 0.0)) return {};
  std::vector<std::vector<RowRange>> out;
  std::int64_t all = 0, without_piece = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    EmptyRows rows = rows_within(*logs[i], empty_times(days.pieces[i]));
    all += rows.all;
    for (const RowRange& range : rows.empty) without_piece += range.end - range.begin;
    out.push_back(std::move(rows.empty));
  }
  const bool enough = without_piece >= kFewestRows &&
                      static_cast<double>(without_piece) >= kFewestOfAll * static_cast<double>(all);
  return enough ? out : std::vector<std::vector<RowRange>>{};
}

}  // namespace faultline
