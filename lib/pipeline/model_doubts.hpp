// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// What speaks against a learned model, in sentences.
struct ModelDoubts {
  std::vector<std::string> grave;  ///< its diagnoses would mean nothing
  std::vector<std::string> minor;  ///< they mean less than those of other models

  bool is_grave() const { return !grave.empty(); }
  void add(const ModelDoubts& more);
};

/// A robot that does not explain the logs, or that no robot is.
ModelDoubts doubts_about(const Identification& identification);

/// A model that misses most of the faults it was trained on, or alarms where there are none.
ModelDoubts doubts_about(const Validation& validation);

/// All of them as one list, the grave first.
std::vector<std::string> listed(const ModelDoubts& doubts);

/// Throws Error(input) that names the grave doubts and what to do.
void refuse_grave(const ModelDoubts& doubts);

}  // namespace faultline
