// SPDX-License-Identifier: MIT
#include "lib/diagnose/diagnose_options.hpp"

namespace faultline {

const char* to_string(ClassifyMode mode) {
  switch (mode) {
    case ClassifyMode::evidence:
      return "evidence";
    case ClassifyMode::samples:
      return "samples";
  }
  return "";
}

}  // namespace faultline
