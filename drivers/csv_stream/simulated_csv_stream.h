// A simulated script that sends its readings as CSV rows.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "drivers/simulated_device.h"
#include "drivers/simulated_wiring.h"

namespace mdof::drivers {

// Sends the header to each client, then one row every 1/rate_hz s. `senses` returns the value of
// each column.
class SimulatedCsvStream final : public SimulatedDevice {
 public:
  // The rows of each client are numbered from 0; -1: never.
  struct Faults {
    bool no_header = false;
    int bad_line_every = 0;  // each n-th row ends in a word; 0: no row
    int cut_row = -1;        // half of this row is sent, then the connection is closed
    int silent_from = -1;    // no rows from this row on
    int restart_at = -1;     // before this row the header is sent again, and time_s starts at 0
    double time_scale = 1;   // factor; 1000: time_s contains milliseconds
  };
  struct Options {
    // Names as in the header, without time_s: "encoder_mm", "A_um".
    std::vector<std::string> columns;
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

// Makes the twin from a plan of mdof-simulate. It sends rows "time_s,encoder_mm,A_um,..." at
// rate_hz.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_csv_stream(SimulatedWiring& wiring);

}  // namespace mdof::drivers
