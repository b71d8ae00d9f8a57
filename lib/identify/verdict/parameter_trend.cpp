// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/parameter_trend.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/distributions.hpp"

namespace faultline {
namespace {

constexpr int kTests = 2;  // tests of each parameter
constexpr double kScatters =
    0.05;  // probability below which logs scatter about the line beyond their own std

/// Weighted sums over the logs of one parameter.
struct TrendSums {
  double weight = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
};

double weight_of(const LogValue& v) { return 1.0 / (v.std * v.std); }

TrendSums sums_of(const std::vector<LogValue>& values) {
  TrendSums s;
  for (const LogValue& v : values) s.weight += weight_of(v);
  for (const LogValue& v : values) {
    s.x += weight_of(v) * v.log / s.weight;
    s.y += weight_of(v) * v.value / s.weight;
  }
  for (const LogValue& v : values) {
    s.xx += weight_of(v) * (v.log - s.x) * (v.log - s.x);
    s.xy += weight_of(v) * (v.log - s.x) * (v.value - s.y);
  }
  return s;
}

ParameterTrend tested(ParameterTrend t) {
  const TrendSums s = sums_of(t.by_log);
  const int logs = static_cast<int>(t.by_log.size());
  t.mean = s.y;
  t.slope = s.xy / s.xx;
  double about_line = 0.0;
  for (const LogValue& v : t.by_log) {
    const double from_mean = v.value - t.mean, from_line = from_mean - t.slope * (v.log - s.x);
    t.chi_square += weight_of(v) * from_mean * from_mean;
    about_line += weight_of(v) * from_line * from_line;
  }
  t.p_same = chi_square_tail(t.chi_square, logs - 1);
  const double scatter = about_line / (logs - 2);
  const bool scatters = chi_square_tail(about_line, logs - 2) < kScatters;
  t.slope_std = std::sqrt((scatters ? scatter : 1.0) / s.xx);
  const double ratio = t.slope / t.slope_std;
  t.p_level = scatters ? student_tail(ratio, logs - 2) : normal_tail(ratio);
  return t;
}

}  // namespace

std::vector<ParameterTrend> tested_trends(std::vector<ParameterTrend> trends) {
  for (ParameterTrend& t : trends) t = tested(std::move(t));
  const double level = kFalseFlags / (kTests * std::max<double>(static_cast<double>(trends.size()), 1.0));
  for (ParameterTrend& t : trends) {
    t.differs = t.p_same < level;
    t.drifts = t.p_level < level;
  }
  return trends;
}

}  // namespace faultline
