// SPDX-License-Identifier: MIT
// What a call of the elementary functions of lib/core/elementary costs beside the C library's: processor time
// in pairs, median of the rounds, in nanoseconds. The C library picks its variant by processor; with
// GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4 it is timed as on a processor without fused multiply-add.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/random.hpp"
#include "tests/bench/call_time.hpp"

namespace faultline {
namespace {

constexpr int kArguments = 4096, kRepeats = 100, kRounds = 15;

template <typename Ours, typename Theirs>
void compare(const char* name, double low, double high, const Ours& ours, const Theirs& theirs) {
  Random random(1);
  std::vector<double> arguments(kArguments);
  // A motion: arguments that change little from one to the next.
  double phase = 0.0;
  for (double& x : arguments) {
    phase += 0.01 * random.uniform();
    x = low + (high - low) * std::abs(std::remainder(phase, 2.0));
  }
  std::array<double, kRounds> mine{}, other{};
  for (int round = 0; round < kRounds; ++round) {
    mine[round] = time_of(ours, arguments, kRepeats);
    other[round] = time_of(theirs, arguments, kRepeats);
  }
  const auto median = [](std::array<double, kRounds>& times) {
    std::nth_element(times.begin(), times.begin() + kRounds / 2, times.end());
    return times[kRounds / 2];
  };
  const double m = median(mine), o = median(other);
  std::printf("%-24s %6.1f ns   C library %6.1f ns   ratio %.2f\n", name, m, o, m / o);
}

void run() {
  namespace own = elementary;
  compare(
      "sin, -3 to 3", -3.0, 3.0, [](double x) { return own::sin(x); }, [](double x) { return std::sin(x); });
  compare(
      "cos, -3 to 3", -3.0, 3.0, [](double x) { return own::cos(x); }, [](double x) { return std::cos(x); });
  compare(
      "sin and cos, -3 to 3", -3.0, 3.0,
      [](double x) {
        const auto [s, c] = own::sin_cos(x);
        return s + c;
      },
      [](double x) { return std::sin(x) + std::cos(x); });
  compare(
      "sin, up to 1000", -1e3, 1e3, [](double x) { return own::sin(x); },
      [](double x) { return std::sin(x); });
  compare(
      "tanh, -0.5 to 0.5", -0.5, 0.5, [](double x) { return own::tanh(x); },
      [](double x) { return std::tanh(x); });
  compare(
      "tanh, -15 to 15", -15.0, 15.0, [](double x) { return own::tanh(x); },
      [](double x) { return std::tanh(x); });
  compare(
      "exp, -10 to 10", -10.0, 10.0, [](double x) { return own::exp(x); },
      [](double x) { return std::exp(x); });
  compare(
      "log, 0.001 to 10", 0.001, 10.0, [](double x) { return own::log(x); },
      [](double x) { return std::log(x); });
  compare(
      "log1p, 0 to 10", 0.0, 10.0, [](double x) { return own::log1p(x); },
      [](double x) { return std::log1p(x); });
  compare(
      "log10, 0.001 to 10", 0.001, 10.0, [](double x) { return own::log10(x); },
      [](double x) { return std::log10(x); });
  compare(
      "pow(x, 3.3), 0 to 10", 0.0, 10.0, [](double x) { return own::pow(x, 3.3); },
      [](double x) { return std::pow(x, 3.3); });
  compare(
      "asinh, -10 to 10", -10.0, 10.0, [](double x) { return own::asinh(x); },
      [](double x) { return std::asinh(x); });
  compare(
      "atan, -5 to 5", -5.0, 5.0, [](double x) { return own::atan(x); },
      [](double x) { return std::atan(x); });
  compare(
      "hypot(x, 1), -5 to 5", -5.0, 5.0, [](double x) { return own::hypot(x, 1.0); },
      [](double x) { return std::hypot(x, 1.0); });
  compare(
      "erfc, -2 to 5", -2.0, 5.0, [](double x) { return own::erfc(x); },
      [](double x) { return std::erfc(x); });
}

}  // namespace
}  // namespace faultline

int main() { faultline::run(); }
