// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/core/random.hpp"
#include "lib/robot/robot.hpp"

/// Chains with general bodies, offsets and any axes.
namespace faultline {

inline JointVector draw(Random& random, int n, double scale) {
  JointVector v(n);
  for (int i = 0; i < n; ++i) v[i] = random.uniform(-scale, scale);
  return v;
}

inline Eigen::Vector3d draw3(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

inline Chain with_general_bodies(Chain chain, Random& random) {
  for (int i = 0; i < chain.joints(); ++i) {
    Eigen::Matrix3d root;
    root << draw3(random), draw3(random), draw3(random);
    chain.links[i] =
        general_body(random.uniform(0.5, 2.0), 0.2 * draw3(random), 0.1 * root * root.transpose());
    chain.length[i] = random.uniform(0.2, 1.0);
    chain.rotor_inertia[i] = random.uniform(0.0, 0.1);
  }
  return chain;
}

/// Two revolute axes and a prismatic one that cross at right angles, as in the wrist of a surgical arm.
inline Chain crossed_wrist(Random& random) {
  Chain chain = with_general_bodies(preset_robot("RRP").chain, random);
  chain.geometry[1].axis = Eigen::Vector3d::UnitY();
  chain.geometry[1].direction.setZero();
  chain.geometry[1].offset = {0.0, 0.0, 0.3};
  chain.geometry[2].axis = Eigen::Vector3d::UnitX();
  chain.geometry[2].direction = Eigen::Vector3d::UnitX();
  return chain;
}

inline std::vector<Chain> assorted_chains() {
  Random random(21);
  std::vector<Chain> chains;
  for (const char* axes : {"RRP", "RRPR", "RPRR", "RR", "R", "P"})
    chains.push_back(with_general_bodies(preset_robot(axes).chain, random));
  chains.push_back(crossed_wrist(random));
  Chain skew = with_general_bodies(preset_robot("RRPR").chain, random);
  for (JointGeometry& joint : skew.geometry) {
    joint.axis = draw3(random).normalized();
    joint.offset = 0.3 * draw3(random);
  }
  skew.gravity = 9.81 * draw3(random).normalized();
  chains.push_back(skew);
  return chains;
}

}  // namespace faultline
