// How a run is found in samples: all that a replay can be asked for beside its rig.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "algo/on_the_fly/target_grid.h"
#include "algo/points/align.h"
#include "algo/points/dwell.h"
#include "algo/sequence/sequence.h"
#include "schema/encoder_datum.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

// A run holds no more stops, whose points take some 4 KB of memory each.
inline constexpr std::size_t kMostStops = 50'000;

struct PipelineOptions {
  Model model = Model::rigid;
  algo::AlignOptions align;
  algo::DwellOptions dwell;
  algo::SequenceOptions sequence;
  double stale_s = 0.5;       // an instant older than this is not shown as good
  bool keep_points = true;    // false: for a view without a run
  int repeats = 0;            // a run was asked for so many, both ways; 0: until stopped
  bool remove_drift = false;  // of the errors, where it is significant (algo/drift)
  std::optional<algo::OnTheFlyOptions> on_the_fly;  // replays only: dwells are not looked for
  EncoderDatum datum;                   // of the positions that are pushed: they have it in them
  std::size_t most_stops = kMostStops;  // later ones are counted and left out

  std::string json() const;  // for the provenance
  // Of that what the configuration gives: not the devices' rates, the targets and the datum.
  std::string settings_json() const;
};

}  // namespace mdof::daemon
