// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

/// The elementary functions of this project, for all of lib/, formats/ and apps/: plain IEEE additions,
/// multiplications, divisions and square roots in a fixed order, so that an argument gives the same bits on
/// every machine. Those of the C library differ with a fused multiply-add, and between releases. Each is
/// within one unit in the last place (most within 0.55; see tests/core/elementary) for every double,
/// subnormal and huge ones too; zeros keep their sign, NaN stays NaN, and infinities and poles are as in C
/// (Annex F). They neither set errno nor promise floating-point exceptions.
namespace faultline::elementary {

double exp(double x);
double log(double x);
double log1p(double x);
double log10(double x);
double pow(double x, double y);
double sin(double x);
double cos(double x);
double tanh(double x);
double asinh(double x);
double atan(double x);
double atan2(double y, double x);
double hypot(double x, double y);
double erfc(double x);

struct SinCos {
  double sin, cos;
};
/// Returns both, for little more time than one of them; the same bits as sin() and cos().
SinCos sin_cos(double x);

}  // namespace faultline::elementary
