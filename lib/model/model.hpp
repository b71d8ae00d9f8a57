// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/classify/confidence_calibration.hpp"
#include "lib/classify/episode_classifier.hpp"
#include "lib/classify/fault_criterion.hpp"
#include "lib/classify/sample_classifier.hpp"
#include "lib/explain/explain_log.hpp"
#include "lib/fault/fault_labels.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/usual_motion.hpp"
#include "lib/model/twin/twin_options.hpp"
#include "lib/residual/relation/signal_relation.hpp"
#include "lib/residual/residual_generator.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// How often faults of one kind were found in simulated runs that nothing was trained on.
struct ValidationRow {
  FaultKind kind = FaultKind::none;
  int runs = 0;
  int detected = 0;
  int right_kind = 0;   ///< whatever the joint
  int right_joint = 0;  ///< whatever the kind
  int right_kind_and_joint = 0;
  int right_or_named = 0;  ///< right, or the right one in could_also_be
  double median_delay_s = std::numeric_limits<double>::quiet_NaN();  ///< onset to alarm
  double p90_delay_s = std::numeric_limits<double>::quiet_NaN();
};

/// How small a fault of one kind at one joint may be to be found all the same, by simulated runs.
struct Reach {
  FaultLabel label;
  int runs = 0;
  int found = 0;
  /// Found nine times of ten from this size on: share, rad, m, N m, N, kg and so on, of a collision its
  /// impulse. NaN for kinds without a size, and where none is large enough.
  double size = std::numeric_limits<double>::quiet_NaN();
  double least_size = std::numeric_limits<double>::quiet_NaN();  ///< the smallest that was simulated
  double median_delay_s = std::numeric_limits<double>::quiet_NaN();
};

/// How good a model is, on runs of the identified robot (its parameters drawn from their uncertainty).
struct Validation {
  std::vector<ValidationRow> rows;
  std::vector<Reach> reach;  ///< in the order of the labels; also of the runs that were trained on
  int early_alarms = 0;      ///< alarms before the onset, in the runs of `rows`
  double healthy_hours = 0.0;
  int false_alarms = 0;  ///< in them
  /// Expected calibration error of the confidences in `rows`: as networks, votes and likelihood gave them,
  /// and calibrated by other runs. NaN where nothing was found.
  double raw_confidence_error = std::numeric_limits<double>::quiet_NaN();
  double confidence_error = std::numeric_limits<double>::quiet_NaN();
};

inline constexpr const char* kLeftOut = "left out";

/// A log that a model was learned from, or would have been.
struct ModelSource {
  std::string path;  ///< file name without folders
  std::string sha256;
  long long rows = 0;
  std::string fault;  ///< "none", the label it came with, or kLeftOut
};

/// The paper's way: both networks over the residuals of each sample, and the fault criterion, as tuned.
struct SampleMode {
  SampleClassifier classifier;
  CriterionOptions consecutive{.kind = CriterionKind::consecutive};
  CriterionOptions log_odds{.kind = CriterionKind::log_odds};
};

/// A change of a model file by hand that somebody accepted (`faultline model sign`).
struct ModelEdit {
  std::string digest_before;  ///< that the file carried when it was signed; empty where it carried none
  std::string why;            ///< as its signer says; may be empty
};

/// All that is known of one healthy robot: what `learn` makes and `diagnose` needs besides the case base.
struct Model {
  std::string name;
  Robot robot;  ///< identified
  /// How well, with intervals; without robot, estimate, covariance and logs. `not_run` in models of programs
  /// that did not keep it.
  Identification identification;
  double sample_period_s = 0.0;    ///< usual one of the logs it was learned from
  bool has_velocity = true;        ///< those logs have dq
  UsualMotion motion;              ///< of its healthy logs
  ExplainModel explain;            ///< what explains its logs
  std::vector<FaultLabel> labels;  ///< what may be wrong with it; follows from the robot, not stored
  ResidualGenerator residual;
  std::vector<SignalRelation>
      relations;  ///< second residuals, tracking; none where the logs lack the signals
  EpisodeClassifier episode_classifier;
  ConfidenceCalibration confidence;  ///< of what names a fault, by simulated runs that it was not trained on
  SampleMode samples;
  Validation validation;
  std::vector<ModelSource> sources;
  std::optional<TwinOptions>
      twin;            ///< what it was trained on; none in models of programs that did not keep it
  std::string sha256;  ///< of the file it was read from
  /// What binds the case base to it (bind_cases()); empty in models of programs that gave none. It stays when
  /// the model is edited.
  std::string identity;
  std::vector<ModelEdit> edits;
  std::vector<std::string> doubts;  ///< why it is not to be trusted as others are; each diagnosis says so
  std::vector<std::string> grave_doubts;  ///< those of them with which no log can be called healthy

  /// False where it was learned from logs without torque: then only `relations` judge.
  bool has_mechanics() const { return residual.joints() > 0; }
};

/// What may be wrong with a robot whose torque is logged as its file says.
std::vector<FaultLabel> labels_of(const Robot& robot);

/// The model as one JSON file, schema "faultline/model/4", with the digest of its content.
std::string model_to_json(const Model& model);
/// Throws Error(input) for text that is no model, is cut, damaged or edited without a signature, is of a
/// newer schema, has a number beyond its range or does not fit together.
Model model_from_json(const std::string& text, const std::string& where);
/// Throws Error(input).
Model load_model(const std::string& path);

}  // namespace faultline
