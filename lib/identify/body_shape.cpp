// SPDX-License-Identifier: MIT
#include "lib/identify/body_shape.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lib/identify/regressor.hpp"

namespace faultline {
namespace {

constexpr double kFactor = 3.0;  // of a logarithm: 20 times more or less
constexpr double kMetre = 1.0;
constexpr double kLeastMass = 1e-3;     // kg, where a robot file has none
constexpr double kLeastInertia = 1e-5;  // kg m^2
constexpr int kGeneral = 10;

double log_at_least(double value, double least) { return std::log(std::max(value, least)); }

/// Second moments, first moment and mass as one positive definite matrix.
Eigen::Matrix4d pseudo_inertia(const LinkInertia<double>& link) {
  const double mass = std::max(link.mass, kLeastMass);
  Eigen::Matrix4d j;
  j.topLeftCorner<3, 3>() = 0.5 * link.inertia.trace() * Eigen::Matrix3d::Identity() - link.inertia;
  j.topLeftCorner<3, 3>().diagonal().array() += kLeastInertia;
  j.topRightCorner<3, 1>() = link.first_moment;
  j.bottomLeftCorner<1, 3>() = link.first_moment.transpose();
  j(3, 3) = mass;
  return j;
}

/// Upper triangular factor with j = u u^T.
Eigen::Matrix4d upper_factor(const Eigen::Matrix4d& j) {
  const Eigen::Matrix4d flipped = j.reverse();
  const Eigen::LLT<Eigen::Matrix4d> llt(flipped);
  if (llt.info() != Eigen::Success) return Eigen::Matrix4d::Identity() * std::sqrt(kLeastMass);
  return Eigen::Matrix4d(llt.matrixL()).reverse();
}

/// Logarithms of the diagonal, then the entries above it.
Eigen::Matrix<double, kGeneral, 1> general_numbers(const LinkInertia<double>& link) {
  const Eigen::Matrix4d u = upper_factor(pseudo_inertia(link));
  Eigen::Matrix<double, kGeneral, 1> x;
  x << std::log(u(0, 0)), std::log(u(1, 1)), std::log(u(2, 2)), std::log(u(3, 3)), u(0, 1), u(0, 2), u(0, 3),
      u(1, 2), u(1, 3), u(2, 3);
  return x;
}

LinkInertia<double> general_link(const Eigen::VectorXd& x) {
  Eigen::Matrix4d u = Eigen::Matrix4d::Zero();
  u.diagonal() = x.head<4>().array().exp();
  u(0, 1) = x[4];
  u(0, 2) = x[5];
  u(0, 3) = x[6];
  u(1, 2) = x[7];
  u(1, 3) = x[8];
  u(2, 3) = x[9];
  const Eigen::Matrix4d j = u * u.transpose();
  LinkInertia<double> link;
  link.mass = j(3, 3);
  link.first_moment = j.topRightCorner<3, 1>();
  const Eigen::Matrix3d second = j.topLeftCorner<3, 3>();
  link.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return link;
}

LinkInertia<double> rod_link(const Eigen::VectorXd& x, const Eigen::Vector3d& along) {
  LinkInertia<double> link;
  link.mass = std::exp(x[0]);
  link.first_moment = link.mass * x[1] * along;
  link.inertia =
      (link.mass * x[1] * x[1] + std::exp(x[2])) * (Eigen::Matrix3d::Identity() - along * along.transpose());
  return link;
}

int count_of(LinkShape shape) {
  switch (shape) {
    case LinkShape::rod:
      return 3;
    case LinkShape::point:
      return 1;
    case LinkShape::general:
      return kGeneral;
  }
  return 0;
}

}  // namespace

BodyNumbers::BodyNumbers(const Robot& robot) : shapes_(robot.shapes) {
  for (int i = 0; i < robot.joints(); ++i) along_.push_back(link_direction(robot, i));
  for (int i = 0; i < robot.joints(); ++i) add_link(robot, i);
  for (int i = 0; i < robot.joints(); ++i) {
    const double rotor = robot.chain.rotor_inertia.empty() ? 0.0 : robot.chain.rotor_inertia[i];
    add(log_at_least(rotor, kLeastInertia), kFactor);
  }
}

void BodyNumbers::add(double start, double doubt) {
  start_.conservativeResize(start_.size() + 1);
  doubt_.conservativeResize(doubt_.size() + 1);
  start_[start_.size() - 1] = start;
  doubt_[doubt_.size() - 1] = doubt;
}

void BodyNumbers::add_link(const Robot& robot, int i) {
  const LinkInertia<double>& link = robot.chain.links[i];
  const double mass = std::max(link.mass, kLeastMass);
  if (shapes_[i] == LinkShape::general) {
    const auto x = general_numbers(link);
    for (int k = 0; k < kGeneral; ++k) add(x[k], k < 4 ? kFactor : kMetre);
    return;
  }
  add(std::log(mass), kFactor);
  if (shapes_[i] == LinkShape::point) return;
  const double centre = link.first_moment.dot(along_[i]) / mass;
  const double about = 0.5 * (link.inertia.trace() - along_[i].dot(link.inertia * along_[i]));
  add(centre, kMetre);
  add(log_at_least(about - mass * centre * centre, kLeastInertia), kFactor);
}

Eigen::VectorXd BodyNumbers::numbers(const Eigen::VectorXd& x) const {
  const int n = static_cast<int>(shapes_.size());
  Eigen::VectorXd out(n * (kLinkParameters + 1));
  int at = 0;
  for (int i = 0; i < n; ++i) {
    const Eigen::VectorXd own = x.segment(at, count_of(shapes_[i]));
    at += count_of(shapes_[i]);
    LinkInertia<double> link;
    switch (shapes_[i]) {
      case LinkShape::rod:
        link = rod_link(own, along_[i]);
        break;
      case LinkShape::point:
        link = point_mass(std::exp(own[0]));
        break;
      case LinkShape::general:
        link = general_link(own);
        break;
    }
    out.segment<kLinkParameters>(i * kLinkParameters) = to_vector(link);
  }
  out.tail(n) = x.tail(n).array().exp();
  return out;
}

}  // namespace faultline
