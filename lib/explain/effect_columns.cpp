// SPDX-License-Identifier: MIT
#include "lib/explain/effect_columns.hpp"

namespace faultline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

EffectColumns::EffectColumns(const std::vector<MatrixXd>& columns)
    : effects_(columns.empty() ? 0 : columns.front().cols()), reach_(columns.size()) {
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (Index e = 0; e < effects_; ++e)
      if (!columns[j].col(e).isZero(0.0)) reach_[j].push_back(static_cast<int>(e));
    column_.emplace_back(columns[j](Eigen::all, reach_[j]));
  }
}

MatrixXd EffectColumns::all(int j) const {
  MatrixXd out = MatrixXd::Zero(rows(), effects_);
  for (std::size_t i = 0; i < reach_[j].size(); ++i)
    out.col(reach_[j][i]) = column_[j].col(static_cast<Index>(i));
  return out;
}

void EffectColumns::append(const StackedColumns& columns) {
  for (int j = 0; j < joints(); ++j) {
    const auto own = columns.middleRows(j * rows(), rows());
    for (Index c = 0; c < columns.cols(); ++c) {
      if (own.col(c).isZero(0.0)) continue;
      reach_[j].push_back(static_cast<int>(effects_ + c));
      column_[j].conservativeResize(Eigen::NoChange, column_[j].cols() + 1);
      column_[j].rightCols<1>() = own.col(c);
    }
  }
  effects_ += columns.cols();
}

EffectColumns EffectColumns::whitened(const std::vector<Whitener>& white) const {
  EffectColumns out = *this;
  for (int j = 0; j < joints(); ++j) out.column_[j] = white[j](column_[j]);
  return out;
}

MatrixXd EffectColumns::square() const {
  MatrixXd out = MatrixXd::Zero(effects_, effects_);
  for (int j = 0; j < joints(); ++j) {
    const MatrixXd own = column_[j].transpose() * column_[j];
    out(reach_[j], reach_[j]) += own;
  }
  return out;
}

MatrixXd EffectColumns::square(const StackedMask& only) const {
  MatrixXd out = MatrixXd::Zero(effects_, effects_);
  for (int j = 0; j < joints(); ++j) {
    std::vector<int> marked;
    for (int k = 0; k < rows(); ++k)
      if (only[j * rows() + k]) marked.push_back(k);
    if (marked.empty()) continue;
    const MatrixXd some = column_[j](marked, Eigen::all), own = some.transpose() * some;
    out(reach_[j], reach_[j]) += own;
  }
  return out;
}

MatrixXd EffectColumns::along(const Eigen::Ref<const StackedColumns>& columns) const {
  MatrixXd out = MatrixXd::Zero(effects_, columns.cols());
  for (int j = 0; j < joints(); ++j) {
    const auto rows_of_joint = columns.middleRows(j * rows(), rows());
    if (rows_of_joint.isZero(0.0)) continue;
    const MatrixXd own = column_[j].transpose() * rows_of_joint;
    out(reach_[j], Eigen::all) += own;
  }
  return out;
}

VectorXd EffectColumns::along(const MatrixXd& torque, Index begin) const {
  VectorXd out = VectorXd::Zero(effects_);
  for (int j = 0; j < joints(); ++j) {
    const VectorXd own = column_[j].middleRows(begin, torque.rows()).transpose() * torque.col(j);
    out(reach_[j]) += own;
  }
  return out;
}

Stacked EffectColumns::times(const VectorXd& effects) const {
  Stacked out(rows() * joints());
  for (int j = 0; j < joints(); ++j) {
    const VectorXd own = effects(reach_[j]);
    out.segment(j * rows(), rows()).noalias() = column_[j] * own;
  }
  return out;
}

}  // namespace faultline
