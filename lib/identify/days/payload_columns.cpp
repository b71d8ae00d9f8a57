// SPDX-License-Identifier: MIT
#include "lib/identify/days/payload_columns.hpp"

namespace faultline {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd payload_columns(const ParameterSpace& space) {
  const int n = space.joints();
  const MatrixXd map = base_map(space);
  MatrixXd out(space.rigid(), n);
  for (int link = 0; link < n; ++link) {
    Chain<double> chain = space.chain;
    for (LinkInertia<double>& l : chain.links) l = {};
    const bool last = link + 1 == n;
    const Eigen::Vector3d along = chain.geometry[last ? link : link + 1].direction;
    const bool at_origin = last && chain.geometry[link].kind == AxisKind::prismatic;
    const Eigen::Vector3d end =
        at_origin ? Eigen::Vector3d(0.0, 0.0, 0.0) : Eigen::Vector3d(chain.length[link] * along);
    if (last)
      chain = with_tip_mass(chain, 1.0);
    else
      chain.links[link] = general_body(1.0, end, Eigen::Matrix3d::Zero());
    VectorXd numbers = VectorXd::Zero(n * (kLinkParameters + 1));
    for (int i = 0; i < n; ++i)
      numbers.segment<kLinkParameters>(i * kLinkParameters) = to_vector(chain.links[i]);
    out.col(link) = map * numbers;
  }
  return out;
}

}  // namespace faultline
