// SPDX-License-Identifier: MIT
#include "lib/identify/extra/find_ripples.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/golden_section.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr int kRates = 1000;     // of the periodogram, a quarter of a period over the joint's range apart
constexpr int kMostRipples = 3;  // searched in one joint
constexpr double kLeastPeriods = 3.0;   // over the range of the joint
constexpr double kLeastTurnRate = 2.5;  // 1/rad: slower ripples look like gravity
constexpr double kStandsOut = 0.03;     // least share of the residual's variance, and
constexpr double kAboveOthers = 10.0;   // least ratio to the median of all rates, that a ripple explains
constexpr int kRefinements = 20;        // steps of the golden section: they leave 7e-5 of the interval
constexpr int kFewest = 50;             // least number of windows

/// Residual of one joint in its shortest windows, with position and travel of the joint.
struct Samples {
  std::vector<double> residual, q, turn;  ///< turn: travel of the joint in the window
  double square() const {
    double sum = 0.0;
    for (const double r : residual) sum += r * r;
    return sum;
  }
};

/// Attenuation of a wave of `x` rad per window by the window's weight 30 u^2 (1 - u)^2; even in x.
class WindowShare {
 public:
  WindowShare() {
    constexpr int kPieces = 200;  // of a window, for the integral over it
    for (int i = 0; i < kSize; ++i)
      for (int k = 0; k < kPieces; ++k) {
        const double u = (k + 0.5) / kPieces;
        share_[i] += 30.0 * u * u * (1.0 - u) * (1.0 - u) * elementary::cos(i * kStep * (u - 0.5)) / kPieces;
      }
  }
  double operator()(double x) const {
    const double at = std::abs(x) / kStep;
    const auto i = static_cast<int>(std::min(at, static_cast<double>(kSize - 1)));
    return i + 1 < kSize ? share_[i] + (at - i) * (share_[i + 1] - share_[i]) : 0.0;
  }

 private:
  static constexpr int kSize = 500;     // entries, up to 50 rad: faster waves average out in a window
  static constexpr double kStep = 0.1;  // rad between two entries
  double share_[kSize] = {};
};

Samples samples_of(const WeakSets& windows, const WeakChoice& choice, const Eigen::VectorXd& parameters,
                   int j) {
  WeakChoice shortest = choice;
  std::fill(shortest.set.begin(), shortest.set.end(), 0);
  const WeakSystem s = assemble(windows, shortest);
  const auto& all = windows.sets[0].all();
  Samples out;
  for (Eigen::Index k = 0; k < s.y.size(); ++k) {
    if (s.joint[k] != j || !(s.use[k] > 0.0)) continue;
    const WeakWindow& w = all[static_cast<std::size_t>(k) % all.size()];
    out.residual.push_back(s.y[k] - s.a.row(k).dot(parameters.head(s.a.cols())));
    out.q.push_back(w.q[j]);
    out.turn.push_back(w.dq[j] * windows.sets[0].length_s());
  }
  return out;
}

/// Sums of a fit of cosine and sine of one rate to the residual.
struct Fit {
  double cc = 0.0, cs = 0.0, ss = 0.0, rc = 0.0, rs = 0.0;

  void add(double residual, double c, double s) {
    cc += c * c, cs += c * s, ss += s * s, rc += residual * c, rs += residual * s;
  }
  Eigen::Vector2d solve() const {
    const double det = cc * ss - cs * cs;
    if (!(det > 1e-9 * cc * ss)) return Eigen::Vector2d::Zero();
    return {(ss * rc - cs * rs) / det, (cc * rs - cs * rc) / det};
  }
  double explained() const { return solve().dot(Eigen::Vector2d(rc, rs)); }
};

Fit fit_at(const Samples& samples, double rate, const WindowShare& share) {
  Fit fit;
  for (std::size_t i = 0; i < samples.q.size(); ++i) {
    const double w = share(rate * samples.turn[i]), angle = rate * samples.q[i];
    const auto [sine, cosine] = elementary::sin_cos(angle);
    fit.add(samples.residual[i], w * cosine, w * sine);
  }
  return fit;
}

std::complex<double> on_circle(double angle) {
  const auto [sine, cosine] = elementary::sin_cos(angle);
  return {cosine, sine};
}

/// Returns the squared residual that each rate first + i step explains.
std::vector<double> periodogram(const Samples& samples, double first, double step, const WindowShare& share) {
  std::vector<Fit> fits(kRates);
  for (std::size_t i = 0; i < samples.q.size(); ++i) {
    std::complex<double> wave = on_circle(first * samples.q[i]);
    const std::complex<double> turn = on_circle(step * samples.q[i]);
    for (int k = 0; k < kRates; ++k, wave *= turn) {
      const double w = share((first + k * step) * samples.turn[i]);
      fits[k].add(samples.residual[i], w * wave.real(), w * wave.imag());
    }
  }
  std::vector<double> power;
  for (const Fit& fit : fits) power.push_back(fit.explained());
  return power;
}

}  // namespace

std::vector<Ripple> find_ripples(const WeakSets& windows, const WeakChoice& choice,
                                 const Eigen::VectorXd& parameters, int j) {
  Samples samples = samples_of(windows, choice, parameters, j);
  std::vector<Ripple> out;
  if (static_cast<int>(samples.q.size()) < kFewest) return out;
  const auto [low, high] = std::minmax_element(samples.q.begin(), samples.q.end());
  const double range = *high - *low, step = 0.5 * std::numbers::pi / std::max(range, 1e-9);
  double first = 2.0 * std::numbers::pi * kLeastPeriods / std::max(range, 1e-9);
  if (windows.space.chain.geometry[j].kind == AxisKind::revolute) first = std::max(first, kLeastTurnRate);
  const WindowShare share;
  for (int i = 0; i < kMostRipples; ++i) {
    std::vector<double> power = periodogram(samples, first, step, share);
    const auto peak = std::max_element(power.begin(), power.end());
    const double most = *peak, at = first + step * static_cast<double>(peak - power.begin());
    if (!(most > kStandsOut * samples.square() && most > kAboveOthers * upper_median_of(power))) break;
    const double rate = golden_section(at - step, at + step, kRefinements,
                                       [&](double r) { return -fit_at(samples, r, share).explained(); });
    const Eigen::Vector2d wave = fit_at(samples, rate, share).solve();
    for (std::size_t k = 0; k < samples.q.size(); ++k) {
      const double w = share(rate * samples.turn[k]), angle = rate * samples.q[k];
      const auto [sine, cosine] = elementary::sin_cos(angle);
      samples.residual[k] -= w * (wave[0] * cosine + wave[1] * sine);
    }
    out.push_back({Joint::at(j), rate, wave[0], wave[1]});
  }
  return out;
}

}  // namespace faultline
