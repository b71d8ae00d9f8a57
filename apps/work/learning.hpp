// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/work/labels.hpp"
#include "apps/work/model_paths.hpp"
#include "lib/cases/carry_over.hpp"
#include "lib/learn/learn.hpp"

namespace faultline {

/// Logs to learn from, open, by what they are known to show.
struct OpenLogs {
  std::vector<std::unique_ptr<LogSource>> owners;
  std::vector<LogSource*> healthy;
  std::vector<LabelledLog> labelled;

  /// False when there are labels and none names this log; it counts as healthy. Throws Error(usage) for a
  /// label that the robot cannot have.
  bool add(const std::string& name, std::unique_ptr<LogSource> log, const std::vector<LogLabel>& labels,
           const Robot& robot);
  /// Throws Error(usage) when no log is healthy.
  void require_healthy() const;
};

/// Fails before the work begins rather than after it.
void check_writable(const ModelPaths& paths, const Robot& robot);

/// Writes model and case base; what people put into a case base that was there is carried over into `cases`.
/// It comes first: it alone holds what nothing can make again. A kill between the two leaves two identities,
/// which load_model_files() notices and learning again mends.
std::optional<CarriedCases> write_model(const Model& model, CaseBase& cases, const ModelPaths& paths);

}  // namespace faultline
