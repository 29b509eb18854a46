// What goes wrong with a device, by its cause: shown at once where somebody looks, and kept with
// the run.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

struct Trouble {
  enum class Kind {
    lost,      // the device does not answer or has gone
    back,      // and is well again
    suspect,   // its values are not to be trusted: an encoder has lost its datum
    slow,      // it gives fewer scans than it should
    clock,     // the time of its samples is uncertain
    unsolved,  // a stop has no errors, for want of readings
  } kind = Kind::lost;
  std::string device;  // "": no single one
  std::string text;    // what happened and what to do, without the device's name
  std::string utc;
  std::string channel = {};  // of the device, where it is of that alone: an encoder; "": of all
};

const char* to_string(Trouble::Kind kind);
// "device \"t7\": lost: no packet for 2 s"
std::string trouble_line(const Trouble& trouble);
// For run.event: {"type": "trouble", "axis", "run": id | null, "device", "kind", "text", "utc"}.
std::string trouble_json(Axis axis, std::int64_t run, const Trouble& trouble);

// Which probes of a point gave nothing usable, and whose they are. `channels` of each device by its
// name; a point that is solved gives nothing.
using ChannelsByDevice = std::map<std::string, std::vector<std::string>>;
std::optional<Trouble> unsolved(const MeasuredPoint& point, const Rig& rig,
                                const ChannelsByDevice& channels, const std::string& utc);

// The troubles of a run, to be reported at its end: a line for each device and kind, however many
// there were.
class TroubleLog {
 public:
  void add(const Trouble& trouble);
  Notices summary() const;

 private:
  struct Story {
    Trouble first, last;
    std::size_t times = 0;
  };
  std::vector<std::string> order_;  // devices, as they came
  std::map<std::string, std::map<Trouble::Kind, Story>> devices_;
};

// What of a stream of lines is worth the journal: of lines with one key one in a while, and then
// how many were left out. Pure.
class JournalLimit {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // The line as it is to be written; nothing: it is left out.
  std::optional<std::string> admit(const std::string& key, const std::string& line, Time now);

 private:
  struct Row {
    Time next;
    std::size_t left_out = 0;
  };
  std::map<std::string, Row> rows_;
};

}  // namespace mdof::daemon
