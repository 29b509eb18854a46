// PoLabs PoKeys57U and 56U: incremental encoders (and analogue inputs) by request and reply over
// HID; each poll gives one scan.
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
  std::string name;       // "encoder1" ... "encoder25", "ultrafast", "analogue1" ... "analogue7"
  std::size_t index = 0;  // of a counter; an analogue input has kCounters + its index
  double um_per_count = 0;
  std::optional<std::uint8_t> options;  // EncoderOption bits to set; nullopt: unchanged
  double most_counts_per_s = 0;         // a faster step cannot be a motion
  bool counts() const { return index < kCounters; }
};

struct Settings {
  std::string name;
  std::uint32_t serial = 0;  // 0: the only connected device
  double poll_ms = 2;
  std::chrono::milliseconds response_timeout{50};
  std::chrono::milliseconds slow{20};       // a scan that takes longer is suspect
  std::chrono::milliseconds silence{2000};  // longest time without a valid scan
  std::vector<Input> inputs;
};

// Thread-bound. A request without a complete reply is sent again twice, each time with another
// number; if all fail, the scan is counted as lost. Errors: no valid reply for 2 s; the device was
// unplugged. The time of a scan is the middle between request and reply; a slow scan is suspect,
// because its time is uncertain.
class PoKeys57u final : public Driver {
 public:
  static constexpr int kSends = 3;

  explicit PoKeys57u(Settings settings);

  DeviceInfo info() const override;
  Status open() override;
  // If no reply arrives, read() takes up to three response time-outs a request longer than
  // `timeout`.
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;
  void trust_count() override;

  // Number of reports that were not the expected reply: late, damaged, or for another program.
  std::uint64_t rejected() const { return rejected_; }

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Counter {
    Unwrap unwrap{32, true};
    std::optional<std::int64_t> last;
    Time at;           // of `last`
    bool sure = true;  // false: its zero may be lost
  };
  struct Span {  // from the request to the reply
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
  // The next three return nullopt if no valid reply has arrived.
  Result<std::optional<Span>> watch_for_restart();
  Result<std::optional<Span>> fetch();
  Result<std::optional<Reply>> exchange(Frame asked);
  Result<std::optional<Frame>> reply_to(std::uint8_t id, Time until);
  Result<Frame> need(const Frame& asked, const char* what);
  tl::unexpected<Error> no_answer_error(const char* what) const;
  Status poll(SampleBlock& block);
  void append(SampleBlock& block, const Span& span);
  double value_of(std::size_t i, Time time, Quality& quality);

  Settings settings_;
  std::vector<Channel> channels_;
  std::chrono::nanoseconds period_;
  std::optional<HidDevice> device_;
  Identity identity_;
  RequestIds ids_;
  std::vector<Counter> counters_;  // one for each input
  std::optional<Tick> tick_;
  std::array<Counts, 2> counts_{};  // of the last poll
  Codes analogue_{};
  Time next_, last_, tick_due_;  // next poll; last scan; next check of the tick
  std::string zero_problem_;     // why a zero may be lost
  bool failing_ = false;
  std::uint64_t rejected_ = 0;
};

}  // namespace mdof::drivers::pokeys57u
