// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/fact_table.hpp"

/// Renderings of the answer about a stop (StopAnswer) that several reports use.
namespace faultline {

/// "At the stop, 12.340 s", with the column that gave the moment.
std::string stop_title(const StopAnswer& stop, double sample_period_s);

/// The signals of each joint in the last moment: signal, joint, state, value, before, healthy up to, since.
FactTable stop_signal_table(const StopAnswer& stop, double sample_period_s);

/// The smallest changes that would have been seen; empty for a log that is not short.
FactTable stop_reach_table(const StopAnswer& stop);

/// The key `stop` of the diagnosis.
nlohmann::ordered_json stop_json(const StopAnswer& stop);

}  // namespace faultline
