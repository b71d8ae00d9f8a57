// SPDX-License-Identifier: MIT
#include "lib/identify/days/payload_columns.hpp"

#include "lib/robot/payload.hpp"

namespace faultline {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd payload_columns(const ParameterSpace& space) {
  const int n = space.joints();
  const MatrixXd map = base_map(space);
  MatrixXd out(space.rigid(), n);
  for (int link = 0; link < n; ++link) {
    Chain chain = space.chain;
    for (LinkInertia& l : chain.links) l = {};
    chain = with_payload(chain, link, 1.0);
    VectorXd numbers = VectorXd::Zero(n * (kLinkParameters + 1));
    for (int i = 0; i < n; ++i)
      numbers.segment<kLinkParameters>(i * kLinkParameters) = to_vector(chain.links[i]);
    out.col(link) = map * numbers;
  }
  return out;
}

}  // namespace faultline
