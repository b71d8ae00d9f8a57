// SPDX-License-Identifier: MIT
#include "apps/cases/case_actions.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lib/cases/carry_over.hpp"
#include "lib/cases/case.hpp"
#include "lib/cases/case_base.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/cases/possible_labels.hpp"
#include "lib/core/error.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLength = 10;  // of YYYY-MM-DD

template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || number < 0) return {};
  return number;
}

bool is_date(const std::string& text) {
  if (text.size() != kLength || text[4] != '-' || text[7] != '-') return false;
  const std::string_view view = text;
  const auto year = number_in<int>(view.substr(0, 4)), month = number_in<int>(view.substr(5, 2)),
             day = number_in<int>(view.substr(8, 2));
  return year && month && day &&
         std::chrono::year_month_day(std::chrono::year(*year), std::chrono::month(unsigned(*month)),
                                     std::chrono::day(unsigned(*day)))
             .ok();
}

std::string today() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  std::time_t now = std::time(nullptr);
  std::tm parts{};
  if (epoch != nullptr && *epoch != '\0') {
    const auto seconds = number_in<long long>(epoch);
    if (!seconds) throw Error(ErrorCode::usage, "SOURCE_DATE_EPOCH", "is not a number of seconds since 1970");
    now = static_cast<std::time_t>(*seconds);
    gmtime_r(&now, &parts);
  } else {
    localtime_r(&now, &parts);
  }
  char text[kLength + 1];
  return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%d", &parts));
}

std::string row(const char* name, const std::string& text) {
  return text.empty() ? "" : fmt::format("  {:<9}{}\n", name, printable(text));
}

/// Returns the origin of a case and the person who described it, as far as known.
std::string source_rows(const CaseBase& base, const Case& c) {
  const std::string& robot = c.robot.empty() ? base.robot().name : c.robot;
  std::string text = row("origin", origin_words(c, base.robot().name)) + row("robot", robot) +
                     row("person", c.person) + row("date", c.date);
  if (c.log_sha256.empty()) return text + row("log", log_name_of(c));
  const std::string name = log_name_of(c);
  return text + row("log", fmt::format("{}SHA-256 {}, fault from {} s on", name.empty() ? "" : name + ", ",
                                       c.log_sha256, value_text(c.onset_s)));
}

/// Returns a case as one line of a list, with its origin.
std::string case_line(const CaseBase& base, const Case& c) {
  const std::string done = c.what_was_done.empty() ? "" : "; done: " + c.what_was_done;
  return printable(fmt::format("{:>6}  {:<12} {:<40} {}{}", c.id, to_string(c.outcome), plain_words(c.label),
                               origin_words(c, base.robot().name), done)) +
         "\n";
}

/// Returns a case with its opinions, evidence and features; `base` has the names, scales and weights of the
/// features.
std::string case_text(const CaseBase& base, const Case& c) {
  const auto opinion = [](const char* network, const Opinion& o) {
    return fmt::format("  {:<9}{} ({:.2f})\n", network, plain_words(o.label), o.confidence);
  };
  std::string text = fmt::format("Case {}: {} ({})\n", c.id, plain_words(c.label), to_string(c.outcome));
  text += fmt::format("  decided  {}\n", plain_words(c.decision));
  text += opinion("MLP", c.episode.mlp) + opinion("RBFN", c.episode.rbfn);
  text += row("evidence", value_text(c.episode.evidence)) + source_rows(base, c) +
          fmt::format("  done     {}\n", printable(c.what_was_done));
  text +=
      fmt::format("  features (value, scale, weight){}\n", c.features_by.empty() ? "" : ", of another model");
  for (std::size_t i = 0; i < c.episode.features.size(); ++i) {
    const Feature& f = base.metric().features[i];
    text += fmt::format("    {:<32} {:>10} {:>10} {:>6.2f}\n", printable(f.name),
                        value_text(c.episode.features[i]), value_text(f.scale), f.weight);
  }
  return text;
}

bool is_asked_for(const CaseBase& base, const Case& c, const CasesArguments& arguments) {
  if (!arguments.origin.empty() && origin_of(c) != case_origin_from(arguments.origin)) return false;
  if (!arguments.by.empty() && c.person != arguments.by) return false;
  if (!arguments.robot.empty() && (c.robot.empty() ? base.robot().name : c.robot) != arguments.robot)
    return false;
  if (!arguments.outcome.empty() && c.outcome != case_outcome_from(arguments.outcome)) return false;
  if (!arguments.fault.empty() && c.label.kind != fault_kind_from(arguments.fault)) return false;
  return arguments.joint_number == 0 || c.label.joint == Joint::numbered(arguments.joint_number);
}

/// Changes the base in one transaction; the answer is the case whose id `change` returns.
CasesAnswer changed_by(const CasesArguments& arguments,
                       const std::function<std::int64_t(CaseBase&)>& change) {
  CaseBase changed;
  std::int64_t id = 0;
  change_case_base(arguments.path(), [&](CaseBase& base) {
    id = change(base);
    changed = base;
  });
  return answer_with(changed, changed.at(id));
}

/// Returns person and date; the date is today's only if the statement is new.
Signature signature_for(const CasesArguments& arguments, const Case& c, CaseOutcome outcome,
                        const FaultLabel& label) {
  const bool is_new = c.outcome != outcome || c.label != label || !arguments.by.empty() ||
                      (c.person.empty() && c.date.empty());
  return {arguments.by, is_new || !arguments.date.empty() ? date_or_today(arguments.date) : ""};
}

}  // namespace

std::string date_or_today(const std::string& date) {
  if (date.empty()) return today();
  if (!is_date(date))
    throw Error(ErrorCode::usage, "--date", "\"" + date + "\" is not a date; expected YYYY-MM-DD");
  return date;
}

std::string CasesArguments::path() const {
  if (cases.empty() == model.empty())
    throw Error(ErrorCode::usage, "faultline cases", "needs either --cases FILE or --model MODEL");
  return case_base();
}

std::optional<FaultLabel> CasesArguments::label(const CaseBase& base) const {
  if (fault.empty() && joint_number == 0) return {};
  if (fault.empty()) throw Error(ErrorCode::usage, "--joint", "needs --fault KIND as well");
  const FaultLabel label = with_tip({fault_kind_from(fault), Joint::numbered(joint_number)}, joints_of(base));
  check_label(base, label, "--fault " + label_text(label));
  return label;
}

CasesAnswer answer_with(const CaseBase& base, const Case& c, const std::string& before) {
  return {to_json(base, c), before + case_line(base, c)};
}

CasesAnswer list_cases(const CasesArguments& arguments) {
  const CaseBase base = read_case_base(arguments.path());
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::string text;
  int shown = 0;
  for (const Case& c : base.cases()) {
    if (!is_asked_for(base, c, arguments)) continue;
    ++shown;
    json.push_back(to_json(base, c));
    text += case_line(base, c);
  }
  return {std::move(json), text + fmt::format("{} of {} cases\n", shown, base.cases().size())};
}

CasesAnswer show_case(const CasesArguments& arguments) {
  const CaseBase base = read_case_base(arguments.path());
  const Case& c = base.at(arguments.id);
  return {to_json(base, c), case_text(base, c)};
}

CasesAnswer confirm_case(const CasesArguments& arguments) {
  return changed_by(arguments, [&](CaseBase& base) {
    const Case& c = base.at(arguments.id);
    const FaultLabel label = arguments.label(base).value_or(c.decision);
    base.confirm(c.id, label, arguments.done, signature_for(arguments, c, CaseOutcome::confirmed, label));
    return arguments.id;
  });
}

CasesAnswer reject_case(const CasesArguments& arguments) {
  return changed_by(arguments, [&](CaseBase& base) {
    const Case& c = base.at(arguments.id);
    const FaultLabel was = arguments.label(base).value_or(FaultLabel{FaultKind::unknown});
    base.reject(c.id, was, arguments.done, signature_for(arguments, c, CaseOutcome::rejected, was));
    return arguments.id;
  });
}

CasesAnswer delete_case(const CasesArguments& arguments) {
  CaseBase base = read_case_base(arguments.path());
  const Case& deleted = base.at(arguments.id);
  change_case_base(arguments.path(), [&](CaseBase& there) {
    if (content_hash(there.at(deleted.id)) != content_hash(deleted))
      throw Error(ErrorCode::usage, arguments.path(), "was changed meanwhile; show the case again");
    there.remove(deleted.id);
  });
  CasesAnswer answer = answer_with(base, deleted, "deleted ");
  if (is_made_by_learn(deleted))
    answer.note = "this case was made by learn, which makes it again when it is next run";
  return answer;
}

}  // namespace faultline
