// SPDX-License-Identifier: MIT
#include "lib/simulate/sensors.hpp"

#include <cmath>

#include "lib/fault/fault_catalogue.hpp"
#include "lib/simulate/joint_list.hpp"
#include "lib/simulate/simulate.hpp"

namespace faultline {

Sensors::Sensors(int joints, const NoiseSpec& noise, const std::vector<SimulatedFault>& faults, Random random)
    : q_noise_(or_all(noise.q, joints, 0.0)),
      dq_noise_(or_all(noise.dq, joints, 0.0)),
      resolution_(or_all(noise.q_resolution, joints, 0.0)),
      random_(random) {
  for (const SimulatedFault& fault : faults)
    if (describe(fault.kind).acts_on == FaultActsOn::sensor) faults_.push_back(fault);
  q = dq = JointVector<double>::Zero(joints);
}

void Sensors::read(double t, const JointVector<double>& true_q, const JointVector<double>& true_dq) {
  for (int i = 0; i < q.size(); ++i) {
    double position = true_q[i], speed = true_dq[i];
    bool stuck = false;
    for (const SimulatedFault& fault : faults_) {
      if (fault.joint != i + 1 || t < fault.onset_s || t >= fault.end_s) continue;
      const MachineFault change = machine_fault(fault);
      position += change.reading_offset + change.reading_drift_per_s * (t - fault.onset_s);
      stuck = stuck || change.reading_sticks;
    }
    if (q_noise_[i] > 0.0) position += q_noise_[i] * random_.normal();
    if (dq_noise_[i] > 0.0) speed += dq_noise_[i] * random_.normal();
    if (resolution_[i] > 0.0) position = resolution_[i] * std::round(position / resolution_[i]);
    if (stuck && started_) continue;
    q[i] = position;
    dq[i] = speed;
  }
  started_ = true;
}

}  // namespace faultline
