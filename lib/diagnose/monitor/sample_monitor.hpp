// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/diagnose_options.hpp"
#include "lib/diagnose/sample_alarm.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// The fault criterion applied to one series of outputs along a log.
class CriterionWatch {
 public:
  CriterionWatch(const CriterionOptions& options, const OutputMeaning& meaning)
      : options_(options), meaning_(meaning) {}

  void take(const Eigen::VectorXd& time, const Eigen::MatrixXd& outputs);
  /// After the last sample: an episode that is open ends.
  void finish();
  const std::vector<SampleEpisode>& episodes() const { return episodes_; }

 private:
  CriterionOptions options_;
  OutputMeaning meaning_;
  CriterionState state_;
  std::vector<SampleEpisode> episodes_;
};

/// The paper's way: both networks over the residuals of each sample, the fault criterion on their average
/// (figure 2) and on each alone (figure 1), whose word becomes its opinion. The criterion is that of the
/// options, as the model has tuned it.
class SampleMonitor {
 public:
  SampleMonitor(const SampleMode& samples, const DiagnoseOptions& options);

  void take(const Residuals& residuals);
  /// After the last segment.
  void finish();
  std::vector<SampleAlarm> alarms() const;

 private:
  const SampleClassifier& classifier_;
  CriterionWatch average_, mlp_, rbfn_;
};

}  // namespace faultline
