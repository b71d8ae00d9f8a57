// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "lib/classify/fault_criterion.hpp"
#include "lib/diagnose/stop/stop_answer.hpp"

namespace faultline {

/// How faults are found and named.
enum class ClassifyMode {
  evidence,  ///< the regression finds episodes, both networks classify their evidence, cases decide
  samples,   ///< the paper's: both networks over the residuals of each sample, and the fault criterion
};
inline constexpr std::array kClassifyModes{ClassifyMode::evidence, ClassifyMode::samples};
inline const char* to_string(ClassifyMode mode) {
  switch (mode) {
    case ClassifyMode::evidence:
      return "evidence";
    case ClassifyMode::samples:
      return "samples";
  }
  return "";
}

struct DiagnoseOptions {
  ClassifyMode mode = ClassifyMode::evidence;
  CriterionKind criterion = CriterionKind::log_odds;  ///< of mode samples
  int g = 0;  ///< of the criterion `consecutive`; 0 = as tuned when the model was learned
  std::optional<StopQuestion> stop{};  ///< the moment that the diagnosis is asked about, if it is
};

}  // namespace faultline
