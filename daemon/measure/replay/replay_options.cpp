#include "daemon/measure/replay/replay_options.h"

#include <algorithm>
#include <cmath>

namespace mdof::daemon {
namespace {

using Of = ReplayOption::Of;
using Range = ReplayOption::Range;
using Request = ReplayRequest;

bool is_given(const ReplayOption& option, const ReplayRequest& request) {
  const auto* number = std::get_if<ReplayOption::Number>(&option.member);
  return number && (request.*(*number)).has_value();
}

Status check_range(const ReplayOption& option, double value) {
  const bool in_range = option.range == Range::any || value > 0 ||
                        (option.range == Range::not_negative && value == 0);
  if (in_range && std::isfinite(value)) return {};
  constexpr const char* kRanges[] = {"a finite number", "0 or more", "more than 0"};
  return fail(ErrorCode::usage, std::string(option.name) + " must be " +
                                    kRanges[static_cast<std::size_t>(option.range)]);
}

}  // namespace

std::string ReplayOption::command_line_name() const {
  std::string text = std::string("--") + name;
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

const std::vector<ReplayOption>& replay_options() {
  static const std::vector<ReplayOption> options{
      {"tolerance_um", &Request::tolerance_um, Range::not_negative, Of::dwells,
       "Largest change of the encoder position that still counts as rest [0: automatic]"},
      {"settle_s", &Request::settle_s, Range::not_negative, Of::dwells,
       "Time left out at the start of each stop [0.1]"},
      {"min_length_s", &Request::min_length_s, Range::positive, Of::dwells,
       "Shortest averaging time of a stop [0.1]"},
      {"max_gap_s", &Request::max_gap_s, Range::positive, Of::each_run,
       "Longest gap between two samples that mdof bridges by interpolation [0.05]"},
      {"lag_bound_s", &Request::lag_bound_s, Range::positive, Of::each_run,
       "Time without samples after which the readings of a probe count as missing [3]"},
      {"remove_drift", &Request::remove_drift, Range::any, Of::each_run,
       "Subtract a significant drift from the errors and add the uncertainty of this drift to u"},
      {"on_the_fly", &Request::on_the_fly, Range::any, Of::each_run,
       "For an axis that never stops: calculate each point from the readings around a target"},
      {"interval_mm", &Request::interval_mm, Range::positive, Of::motion,
       "On the fly: distance between targets [1]"},
      {"bin_mm", &Request::bin_mm, Range::not_negative, Of::motion,
       "On the fly: mdof calculates a point from the readings in a range of this width around its "
       "target [0: the interval, but at most 1]"},
      {"from_mm", &Request::from_mm, Range::any, Of::motion,
       "On the fly: the first target [start of the travel]"},
      {"to_mm", &Request::to_mm, Range::any, Of::motion,
       "On the fly: end of the range of targets [end of the travel]"}};
  return options;
}

Status check_replay_options(const ReplayRequest& request) {
  for (const ReplayOption& option : replay_options()) {
    if (!is_given(option, request)) continue;
    MDOF_CHECK(check_range(option, *(request.*std::get<ReplayOption::Number>(option.member))));
    if (option.of == Of::motion && !request.on_the_fly)
      return fail(ErrorCode::usage,
                  std::string(option.name) +
                      " applies only to a run that is measured on the fly; set on_the_fly too");
    if (option.of == Of::dwells && request.on_the_fly)
      return fail(ErrorCode::usage, std::string(option.name) +
                                        " applies only to stops, and a run that is measured on the "
                                        "fly has no stops; leave this option out");
  }
  return {};
}

}  // namespace mdof::daemon
