// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/golden/observation.hpp"

namespace faultline {

struct Model;

/// How far a number may be from what is expected: absolute + relative * |expected|.
struct Tolerance {
  double absolute = 0.0;
  double relative = 0.0;

  double allowed(double expected) const;
  /// NaN agrees with NaN only, an infinity with itself only.
  bool agree(double expected, double actual) const;
};

/// What one table of golden.toml says: by channel (dq2, velocity_rms_2, m1) or by family of channels (dq,
/// velocity_rms, parameter).
struct Tolerances {
  std::map<std::string, Tolerance> by_channel;
  std::optional<bool> length_may_differ;
};

/// Tables that hold for one log, the nearest first.
using ToleranceChain = std::vector<const Tolerances*>;

/// Of the nearest table that names the channel or its family (the channel goes before); exact when none does.
Tolerance tolerance_of(const ToleranceChain& chain, const std::string& channel, const std::string& family);
bool length_may_differ(const ToleranceChain& chain);

/// The families that a golden file can name.
const std::vector<std::string>& tolerance_families();
/// The family of a channel such as "dq2" or "velocity_rms_1"; empty when it is none.
std::string tolerance_family(const std::string& channel);

/// What a model judges by, as numbers with names that golden.toml can give tolerances to: the parameters of
/// its robot ("model_a", "model_fv_1", with the standard deviation they were identified with, as far as the
/// model keeps it), "trigger", "threshold" (nats) and those of faults that need more ("threshold_locked_2").
std::vector<ParameterValue> values_of(const Model& model);

/// What record writes for all logs: times within two samples, predicted motion within a fiftieth of the noise
/// of a healthy log, residuals within 2 %. Arithmetic differs between machines by far less; a change of the
/// program or of the model that a user would notice is more.
Tolerances default_tolerances(const Model& model);

/// For each identified parameter a tenth of its standard deviation.
Tolerances default_tolerances(const ObservedIdentification& identification);

}  // namespace faultline
