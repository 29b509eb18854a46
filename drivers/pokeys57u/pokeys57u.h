// Driver of PoLabs PoKeys57U and 56U: incremental encoders and analogue inputs, by requests and
// replies over HID. Each poll is one scan.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/counter/unwrap.h"
#include "drivers/driver.h"
#include "drivers/io/hid.h"
#include "drivers/pokeys57u/protocol.h"

namespace mdof::drivers::pokeys57u {

struct Input {
  Channel channel;
  std::string name;  // one of "encoder1" ... "encoder25", "ultrafast", "analogue1" ... "analogue7"
  std::size_t index = 0;  // index of the counter; for an analogue input, kCounters + its index
  double um_per_count = 0;
  // Bits of EncoderOption that the driver sets; nullopt: the driver changes no option.
  std::optional<std::uint8_t> options;
  double most_counts_per_s = 0;  // a faster change of the count is not a motion of the axis
  bool counts() const { return index < kCounters; }
};

struct Settings {
  std::string name;
  std::uint32_t serial = 0;  // 0: exactly one device must be connected
  double poll_ms = 2;
  std::chrono::milliseconds response_timeout{50};
  std::chrono::milliseconds slow{20};       // a scan that takes longer is suspect
  std::chrono::milliseconds silence{2000};  // longest time without a valid scan
  std::vector<Input> inputs;
};

// Thread-bound. If the reply to a request is missing or incomplete, the driver sends the request
// two more times, each time with another request number. If these attempts fail too, the scan
// counts as lost. The time of a scan is the middle between request and reply. A slow scan is
// suspect, because its time is uncertain. Errors: no valid reply for 2 s; the device was unplugged.
class PoKeys57u final : public Driver {
 public:
  static constexpr int kSends = 3;

  explicit PoKeys57u(Settings settings);

  DeviceInfo info() const override;
  Status open() override;
  // If replies are missing, read() exceeds `timeout` by up to three response time-outs for each
  // request.
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;
  void trust_count() override;

  // Number of reports that were not the expected reply: they were late or damaged, or for another
  // program.
  std::uint64_t rejected() const { return rejected_; }

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Counter {
    Unwrap unwrap{32, true};
    std::optional<std::int64_t> last;
    Time at;           // time of `last`
    bool sure = true;  // false: the zero of the counter may be lost
  };
  struct Span {  // times of the request and of the reply
    Time from, to;
    Time middle() const { return from + (to - from) / 2; }
  };
  struct Reply {
    Frame frame;
    Span span;
  };
  struct Tick {
    std::uint32_t ms;
    Time at;
  };
  std::string place() const;
  Status connect();
  Status try_candidate(const HidEntry& entry, std::vector<std::string>& others);
  Status set_up_encoders();
  Status check_enabled(const Frame& options) const;
  // The next three functions return nullopt if no valid reply has arrived.
  Result<std::optional<Span>> watch_for_restart();
  Result<std::optional<Span>> fetch();
  Result<std::optional<Reply>> exchange(Frame asked);
  Result<std::optional<Frame>> reply_to(std::uint8_t id, Time until);
  Result<Frame> need(const Frame& asked, const char* what);
  tl::unexpected<Error> no_answer_error(const char* what) const;
  Status poll(SampleBlock& block);
  // `span`: the last request of the scan; `duration`: of all its requests.
  void append(SampleBlock& block, const Span& span, std::chrono::nanoseconds duration);
  double value_of(std::size_t i, Time time, Quality& quality);

  Settings settings_;
  std::vector<Channel> channels_;
  std::chrono::nanoseconds period_;
  std::optional<HidDevice> device_;
  Identity identity_;
  RequestIds ids_;
  std::vector<Counter> counters_;  // one for each input
  std::optional<Tick> tick_;
  std::array<Counts, 2> counts_{};  // counts of the last poll
  Codes analogue_{};
  // Time of the next poll, of the last scan, and of the next tick check.
  Time next_, last_, tick_due_;
  std::string zero_problem_;  // reason why the zero of a counter may be lost
  bool failing_ = false;
  std::uint64_t rejected_ = 0;
};

}  // namespace mdof::drivers::pokeys57u
