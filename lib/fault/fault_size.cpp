// SPDX-License-Identifier: MIT
#include "lib/fault/fault_size.hpp"

namespace faultline {

const char* unit_of(SizeMeasure measure, bool turns) {
  switch (measure) {
    case SizeMeasure::torque_share:
      return "1";
    case SizeMeasure::length:
      return turns ? "rad" : "m";
    case SizeMeasure::length_per_s:
      return turns ? "rad/s" : "m/s";
    case SizeMeasure::viscous_friction:
      return turns ? "N m s/rad" : "N s/m";
    case SizeMeasure::coulomb_friction:
    case SizeMeasure::torque:
      return turns ? "N m" : "N";
    case SizeMeasure::mass:
      return "kg";
    case SizeMeasure::impulse:
      return turns ? "N m s" : "N s";
  }
  return "";
}

const char* usual_of(SizeMeasure measure) {
  switch (measure) {
    case SizeMeasure::torque_share:
      return "the torque";
    case SizeMeasure::length:
      return "the range";
    case SizeMeasure::length_per_s:
      return "the range, per s";
    case SizeMeasure::viscous_friction:
      return "the viscous friction";
    case SizeMeasure::coulomb_friction:
      return "the Coulomb friction";
    case SizeMeasure::mass:
      return "the mass carried";
    case SizeMeasure::torque:
      return "the largest torque";
    case SizeMeasure::impulse:
      return "the impulse of a usual push";
  }
  return "";
}

const char* to_string(Spread spread) {
  switch (spread) {
    case Spread::uniform:
      return "uniform";
    case Spread::log_uniform:
      return "log_uniform";
  }
  return "";
}

}  // namespace faultline
