// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/work/file_use.hpp"
#include "apps/work/labels.hpp"
#include "lib/cases/carry_over.hpp"
#include "lib/learn/learn.hpp"

namespace faultline {

/// Open logs to learn from, by their known faults.
struct OpenLogs {
  std::vector<std::unique_ptr<LogSource>> owners;
  std::vector<LogSource*> healthy;
  std::vector<LabelledLog> labelled;

  /// Returns false when there are labels but none for this log, which then counts as healthy. Throws
  /// Error(usage) for a label that is impossible for the robot.
  bool add(const std::string& name, std::unique_ptr<LogSource> log, const std::vector<LogLabel>& labels,
           const Robot& robot);
  /// Throws Error(usage) when no log is healthy.
  void require_healthy() const;
};

/// Throws before the work begins if the files could not be written after it.
void check_writable(const ModelPaths& paths, const Robot& robot);

/// Writes model and case base; cases that people added to an existing case base are carried over into
/// `cases`. The case base comes first, as only it holds data that cannot be made again. A kill between the
/// two leaves two identities, which load_model_files() detects and learning again repairs.
std::optional<CarriedCases> write_model(const Model& model, CaseBase& cases, const ModelPaths& paths);

/// Reports the fate of the existing cases in a sentence or two; empty if there were none.
std::string carried_text(const std::optional<CarriedCases>& carried);

}  // namespace faultline
