// SPDX-License-Identifier: MIT
#include "lib/simulate/joint_list.hpp"

#include <fmt/format.h>

#include "lib/core/error.hpp"

namespace faultline {

void bad_value(const std::string& key, const std::string& message) {
  throw Error(ErrorCode::usage, key, message);
}

void check_count(int joints, const std::vector<double>& list, const char* key) {
  if (!list.empty() && static_cast<int>(list.size()) != joints)
    bad_value(key, fmt::format("expected {} numbers, found {}", joints, list.size()));
}

void check_positive(int joints, const std::vector<double>& list, const char* key) {
  check_count(joints, list, key);
  for (const double value : list)
    if (!(value > 0.0)) bad_value(key, fmt::format("expected positive numbers, found {}", value));
}

void check_not_negative(int joints, const std::vector<double>& list, const char* key) {
  check_count(joints, list, key);
  for (const double value : list)
    if (!(value >= 0.0))
      bad_value(key, fmt::format("expected numbers that are not negative, found {}", value));
}

std::vector<double> or_all(const std::vector<double>& list, int joints, double usual) {
  return list.empty() ? std::vector<double>(joints, usual) : list;
}

}  // namespace faultline
