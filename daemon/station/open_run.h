// A run in progress. Only the measure thread uses it. Only station*.cpp include this header.
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
  std::vector<MeasuredPoint> stored;      // points that were sent to the store
  std::optional<Continuation> continues;  // set if the run continues another run
  Unrecorded unrecorded;                  // samples that were not sent to the store yet
  // Time at which samples were sent to the store last.
  std::chrono::steady_clock::time_point recorded;
  // Number of blocks for which the queue of the store had no space.
  std::uint64_t blocks_not_recorded = 0;
  // Time of the beginning of the last stop that was reported as left out.
  std::optional<std::int64_t> left_out_ns = {};
  TroubleLog troubles = {};  // troubles of the devices after the run began
  EncoderDatum datum = {};   // datum of the positions
  Model model = Model::rigid;
};

// The initial state of a run that continues another run.
struct Station::Beginning {
  Pipeline pipeline;
  std::int64_t end_ns;  // time of the last scan of the other run
};

}  // namespace mdof::daemon
