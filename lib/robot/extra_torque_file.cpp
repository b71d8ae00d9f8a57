// SPDX-License-Identifier: MIT
#include "lib/robot/extra_torque_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/robot/toml/toml_text.hpp"
#include "lib/robot/toml/toml_values.hpp"

namespace faultline {
namespace {

constexpr double kFastest = 1e5;  // highest rate of a ripple, 1/rad or 1/m

}  // namespace

Chain read_extra_torque(const TomlTable& table, Chain chain) {
  const int n = chain.joints();
  for (const TomlTable& ripple : table.tables("ripple")) {
    const auto joint = ripple.integer("joint", 0);
    if (joint < 1 || joint > n)
      ripple.fail("joint", fmt::format("expected a joint from 1 to {}, found {}", n, joint));
    const double rate = ripple.number("rate");
    if (!(rate > 0.0 && rate <= kFastest))
      ripple.fail("rate", fmt::format("expected a number above 0 and up to {}, found {}", kFastest, rate));
    chain.ripples.push_back(
        {static_cast<int>(joint) - 1, rate, ripple.number("cosine", 0.0), ripple.number("sine", 0.0)});
  }
  for (const TomlTable& shared : table.tables("shared_drive")) {
    const auto along = shared.numbers("along", n);
    if (n - std::count(along.begin(), along.end(), 0.0) < 2)
      shared.fail("along", "expected a drive that turns with two joints or more: two numbers that are not 0");
    chain.shared_drives.push_back({Eigen::Map<const Eigen::VectorXd>(along.data(), n),
                                   not_negative(shared, "viscous", 0.0), not_negative(shared, "coulomb", 0.0),
                                   positive(shared, "width", 0.01),
                                   not_negative(shared, "rotor_inertia", 0.0)});
  }
  return chain;
}

std::string extra_torque_text(const Chain& chain, const std::string& prefix) {
  std::string text;
  for (const Ripple& r : chain.ripples)
    text += fmt::format("\n[[{}ripple]]\njoint = {}\nrate = {}\ncosine = {}\nsine = {}\n", prefix,
                        r.joint + 1, toml_number(r.rate), toml_number(r.cosine), toml_number(r.sine));
  for (const SharedDrive& f : chain.shared_drives)
    text += fmt::format(
        "\n[[{}shared_drive]]\nalong = {}\nviscous = {}\ncoulomb = {}\nwidth = {}\n"
        "rotor_inertia = {}\n",
        prefix, toml_numbers(f.along), toml_number(f.viscous), toml_number(f.coulomb), toml_number(f.width),
        toml_number(f.rotor_inertia));
  return text;
}

}  // namespace faultline
