// SPDX-License-Identifier: MIT
#include "lib/log/recorder/corrected_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "lib/log/log.hpp"
#include "lib/log/recorder/measured_rows.hpp"
#include "lib/log/recorder/stopped_columns.hpp"
#include "lib/log/transformed/changed_source.hpp"

namespace faultline {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
constexpr double kBorderRounding = 1e-3;  // rad, by which a printed border may be rounded
constexpr double kNearPrediction = 0.25;  // of a turn, from the angle that the velocity predicts
constexpr double kSmallStep = 0.1;        // of a turn: a longer step does not predict the next one

/// Whether both angles lie in one turn that begins at `border`.
bool within(double a, double b, double border) {
  return std::min(a, b) >= border - kBorderRounding &&
         std::max(a, b) <= border + kWholeTurn + kBorderRounding;
}

constexpr int kFewestJumps = 2;           // joints: the sensor of a single one may be faulty
constexpr std::int64_t kBreakRows = 6;    // left out behind a break: every stage restarts after such a gap
constexpr std::int64_t kSurelyAgain = 3;  // successive rows with all digits of earlier ones
constexpr double kLongStep = 5.5;         // usual steps: longer is a gap
constexpr double kStepForgetting = 0.05;  // weight of a new step in the usual one

/// Unwraps the angle of one joint that a recorder keeps within one turn (-pi to pi or 0 to 2 pi).
class WrappedAngle {
 public:
  /// Returns the unwrapped angle, rad. If `dq` is missing (NaN), the last step predicts this one, provided
  /// that it was a small part of a turn. After a step longer than `longest_s` the path is unknown, and the
  /// number of turns stays.
  double unwrapped(double t, double q, double dq, double longest_s) {
    has_wrapped_ = false;
    if (std::isnan(q)) return q;
    const double moved = q - q_;
    if (begun_ && std::abs(moved) > std::numbers::pi && t - t_ < longest_s &&
        (within(q, q_, -std::numbers::pi) || within(q, q_, 0.0))) {
      const double way = 0.5 * (dq + dq_) * (t - t_);
      const bool has_way = std::isfinite(way);
      const double expected = has_way ? way : step_, near = has_way ? kNearPrediction : kSmallStep;
      const double turns = std::round((expected - moved) / kWholeTurn);
      has_wrapped_ = turns != 0.0 && (has_way || std::abs(step_) < kSmallStep * kWholeTurn) &&
                     std::abs(moved + turns * kWholeTurn - expected) < near * kWholeTurn;
      if (has_wrapped_) turns_ += turns;
    }
    if (begun_) step_ = has_wrapped_ ? std::remainder(moved, kWholeTurn) : moved;
    begun_ = true;
    t_ = t, q_ = q, dq_ = dq;
    return q + turns_ * kWholeTurn;
  }
  /// Whether the last angle crossed a border of the turn.
  bool has_wrapped() const { return has_wrapped_; }

 private:
  bool begun_ = false, has_wrapped_ = false;
  double t_ = 0.0, q_ = 0.0, dq_ = 0.0;  ///< of the row before, as recorded
  double turns_ = 0.0;
  double step_ = std::numeric_limits<double>::quiet_NaN();  ///< the last one
};

class Corrections {
 public:
  explicit Corrections(std::vector<bool> slides) : slides_(std::move(slides)) {}

  bool next(LogSource& source, Log& segment) {
    while (source.next(segment)) {
      append(rows_, std::move(segment));
      judge_rows();
      hand_out(segment);
      if (segment.rows() > 0) return true;
    }
    while (settled_ < rows_.rows()) settle(settled_);  // undecided rows at the end of the log
    end_cut();
    hand_out(segment);
    return segment.rows() > 0;
  }

  const Issues& issues() const { return corrections_; }

 private:
  void judge_rows() {
    for (; looked_at_ < rows_.rows(); ++looked_at_) {
      row_.take(rows_, looked_at_);
      const RecorderState state = recorder_.take(row_);
      if (state == RecorderState::undecided) continue;
      if (state == RecorderState::froze)
        while (settled_ <= looked_at_)
          empty_row(
              settled_, "recorder_stopped",
              "all joints repeat every digit of their values although their velocities show motion: the "
              "recorder stood still; the values of such rows are treated as missing");
      while (settled_ < looked_at_) settle(settled_);
      if (settled_ > looked_at_) continue;
      if (state == RecorderState::blank)
        empty_row(settled_, "rows_blank",
                  "position, velocity and torque of all joints become exactly zero from one row to the next: "
                  "the recorder wrote no values; the values of such rows are treated as missing");
      else
        settle(settled_);
    }
  }

  /// Keeps a row in which nothing was measured without its values, so that its time counts as not judged.
  void empty_row(int row, const char* code, const std::string& what) {
    corrections_.add({code, "", Severity::warning, fmt::format("row {}: {}", number_of(row), what),
                      number_of(row), rows_.time[row], 1});
    for_each_joint_channel(rows_, [&](std::vector<double>& values, Channel) { values[row] = std::nan(""); });
    kept_.push_back(row);
    ++settled_;
  }

  /// Takes a measured row: unwraps it, and keeps it unless it is behind a break.
  void settle(int row) {
    row_.take(rows_, row);
    ++settled_;
    if (is_in_cut()) return;
    const std::int64_t earlier = memory_.add(row_, number_of(row) - 1);
    take_usual_step(row_.t);
    unwrap(row);
    row_.take(rows_, row);
    const std::vector<Joint>& jumped = jumps_.take(row_, usual_step_);
    if (static_cast<int>(jumped.size()) < kFewestJumps) {
      kept_.push_back(row);
      return;
    }
    if (const auto pair = jumps_.swapped()) {
      corrections_.add(
          {kChangedColumns, "", Severity::severe,
           fmt::format("row {}: from {:.10g} s on the columns of joints {} and {} are swapped; cut the "
                       "log there, or correct the columns",
                       number_of(row), row_.t, pair->first, pair->second),
           number_of(row), row_.t, 1});
      kept_.push_back(row);
      return;
    }
    begin_cut(row, jumped, earlier);
  }

  void begin_cut(int row, const std::vector<Joint>& jumped, std::int64_t earlier) {
    const bool again = earlier >= 0;
    row_cut_ = {number_of(row),           row_.t,        1,
                again ? earlier + 1 : -1, again ? 1 : 0, fmt::format("{}", fmt::join(jumped, ", "))};
  }

  /// Whether the row is left out behind a break: it repeats an earlier row as the rows before it do, or is
  /// one of the first few.
  bool is_in_cut() {
    if (row_cut_.row == 0) return false;
    const bool copies = row_cut_.again >= 0 && memory_.find(row_) == row_cut_.again;
    if (copies) {
      ++row_cut_.again;
      ++row_cut_.copies;
    } else {
      row_cut_.again = -1;
      if (row_cut_.rows >= kBreakRows) {
        end_cut();
        return false;
      }
    }
    ++row_cut_.rows;
    return true;
  }

  void end_cut() {
    if (row_cut_.row == 0) return;
    const std::string place = fmt::format(
        "row {}: at {:.10g} s joints {} jump together, further than their velocities allow: ", row_cut_.row,
        row_cut_.t, row_cut_.joints);
    const std::int64_t rows = row_cut_.rows;
    if (row_cut_.copies >= kSurelyAgain)
      corrections_.add(
          {"block_repeated", "", Severity::severe,
           place + fmt::format("{} rows repeat earlier ones in all digits, under later times; they were "
                               "left out",
                               row_cut_.copies),
           row_cut_.row, row_cut_.t, 1, rows});
    else
      corrections_.add(
          {"rows_cut_out", "", Severity::warning,
           place + fmt::format("rows are missing before it although no time is missing; {} rows were "
                               "left out, so that nothing is concluded across the break",
                               rows),
           row_cut_.row, row_cut_.t, 1, rows});
    row_cut_ = {};
  }

  void unwrap(int row) {
    const double longest =
        usual_step_ > 0.0 ? kLongStep * usual_step_ : std::numeric_limits<double>::infinity();
    const auto go_on = [&](JointSignals& positions, const JointSignals& velocities, Quantity quantity,
                           std::vector<WrappedAngle>& angles) {
      angles.resize(positions.size());
      for (std::size_t j = 0; j < positions.size(); ++j) {
        if (j < slides_.size() && slides_[j]) continue;
        const double before = positions[j][row], dq = velocities.empty() ? std::nan("") : velocities[j][row];
        positions[j][row] = angles[j].unwrapped(rows_.time[row], before, dq, longest);
        if (!angles[j].has_wrapped()) continue;
        corrections_.add(
            {"angle_unwrapped", to_string({quantity, Joint::at(static_cast<int>(j))}), Severity::note,
             fmt::format("row {}: jumps by a turn to {:.4g} rad while the joint continues to move; the "
                         "angle was logged within one turn and is continued beyond it",
                         number_of(row), before),
             number_of(row), rows_.time[row], 1});
      }
    };
    go_on(rows_.q, rows_.dq, Quantity::q, angles_);
    go_on(rows_.q_ref, rows_.dq_ref, Quantity::q_ref, references_);
  }

  void take_usual_step(double t) {
    const double step = t - last_t_;  // NaN at the first row
    last_t_ = t;
    if (usual_step_ == 0.0 && step > 0.0)
      usual_step_ = step;
    else if (step < kLongStep * usual_step_)
      usual_step_ += kStepForgetting * (step - usual_step_);
  }

  /// Hands out the settled rows that are kept; rows not settled stay.
  void hand_out(Log& segment) {
    const int done = settled_;
    segment = take_front(rows_, done);
    if (static_cast<int>(kept_.size()) < done) keep_log_rows(segment, kept_);
    segment.first_row = handed_out_;
    handed_out_ += segment.rows();
    looked_at_ -= done;
    settled_ = 0;
    kept_.clear();
  }

  std::int64_t number_of(int row) const { return rows_.first_row + row + 1; }

  std::vector<bool> slides_;

  Log rows_;               ///< rows not handed out yet; first_row as in the source
  int looked_at_ = 0;      ///< number of these for which the recorder's state is known
  int settled_ = 0;        ///< number of these that are kept or left out for good
  std::vector<int> kept_;  ///< settled rows that are kept
  std::int64_t handed_out_ = 0;

  StoppedRecorder recorder_;
  PositionJumps jumps_;
  RowMemory memory_;
  std::vector<WrappedAngle> angles_, references_;
  MeasuredRow row_;
  double last_t_ = std::numeric_limits<double>::quiet_NaN();  ///< time of the row before
  double usual_step_ = 0.0;

  /// Rows that are left out after a jump, because rows before them are missing or repeated.
  struct RowCut {
    std::int64_t row = 0;  ///< first one, from 1; 0 for no break
    double t = 0.0;
    std::int64_t rows = 0;
    std::int64_t again = -1;  ///< row, from 0, that the next one repeats if this is a repeated block
    std::int64_t copies = 0;
    std::string joints;
  };
  RowCut row_cut_;
  Issues corrections_;
};

using CorrectedSource = StagedSource<Corrections>;

}  // namespace

std::unique_ptr<LogSource> corrected(LogSource& source, std::vector<bool> slides) {
  return std::make_unique<CorrectedSource>(source, Corrections(std::move(slides)));
}

std::unique_ptr<LogSource> mended(std::unique_ptr<LogSource> source, std::vector<bool> slides) {
  return without_stopped_columns(
      std::make_unique<CorrectedSource>(std::move(source), Corrections(std::move(slides))));
}

}  // namespace faultline
