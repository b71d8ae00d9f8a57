// SPDX-License-Identifier: MIT
#include "lib/identify/shooting/stable_step.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lib/robot/dynamics.hpp"

namespace faultline {

double stable_step(const Chain<double>& chain, const JointVector<double>& q,
                   const JointVector<double>& torque) {
  const JointMatrix<double> m = inertia_matrix(chain, q);
  const JointMatrix<double> inverse =
      m.ldlt().solve(JointMatrix<double>::Identity(chain.joints(), chain.joints()));
  double rate = 1e-9;
  for (int j = 0; j < chain.joints(); ++j)
    rate = std::max(
        rate, std::abs(inverse(j, j)) * (steepest(chain.friction[j], torque[j]) - chain.friction[j].viscous));
  for (const SharedDrive& f : chain.shared_drives)
    rate = std::max(rate, f.along.dot(Eigen::MatrixXd(inverse) * f.along) * f.coulomb / f.width);
  return 0.6 / rate;
}

}  // namespace faultline
