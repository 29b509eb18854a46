// One instant of the bench as text.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::tools {

// The value of a "live.update" notification; NaN: not known.
struct LiveUpdate {
  struct Probe {
    std::string id, quality;
    double um = 0, range_um = 0;
  };
  std::string axis;
  double encoder_mm = 0;
  bool still = false, simulated = false, stale = false;
  std::vector<Probe> probes;
  std::vector<std::pair<std::string, double>> errors;  // "EYX_um"; empty: not solved
  std::optional<std::int64_t> run;                     // under way
  std::vector<std::string> trouble;                    // of its devices, as it stands
  std::string json;                                    // all of it
};

// nullopt: the line is something else.
std::optional<LiveUpdate> read_update(std::string_view notification);

// A "run.event" of the type "trouble" (a device is lost, back, suspect or slow) or "left_out" (a
// stop is near no target).
struct TroubleEvent {
  std::string axis, line;  // for people
  std::string json;        // all of it
};
std::optional<TroubleEvent> read_trouble(std::string_view notification);

// "|.....#....+.........|": the reading within -range/2 ... range/2, '+' the middle; '<' or '>'
// beyond an end; blank where it is not known.
std::string range_bar(double um, double range_um, std::size_t width = 41);

// On a terminal a block of lines for each axis, drawn again in place; else a few words per update,
// which go on in the next line. No line is longer than `columns`.
class LiveScreen {
 public:
  LiveScreen(bool terminal, std::size_t columns) : terminal_(terminal), columns_(columns) {}
  std::string next(const LiveUpdate& update);

 private:
  bool terminal_;
  std::size_t columns_;
  std::map<std::string, std::string> blocks_;  // by axis
  std::size_t lines_ = 0;                      // drawn last
};

}  // namespace mdof::tools
