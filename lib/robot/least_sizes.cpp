// SPDX-License-Identifier: MIT
#include "lib/robot/least_sizes.hpp"

#include <fmt/format.h>

#include "lib/robot/toml/toml_text.hpp"

namespace faultline {
namespace {

constexpr double kMostLeastSize =
    10.0;  // times the usual value: a larger share would switch the fault kind off

FaultKind kind_at(std::size_t i) { return static_cast<FaultKind>(i); }

}  // namespace

LeastSizes::LeastSizes() : share{} {
  for (std::size_t i = 0; i < share.size(); ++i) share[i] = describe(kind_at(i)).least_size;
}

LeastSizes least_sizes_from_table(const TomlTable& table) {
  LeastSizes sizes;
  for (std::size_t i = 0; i < sizes.share.size(); ++i) {
    const FaultDescription& fault = describe(kind_at(i));
    if (!(fault.least_size > 0.0)) continue;
    sizes.share[i] = table.number(fault.name, fault.least_size);
    if (!(sizes.share[i] >= 0.0 && sizes.share[i] <= kMostLeastSize))
      table.fail(fault.name, fmt::format("expected a share of {} from 0 to {:g}, such as {:g}, found {:g}",
                                         usual_of(fault.sizes().back().feature), kMostLeastSize,
                                         fault.least_size, sizes.share[i]));
  }
  return sizes;
}

std::string least_sizes_text(const LeastSizes& sizes) {
  if (sizes == LeastSizes{}) return "";
  std::string text = "\n[least_size]\n";
  for (std::size_t i = 0; i < sizes.share.size(); ++i)
    if (const FaultDescription& fault = describe(kind_at(i)); fault.least_size > 0.0)
      text += fmt::format("{} = {}\n", fault.name, toml_number(sizes.share[i]));
  return text;
}

}  // namespace faultline
