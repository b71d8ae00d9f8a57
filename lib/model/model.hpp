// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/classify/confidence_calibration.hpp"
#include "lib/classify/episode_classifier.hpp"
#include "lib/classify/fault_criterion.hpp"
#include "lib/classify/sample_classifier.hpp"
#include "lib/explain/explain_log.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/usual_motion.hpp"
#include "lib/model/twin/twin_options.hpp"
#include "lib/residual/relation/signal_relation.hpp"
#include "lib/residual/residual_generator.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Detection and classification of faults of one kind in simulated runs that were not used for training.
struct ValidationRow {
  FaultKind kind = FaultKind::none;
  int runs = 0;
  int detected = 0;
  int right_kind = 0;   ///< at any joint
  int right_joint = 0;  ///< of any kind
  int right_kind_and_joint = 0;
  int right_or_named = 0;  ///< right, or the right label in could_also_be
  double median_delay_s = std::numeric_limits<double>::quiet_NaN();  ///< from onset to alarm
  double p90_delay_s = std::numeric_limits<double>::quiet_NaN();
};

/// Smallest fault of one kind at one joint that is still found, from simulated runs.
struct Detectability {
  FaultLabel label;
  int runs = 0;
  int found = 0;
  /// From this size on, nine of ten faults are found: share, rad, m, N m, N, kg and so on; for a collision
  /// its impulse. NaN for kinds without a size, or if no size suffices.
  double size = std::numeric_limits<double>::quiet_NaN();
  double least_size = std::numeric_limits<double>::quiet_NaN();  ///< the smallest simulated size
  double median_delay_s = std::numeric_limits<double>::quiet_NaN();
};

/// Performance of a model on runs of the identified robot (its parameters drawn from their uncertainty).
struct Validation {
  std::vector<ValidationRow> rows;
  std::vector<Detectability> reach;  ///< in the order of the labels; includes training runs
  int early_alarms = 0;              ///< alarms before the onset, in the runs of `rows`
  double healthy_hours = 0.0;
  int false_alarms = 0;  ///< in the healthy hours
  /// Expected calibration error of the confidences in `rows`: as computed from networks, votes and
  /// likelihood, and after calibration by other runs. NaN if nothing was found.
  double raw_confidence_error = std::numeric_limits<double>::quiet_NaN();
  double confidence_error = std::numeric_limits<double>::quiet_NaN();
};

inline constexpr const char* kLeftOut = "left out";

/// A log that a model was learned from, or that was left out.
struct ModelSource {
  std::string path;  ///< file name without folders
  std::string sha256;
  long long rows = 0;
  std::string fault;  ///< "none", the given label, or kLeftOut
};

/// The paper's method: both networks on the residuals of each sample, and the tuned fault criterion.
struct SampleMode {
  SampleClassifier classifier;
  CriterionOptions consecutive{.kind = CriterionKind::consecutive};
  CriterionOptions log_odds{.kind = CriterionKind::log_odds};
};

/// A manual change of a model file that a person accepted (`faultline model sign`).
struct ModelEdit {
  std::string digest_before;  ///< digest in the file when it was signed; empty if there was none
  std::string why;            ///< reason of the signer; may be empty
};

/// The model of one healthy robot: the result of `learn` and, with the case base, the input of `diagnose`.
struct Model {
  std::string name;
  Robot robot;  ///< identified
  /// Quality of the identification, with intervals; without robot, estimate, covariance and logs. `not_run`
  /// without mechanics.
  Identification identification;
  double sample_period_s = 0.0;    ///< usual sample period of the training logs
  bool has_velocity = true;        ///< whether these logs have dq
  UsualMotion motion;              ///< of its healthy logs
  ExplainModel explain;            ///< explains its logs
  std::vector<FaultLabel> labels;  ///< possible faults; follow from the robot, not stored
  ResidualGenerator residual;
  std::vector<SignalRelation> relations;  ///< second residuals, tracking; empty if the logs lack the signals
  EpisodeClassifier episode_classifier;
  ConfidenceCalibration confidence;  ///< of fault labels; from simulated runs not used for training
  SampleMode samples;
  Validation validation;
  std::vector<ModelSource> sources;
  TwinOptions twin;    ///< distribution of the training runs
  std::string sha256;  ///< of the file that it was read from
  /// Identity that binds the case base to the model; empty until bind_cases() sets it. An edit of the model
  /// does not change it.
  std::string identity;
  std::vector<ModelEdit> edits;
  std::vector<std::string> doubts;        ///< reasons against trusting the model; each diagnosis reports them
  std::vector<std::string> grave_doubts;  ///< those that forbid calling any log healthy

  /// False if the model was learned from logs without torque: then only `relations` are judged.
  bool has_mechanics() const { return residual.joints() > 0; }
};

/// Returns the possible faults of a robot whose torque is logged as its file states.
std::vector<FaultLabel> labels_of(const Robot& robot);

/// Returns the model as a JSON file, schema "faultline/model/4", with the digest of its content.
std::string model_to_json(const Model& model);
/// Throws Error(input) if the text is no model, is cut, damaged or edited without a signature, has another
/// schema or a number beyond its range, or does not fit together.
Model model_from_json(const std::string& text, const std::string& where);
/// Throws Error(input).
Model load_model(const std::string& path);

}  // namespace faultline
