// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

/// End of link `link` (from 0) in its own frame, m: the origin of the next joint; for the last link the tip,
/// which is the link's origin if its joint is prismatic.
Eigen::Vector3d link_end(const Chain& chain, int link);

/// Returns the chain with `kg` added (negative: removed) as a point mass at the end of link `link` (from 0).
Chain with_payload(const Chain& chain, int link, double kg);

/// Returns the links, by the joints that move them, whose payload a log can distinguish: a mass at the link's
/// end takes torque in some joint, and not in proportion to the torque of a mass at the end of a later link.
/// A link whose end lies on all axes before it, or coincides with the end of a later link, is left out.
std::vector<Joint> payload_links(const Chain& chain);

}  // namespace faultline
