// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/model/model.hpp"
#include "lib/residual/relation/relation_watch.hpp"

/// What a log without torque tells: how the joints follow their references.
namespace faultline {

/// A finding for each joint that does not: locked where it stands still while its reference moves, else
/// unknown. What position and velocity show at the same time is one.
std::vector<FaultFinding> tracking_findings(const std::vector<RelationEpisode>& episodes, const Chain& chain);

/// Rows of a log that were held against a reference, of the joint that was for longest; `judged_s` by
/// relation.
std::int64_t rows_tracked(const Model& model, const std::vector<double>& judged_s);

/// Joints (from 1) that the model knows to follow a reference, and that this log did not show following one.
std::vector<int> joints_not_tracked(const Model& model, const std::vector<double>& judged_s);

/// What such a log cannot show, and from where on a joint is seen to leave its reference, a sentence each.
std::vector<std::string> tracking_spots(const Model& model, const std::vector<double>& judged_s);

}  // namespace faultline
