// SPDX-License-Identifier: MIT
#include "lib/explain/explain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "lib/explain/judge.hpp"
#include "lib/explain/search.hpp"
#include "lib/explain/sensor_jumps.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFreeRowCost =
    1.5;  // nats of a row and joint of which nothing is said: that of 1.7 standard deviations
constexpr int kRowsOfChange = 6;  // on each side of a change of the work piece: kernel and filter
constexpr double kSameOnset_s = 0.08;
constexpr std::size_t kOnsets = 6, kOnsetsForAll = 6;
constexpr double kWorthRefining = 5.0;  // nats
constexpr std::size_t kRefined = 5;     // hypotheses

/// Judges hypotheses of one log and keeps them all.
struct Bench {
  const LogFit& fit;
  std::vector<LinearFault> linear;
  std::vector<FaultHypothesis> judged;

  const FaultHypothesis* go(FaultKind kind, int joint, double onset_s, double start = 0.0) {
    std::optional<FaultHypothesis> h = judge(fit, linear, kind, joint, onset_s, start);
    if (!h) return nullptr;
    judged.push_back(std::move(*h));
    return &judged.back();
  }
};

std::vector<Candidate> of(const std::vector<Candidate>& all, FaultKind kind, int joint) {
  std::vector<Candidate> out;
  for (const Candidate& c : all)
    if (c.kind == kind && c.joint == joint) out.push_back(c);
  std::stable_sort(out.begin(), out.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return out;
}

/// Onsets that stand out for any kind.
std::vector<double> common_onsets(const std::vector<Candidate>& all) {
  std::vector<Candidate> sorted;
  for (const Candidate& c : all)
    if (c.kind != FaultKind::sensor_drift || c.score > 5.0) sorted.push_back(c);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  std::vector<double> out;
  for (const Candidate& c : sorted) {
    bool apart = true;
    for (const double t : out) apart = apart && std::abs(c.onset_s - t) > kSameOnset_s;
    if (apart) out.push_back(c.onset_s);
    if (out.size() == kOnsets) break;
  }
  return out;
}

std::set<double> onsets_of(const std::vector<Candidate>& own, const std::vector<double>& common,
                           std::size_t most) {
  std::set<double> out;
  for (const Candidate& c : own) out.insert(c.onset_s);
  for (std::size_t k = 0; k < std::min(most, common.size()); ++k) out.insert(common[k]);
  return out;
}

void judge_candidates(const std::vector<Candidate>& all, const FreeForm& change, Bench& bench) {
  const LogFit& fit = bench.fit;
  std::vector<double> common = common_onsets(all);
  const double row_s = fit.model().setting.row_s();
  for (const double rows : {-1.0, -0.5, 0.0}) common.insert(common.begin(), change.onset_s + rows * row_s);
  std::vector<double> changes;  // of the work piece
  for (int k = 0; k + 1 < static_cast<int>(fit.healthy().path.size()); ++k)
    if (fit.healthy().path[k] != fit.healthy().path[k + 1]) changes.push_back(fit.time_s()[k + 1]);
  for (std::size_t f = 0; f < bench.linear.size(); ++f) {
    const FaultKind kind = bench.linear[f].kind;
    const int joint = bench.linear[f].joint;
    std::set<double> onsets = onsets_of(of(all, kind, joint), common, kOnsetsForAll);
    if (joint == fit.joints()) onsets.insert(changes.begin(), changes.end());
    for (const double t : onsets) bench.go(kind, joint, t);
  }
  std::vector<Candidate> blows = of(all, FaultKind::collision, fit.joints());
  if (blows.size() > 4) blows.resize(4);
  for (const double t : onsets_of(blows, common, 5)) bench.go(FaultKind::collision, fit.joints(), t);
  for (int joint = 1; joint <= fit.joints(); ++joint) {
    const bool slide = fit.model().rigid.chain.geometry[joint - 1].kind == AxisKind::prismatic;
    std::vector<Candidate> drifts = of(all, FaultKind::sensor_drift, joint);
    if (drifts.size() > 3) drifts.resize(3);
    for (std::size_t k = 0; k < std::min<std::size_t>(4, common.size()); ++k)
      for (const double sign : {-1.0, 1.0})
        drifts.push_back({FaultKind::sensor_drift, joint, common[k], 0.0, sign * (slide ? 0.01 : 0.03)});
    for (const Candidate& c : drifts) bench.go(c.kind, joint, c.onset_s, c.start);
    for (const Candidate& c : of(all, FaultKind::sensor_bias, joint))
      bench.go(c.kind, joint, c.onset_s, c.start);
    for (const double t : onsets_of(of(all, FaultKind::locked, joint), common, kOnsetsForAll))
      bench.go(FaultKind::locked, joint, t);
    for (const Candidate& c : of(all, FaultKind::stuck_encoder, joint)) bench.go(c.kind, joint, c.onset_s);
  }
}

/// The best of each kind and joint, best first.
std::vector<FaultHypothesis> ranked(const std::vector<FaultHypothesis>& all) {
  std::vector<FaultHypothesis> out;
  for (const FaultHypothesis& h : all) {
    auto known = std::find_if(out.begin(), out.end(), [&](const FaultHypothesis& o) {
      return o.kind == h.kind && o.joint == h.joint;
    });
    if (known == out.end())
      out.push_back(h);
    else if (h.gain > known->gain)
      *known = h;
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const FaultHypothesis& a, const FaultHypothesis& b) { return a.gain > b.gain; });
  return out;
}

/// Moves the onset of a hypothesis while it explains more, by halved steps.
void refine(FaultHypothesis best, Bench& bench) {
  const LogFit& fit = bench.fit;
  const double row_s = fit.model().setting.row_s();
  const int first = std::max(6, static_cast<int>(kLead_s / row_s));
  const double earliest = fit.time_s()[std::min(first, fit.count() - 1)],
               latest = fit.time_s()[std::max(0, fit.count() - 3)];
  const auto try_at = [&](double t) {
    if (t < earliest || t >= latest) return false;
    const double start = best.kind == FaultKind::sensor_drift ? best.size[0] : 0.0;
    const FaultHypothesis* h = bench.go(best.kind, best.joint, t, start);
    if (h == nullptr || h->gain <= best.gain) return false;
    best = *h;
    return true;
  };
  const double at = best.onset_s;
  for (const double d : {-.04, -.03, -.02, -.01, -.005, .005, .01, .02, .03, .04}) try_at(at + d);
  for (double step = 0.16; step > 0.3 * row_s;)
    if (!try_at(best.onset_s - step) && !try_at(best.onset_s + step)) step /= 2.0;
}

/// Whether one encoder jumped more than once by about as much.
bool slips(const std::vector<FaultHypothesis>& best, const std::vector<FaultHypothesis>& all) {
  if (best.empty() || best.front().kind != FaultKind::sensor_bias) return false;
  const FaultHypothesis& b = best.front();
  return std::any_of(all.begin(), all.end(), [&](const FaultHypothesis& h) {
    return h.kind == FaultKind::sensor_bias && h.joint == b.joint && std::abs(h.onset_s - b.onset_s) > 0.2 &&
           h.gain > 0.02 * b.gain && std::abs(h.size[0]) > 0.4 * std::abs(b.size[0]);
  });
}

/// The moment up to which rows are explained, where each row after it costs kFreeRowCost: effects of the day
/// are those of the rows before, from cumulative normal equations.
FreeForm free_form(const LogFit& fit) {
  const int rows = fit.count(), n = fit.joints();
  const int effects = static_cast<int>(fit.model().day_variance.size());
  Stacked torque = fit.residual();
  if (fit.has_piece())  // as seen before a fault could bend the effects of the day
    torque -=
        fit.piece_torque(piece_ramps(fit.first_path(), fit.time_s(), fit.model().setting.kernel_s).level);
  Stacked white = fit.whitened(torque);
  const std::vector<bool> changes = near_change(fit.first_path(), kRowsOfChange);
  for (int k = 0; k < static_cast<int>(changes.size()); ++k)  // the time of a change is not known to a row
    for (int j = 0; j < n && changes[k]; ++j) white[j * rows + k] = 0.0;
  NormalEquations sums{MatrixXd::Zero(effects, effects), VectorXd::Zero(effects)};
  const VectorXd precision = fit.model().day_variance.cwiseInverse();
  const int first = std::max(6, static_cast<int>(kLead_s / fit.model().setting.row_s()));
  double least = std::numeric_limits<double>::infinity();
  int best = first;
  VectorXd day = VectorXd::Zero(effects);
  for (int k = 0; k + kTail < rows; ++k) {
    for (int j = 0; j < n; ++j) {
      const double y = white[j * rows + k];
      if (!changes.empty() && changes[k]) continue;
      const VectorXd w = fit.white_day().row(j * rows + k).transpose();
      sums.matrix += w * w.transpose();
      sums.vector += y * w;
      sums.square += y * y;
    }
    if (k < first) continue;
    const Regression before = regress(sums, precision);
    const double cost =
        0.5 * (sums.square - before.estimate.dot(sums.vector)) + kFreeRowCost * n * (rows - 1 - k);
    if (cost >= least) continue;
    least = cost;
    best = k;
    day = before.estimate;
  }
  FreeForm out;
  out.onset_s = fit.time_s()[std::min(best + 1, rows - 1)];
  out.left = white - fit.white_day() * day;
  return out;
}

}  // namespace

LogExplanation explain_log(const LogFit& fit) {
  Bench bench{fit, linear_faults(fit), {}};
  bench.judged.reserve(1024);
  LogExplanation out;
  out.free_form = free_form(fit);
  judge_candidates(search(fit, bench.linear), out.free_form, bench);
  std::vector<FaultHypothesis> top = ranked(bench.judged);
  if (top.size() > kRefined) top.resize(kRefined);
  for (const FaultHypothesis& h : top)
    if (h.gain >= kWorthRefining && h.kind != FaultKind::stuck_encoder && h.kind != FaultKind::sensor_bias)
      refine(h, bench);
  out.best = ranked(bench.judged);
  if (!out.best.empty()) {
    const FaultHypothesis first = out.best.front();
    if (first.kind == FaultKind::locked) bench.go(FaultKind::stuck_encoder, first.joint, first.onset_s);
    if (first.kind == FaultKind::stuck_encoder) bench.go(FaultKind::locked, first.joint, first.onset_s);
    out.best = ranked(bench.judged);
  }
  out.healthy_square = fit.healthy().mean_square();
  out.slips = slips(out.best, bench.judged);
  return out;
}

double alarm_time(const LogFit& fit, const FreeForm& change, double threshold) {
  const double edge = reach_s(fit.model().setting);
  double sum = 0.0;
  for (int k = 0; k < fit.count(); ++k) {
    if (fit.time_s()[k] < change.onset_s - edge) continue;
    for (int j = 0; j < fit.joints(); ++j) {
      const double z = change.left[j * fit.count() + k];
      sum += 0.5 * z * z - 0.5;
    }
    if (sum > threshold) return std::max(fit.time_s()[k] + edge, change.onset_s);
  }
  return fit.time_s()[fit.count() - 1] + edge;
}

double alarm_time(const LogFit& fit, const FaultHypothesis& h, double threshold) {
  Stacked y = fit.residual() - fit.day_torque(h.fit.day);
  if (h.fit.piece_level.size() > 0) y -= fit.piece_torque(h.fit.piece_level);
  const Stacked without = fit.whitened(y);
  const double edge = reach_s(fit.model().setting);
  double sum = 0.0;
  for (int k = 0; k < fit.count(); ++k) {
    if (fit.time_s()[k] < h.onset_s - edge) continue;
    for (int j = 0; j < fit.joints(); ++j) {
      const double a = without[j * fit.count() + k], b = h.fit.left[j * fit.count() + k];
      sum += 0.5 * (a * a - (std::isnan(b) ? 1.0 : b * b));
    }
    if (sum > threshold) return std::max(fit.time_s()[k] + edge, h.onset_s);
  }
  return fit.time_s()[fit.count() - 1] + edge;
}

}  // namespace faultline
