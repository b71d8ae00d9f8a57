// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <string>

#include "lib/core/version.hpp"
#include "lib/reproduce/page/reproduction.hpp"
#include "lib/reproduce/page/result_table.hpp"

namespace faultline {
namespace {

std::string named(const FigureColumn& column) {
  return column.unit.empty() ? column.name : column.name + ", " + column.unit;
}

std::string table_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& text : cells) line += " " + text + " |";
  return line + "\n";
}

std::string rule(std::size_t labels, std::size_t figures) {
  std::string line = "|";
  for (std::size_t i = 0; i < labels; ++i) line += "---|";
  for (std::size_t i = 0; i < figures; ++i) line += "---:|";
  return line + "\n";
}

std::string table_text(const ResultTable& table) {
  std::string text = fmt::format("### {}\n\n", table.title);
  if (!table.text.empty()) text += table.text + "\n\n";
  std::vector<std::string> head = table.label_columns;
  for (const FigureColumn& column : table.figure_columns) head.push_back(named(column));
  text += table_line(head) + rule(table.label_columns.size(), table.figure_columns.size());
  for (const ResultRow& row : table.rows) {
    std::vector<std::string> cells = row.labels;
    for (std::size_t i = 0; i < row.figures.size(); ++i)
      cells.push_back(row.figures[i] ? figure_text(*row.figures[i], table.figure_columns[i].style) : "");
    text += table_line(cells);
  }
  return text + "\n";
}

std::string goals_text(const std::vector<Goal>& goals) {
  std::string text =
      table_line({"what", "paper", "independent study", "to reach", "measured", "reached"}) + rule(3, 3);
  std::string notes;
  for (const Goal& goal : goals) {
    const std::string unit = goal.unit.empty() ? "" : " " + goal.unit;
    text += table_line({goal.what, goal.paper, goal.study,
                        (goal.at_most ? "≤ " : "≥ ") + figure_text(goal.bound, goal.style) + unit,
                        figure_text(goal.measured, goal.style) + unit, goal.reached() ? "yes" : "no"});
    if (!goal.note.empty()) notes += fmt::format("- *{}*: {}\n", goal.what, goal.note);
  }
  return text + (notes.empty() ? "" : "\n" + notes) + "\n";
}

std::string how_made(const ReproduceOptions& options) {
  return fmt::format(
      "Made by `faultline reproduce{}{}{}` of faultline {}. Figures are means over {} ± the standard "
      "deviation between them where there is one.\n\n",
      options.quick ? " --quick" : "", options.seeds != 5 ? fmt::format(" --seeds {}", options.seeds) : "",
      options.seed != 1 ? fmt::format(" --seed {}", options.seed) : "", program_version(),
      options.seeds == 1 ? "one experiment" : fmt::format("{} experiments", options.seeds));
}

/// The method in short, and what had to be settled before it could be run.
std::string paper_introduction() {
  return R"(The paper, "Robust fault diagnosis in robotic manipulators", lets a multi-layer perceptron
predict position and velocity of a three-axis SCARA robot one sample ahead, calls the difference from what
was measured the residual, and lets an MLP or a radial basis function network (RBFN) determine from the
velocity residual which joint swings freely. Its second approach queries both networks and combines their
answers by case-based reasoning.

## Assumptions of the reproduction

The paper gives no masses, lengths, joint ranges, controller or unit of its noise. What was used here:

- **Robot**: m = (1, 0.8, 0.5) kg, l = (1, 0.8) m, links 1 and 2 uniform rods, no friction; q1 and q2 within
  ±2 rad, q3 from -0.35 to 0.05 m, sample period 0.073 s. One study uses the same robot with friction in every
  joint.
- **Motion**: random point-to-point moves of 1.2 to 1.8 s. A *trajectory* (the paper's training and test sets)
  is one such move from rest, then rest. A *run* is many of them, each followed by a rest of up to 0.4 s.
- **Controller**, in three variants that are named with every number. *held*: computed torque along quintic
  moves, the torque constant over each sample. *fast*: the same at 1 kHz, logged every 73 ms, so that the
  torque between two samples is not in the log. *pd*: PD control with gravity compensation at 1 kHz after
  set-points that jump.
- **Noise**: "variance = 0.01" is read as a standard deviation of 0.01 or of 0.1 of half the range of each
  position and velocity. It is added to what was measured; the controller does not see it. The torque is the
  commanded one.
- **Errors** are mean squares in units of half ranges: of q as commanded, of dq as observed in 100 healthy
  trajectories.
- **Fault**: from its onset on no torque reaches the joint, while the controller continues to command it.

Every set is drawn from seeds of its own. Networks learn from training sets; g, thresholds and the choice
between recipes come from tuning sets; what is printed was measured once, on test sets.

)";
}

constexpr const char* kErrataIntroduction =
    R"(## Errata of the paper

What is printed cannot be run as it stands. With a = l1² (m1/3 + m2 + m3), b = l2² (m2/3 + m3), c = l1 l2
(m2/2 + m3), rods for links 1 and 2 and the third link's mass on its axis, the dynamics are

    M11 = a + b + 2 c cos q2     M12 = M21 = b + c cos q2     M22 = b     M33 = m3
    h1  = -c sin q2 (2 dq1 dq2 + dq2²)     h2 = c sin q2 dq1²     G3 = m3 g
    M(q) ddq + h(q, dq) + G + F(dq) = tau

| where | printed | used, and why |
|---|---|---|
)";

/// What is printed where, and what was used in its place.
struct Erratum {
  const char *where, *printed, *used;
};
constexpr Erratum kErrata[] = {
    {"equations 4 and 5", "the fault-free system is g_i, the faulty one f",
     "f is the fault-free one, as the text before and equation 6 have it"},
    {"equation 6", "g_i is also the difference; \"for the fault-free system g_i(t + dt).\"",
     "the fault vector is another quantity than the faulty dynamics, and it is zero without a fault"},
    {"equation 8", "M⁻¹ multiplies the velocity too",
     "x = (θ, dθ): the velocity is itself, M⁻¹ belongs to the acceleration alone"},
    {"equation 9", "Φ_i on both sides, \"fault i = 1\"",
     "fault i is declared when output i is the largest of all for g samples in a row"},
    {"dynamics", "q where accelerations belong", "the dots were lost: M multiplies ddq"},
    {"D12, D13", "D12 = 0 and D13 = D21",
     "the two are swapped: joints 1 and 2 are coupled, joint 3 is with neither"},
    {"D21", "l1 l2 (m2/3 + m3) cos q2 - (m2/3 + m3)",
     "m2/2 instead of m2/3 in the first term, l2² on the second (kg against kg m²), and plus: no "
     "choice of angles gives the minus"},
    {"C11, C12", "-q2 (...) with m2/3 in C12", "dq2, and m2/2"},
    {"C21", "0", "dq1 (m2/2 + m3): without it the robot gains energy from nothing"},
    {"C", "multiplied by nothing", "the vector of velocities was lost"},
    {"gravity", "g is announced and does not appear", "m3 g on joint 3"},
    {"q3, tau3", "\"angles of joints 1, 2 and 3\"", "q3 is a length, tau3 a force"},
    {"inputs of the MLP", "measured at t in III.C, at t + dt in V.A",
     "at t: at t + dt the network would only have to copy"},
    {"2500 patterns", "more than 90 trajectories of 25 samples", "100 trajectories"},
    {"5000 test patterns of the classifier", "250 trajectories of 10 samples", "500 trajectories"},
    {"figures 7 and 8", "the same caption twice",
     "figure 7 shows the position, as figure 4 does for the MLP"},
    {"section III.D", "the sentence on locked joints breaks off into the start of section IV",
     "not used: the paper's runs have free-swinging joints only"},
    {"conclusion", "the RBFN outperforms the MLP",
     "the paper's own table 2 says the opposite in all three rows"},
    {"\"variance = 0.01\"", "no unit", "both readings above"},
};

/// The printed equations and counts that cannot be right, and what was used in their place.
std::string paper_errata() {
  std::string text = kErrataIntroduction;
  for (const Erratum& erratum : kErrata)
    text += fmt::format("| {} | {} | {} |\n", erratum.where, erratum.printed, erratum.used);
  return text;
}

}  // namespace

std::string reproduction_markdown(const Reproduction& reproduction) {
  std::string text = "# The paper, reproduced\n\n" + how_made(reproduction.options) + paper_introduction();
  text += "## Targets and results\n\n" + goals_text(reproduction.goals);
  text += "## Tables\n\n";
  for (const ResultTable& table : reproduction.tables)
    if (!is_trade_off(table)) text += table_text(table);
  text += "## Figures\n\n";
  for (const Figure& figure : reproduction.figures)
    text += fmt::format("![{}]({}.svg)\n\n{}\n\n", figure.plot.title, figure.id, figure.caption);
  return text + paper_errata();
}

}  // namespace faultline
