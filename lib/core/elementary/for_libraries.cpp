// SPDX-License-Identifier: MIT
// Without this file, linked libraries would depend on the processor: Ceres calls functions of the C library,
// and Eigen queries the sizes of the caches and splits long sums accordingly, in Ceres and in faultline. The
// linker redirects calls in them of every function `f` listed in lib/CMakeLists.txt to `__wrap_f` here.
#include <Eigen/Core>

#include "lib/core/elementary/elementary.hpp"

namespace own = faultline::elementary;

// NOLINTBEGIN(bugprone-reserved-identifier): the names are the linker's.
extern "C" {
double __wrap_exp(double x);
double __wrap_log(double x);
double __wrap_pow(double x, double y);
double __wrap_sin(double x);
double __wrap_cos(double x);
double __wrap_atan2(double y, double x);
void __wrap_sincos(double x, double* sine, double* cosine);

double __wrap_exp(double x) { return own::exp(x); }
double __wrap_log(double x) { return own::log(x); }
double __wrap_pow(double x, double y) { return own::pow(x, y); }
double __wrap_sin(double x) { return own::sin(x); }
double __wrap_cos(double x) { return own::cos(x); }
double __wrap_atan2(double y, double x) { return own::atan2(y, x); }
void __wrap_sincos(double x, double* sine, double* cosine) {
  const auto [s, c] = own::sin_cos(x);
  *sine = s;
  *cosine = c;
}
}
// NOLINTEND(bugprone-reserved-identifier)

namespace {

/// Set before main() begins, as the first product queries it; Eigen's own defaults for an unknown processor.
[[maybe_unused]] const bool kCachesAreSet = [] {
  constexpr std::ptrdiff_t kLevel1 = 32 * 1024, kLevel2 = 256 * 1024, kLevel3 = 2 * 1024 * 1024;
  Eigen::setCpuCacheSizes(kLevel1, kLevel2, kLevel3);
  return true;
}();

}  // namespace
