// SPDX-License-Identifier: MIT
#include "lib/identify/extra/extra_term.hpp"

#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {

bool is_ripple(ExtraKind kind) { return kind == ExtraKind::ripple_cosine || kind == ExtraKind::ripple_sine; }

bool is_of_shared_drive(ExtraKind kind) {
  return kind == ExtraKind::shared_inertia || kind == ExtraKind::shared_viscous ||
         kind == ExtraKind::shared_coulomb;
}

bool belong_together(const ExtraTerm& a, const ExtraTerm& b) {
  return a.index == b.index && ((is_ripple(a.kind) && is_ripple(b.kind)) ||
                                (is_of_shared_drive(a.kind) && is_of_shared_drive(b.kind)));
}

bool is_possible(ExtraKind kind, double value) {
  constexpr double kMostLoad = 0.5;  // of the carried torque: more load friction is a wrong fit
  if (is_ripple(kind)) return true;
  return value >= 0.0 && (kind != ExtraKind::load_friction || value < kMostLoad);
}

std::vector<ExtraTerm> extra_terms_of(const Chain& chain, const std::vector<double>& gear_compliance) {
  std::vector<ExtraTerm> out;
  for (int j = 0; j < chain.joints(); ++j)
    if (chain.friction[j].load != 0.0) out.push_back({ExtraKind::load_friction, Joint::at(j), j});
  for (int i = 0; i < static_cast<int>(chain.shared_drives.size()); ++i) {
    int j = 0;
    while (j + 1 < chain.joints() && chain.shared_drives[i].along[j] == 0.0) ++j;
    const Joint joint = Joint::at(j);
    out.push_back({ExtraKind::shared_inertia, joint, i});
    out.push_back({ExtraKind::shared_viscous, joint, i});
    out.push_back({ExtraKind::shared_coulomb, joint, i});
  }
  for (int i = 0; i < static_cast<int>(chain.ripples.size()); ++i) {
    out.push_back({ExtraKind::ripple_cosine, chain.ripples[i].joint, i});
    out.push_back({ExtraKind::ripple_sine, chain.ripples[i].joint, i});
  }
  for (int j = 0; j < static_cast<int>(gear_compliance.size()); ++j)
    if (gear_compliance[j] != 0.0) out.push_back({ExtraKind::gear_compliance, Joint::at(j), j});
  return out;
}

double* extra_value(Chain& chain, const ExtraTerm& term) {
  const auto index = static_cast<std::size_t>(term.index);
  if (term.kind == ExtraKind::load_friction) return &chain.friction[index].load;
  if (is_ripple(term.kind) && index < chain.ripples.size()) {
    Ripple& ripple = chain.ripples[index];
    return term.kind == ExtraKind::ripple_cosine ? &ripple.cosine : &ripple.sine;
  }
  if (is_of_shared_drive(term.kind) && index < chain.shared_drives.size()) {
    SharedDrive& drive = chain.shared_drives[index];
    return term.kind == ExtraKind::shared_inertia   ? &drive.rotor_inertia
           : term.kind == ExtraKind::shared_viscous ? &drive.viscous
                                                    : &drive.coulomb;
  }
  return nullptr;
}

JointVector extra_torque(const Chain& chain, const ExtraTerm& term, const JointVector& q,
                         const JointVector& dq, const JointVector& ddq, const JointVector& carried) {
  JointVector out = JointVector::Zero(chain.joints());
  const int j = term.joint.index();
  if (term.kind == ExtraKind::load_friction) {
    out[j] = std::abs(carried[j]) * elementary::tanh(dq[j] / chain.friction[j].width);
  } else if (is_ripple(term.kind)) {
    const double angle = chain.ripples[term.index].rate * q[j];
    out[j] = term.kind == ExtraKind::ripple_cosine ? elementary::cos(angle) : elementary::sin(angle);
  } else if (is_of_shared_drive(term.kind)) {
    const SharedDrive& f = chain.shared_drives[term.index];
    const double motion = f.speed(term.kind == ExtraKind::shared_inertia ? ddq.data() : dq.data());
    out = f.along * (term.kind == ExtraKind::shared_coulomb ? elementary::tanh(motion / f.width) : motion);
  }
  return out;
}

}  // namespace faultline
