// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/neural/patterns.hpp"
#include "lib/neural/rbfn.hpp"
#include "lib/neural/training.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

/// The networks' inputs of each sample.
enum class SampleFeatures {
  velocity,      ///< velocity residual of each joint, as in the paper
  torque_space,  ///< of each joint: torque-space residual and torque (both compressed by asinh, in healthy
                 ///< rms), and their ratio; separates joints that look alike in velocity (docs/residual.md)
  hypotheses,  ///< of each joint, as magnitudes compressed by asinh in healthy rms: the torque-space residual
               ///< (near 0 when it is healthy), that plus the torque (near 0 when it swings freely), and the
               ///< torque
};
const char* to_string(SampleFeatures features);

/// The paper's classifier: an MLP and an RBFN, each with one output for each fault and a last one for
/// fault-free operation.
struct SampleClassifier {
  SampleFeatures features = SampleFeatures::torque_space;
  std::vector<FaultLabel> classes;  ///< of the outputs; the last is `none`
  Eigen::VectorXd prior;            ///< share of each class among the training samples
  Eigen::VectorXd torque_rms;       ///< healthy rms of each joint's torque-space residual, N m or N
  Scaler scaler;                    ///< of the features
  Mlp mlp;
  Rbfn rbfn;

  int joints() const { return static_cast<int>(torque_rms.size()); }
};

/// Outputs of both networks, classes x samples: near 1 for the class that is present. NaN if a residual is
/// missing.
struct SampleOutputs {
  Eigen::VectorXd time;  ///< s
  Eigen::MatrixXd mlp;
  Eigen::MatrixXd rbfn;

  /// Mean of both networks, as in the dual classification.
  Eigen::MatrixXd average() const { return 0.5 * (mlp + rbfn); }
};

SampleOutputs classify_samples(const SampleClassifier& classifier, const Residuals& residuals);

/// Residuals of a run with its true fault: fault-free up to `onset_s` and after `end_s`.
struct LabelledResiduals {
  Residuals residuals;
  FaultLabel fault;
  double onset_s = std::numeric_limits<double>::infinity();
  double end_s = std::numeric_limits<double>::infinity();
};

enum class SampleTrainer { quasi_newton, back_propagation };

struct SampleClassifierOptions {
  SampleFeatures features = SampleFeatures::torque_space;
  int hidden = 20;
  /// Softmax trained by cross-entropy gives probabilities; linear trained on 1 and 0 is the paper's.
  OutputKind output = OutputKind::softmax;
  SampleTrainer trainer = SampleTrainer::quasi_newton;  ///< of the MLP; back-propagation is the paper's
  SomOptions map = {.rows = 10, .columns = 10};         ///< on which the centres of the RBFN lie
  int patterns_per_class = 400;                         ///< drawn at random from all runs
  int validate_every = 5;    ///< one in this number of each fault's runs validates; 0: all runs train
  int max_iterations = 300;  ///< of the MLP's trainer; epochs for back-propagation
  double weight_decay = 1e-4;
  std::uint64_t seed = 1;
};

/// Trains both networks on samples of labelled runs. Classes are the labels that occur, in the order of kind
/// and joint, with `none` last. Throws Error(input) if there are no fault-free or no faulty samples.
SampleClassifier train_sample_classifier(std::span<const LabelledResiduals> runs,
                                         const ResidualGenerator& generator,
                                         const SampleClassifierOptions& options = {},
                                         const Progress& progress = {});

void to_json(nlohmann::json& json, const SampleClassifier& classifier);
/// Throws Error(input) if something is missing or does not fit; `where` names the file.
SampleClassifier sample_classifier_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
