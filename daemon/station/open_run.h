// A run in progress. The measure thread owns it. Private to station*.cpp.
#pragma once

#include <optional>
#include <vector>

#include "daemon/station/device/trouble.h"
#include "daemon/station/resume.h"
#include "daemon/station/station.h"
#include "daemon/station/unrecorded.h"

namespace mdof::daemon {

struct Station::OpenRun {
  std::int64_t id;
  RunRequest request;
  Pipeline pipeline;
  std::vector<MeasuredPoint> stored;               // as sent to the store
  std::optional<Continuation> continues;           // the recording of another run
  Unrecorded unrecorded;                           // not yet sent to the store
  std::chrono::steady_clock::time_point recorded;  // last time of sending
  std::uint64_t blocks_not_recorded = 0;  // number of blocks for which the store's queue had no
                                          // space
  std::optional<std::int64_t> left_out_ns = {};  // begin of the last reported stop that was left
                                                 // out
  TroubleLog troubles = {};                      // troubles of the devices since the run began
  EncoderDatum datum = {};                       // datum of its positions
  Model model = Model::rigid;
};

// The initial state of a run that continues another one.
struct Station::Beginning {
  Pipeline pipeline;
  std::int64_t end_ns;  // time of the last scan
};

}  // namespace mdof::daemon
