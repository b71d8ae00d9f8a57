// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/robot/chain.hpp"

namespace faultline {

/// The end of link `link` (from 0) in its own frame, m: where the next joint sits; of the last link the tip,
/// which is its origin where it slides.
Eigen::Vector3d link_end(const Chain& chain, int link);

/// The chain with a point mass of `kg` more (negative: less) at the end of link `link` (from 0).
Chain with_payload(const Chain& chain, int link, double kg);

/// Links (from 0) at whose end a mass takes a torque of some joint that no mass at the end of a later link
/// takes: those whose payload a log can show. The end of a link that lies on all axes before it, and two ends
/// that are one point, show no difference.
std::vector<int> payload_links(const Chain& chain);

}  // namespace faultline
