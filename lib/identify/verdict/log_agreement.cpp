// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/log_agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/make_issue.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr int kFewestLogs = 3;      // of two that disagree neither is the odd one
constexpr double kOdd = 4.0;        // times what other logs leave of their torque, in rms and as a share,
constexpr double kOddShare = 0.01;  // and at least this share of its mean square: days of a robot differ too

}  // namespace

std::vector<int> odd_logs(const ModelChoice& choice) {
  std::vector<int> odd;
  const HeldOutError& e = choice.held_out;
  const int logs = static_cast<int>(e.square.rows());
  if (choice.spread.size() == 0 || logs < kFewestLogs) return odd;
  for (int i = 0; i < logs; ++i)
    for (int j = 0; j < static_cast<int>(e.square.cols()); ++j) {
      std::vector<double> left, share;
      for (int k = 0; k < logs; ++k)
        if (k != i && e.rows(k, j) > 0.0) {
          left.push_back(e.square(k, j));
          share.push_back(e.square(k, j) / std::max(e.torque(k, j), 1e-300));
        }
      if (left.empty() || e.rows(i, j) == 0.0) continue;
      const double own_share = e.square(i, j) / std::max(e.torque(i, j), 1e-300);
      if (e.square(i, j) > kOdd * kOdd * upper_median(left) && own_share > kOddShare &&
          own_share > kOdd * kOdd * upper_median(share)) {
        odd.push_back(i);
        break;
      }
    }
  if (2 * odd.size() >= static_cast<std::size_t>(logs)) odd.clear();
  return odd;
}

std::vector<int> repeated_logs(Identification& id) {
  std::vector<int> repeated;
  for (std::size_t i = 0; i < id.logs.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (id.logs[i].sha256.empty() || id.logs[i].sha256 != id.logs[k].sha256 || id.logs[k].left_out)
        continue;
      repeated.push_back(static_cast<int>(i));
      id.logs[i].left_out = true;
      id.issues.add(make_issue(fmt::format("repeated_log_{}", i + 1), Severity::warning,
                               fmt::format("{} is {} once more, byte for byte; it was left out",
                                           id.logs[i].path, id.logs[k].path)));
      break;
    }
  return repeated;
}

void tell_spread(const ModelChoice& choice, Identification& id) {
  id.between_logs_std.assign(id.space.count(), std::numeric_limits<double>::quiet_NaN());
  std::vector<int> used;
  for (int log = 0; log < static_cast<int>(choice.spread.cols()); ++log)
    if (!id.logs[log].left_out) used.push_back(log);
  if (used.size() < kFewestLogs) return;
  for (int p = 0; p < id.space.timing(); ++p) {
    if (!choice.wanted[p]) continue;
    const Eigen::ArrayXd values = choice.spread.row(p)(used);
    id.between_logs_std[p] =
        std::sqrt((values - values.mean()).square().sum() / static_cast<double>(used.size() - 1));
  }
}

}  // namespace faultline
