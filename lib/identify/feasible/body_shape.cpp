// SPDX-License-Identifier: MIT
#include "lib/identify/feasible/body_shape.hpp"

#include <algorithm>

#include "lib/balance/regressor.hpp"

namespace faultline {
namespace {

constexpr double kLeastMass = 1e-3;     // kg, if the robot file has none
constexpr double kLeastInertia = 1e-5;  // kg m^2
constexpr double kLeastSpread = 0.05;   // m: least radius of gyration, if the robot file has none

/// Columns of the inertial numbers by the unknowns of one body, and its block.
struct Body {
  Eigen::MatrixXd numbers;
  DefiniteBlock block;
};

/// Returns second moments, first moment and mass as one matrix (4 x 4).
Eigen::MatrixXd pseudo_inertia(const LinkInertia& link) {
  Eigen::Matrix4d j;
  j.topLeftCorner<3, 3>() = 0.5 * link.inertia.trace() * Eigen::Matrix3d::Identity() - link.inertia;
  j.topRightCorner<3, 1>() = link.first_moment;
  j.bottomLeftCorner<1, 3>() = link.first_moment.transpose();
  j(3, 3) = link.mass;
  return j;
}

double mass_of(const LinkInertia& link) { return std::max(link.mass, kLeastMass); }

Body general_body_of(const LinkInertia& link) {
  Body body;
  body.numbers = Eigen::MatrixXd::Identity(kLinkParameters, kLinkParameters);
  for (int k = 0; k < kLinkParameters; ++k)
    body.block.basis.push_back(pseudo_inertia(link_from(LinkVector::Unit(k))));
  const double mass = mass_of(link), least = mass * kLeastSpread * kLeastSpread + kLeastInertia;
  const Eigen::Vector3d centre = link.first_moment / mass;
  const Eigen::Matrix3d about =
      pseudo_inertia(link).topLeftCorner<3, 3>() - mass * centre * centre.transpose();
  const Eigen::Matrix3d second =
      Eigen::Matrix3d(about.diagonal().cwiseMax(least).asDiagonal()) + mass * centre * centre.transpose();
  body.block.nominal =
      to_vector({mass, link.first_moment, second.trace() * Eigen::Matrix3d::Identity() - second});
  return body;
}

/// Returns a rod: mass, first moment along the link and inertia about every axis across it.
Body rod_of(const LinkInertia& link, const Eigen::Vector3d& along) {
  Body body;
  LinkInertia mass, moment, inertia;
  mass.mass = 1.0;
  moment.first_moment = along;
  inertia.inertia = Eigen::Matrix3d::Identity() - along * along.transpose();
  body.numbers.resize(kLinkParameters, 3);
  body.numbers << to_vector(mass), to_vector(moment), to_vector(inertia);
  const Eigen::Matrix2d of_mass{{0.0, 0.0}, {0.0, 1.0}}, of_moment{{0.0, 1.0}, {1.0, 0.0}},
      of_inertia{{1.0, 0.0}, {0.0, 0.0}};
  body.block.basis = {of_mass, of_moment, of_inertia};
  const double m = mass_of(link), centre = link.first_moment.dot(along) / m;
  const double origin = 0.5 * (link.inertia.trace() - along.dot(link.inertia * along));
  const double about =
      std::max(origin - m * centre * centre, m * kLeastSpread * kLeastSpread + kLeastInertia);
  body.block.nominal = Eigen::Vector3d(m, m * centre, about + m * centre * centre);
  return body;
}

Body point_of(const LinkInertia& link) {
  Body body;
  body.numbers = to_vector(point_mass(1.0));
  body.block = positive_number(0, mass_of(link));
  return body;
}

Body body_of(const Robot& robot, int i) {
  const LinkInertia& link = robot.chain.links[i];
  switch (robot.shapes[i]) {
    case LinkShape::rod:
      return rod_of(link, link_direction(robot, i));
    case LinkShape::point:
      return point_of(link);
    case LinkShape::general:
      break;
  }
  return general_body_of(link);
}

void add(const Body& body, int first_number, BodyShapes& out) {
  const Eigen::Index at = out.numbers.cols(), rows = out.numbers.rows();
  out.numbers.conservativeResize(rows, at + body.numbers.cols());
  out.numbers.rightCols(body.numbers.cols()).setZero();
  out.numbers.block(first_number, at, body.numbers.rows(), body.numbers.cols()) = body.numbers;
  out.blocks.push_back(body.block);
  out.blocks.back().first = static_cast<int>(at);
}

}  // namespace

Eigen::MatrixXd DefiniteBlock::value(const Eigen::VectorXd& own_unknowns) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(basis[0].rows(), basis[0].cols());
  for (int i = 0; i < unknowns(); ++i) out += own_unknowns[i] * basis[i];
  return out;
}

DefiniteBlock positive_number(int first, double nominal) {
  return {first, {Eigen::MatrixXd::Ones(1, 1)}, Eigen::VectorXd::Constant(1, nominal)};
}

BodyShapes body_shapes(const Robot& robot) {
  const int n = robot.joints();
  BodyShapes out;
  out.numbers.resize(n * (kLinkParameters + 1), 0);
  for (int i = 0; i < n; ++i) add(body_of(robot, i), i * kLinkParameters, out);
  for (int i = 0; i < n; ++i) {
    const double rotor = robot.chain.rotor_inertia.empty() ? 0.0 : robot.chain.rotor_inertia[i];
    add({Eigen::MatrixXd::Ones(1, 1), positive_number(0, std::max(rotor, kLeastInertia))},
        n * kLinkParameters + i, out);
  }
  return out;
}

}  // namespace faultline
