// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/gathered.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/weak_form/weak_choice.hpp"
#include "lib/identify/weak_form/weak_form.hpp"

namespace faultline {

/// What the torque balance says.
struct TorqueFit {
  WeakSystem system;
  WeakFit fit;
  std::vector<bool> wanted;
  std::vector<int> shift;  ///< by joint, samples
};

/// The fit of the torque balance of the chosen windows and terms, brought to a robot that can be; `id.issues`
/// says where a bound binds. Parameters that are not wanted stay at `nominal`.
TorqueFit fit_torque(const Gathered& gathered, const ModelChoice& choice, const Eigen::VectorXd& nominal,
                     Identification& id);

}  // namespace faultline
