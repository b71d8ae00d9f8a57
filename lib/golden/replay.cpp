// SPDX-License-Identifier: MIT
#include "lib/golden/replay.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/error.hpp"
#include "lib/core/parallel.hpp"
#include "lib/core/version.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/golden/tolerance.hpp"
#include "lib/golden/trace_tap.hpp"
#include "lib/identify/identify.hpp"

namespace faultline {
namespace {

ObservedEvent observed(const FaultFinding& finding) {
  ObservedEvent event{event_of(finding),
                      finding.episode.evidence,
                      to_string(finding.decided_by),
                      {finding.mlp, finding.rbfn},
                      {}};
  for (const Alternative& alternative : finding.could_also_be)
    event.could_also_be.push_back(alternative.label);
  return event;
}

Observation observed(const Diagnosis& diagnosis, const Trace& trace) {
  Observation seen;
  seen.verdict = to_string(diagnosis.verdict);
  seen.reason = diagnosis.verdict_reason;
  seen.rows = diagnosis.log.rows_used;
  for (const FaultFinding& finding : diagnosis.faults) seen.events.push_back(observed(finding));
  seen.residuals = diagnosis.residuals;
  seen.trace = trace;
  return seen;
}

Observation observe_file(const ReplayLog& log, const ModelAndCases& subject, const LogOpener& open,
                         int trace_points) {
  try {
    const auto source = open(log.path, subject.model);
    TraceTap tap(*source, subject.model.residual, trace_points);
    const Diagnosis diagnosis = diagnose(tap, subject.model, subject.cases);
    return observed(diagnosis, tap.trace());
  } catch (const Error& error) {
    if (error.code() == ErrorCode::internal) throw;
    Observation unusable;
    unusable.verdict = kUnusable;
    unusable.reason = error.message();
    return unusable;
  }
}

void add(const std::vector<ParameterEstimate>& from, std::vector<ParameterValue>& to) {
  for (const ParameterEstimate& p : from)
    if (!find_value(to, p.name)) to.push_back(value_of(p));
}

}  // namespace

ObservedIdentification observe_identification(const std::vector<ReplayLog>& logs, const Model& model,
                                              const LogOpener& open, int threads) {
  try {
    std::vector<std::unique_ptr<LogSource>> owners;
    std::vector<LogSource*> sources;
    for (const ReplayLog& log : logs) {
      owners.push_back(open(log.path, model));
      sources.push_back(owners.back().get());
    }
    IdentifyOptions options;
    options.threads = threads;
    const Identification found = identify(sources, model.robot, options);
    ObservedIdentification seen{to_string(found.status), to_string(found.method), {}, ""};
    add(found.base_parameters, seen.parameters);
    add(found.physical_parameters, seen.parameters);
    return seen;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::internal) throw;
    return {kUnusable, "", {}, error.message()};
  }
}

GoldenRun replay(const std::vector<ReplayLog>& logs, const ModelAndCases& subject, const LogOpener& open,
                 const ReplayOptions& options, const Progress& progress) {
  GoldenRun run;
  run.program_version = program_version();
  run.model = {subject.name, subject.model.sha256, subject.cases.sha256(), notes_of(subject.model)};
  run.model_values = values_of(subject.model);
  run.logs.resize(logs.size());
  std::vector<ReplayLog> healthy;
  std::copy_if(logs.begin(), logs.end(), std::back_inserter(healthy),
               [](const ReplayLog& log) { return log.identify; });
  const auto steps = static_cast<int>(logs.size()) + 1;
  parallel_steps("replaying golden logs", steps, options.threads, progress, [&](int i) {
    if (i > 0)
      run.logs[i - 1] = {logs[i - 1].name, observe_file(logs[i - 1], subject, open, options.trace_points)};
    else if (!healthy.empty())
      run.identification = observe_identification(healthy, subject.model, open, options.threads);
  });
  return run;
}

}  // namespace faultline
