// SPDX-License-Identifier: MIT
#include "lib/evidence/learn/work_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.hpp"
#include "lib/core/statistics.hpp"
#include "lib/evidence/learn/carried_levels.hpp"
#include "lib/evidence/learn/follow_excerpt.hpp"
#include "lib/evidence/slow_states.hpp"
#include "lib/evidence/survey/survey_log.hpp"
#include "lib/evidence/watch/episode_detector.hpp"

namespace faultline {
namespace {

constexpr int kPiecesFewestChanges = 3;  // fewer are no habit
constexpr double kSameMass = 0.25;       // share by which most changes may differ from the usual one
constexpr double kMostAlike = 0.6;       // share of the changes that must be that alike
// Standard deviation of a work piece's mass, share of it: from single changes, from levels at the least, and
// while levels are to tell it.
constexpr double kDoubtOfChanges = 0.15, kDoubtOfLevels = 0.03, kAnyMass = 0.5;
constexpr double kPiecesStdOfMedian = 1.4826;  // standard deviation over median of the absolute errors
constexpr double kAtFirst = 0.6;               // of a work piece: doubt of what is carried when a log begins
constexpr double kLeastOfCarried = 0.05;       // of the prior of a payload: less is no work piece

/// What a jump of the load may be: a mass, a push on one joint, or a row read wrong.
std::vector<Hypothesis> explanations(int joints, const std::vector<double>& work_pieces) {
  std::vector<Hypothesis> bank;
  for (const Hypothesis& hypothesis : hypotheses_of(joints, TorqueMeaning::measured, work_pieces)) {
    const FaultKind kind = hypothesis.label.kind;
    if (is_healthy(hypothesis) || kind == FaultKind::payload_change || kind == FaultKind::unknown)
      bank.push_back(hypothesis);
  }
  return bank;
}

/// Masses by which the tip changed in the excerpt, if anything did.
std::vector<double> mass_changes(const MotionModel& model, const HealthyExcerpt& excerpt) {
  const std::vector<Hypothesis> bank = explanations(model.joints(), {});
  EpisodeDetector detector(model, bank, {}, excerpt.noise);
  detector.take(excerpt.log);
  detector.finish();
  std::vector<double> changes;
  for (const EpisodeEvidence& episode : detector.episodes())
    if (bank[episode.best].label.kind == FaultKind::payload_change)
      changes.push_back(std::abs(episode.hypotheses[episode.best].size[0]));
  return changes;
}

/// The mass that most changes share; 0 for none.
double usual_mass(const std::vector<double>& changes, double least) {
  if (static_cast<int>(changes.size()) < kPiecesFewestChanges) return 0.0;
  const double mass = upper_median(changes);
  const auto alike = std::count_if(changes.begin(), changes.end(),
                                   [&](double change) { return std::abs(change - mass) < kSameMass * mass; });
  const bool most = static_cast<double>(alike) >= kMostAlike * static_cast<double>(changes.size());
  return most && mass > least ? mass : 0.0;
}

/// What motions from rest to rest show; 0 for none. Notes in the excerpts when it came and went.
double mass_by_motions(const MotionModel& model, std::vector<HealthyExcerpt>& excerpts, int threads) {
  std::vector<std::vector<CarriedLevel>> levels(excerpts.size());
  parallel_for(static_cast<int>(excerpts.size()), threads,
               [&](int i) { levels[i] = carried_levels(model, excerpts[i]); });
  const ShownPiece piece = piece_that_comes_and_goes(levels);
  if (!(piece.kg > 0.0)) return 0.0;
  for (std::size_t i = 0; i < excerpts.size(); ++i)
    excerpts[i].work_piece_changes = changes_between(levels[i], piece);
  return piece.kg;
}

/// What changes of the load within a motion show; 0 for none.
double mass_by_changes(const MotionModel& model, const std::vector<HealthyExcerpt>& excerpts, int threads) {
  std::vector<std::vector<double>> found(excerpts.size());
  parallel_for(static_cast<int>(excerpts.size()), threads,
               [&](int i) { found[i] = mass_changes(model, excerpts[i]); });
  std::vector<double> changes;
  for (const std::vector<double>& part : found) changes.insert(changes.end(), part.begin(), part.end());
  return usual_mass(changes, kLeastOfCarried * model.priors.payload);
}

/// By how much the tip's mass at the end of each stretch between changes differs from that at the end of the
/// stretch before: what whole stretches tell, where the moment of a change mixes mass and friction.
std::vector<double> level_changes(const MotionModel& model, const HealthyExcerpt& excerpt) {
  const int tip = tip_mass_index(model);
  if (tip < 0 || excerpt.work_piece_changes.empty()) return {};
  MotionModel open_minded = model;
  open_minded.work_piece_doubt = kAnyMass;
  std::vector<double> levels;
  double level = 0.0;
  follow_excerpt(excerpt, open_minded, [&](const FollowedSample& sample, bool changed) {
    if (changed) levels.push_back(level);
    level = sample.posterior.mean[tip];
  });
  levels.push_back(level);
  std::vector<double> changes;
  for (std::size_t i = 1; i < levels.size(); ++i) changes.push_back(std::abs(levels[i] - levels[i - 1]));
  return changes;
}

/// Sets the mass of the model's only work piece, and its doubt, to what whole stretches tell.
void take_levels(MotionModel& model, const std::vector<HealthyExcerpt>& excerpts, int threads) {
  std::vector<std::vector<double>> found(excerpts.size());
  parallel_for(static_cast<int>(excerpts.size()), threads,
               [&](int i) { found[i] = level_changes(model, excerpts[i]); });
  std::vector<double> changes, errors;
  for (const std::vector<double>& part : found) changes.insert(changes.end(), part.begin(), part.end());
  if (static_cast<int>(changes.size()) < kPiecesFewestChanges) return;
  const double mass = upper_median(changes);
  for (const double change : changes) errors.push_back(std::abs(change - mass));
  model.work_pieces_kg = {mass};
  model.work_piece_doubt = std::max(kPiecesStdOfMedian * upper_median(errors) / mass, kDoubtOfLevels);
}

double tip_mass(const std::vector<SlowEstimate>& estimates) {
  for (const SlowEstimate& estimate : estimates)
    if (estimate.state.kind == SlowKind::tip_mass) return estimate.value;
  return 0.0;
}

/// When the model's work pieces come and go in each excerpt.
void note_changes(const MotionModel& model, std::vector<HealthyExcerpt>& excerpts, int threads) {
  const std::vector<Hypothesis> bank = explanations(model.joints(), model.work_pieces_kg);
  parallel_for(static_cast<int>(excerpts.size()), threads, [&](int i) {
    EpisodeDetector detector(model, bank, {}, excerpts[i].noise);
    detector.take(excerpts[i].log);
    detector.finish();
    excerpts[i].work_piece_changes = detector.work_piece_changes();
  });
}

}  // namespace

WorkPieceHistory work_piece_history(LogSource& log, const MotionModel& model) {
  const std::vector<Hypothesis> bank = explanations(model.joints(), model.work_pieces_kg);
  EpisodeDetector detector(model, bank, {}, survey_noise(log, model));
  log.rewind();
  for (Log segment; log.next(segment);) detector.take(segment);
  detector.finish();
  return {detector.work_piece_changes(), tip_mass(detector.slow_estimates())};
}

void allow_work_pieces(MotionModel& model) {
  double doubt = 0.0;
  for (const double mass : model.work_pieces_kg) doubt = std::max(doubt, kAtFirst * mass);
  for (SlowState& slow : model.slow)
    if (slow.kind == SlowKind::tip_mass) slow.day_std = std::max(slow.day_std, doubt);
}

ToldBy learn_work_pieces(MotionModel& model, const std::vector<SlowState>& unmatched,
                         std::vector<HealthyExcerpt>& excerpts, int threads) {
  ToldBy told = ToldBy::statement;
  if (model.work_pieces_kg.empty()) {
    MotionModel open_minded = model;
    open_minded.slow = unmatched;
    told = ToldBy::motions;
    double mass = mass_by_motions(open_minded, excerpts, threads);
    if (mass <= 0.0) {
      told = ToldBy::changes;
      mass = mass_by_changes(model, excerpts, threads);
    }
    if (mass <= 0.0) return ToldBy::nothing;
    model.work_pieces_kg = {mass};
    model.work_piece_doubt = kDoubtOfChanges;
  }
  allow_work_pieces(model);
  if (told != ToldBy::motions) note_changes(model, excerpts, threads);
  return told;
}

void settle_work_piece(MotionModel& model, ToldBy told, std::vector<HealthyExcerpt>& excerpts, int threads) {
  take_levels(model, excerpts, threads);
  allow_work_pieces(model);
  if (told != ToldBy::motions) note_changes(model, excerpts, threads);
}

}  // namespace faultline
