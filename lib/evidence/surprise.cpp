// SPDX-License-Identifier: MIT
#include "lib/evidence/surprise.hpp"

namespace faultline {
namespace {

constexpr double kFewest = 35.0;      // rows: slower logs are known too little between them
constexpr double kCorrelated = 0.12;  // more than is usual,
constexpr double kCorrelatedSpecific = 0.3;
constexpr double kLarge = 1.3;   // times what is usual,
constexpr double kChance = 4.0;  // and so many standard errors of white noise beyond

double or_else(double value, double fallback) { return std::isnan(value) ? fallback : value; }

}  // namespace

bool is_far_from_white(const Surprise& left, const Surprise& usual, bool is_specific) {
  if (left.rows() < kFewest) return false;
  const double chance = kChance / std::sqrt(left.numbers());
  const double correlation = left.correlation() - std::max(or_else(usual.correlation(), 0.0), 0.0);
  const double size = left.mean_square() / std::max(or_else(usual.mean_square(), 1.0), 1.0);
  return correlation > (is_specific ? kCorrelatedSpecific : kCorrelated) + chance || size > kLarge + chance;
}

}  // namespace faultline
