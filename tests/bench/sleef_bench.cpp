// SPDX-License-Identifier: MIT
// Elementary functions of lib/core/elementary beside the deterministic ones of SLEEF that do not fuse
// (package libsleef-dev): processor time of a call, least of the rounds, and largest error in units in the
// last place against the C library's long double.
#include <sleef.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/random.hpp"
#include "tests/bench/call_time.hpp"

namespace faultline {
namespace {

constexpr int kArguments = 4096, kRepeats = 50, kRounds = 15;

template <typename F>
double least_time_of(const F& function, const std::vector<double>& arguments) {
  double least = HUGE_VAL;
  for (int round = 0; round < kRounds; ++round)
    least = std::min(least, time_of(function, arguments, kRepeats));
  return least;
}

template <typename F, typename Truth>
double error_of(const F& function, const Truth& truth, const std::vector<double>& arguments) {
  long double most = 0.0L;
  for (const double x : arguments) {
    const long double right = truth(static_cast<long double>(x));
    const double size = std::abs(static_cast<double>(right));
    most = std::max(most, std::abs(function(x) - right) / (std::nextafter(size, HUGE_VAL) - size));
  }
  return static_cast<double>(most);
}

template <typename Ours, typename Theirs, typename Truth>
void compare(const char* name, double low, double high, const Ours& ours, const Theirs& theirs,
             const Truth& truth) {
  Random random(1);
  std::vector<double> arguments(kArguments);
  for (double& x : arguments) x = random.uniform(low, high);
  std::printf("%-6s ours %5.1f ns %.3f ulp   SLEEF %5.1f ns %.3f ulp\n", name, least_time_of(ours, arguments),
              error_of(ours, truth, arguments), least_time_of(theirs, arguments),
              error_of(theirs, truth, arguments));
}

}  // namespace
}  // namespace faultline

int main() {
  using namespace faultline;
  compare("exp", -20.0, 20.0, elementary::exp, Sleef_cinz_expd1_u10purec, expl);
  compare("log", 1e-3, 50.0, elementary::log, Sleef_cinz_logd1_u10purec, logl);
  compare("sin", -6.0, 6.0, elementary::sin, Sleef_cinz_sind1_u10purec, sinl);
  compare("tanh", -3.0, 3.0, elementary::tanh, Sleef_cinz_tanhd1_u10purec, tanhl);
  compare("log1p", -0.5, 3.0, elementary::log1p, Sleef_cinz_log1pd1_u10purec, log1pl);
  compare("atan", -5.0, 5.0, elementary::atan, Sleef_cinz_atand1_u10purec, atanl);
}
