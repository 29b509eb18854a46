// Shows the updates of a running measurement as text.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::tools {

// The value of a "live.update" notification. An unknown number is NaN.
struct LiveUpdate {
  struct Probe {
    std::string id, quality;
    double um = 0, range_um = 0;
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

// nullopt: the notification is not a "live.update".
std::optional<LiveUpdate> read_update(std::string_view notification);

// A "run.event" that the user must see. Type "trouble": a device is lost, works again, is suspect
// or is slow. Type "left_out": a stop was ignored because it is near no target.
struct TroubleEvent {
  std::string axis, line;  // `line`: text for the user.
  std::string json;        // The complete event.
};
std::optional<TroubleEvent> read_trouble(std::string_view notification);

// Draws a reading in the range of the probe, -range/2 to range/2: "|.....#....+.........|". '#' is
// the reading, '+' the middle of the range. '<' or '>' at an end shows a reading outside the range.
// If the reading is unknown, the bar is blank.
std::string range_bar(double um, double range_um, std::size_t width = 41);

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
