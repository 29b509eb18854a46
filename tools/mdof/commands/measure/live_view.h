// One update of the measurement as text.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::tools {

// The value of a "live.update" notification; NaN: unknown.
struct LiveUpdate {
  struct Probe {
    std::string id, quality;
    double um = 0, range_um = 0;
  };
  std::string axis;
  double encoder_mm = 0;
  bool still = false, simulated = false, stale = false;
  std::vector<Probe> probes;
  std::vector<std::pair<std::string, double>> errors;  // "EYX_um"; empty: not solved.
  std::optional<std::int64_t> run;                     // The run in progress.
  std::vector<std::string> trouble;                    // Present faults of the devices.
  std::string json;                                    // The complete value.
};

// nullopt: the line is another message.
std::optional<LiveUpdate> read_update(std::string_view notification);

// A "run.event" of type "trouble" (a device is lost, back, suspect or slow) or "left_out" (a stop
// is near no target).
struct TroubleEvent {
  std::string axis, line;  // `line`: text for people.
  std::string json;        // The complete event.
};
std::optional<TroubleEvent> read_trouble(std::string_view notification);

// "|.....#....+.........|": the reading within -range/2 ... range/2; '+' marks the middle, '<' or
// '>' a reading beyond an end. Blank if the reading is unknown.
std::string range_bar(double um, double range_um, std::size_t width = 41);

// On a terminal, redraws a block of lines for each axis in place. Otherwise prints one text for
// each update, wrapped into several lines. No line is longer than `columns`.
class LiveScreen {
 public:
  LiveScreen(bool terminal, std::size_t columns) : terminal_(terminal), columns_(columns) {}
  std::string next(const LiveUpdate& update);

 private:
  bool terminal_;
  std::size_t columns_;
  std::map<std::string, std::string> blocks_;  // By axis.
  std::size_t lines_ = 0;                      // Number of lines drawn last.
};

}  // namespace mdof::tools
