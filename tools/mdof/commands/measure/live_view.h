// Shows the updates of a running measurement as text.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mdof::tools {

// The value of a "live.update" notification. An unknown number is NaN.
struct LiveUpdate {
  struct Probe {
    std::string id, quality;
    double um = 0;
    double low_um = 0,
           high_um = 0;  // The ends of the range: -range/2 and range/2, or those of the rig.
  };
  std::string axis;
  std::string encoder_quality;
  std::string waiting_for;  // The channel for which mdofd waits; empty: none.
  double encoder_mm = 0, age_s = 0;
  bool still = false, simulated = false, stale = false;
  std::vector<Probe> probes;
  std::vector<std::pair<std::string, double>>
      errors;                        // Keys ("EYX_um") and values; empty: not solved.
  std::optional<std::int64_t> run;   // The run in progress.
  std::vector<std::string> trouble;  // The faults that devices have now.
  std::string json;                  // The complete value.
};

// The ends of the ranges of the probes of all axes, from the replies of rig.get. They differ from
// -range/2 and range/2 if a probe reads a gap or has an offset.
class ProbeRanges {
 public:
  void add(const std::string& axis, const std::string& rig);
  void apply(LiveUpdate& update) const;

 private:
  std::map<std::pair<std::string, std::string>, std::pair<double, double>>
      ends_um_;  // [axis, probe]
};

// nullopt: the notification is not a "live.update".
std::optional<LiveUpdate> read_update(std::string_view notification);

// A "run.event" that the user must see. Type "trouble": a device is lost, works again, is suspect
// or is slow. Type "left_out": a stop was ignored because it is near no target.
struct TroubleEvent {
  std::string axis, line;  // `line`: text for the user.
  std::string json;        // The complete event.
};
std::optional<TroubleEvent> read_trouble(std::string_view notification);

// Draws a reading in the range of the probe, low to high: "|.....#....+.........|". '#' is
// the reading, '+' the middle of the range. '<' or '>' at an end shows a reading outside the range.
// If the reading is unknown, the bar is blank.
std::string range_bar(double um, double low_um, double high_um, std::size_t width = 41);

// On a terminal, shows a block of lines for each axis and overwrites the block at each update.
// Otherwise, appends a text for each update. No line has more than `columns` characters.
class LiveScreen {
 public:
  LiveScreen(bool terminal, std::size_t columns) : terminal_(terminal), columns_(columns) {}
  std::string next(const LiveUpdate& update);

 private:
  bool terminal_;
  std::size_t columns_;
  std::map<std::string, std::string> blocks_;  // [axis] text of its block.
  std::size_t lines_ = 0;                      // Number of lines drawn last.
};

}  // namespace mdof::tools
