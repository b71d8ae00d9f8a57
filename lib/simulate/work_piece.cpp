// SPDX-License-Identifier: MIT
#include "lib/simulate/work_piece.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/simulate/joint_list.hpp"

namespace faultline {
namespace {

constexpr double kShortest_s = 1e-3;  // shortest time, so that a long run has no endless list of pieces

void check_span(const char* key, double shortest, double longest) {
  if (!(shortest >= kShortest_s && shortest <= longest && std::isfinite(longest)))
    bad_value(key, fmt::format("expected {} <= shortest <= longest, found {} and {}", kShortest_s, shortest,
                               longest));
}

}  // namespace

void check_work_piece(const WorkPieceSpec& spec) {
  if (!(spec.mass >= 0.0 && std::isfinite(spec.mass)))
    bad_value("work_piece.mass", fmt::format("expected a mass that is not negative, found {}", spec.mass));
  check_span("work_piece.carried_s", spec.carried_min_s, spec.carried_max_s);
  check_span("work_piece.empty_s", spec.empty_min_s, spec.empty_max_s);
}

std::vector<SimulatedFault> carried(const WorkPieceSpec& spec, int joints, double duration_s, Random random) {
  std::vector<SimulatedFault> pieces;
  if (spec.mass == 0.0) return pieces;
  for (double t = random.uniform(spec.empty_min_s, spec.empty_max_s); t < duration_s;
       t += random.uniform(spec.empty_min_s, spec.empty_max_s)) {
    SimulatedFault piece{FaultKind::payload_change, Joint::at(joints - 1), t, 0.0, spec.mass};
    piece.end_s = t += random.uniform(spec.carried_min_s, spec.carried_max_s);
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace faultline
