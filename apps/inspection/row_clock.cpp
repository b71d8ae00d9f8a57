// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "apps/inspection/inspection.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kOnePeriod = 0.05;  // relative; joints that differ by more are in different units

}  // namespace

RowClock::RowClock(const std::vector<RawColumn>& table, ColumnMap columns, const std::string& path) {
  if (why_no_match(table, columns, path).empty()) return;
  columns["t"] = ColumnSpec{};
  columns["t"].name = kRowNumberName;
  if (!why_no_match(table, columns, path).empty()) return;
  matching_ = match_columns(table, columns, path);
  joints_.resize(matching_.joints);
}

std::vector<double> RowClock::values_of(const RawBlock& block, Channel channel) const {
  for (const ChannelSource& source : matching_.channels) {
    if (source.channel != channel || source.column < 0) continue;
    std::vector<double> values = block.columns[source.column];
    for (double& value : values) value = source.gain * value + source.offset;
    return values;
  }
  return {};
}

void RowClock::add(const RawBlock& block) {
  rows_.resize(block.rows);
  for (int i = 0; i < block.rows; ++i) rows_[i] = static_cast<double>(block.first_row + i);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint joint = Joint::at(static_cast<int>(j));
    const std::vector<double> q = values_of(block, {Quantity::q, joint}),
                              dq = values_of(block, {Quantity::dq, joint});
    if (!q.empty() && !dq.empty()) joints_[j].add(rows_, q, dq);
  }
}

std::optional<RowClock::Estimate> RowClock::estimate() const {
  std::vector<VelocityAgreement> moving;
  std::vector<double> periods;
  for (const VelocityCheck& check : joints_) {
    const VelocityAgreement joint = check.result();  // in units of rows
    if (joint.verdict == VelocityVerdict::not_judged) continue;
    if (!joint.is_one_motion() || joint.factor <= 0.0) return {};
    moving.push_back(joint);
    periods.push_back(joint.factor);
  }
  if (moving.empty()) return {};
  const double period = upper_median(periods);
  for (const VelocityAgreement& joint : moving)
    if (std::abs(joint.factor / period - 1.0) > kOnePeriod) return {};
  const auto best = std::min_element(
      moving.begin(), moving.end(), [](const auto& a, const auto& b) { return a.factor_std < b.factor_std; });
  return Estimate{best->factor, best->factor_std};
}

}  // namespace faultline
