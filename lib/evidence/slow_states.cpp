// SPDX-License-Identifier: MIT
#include "lib/evidence/slow_states.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.hpp"
#include "lib/evidence/learn/follow_excerpt.hpp"
#include "lib/log/difference_velocity.hpp"

namespace faultline {
namespace {

constexpr double kColourShare = 0.01;           // of the largest torque, where matching starts
constexpr double kFirstMemory_s = 0.05;         // likewise
constexpr double kStatesCarriedInPriors = 2.0;  // the payload's prior is half of what is carried
constexpr double kDayPace = 0.05;    // of a day's spread: what wanders of it in a second (root of time)
constexpr double kNearFloor = 0.25;  // of the least level: what the logs show of it keeps its time
constexpr double kModelErrorMemory_s = 0.03;  // of ripple, springs and friction that is met again and again

bool rubs(const Friction<double>& friction) { return friction.viscous != 0.0 || friction.coulomb != 0.0; }

}  // namespace

std::vector<SlowState> slow_states(const MotionModel& model, const NormalRange& normal) {
  std::vector<SlowState> states;
  const int n = model.joints();
  auto add = [&](SlowKind kind, int joint, double range, double walk, double memory_s = 0.0) {
    states.push_back({kind, joint, range / kStdsInRange, walk, memory_s});
  };
  for (int j = 0; j < n; ++j) {
    const double largest = model.torque_scale[j];
    const double offset = normal.torque_offset * largest;
    if (offset > 0.0) add(SlowKind::torque_offset, j, offset, kDayPace * offset);
    if (normal.friction > 0.0 && rubs(model.chain.friction[j]))
      add(SlowKind::friction, j, normal.friction, normal.friction_pace);
    if (largest <= 0.0) continue;
    if (normal.torque_constant > 0.0)
      add(SlowKind::torque_gain, j, normal.torque_constant, kDayPace * normal.torque_constant);
    states.push_back({SlowKind::coloured_torque, j, kColourShare * largest, 0.0, kFirstMemory_s});
  }
  const double carried = kStatesCarriedInPriors * model.priors.payload;
  if (normal.tip_mass > 0.0 && carried > 0.0)
    add(SlowKind::tip_mass, n - 1, normal.tip_mass * carried, kDayPace * normal.tip_mass * carried);
  return states;
}

int tip_mass_index(const MotionModel& model) {
  for (std::size_t s = 0; s < model.slow.size(); ++s)
    if (model.slow[s].kind == SlowKind::tip_mass) return 2 * model.joints() + static_cast<int>(s);
  return -1;
}

void widen_to_days(MotionModel& model, const std::vector<HealthyExcerpt>& days, int threads) {
  const int first = 2 * model.joints();
  const std::size_t count = model.slow.size();
  std::vector<std::vector<double>> squares(days.size(), std::vector<double>(count, 0.0));
  parallel_for(static_cast<int>(days.size()), threads, [&](int i) {
    GaussianState last;
    follow_excerpt(days[i], model, [&](const FollowedSample& sample, bool) { last = sample.posterior; });
    double carried = 0.0;
    for (const WorkPieceChange& change : days[i].work_piece_changes) carried += change.kg;
    for (std::size_t s = 0; s < count; ++s) {
      const int index = first + static_cast<int>(s);
      const double work_piece = model.slow[s].kind == SlowKind::tip_mass ? carried : 0.0;
      const double mean = last.mean[index] - work_piece;
      squares[i][s] = mean * mean + last.p(index, index);
    }
  });
  for (std::size_t s = 0; s < count; ++s) {
    if (model.slow[s].memory_s > 0.0) continue;
    double sum = 0.0;
    for (const std::vector<double>& day : squares) sum += day[s];
    const double seen = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(days.size(), 1)));
    model.slow[s].day_std = std::max(model.slow[s].day_std, seen);
  }
}

LogNoise log_noise(const MotionModel& model, const Log& rows) {
  LogNoise noise = noise_against(model.usual_noise, noise_level(rows), model.noise_range);
  noise.has_velocity = !rows.dq.empty();
  const std::vector<char> differences = velocities_by_difference(rows);
  for (std::size_t j = 0; j < differences.size(); ++j) noise.dq_is_difference[j] = differences[j] != 0;
  return noise;
}

void allow_model_error(MotionModel& model, double share) {
  for (SlowState& slow : model.slow) {
    const double least = share * model.torque_scale[slow.joint];
    if (slow.kind != SlowKind::coloured_torque || least <= slow.day_std) continue;
    if (slow.day_std < kNearFloor * least) slow.memory_s = kModelErrorMemory_s;
    slow.day_std = least;
  }
}

}  // namespace faultline
