// SPDX-License-Identifier: MIT
#include "lib/wear/change_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

/// Ways to look for a change, which share the rate of false alarms.
constexpr int kWays = 3;

/// Most points among which a stretch of another level is looked for, since the pairs of its ends are n^2 / 2;
/// longer series have steps enough to be found one by one.
constexpr int kMostForStretch = 1500;

/// Standard deviations from the median of its neighbours beyond which a value is an outlier: with chance
/// alone one in ten thousand.
constexpr double kOutlier = 4.0;

/// Logs to each side whose median a value is compared with.
constexpr int kNeighbours = 2;

/// Median of |difference of two normal values| over their standard deviation.
constexpr double kMedianDifference = 0.6744897501960817 * 1.4142135623730951;

/// Share of its squares that a step must keep beside a line.
constexpr double kStepShare = 1e-9;

/// Largest correlation of neighbours that is taken into account.
constexpr double kMostCorrelation = 0.9;

enum class ChangeForm { step, stretch, step_on_line };

/// The best change of one form in a part of a series, by indices within it.
struct FoundChange {
  ChangeForm form = ChangeForm::step;
  int first = 0, end = 0;   ///< the points from first to before end have another level; end = n for a step
  int places = 0;           ///< that were searched
  double gain = 0.0;        ///< by which the step lowers chi_square
  double chi_square = 0.0;  ///< that is left
  double size = 0.0;
  double information = 0.0;   ///< 1 / variance of `size`, if the weights are right
  std::vector<double> gains;  ///< by first, for a single step

  int parameters() const { return form == ChangeForm::step_on_line ? 3 : 2; }
  /// With the places, for the comparison of forms.
  int complexity() const { return form == ChangeForm::step ? 4 : form == ChangeForm::stretch ? 6 : 5; }
};

/// Sums over the first i points.
struct RunningSums {
  std::vector<double> weight{0.0}, x{0.0}, residual{0.0};

  RunningSums(const WeightedSeries& s, const LineFit& fit) {
    for (int i = 0; i < s.size(); ++i) {
      weight.push_back(weight.back() + s.weight[i]);
      x.push_back(x.back() + s.weight[i] * (s.x[i] - fit.mean_x));
      residual.push_back(residual.back() + s.weight[i] * fit.residual[i]);
    }
  }
};

/// Tries a step from `first` to `end` beside the fit: a level, or a line if `spread_x` is not 0.
void try_change(FoundChange& best, const RunningSums& sums, double spread_x, int first, int end) {
  const double w = sums.weight[end] - sums.weight[first], x = sums.x[end] - sums.x[first];
  const double r = sums.residual[end] - sums.residual[first];
  const double line = spread_x > 0.0 ? x * x / spread_x : 0.0;
  const double own = w - w * w / sums.weight.back() - line;  // squares of the step beside the fit
  ++best.places;
  const double gain = own > kStepShare * w ? r * r / own : 0.0;
  if (best.form != ChangeForm::stretch) best.gains[first] = gain;
  if (!(gain > best.gain)) return;
  best.first = first;
  best.end = end;
  best.gain = gain;
  best.size = r / own;
  best.information = own;
}

std::optional<FoundChange> best_of(ChangeForm form, const WeightedSeries& s) {
  const int n = s.size(), least = kLogsBesideChange;
  const LineFit fit = form == ChangeForm::step_on_line ? fit_line(s) : fit_level(s);
  if (form == ChangeForm::step_on_line && !(fit.spread_x > 0.0)) return {};
  if (form == ChangeForm::stretch && n > kMostForStretch) return {};
  const RunningSums sums(s, fit);
  FoundChange best;
  best.form = form;
  best.gains.assign(static_cast<std::size_t>(n) + 1, 0.0);
  for (int first = least; first + least <= n; ++first)
    if (form == ChangeForm::stretch)
      for (int end = first + least; end + least <= n; ++end) try_change(best, sums, 0.0, first, end);
    else
      try_change(best, sums, fit.spread_x, first, n);
  best.chi_square = std::max(fit.chi_square - best.gain, 0.0);
  if (!(best.gain > 0.0)) return {};
  return best;
}

/// Returns residual / standard deviation of each point beside the change.
std::vector<double> standard_residuals(const WeightedSeries& s, const FoundChange& change) {
  WeightedSeries rest = s;
  for (int i = change.first; i < change.end; ++i) rest.y[i] -= change.size;
  const LineFit fit = change.form == ChangeForm::step_on_line ? fit_line(rest) : fit_level(rest);
  std::vector<double> residuals;
  for (int i = 0; i < s.size(); ++i) residuals.push_back(fit.residual[i] * std::sqrt(s.weight[i]));
  return residuals;
}

/// How far the scatter about a change lets one know its size.
struct ChangeScale {
  double variance = 0.0;  ///< of the size
  int degrees = 1;        ///< of Student's t
};

/// `least_scale` is the variance of the points by their own standard deviations, in units of 1 / weight.
ChangeScale scale_of(const WeightedSeries& s, const FoundChange& change, double least_scale) {
  const double n = s.size();
  const double factor = correlation_factor(standard_residuals(s, change), change.parameters() + 1);
  const double scale = std::max(change.chi_square / (n - change.parameters()), least_scale);
  return {scale * factor / change.information, s.size() - change.parameters()};
}

/// Schwarz's criterion up to a constant; the smaller the better.
double schwarz(double chi_square, int complexity, int n) {
  return n * elementary::log(std::max(chi_square, 1e-300)) + complexity * elementary::log(n);
}

double best_smooth(const WeightedSeries& s) {
  const int n = s.size();
  return std::min({schwarz(fit_level(s).chi_square, 1, n), schwarz(fit_line(s).chi_square, 2, n),
                   schwarz(parabola_chi_square(s), 3, n)});
}

/// Places of a single step within 95 % of the likelihood of the best one.
std::array<int, 2> likely_places(const FoundChange& change, double scale) {
  constexpr double kWithin = 3.841458820694124;  // 95 % of chi-square with one degree of freedom
  std::array<int, 2> range = {change.first, change.first};
  const auto likely = [&](int place) {
    return place > 0 && place < static_cast<int>(change.gains.size()) &&
           change.gains[static_cast<std::size_t>(place)] > change.gain - kWithin * scale;
  };
  while (likely(range[0] - 1)) --range[0];
  while (likely(range[1] + 1)) ++range[1];
  return range;
}

/// Returns the better of the changes that pass the test, or nothing.
class ChangeSearch {
 public:
  ChangeSearch(WeightedSeries all, std::vector<double> least_scale, double false_alarms)
      : all_(std::move(all)), least_scale_(std::move(least_scale)), false_alarms_(false_alarms) {}

  std::vector<SeriesChange> run() {
    search(0, all_.size());
    std::sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < found_.size(); ++i) refine(i);
    return found_;
  }

 private:
  double least_scale(int begin, int end) const {
    return upper_median({least_scale_.begin() + begin, least_scale_.begin() + end});
  }

  double probability(const FoundChange& change, const ChangeScale& scale) const {
    const double t = std::abs(change.size) / std::sqrt(scale.variance);
    return std::min(kWays * change.places * student_tail(t, scale.degrees), 1.0);
  }

  void search(int begin, int end) {
    if (end - begin < 2 * kLogsBesideChange) return;
    const WeightedSeries s = all_.part(begin, end);
    double best = best_smooth(s);
    std::optional<FoundChange> chosen;
    double p = 1.0;
    for (const ChangeForm form : {ChangeForm::step, ChangeForm::stretch, ChangeForm::step_on_line}) {
      const std::optional<FoundChange> change = best_of(form, s);
      if (!change) continue;
      const double chance = probability(*change, scale_of(s, *change, least_scale(begin, end)));
      const double score = schwarz(change->chi_square, change->complexity(), s.size());
      if (chance > false_alarms_ || score >= best) continue;
      best = score;
      chosen = change;
      p = chance;
    }
    if (chosen) split(begin, end, *chosen, p);
  }

  void split(int begin, int end, const FoundChange& chosen, double p) {
    std::vector<int> places = {chosen.first};
    if (chosen.form == ChangeForm::stretch) places.push_back(chosen.end);
    int from = begin;
    for (const int place : places) {
      SeriesChange change;
      change.first = begin + place;
      change.p = p;
      change.beside_trend = chosen.form == ChangeForm::step_on_line;
      found_.push_back(change);
      search(from, begin + place);
      from = begin + place;
    }
    search(from, end);
  }

  /// Places and sizes a change between its neighbours.
  void refine(std::size_t i) {
    SeriesChange& change = found_[i];
    const int begin = i == 0 ? 0 : found_[i - 1].first;
    const int end = i + 1 == found_.size() ? all_.size() : found_[i + 1].first;
    const WeightedSeries s = all_.part(begin, end);
    const auto best = best_of(change.beside_trend ? ChangeForm::step_on_line : ChangeForm::step, s);
    if (!best) return;
    const ChangeScale scale = scale_of(s, *best, least_scale(begin, end));
    change.first = begin + best->first;
    const auto likely = likely_places(*best, scale.variance * best->information);
    change.first_between = {begin + likely[0], begin + likely[1]};
    change.size = best->size;
    const double half = student_limit(0.05, scale.degrees) * std::sqrt(scale.variance);
    change.ci95 = {change.size - half, change.size + half};
  }

  WeightedSeries all_;
  std::vector<double> least_scale_;
  double false_alarms_;
  std::vector<SeriesChange> found_;
};

/// Returns the variance between neighbouring logs beyond their standard deviations, from the median of their
/// differences, which neither outliers nor changes of level disturb.
double robust_variance(const std::vector<SeriesPoint>& points) {
  std::vector<double> differences, variances;
  for (std::size_t i = 1; i < points.size(); ++i)
    differences.push_back(std::abs(points[i].value - points[i - 1].value));
  for (const SeriesPoint& point : points) variances.push_back(point.std * point.std);
  const double spread = upper_median(differences) / kMedianDifference;
  return std::max(spread * spread - upper_median(variances), 0.0);
}

}  // namespace

double correlation_factor(const std::vector<double>& residuals, int parameters) {
  const double n = static_cast<double>(residuals.size());
  double squares = 0.0, products = 0.0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    squares += residuals[i] * residuals[i];
    if (i > 0) products += residuals[i] * residuals[i - 1];
  }
  if (!(squares > 0.0)) return 1.0;
  const double correlation = (n * products / squares + parameters) / std::max(n - parameters - 2.0, 1.0);
  const double counted = std::clamp(correlation, 0.0, kMostCorrelation);
  return (1.0 + counted) / (1.0 - counted);
}

LimitedSeries without_outliers(const std::vector<SeriesPoint>& points) {
  LimitedSeries limited{points, {}};
  const int n = static_cast<int>(points.size());
  if (n < 2 * kNeighbours + 1) return limited;
  const double between = robust_variance(points);
  for (int i = 0; i < n; ++i) {
    std::vector<double> near;
    const int begin = std::clamp(i - kNeighbours, 0, n - 2 * kNeighbours - 1);  // as many at the ends
    for (int k = begin; k <= begin + 2 * kNeighbours; ++k) near.push_back(points[k].value);
    const double middle = upper_median(near);
    const double most = kOutlier * std::sqrt(points[i].std * points[i].std + between);
    if (std::abs(points[i].value - middle) <= most) continue;
    limited.outliers.push_back(i);
    limited.points[i].value = middle;
  }
  return limited;
}

std::vector<SeriesChange> change_points(const std::vector<SeriesPoint>& points, double false_alarms) {
  if (static_cast<int>(points.size()) < 2 * kLogsBesideChange) return {};
  const double between = robust_variance(points);
  std::vector<double> least_scale;
  for (const SeriesPoint& point : points)
    least_scale.push_back(point.std * point.std / (point.std * point.std + between));
  return ChangeSearch(weighted(points, between), std::move(least_scale), false_alarms).run();
}

}  // namespace faultline
