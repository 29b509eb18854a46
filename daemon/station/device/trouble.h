// Troubles: faults of devices. mdofd reports them to clients at once, and stores them as notices of
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
    lost,      // the device does not respond or was removed
    back,      // the device works again
    suspect,   // the values of the device may be wrong, because an encoder has lost its datum
    slow,      // the device sends fewer scans than its nominal rate, or scans were lost
    position,  // the encoder sends no positions
    missing,   // a script has no column for a channel of the rig
    clock,     // the time of the samples is uncertain
    unsolved,  // a stop has no errors because readings are missing
  } kind = Kind::lost;
  std::string device;  // "": the trouble concerns no single device
  std::string text;    // the event and the remedy, without the name of the device
  std::string utc;
  std::string channel = {};  // the encoder that has the trouble; "": the whole device
};

const char* to_string(Trouble::Kind kind);
// "device \"t7\": lost: no packet for 2 s"
std::string trouble_line(const Trouble& trouble);
// Message for the topic run.event: {"type": "trouble", "axis", "run": id | null, "device", "kind",
// "text", "utc"}.
std::string trouble_json(Axis axis, std::int64_t run, const Trouble& trouble);

// The trouble that a point has no errors. The trouble states the probes without usable readings and
// their device. `channels`: channel ids by the name of the device. Returns nullopt for a solved
// point.
using ChannelsByDevice = std::map<std::string, std::vector<std::string>>;
std::optional<Trouble> unsolved(const MeasuredPoint& point, const Rig& rig,
                                const ChannelsByDevice& channels, const std::string& utc);

// Collects the troubles of a run. At the end of the run, summary() returns one notice for each
// device and kind of trouble.
class TroubleLog {
 public:
  void add(const Trouble& trouble);
  Notices summary() const;

 private:
  struct RepeatedTrouble {
    Trouble first, last;
    std::size_t times = 0;
  };
  std::vector<std::string> order_;  // names of the devices, in the order of their first troubles
  std::map<std::string, std::map<Trouble::Kind, RepeatedTrouble>> devices_;
};

// Limits the number of lines in the journal. In each interval of 10 s this class admits one line
// for each key. The next admitted line states the number of omitted lines. The class reads no
// clocks and writes nothing.
class JournalLimit {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Returns the line to write, or nullopt if the line must be omitted.
  std::optional<std::string> admit(const std::string& key, const std::string& line, Time now);

 private:
  struct Row {
    Time next;
    std::size_t left_out = 0;
  };
  std::map<std::string, Row> rows_;
};

}  // namespace mdof::daemon
