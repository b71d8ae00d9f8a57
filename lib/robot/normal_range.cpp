// SPDX-License-Identifier: MIT
#include "lib/robot/normal_range.hpp"

#include <fmt/format.h>

#include "lib/robot/toml/toml_values.hpp"

namespace faultline {
namespace {

constexpr double kMostLeastSize =
    10.0;  // times the usual value: a larger share would switch the fault kind off

FaultKind kind_at(std::size_t i) { return static_cast<FaultKind>(i); }

double share(const TomlTable& table, const char* key, double fallback) {
  const double value = table.number(key, fallback);
  if (value < 0.0 || value >= 1.0)
    table.fail(key,
               fmt::format("expected a share from 0 to less than 1, such as {}, found {}", fallback, value));
  return value;
}

std::array<double, 2> noise_factors(const TomlTable& table, const std::array<double, 2>& fallback) {
  if (!table.has("noise")) return fallback;
  const std::vector<double> factors = table.numbers("noise", 2);
  if (!(factors[0] > 0.0 && factors[0] <= 1.0 && factors[1] >= 1.0))
    table.fail("noise", fmt::format("expected a factor of at most 1 and one of at least 1, such as [0.5, 2], "
                                    "found [{}, {}]",
                                    factors[0], factors[1]));
  return {factors[0], factors[1]};
}

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

NormalRange normal_range_from_table(const TomlTable& normal) {
  NormalRange range;
  range.friction = share(normal, "friction", range.friction);
  range.torque_constant = share(normal, "torque_constant", range.torque_constant);
  range.torque_offset = share(normal, "torque_offset", range.torque_offset);
  range.model_error = share(normal, "model_error", range.model_error);
  range.noise = noise_factors(normal, range.noise);
  if (normal.has("work_piece_kg")) {
    range.work_piece_kg = normal.number("work_piece_kg", 0.0);
    check_signs(normal, "work_piece_kg", {range.work_piece_kg}, false);
  }
  return range;
}

std::string normal_range_text(const NormalRange& normal) {
  if (normal == NormalRange{}) return "";
  std::string text = fmt::format(
      "\n[normal]\nfriction = {}\ntorque_constant = {}\ntorque_offset = {}\nmodel_error = {}\n"
      "noise = [{}, {}]\n",
      toml_number(normal.friction), toml_number(normal.torque_constant), toml_number(normal.torque_offset),
      toml_number(normal.model_error), toml_number(normal.noise[0]), toml_number(normal.noise[1]));
  if (normal.work_piece_kg > 0.0) text += "work_piece_kg = " + toml_number(normal.work_piece_kg) + "\n";
  return text;
}

}  // namespace faultline
