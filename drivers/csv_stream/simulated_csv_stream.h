// A simulated script that serves its readings as CSV rows.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "drivers/simulated_device.h"
#include "drivers/simulated_wiring.h"

namespace mdof::drivers {

// Sends the header to each client, then a row each 1/rate_hz s. `senses` gives the value of each
// column.
class SimulatedCsvStream final : public SimulatedDevice {
 public:
  // Row numbers start at 0 for each client; -1: never.
  struct Faults {
    bool no_header = false;
    int bad_line_every = 0;  // each n-th row ends in a word; 0: none
    int cut_row = -1;        // row that is sent half, then the connection breaks
    int silent_from = -1;    // no rows from this row on
    int restart_at = -1;     // before this row the header comes again, and time_s starts at 0
    double time_scale = 1;   // 1000: milliseconds in time_s
  };
  struct Options {
    std::vector<std::string> columns;  // without time_s, as in the header: "encoder_mm", "A_um"
    double rate_hz = 1000;
    bool with_time = true;
    Faults faults = {};
  };
  SimulatedCsvStream(Senses senses, Options options);

  std::vector<Port> ports() const override { return {{"rows", 9000}}; }
  void opened(std::size_t port, int client, std::int64_t now_ns) override;
  void closed(std::size_t port, int client) override;
  std::string exchange(std::size_t port, int client, std::string_view received,
                       std::int64_t now_ns) override;
  bool hangs_up(std::size_t port, int client) override;

 private:
  struct Client {
    std::int64_t opened_ns = 0, time_from_ns = 0;
    int next_row = 0;
    bool greeted = false, broken = false;
  };
  std::string header() const;
  std::string row(Client& client, std::int64_t t_ns) const;

  Senses senses_;
  Options options_;
  std::map<int, Client> clients_;
};

// Makes the twin from a plan of mdof-simulate. Rows "time_s,encoder_mm,A_um,..." at rate_hz.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_csv_stream(SimulatedWiring& wiring);

}  // namespace mdof::drivers
