// SPDX-License-Identifier: MIT
#include "lib/pipeline/without_work_piece.hpp"

#include <algorithm>
#include <limits>

#include "lib/core/parallel.hpp"
#include "lib/core/statistics.hpp"
#include "lib/evidence/learn/work_pieces.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kSpareRows = 20;  // beside a change, whose row is not told better
constexpr double kFewestOfAll = 0.15;    // share of the rows
constexpr std::int64_t kFewestRows = 1000;
constexpr std::int64_t kToTheEnd = std::numeric_limits<std::int64_t>::max();

bool is_picked_up(const WorkPieceChange& change) { return change.kg > 0.0; }

/// The tip's mass at the start of logs that began without a work piece, against what was identified.
double empty_tip(const std::vector<WorkPieceHistory>& histories) {
  std::vector<double> masses;
  for (const WorkPieceHistory& log : histories)
    if (!log.changes.empty()) masses.push_back(log.at_first_kg + std::min(log.changes.front().kg, 0.0));
  return masses.empty() ? 0.0 : upper_median(masses);
}

/// Between a piece put down, or the log's start, and a piece picked up, or its end.
std::vector<RowRange> empty_rows(const std::vector<WorkPieceChange>& changes) {
  std::vector<RowRange> out;
  for (std::size_t i = 0; i <= changes.size(); ++i) {
    const bool after = i == 0 || !is_picked_up(changes[i - 1]);
    const bool before = i == changes.size() || is_picked_up(changes[i]);
    const RowRange range{i == 0 ? 0 : changes[i - 1].row + kSpareRows,
                         i == changes.size() ? kToTheEnd : changes[i].row - kSpareRows};
    if (after && before && range.begin < range.end) out.push_back(range);
  }
  return out;
}

std::int64_t rows_in(const std::vector<RowRange>& ranges, std::int64_t rows) {
  std::int64_t sum = 0;
  for (const RowRange& range : ranges)
    sum += std::max<std::int64_t>(std::min(range.end, rows) - range.begin, 0);
  return sum;
}

}  // namespace

std::vector<std::vector<RowRange>> rows_without_work_piece(std::span<LogSource* const> logs,
                                                           const MotionModel& model, int threads) {
  if (model.work_pieces_kg.empty()) return {};
  const auto count = static_cast<int>(logs.size());
  std::vector<WorkPieceHistory> histories(logs.size());
  parallel_for(count, threads, [&](int i) { histories[i] = work_piece_history(*logs[i], model); });
  const double empty = empty_tip(histories);
  const double piece = *std::min_element(model.work_pieces_kg.begin(), model.work_pieces_kg.end());
  std::vector<std::vector<RowRange>> out(logs.size());
  std::int64_t all = 0, told = 0;
  for (int i = 0; i < count; ++i) {
    const WorkPieceHistory& log = histories[i];
    const bool carries_throughout = log.changes.empty() && log.at_first_kg - empty > 0.5 * piece;
    if (!carries_throughout) out[i] = empty_rows(log.changes);
    const std::int64_t rows = logs[i]->identity().rows_read;
    all += rows;
    told += rows_in(out[i], rows);
  }
  const bool enough =
      told >= kFewestRows && static_cast<double>(told) >= kFewestOfAll * static_cast<double>(all);
  return enough ? out : std::vector<std::vector<RowRange>>{};
}

}  // namespace faultline
