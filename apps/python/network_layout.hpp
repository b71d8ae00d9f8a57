// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lib/model/model.hpp"

namespace faultline {

/// A matrix that a network takes or gives: its columns, a row a sample.
struct NetworkPort {
  std::string name;                    ///< such as "tau"
  std::vector<std::string> columns{};  ///< such as "tau1"
  std::vector<std::string> units{};    ///< of the columns; "1" for a number without one
  std::string what{};                  ///< for a person
};

/// One of a model's networks as others see it: in SI units, what scales its numbers inside.
struct NetworkLayout {
  std::string name;  ///< such as "sample_mlp"
  std::string what;  ///< for a person
  std::vector<NetworkPort> inputs{};
  NetworkPort output{};
};

/// All networks that the model has; none where it has no mechanics. Throws Error(input) where the evidence
/// classifiers were trained on other features than this program collects.
std::vector<NetworkLayout> network_layouts(const Model& model);

/// What the network called so gives, outputs x samples, for its inputs in the order of the layout, each
/// columns x samples.
Eigen::MatrixXd run_network(const Model& model, const std::string& network,
                            const std::vector<Eigen::MatrixXd>& inputs);

}  // namespace faultline
