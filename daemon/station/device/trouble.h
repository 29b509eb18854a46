// Faults of devices by kind. They are shown at once and stored with the run.
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
    lost,      // the device does not respond or was removed
    back,      // it works again
    suspect,   // its values cannot be trusted: an encoder has lost its datum
    slow,      // it gives fewer scans than it should
    clock,     // the time of its samples is uncertain
    unsolved,  // a stop has no errors because readings are missing
  } kind = Kind::lost;
  std::string device;  // "": no single device
  std::string text;    // what happened and what to do, without the device's name
  std::string utc;
  std::string channel = {};  // encoder concerned; "": the whole device
};

const char* to_string(Trouble::Kind kind);
// "device \"t7\": lost: no packet for 2 s"
std::string trouble_line(const Trouble& trouble);
// For run.event: {"type": "trouble", "axis", "run": id | null, "device", "kind", "text", "utc"}.
std::string trouble_json(Axis axis, std::int64_t run, const Trouble& trouble);

// The probes of a point without usable readings, and their device. `channels`: the channels of each
// device by its name. nullopt for a solved point.
using ChannelsByDevice = std::map<std::string, std::vector<std::string>>;
std::optional<Trouble> unsolved(const MeasuredPoint& point, const Rig& rig,
                                const ChannelsByDevice& channels, const std::string& utc);

// The troubles of a run, reported at its end: one line for each device and kind.
class TroubleLog {
 public:
  void add(const Trouble& trouble);
  Notices summary() const;

 private:
  struct RepeatedTrouble {
    Trouble first, last;
    std::size_t times = 0;
  };
  std::vector<std::string> order_;  // devices in order of their first trouble
  std::map<std::string, std::map<Trouble::Kind, RepeatedTrouble>> devices_;
};

// Limits a stream of lines for the journal: of lines with the same key it admits one per interval,
// with the number of omitted lines. Pure.
class JournalLimit {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // The line to be written; nullopt: omit it.
  std::optional<std::string> admit(const std::string& key, const std::string& line, Time now);

 private:
  struct Row {
    Time next;
    std::size_t left_out = 0;
  };
  std::map<std::string, Row> rows_;
};

}  // namespace mdof::daemon
