// SPDX-License-Identifier: MIT
#include "lib/classify/confidence_calibration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr int kParameters = 1 + 1 + kConfidenceSources;  // slope, common shift, shift of each source
constexpr double kSureEnough = 0.99;  // confidences above this, or below its complement, are clamped to it
// Standard deviations of the prior.
constexpr double kSlopeStd = 0.5, kShiftStd = 2.0, kOwnShiftStd = 1.0;
constexpr int kBins = 10;

using Parameters = Eigen::Matrix<double, kParameters, 1>;

double log_odds(double p) {
  const double q = std::clamp(p, 1.0 - kSureEnough, kSureEnough);
  return elementary::log(q / (1.0 - q));
}

double logistic(double x) { return 1.0 / (1.0 + elementary::exp(-x)); }

Parameters features_of(const JudgedConfidence& one) {
  Parameters x = Parameters::Zero();
  x[0] = log_odds(one.said);
  x[1] = 1.0;
  x[2 + static_cast<int>(one.source)] = 1.0;
  return x;
}

Parameters prior_precision() {
  Parameters precision = Parameters::Constant(1.0 / (kOwnShiftStd * kOwnShiftStd));
  precision[0] = 1.0 / (kSlopeStd * kSlopeStd);
  precision[1] = 1.0 / (kShiftStd * kShiftStd);
  return precision;
}

std::vector<JudgedConfidence> every_other(std::span<const JudgedConfidence> judged, std::size_t first) {
  std::vector<JudgedConfidence> half;
  for (std::size_t i = first; i < judged.size(); i += 2) half.push_back(judged[i]);
  return half;
}

}  // namespace

double ConfidenceCalibration::of(ConfidenceSource source, double said) const {
  if (slope == 1.0 && shift == decltype(shift){}) return std::min(said, most);
  return std::min(logistic(slope * log_odds(said) + shift[static_cast<std::size_t>(source)]), most);
}

ConfidenceCalibration calibrate_confidence(std::span<const JudgedConfidence> judged) {
  if (judged.empty()) return {};
  const Parameters precision = prior_precision();
  Parameters unchanged = Parameters::Zero();
  unchanged[0] = 1.0;
  Parameters theta = unchanged;
  for (int step = 0; step < 50; ++step) {  // Newton: the negative log likelihood is convex
    Parameters gradient = precision.cwiseProduct(theta - unchanged);
    Eigen::Matrix<double, kParameters, kParameters> curvature = precision.asDiagonal();
    for (const JudgedConfidence& one : judged) {
      const Parameters x = features_of(one);
      const double p = logistic(theta.dot(x));
      gradient += (p - (one.right ? 1.0 : 0.0)) * x;
      curvature += p * (1.0 - p) * x * x.transpose();
    }
    theta -= curvature.llt().solve(gradient);
  }
  ConfidenceCalibration calibration;
  calibration.slope = std::max(theta[0], 0.0);
  for (int s = 0; s < kConfidenceSources; ++s) calibration.shift[s] = theta[1] + theta[2 + s];
  calibration.most = 1.0 - 1.0 / (static_cast<double>(judged.size()) + 2.0);  // rule of succession
  return calibration;
}

double calibration_error(std::span<const JudgedConfidence> judged) {
  if (judged.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::array<double, kBins> too_much{};
  for (const JudgedConfidence& one : judged) {
    const int bin = std::clamp(static_cast<int>(one.said * kBins), 0, kBins - 1);
    too_much[bin] += one.said - (one.right ? 1.0 : 0.0);
  }
  double sum = 0.0;
  for (const double difference : too_much) sum += std::abs(difference);
  return sum / static_cast<double>(judged.size());
}

double held_out_calibration_error(std::span<const JudgedConfidence> judged) {
  std::vector<JudgedConfidence> calibrated;
  for (const std::size_t half : {std::size_t{0}, std::size_t{1}}) {
    const ConfidenceCalibration calibration = calibrate_confidence(every_other(judged, 1 - half));
    for (JudgedConfidence one : every_other(judged, half)) {
      one.said = calibration.of(one.source, one.said);
      calibrated.push_back(one);
    }
  }
  return calibration_error(calibrated);
}

}  // namespace faultline
