// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lib/model/model.hpp"

namespace faultline {

/// A matrix that is an input or output of a network: its columns, with a row per sample.
struct NetworkPort {
  std::string name;                    ///< such as "tau"
  std::vector<std::string> columns{};  ///< such as "tau1"
  std::vector<std::string> units{};    ///< of the columns; "1" for a number without one
  std::string what{};                  ///< description for the user
};

/// The interface of one of a model's networks: in SI units, with the scaling of its numbers inside.
struct NetworkLayout {
  std::string name;  ///< such as "sample_mlp"
  std::string what;  ///< description for the user
  std::vector<NetworkPort> inputs{};
  NetworkPort output{};
};

/// Returns all networks of the model; none if it has no mechanics. Throws Error(input) if the evidence
/// classifiers were trained on other features than this program collects.
std::vector<NetworkLayout> network_layouts(const Model& model);

/// Runs the named network; returns outputs x samples. The inputs are in the order of the layout, each columns
/// x samples.
Eigen::MatrixXd run_network(const Model& model, const std::string& network,
                            const std::vector<Eigen::MatrixXd>& inputs);

}  // namespace faultline
