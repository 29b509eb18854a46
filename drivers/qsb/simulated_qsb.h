// A simulated QSB on a serial line.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "drivers/qsb/protocol.h"
#include "drivers/simulated_device.h"
#include "drivers/simulated_wiring.h"
#include "schema/sample.h"

namespace mdof::drivers {

// `senses`: input 0, in counts. Only one client may be connected at a time.
class SimulatedQsb final : public SimulatedDevice {
 public:
  // Possible faults. The lines of a stream are numbered from 0 at each S command; -1: never.
  struct Faults {
    double tick_ns = qsb::kTick_ns;
    int reset_at = -1;              // a banner is sent instead of this line, and the count restarts
    int cut_at = -1;                // only half of this line is sent, without a line end
    int jump_at = -1;               // from this line on the stamp is higher by jump_ticks
    std::uint32_t jump_ticks = 10;  // the difference of the stamp
    int silent_from = -1;
    bool rubbish = false;  // no line of the stream contains a valid digit
    int refuse = -1;       // register whose reply is e
    int unsupported = -1;  // register whose reply is x
    bool mute = false;     // the device never replies
    bool streams_at_start = false;
    // Number of the first line with a count that no motion explains, and number of such lines.
    int first_far_line = -1, far_line_count = 1;
  };
  // The reference mark. `at`: its position in counts of `senses`. `inverted`: the index signal is
  // low at the mark and high elsewhere. `next_at`: position of the next mark of a rotary encoder,
  // one turn further.
  struct Mark {
    double at = 0;
    bool inverted = false;
    double next_at = kNaN;
  };
  struct Options {
    Faults faults = {};
  };
  SimulatedQsb(Senses senses, const Options& options);
  void set_mark(Mark mark) { mark_ = mark; }  // call it before the device is used

  std::vector<Port> ports() const override { return {{"serial", 0}}; }
  void opened(std::size_t port, int client, std::int64_t now_ns) override;
  std::string exchange(std::size_t port, int client, std::string_view received,
                       std::int64_t now_ns) override;

 private:
  std::string execute(std::string_view command, std::int64_t now_ns);
  QsbReply answer(char type, std::uint8_t reg, std::uint32_t data, std::int64_t now_ns);
  void write(std::uint8_t reg, std::uint32_t data, std::int64_t now_ns);
  std::uint32_t read(std::uint8_t reg, std::int64_t now_ns);
  void watch_mark(double position);
  std::string stream(std::int64_t now_ns);
  std::string stream_line(std::int64_t tick);
  std::int64_t tick_at(std::int64_t now_ns) const;
  std::uint32_t count_at(std::int64_t t_ns);
  void reset(std::int64_t now_ns);

  Senses senses_;
  Faults faults_;
  std::array<std::uint32_t, 256> registers_{};
  std::string received_;
  std::int64_t stamp_from_ns_ = 0;
  double count_from_ = 0;
  std::optional<Mark> mark_;
  double last_position_ = 0;  // position in counts when it was last read
  bool streaming_ = false;
  std::int64_t next_tick_ = 0;
  int line_ = 0;
};

// Makes the twin from a plan of mdof-simulate. It counts the given channel; default: the encoder.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_qsb(SimulatedWiring& wiring);

}  // namespace mdof::drivers
