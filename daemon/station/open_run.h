// A run under way, as the measure thread holds it. Private to station*.cpp.
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
  std::vector<MeasuredPoint> stored;               // as handed to the store
  std::optional<Continuation> continues;           // another run's recording
  Unrecorded unrecorded;                           // not yet handed to the store
  std::chrono::steady_clock::time_point recorded;  // when the last were
  std::uint64_t blocks_not_recorded = 0;           // the store's queue was full
  std::optional<std::int64_t> left_out_ns = {};    // begin of the last stop reported as left out
  TroubleLog troubles = {};                        // of the devices, since it began
  EncoderDatum datum = {};                         // of its positions
  Model model = Model::rigid;
};

// What a run that goes on from another begins with.
struct Station::Beginning {
  Pipeline pipeline;
  std::int64_t end_ns;  // of its last scan
};

}  // namespace mdof::daemon
