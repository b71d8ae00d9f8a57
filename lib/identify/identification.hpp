// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/core/joint.hpp"
#include "lib/core/random.hpp"
#include "lib/identify/excitation/excitation.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/verdict/parameter_trend.hpp"
#include "lib/identify/verdict/residual_pattern.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

enum class IdentificationStatus {
  not_run,
  converged,
  not_converged,     ///< values are the best found, not an optimum
  poorly_excited,    ///< converged, but some parameters are not identifiable from the motion and were kept
  poorly_explained,  ///< more than a twentieth of some joint's torque is unexplained: values are rough
  unexplained,       ///< the model does not explain the torque of some joint: values are meaningless
};

const char* to_string(IdentificationStatus status);

/// Status that a test found, and why.
struct FitStatus {
  IdentificationStatus status = IdentificationStatus::not_run;
  std::string reason;
};

/// Estimator of the values.
enum class IdentifyMethod {
  automatic,     ///< output error, unless model error dominates its residual: then weak form
  weak_form,     ///< momentum balance over short windows, least squares
  output_error,  ///< multiple shooting
};

const char* to_string(IdentifyMethod method);

struct ParameterEstimate {
  std::string name;
  double value = 0.0;
  double std = 0.0;  ///< NaN if not identifiable
  std::array<double, 2> ci95 = {0.0, 0.0};
  std::string unit;
  bool identifiable = false;
  std::string why_not;  ///< names the missing datum; empty if identifiable
  std::string meaning;  ///< of a base parameter: its sum of masses and inertias
};

struct IdentifiedLog {
  std::string path;
  std::string sha256;
  std::int64_t rows = 0;       ///< rows read
  std::int64_t rows_used = 0;  ///< rows in the windows of the weak form
  double sample_period_s = 0.0;
  double payload_kg = 0.0;
  std::vector<double> fit_r2;  ///< share of the torque's variance explained in this log, by joint
  bool left_out = false;       ///< excluded: it repeats another log or disagrees with the others
};

/// What an optional term is: a parameter, one of many candidates (shared drives, ripples, torque gains; those
/// that are rejected are not listed), or the delay of a torque.
enum class TermKind { parameter, candidate, delay };

/// An optional term of the model, and its gain on held-out data.
struct ModelTerm {
  std::string name;  ///< of the parameter, such as "jr2", or "delay_1"
  Joint joint{};     ///< the joint whose torque judges it
  bool kept = false;
  double error_before = 0.0;            ///< held-out residual of that joint without it, N m or N rms
  double error_after = 0.0;             ///< with it
  TermKind kind = TermKind::parameter;  ///< while the terms are chosen; not part of the JSON
};

/// Robot identified from healthy logs.
struct Identification {
  IdentificationStatus status = IdentificationStatus::not_run;
  std::string reason;  ///< why it stopped, in a sentence, and what tests found, separated by "; "
  IdentifyMethod method = IdentifyMethod::automatic;  ///< the estimator used
  /// The input robot with the identified values: `chain` moves as the logs did (its single masses and lengths
  /// are real only if physical_parameters are identifiable), `torque_phi`, friction.
  Robot robot;
  /// Base parameters, then fv_j, fc_j, offset_j, fb_j, fs_j and extra terms unless 0, phi, width_j.
  std::vector<ParameterEstimate> base_parameters;
  std::vector<ParameterEstimate> physical_parameters;  ///< m_j, l_j
  std::vector<double> q_noise;           ///< std of measured positions, by joint; at least that of rounding
  std::vector<double> dq_noise;          ///< std of measured velocities; empty if no log has them
  double condition_number = 0.0;         ///< of the base parameters' regressor, columns scaled to length 1
  std::vector<double> residual_rms;      ///< torque residual over windows, by joint, N m or N rms
  std::vector<double> fit_r2;            ///< share of the windowed torque's variance explained, by joint
  std::vector<double> held_out_r2;       ///< the same for held-out windows
  std::vector<ModelTerm> terms;          ///< optional terms that were tried, and whether they were kept
  std::vector<double> between_logs_std;  ///< std of `estimate` over fits to single logs; NaN if unknown
  std::vector<double> torque_delay_s;    ///< delay of each joint, relative to a straight line between samples
  std::vector<IdentifiedLog> logs;
  Issues issues;
  std::vector<JointFit> joint_fits;                ///< by joint; not kept in JSON
  std::vector<ResidualPattern> residual_patterns;  ///< by joint
  Excitation excitation;
  std::vector<ParameterTrend> trends;  ///< with three logs or more, from the torque balance of each log alone

  ParameterSpace space;
  Eigen::VectorXd estimate;    ///< all parameters of `space`
  Eigen::MatrixXd covariance;  ///< of `estimate`; zero rows for parameters that were kept

  /// Takes the status that a test found and adds its reason; unchanged if it found nothing.
  void take(const std::optional<FitStatus>& found);
};

/// Returns the identified robot with parameters drawn from their joint normal distribution, its standard
/// deviations times `spread`; masses and friction stay positive.
Robot draw(const Identification& identification, Random& random, double spread = 1.0);

/// Returns `robot` with the parameters of `space` in its chain and its torque timing.
Robot robot_with(const Robot& robot, const ParameterSpace& space, const Eigen::VectorXd& parameters);

/// Estimate of a parameter by one identification, without its reasons, to be stored and compared with that of
/// another identification.
struct ParameterValue {
  std::string name;  ///< of ParameterEstimate
  double value = std::numeric_limits<double>::quiet_NaN();
  double std = std::numeric_limits<double>::quiet_NaN();  ///< NaN if not identifiable
  std::string unit;
};

ParameterValue value_of(const ParameterEstimate& estimate);
/// Returns the value of that name; null if there is none.
const ParameterValue* find_value(const std::vector<ParameterValue>& values, const std::string& name);

}  // namespace faultline
