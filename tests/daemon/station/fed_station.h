// A station with its own store. Its device delivers the samples that a test feeds, with the time
// stamps of the test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "daemon/history.h"
#include "daemon/station/station.h"
#include "tests/daemon/measure/test_axis.h"
#include "tests/shown.h"

namespace mdof::daemon {

// The object through which a test controls a device. The station owns the driver of the device.
// Thread-safe.
class Feed {
 public:
  void give(SampleBlock block) {
    const std::lock_guard lock(mutex_);
    blocks_.push_back(std::move(block));
    ++given_;
    changed_.notify_all();
  }
  // The encoder passes its reference mark after the blocks that were given until now.
  void pass_mark() {
    const std::lock_guard lock(mutex_);
    mark_before_.push_back(given_);
  }
  int marks_passed() {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(std::count_if(mark_before_.begin(), mark_before_.end(),
                                          [this](std::size_t block) { return block < read_; }));
  }
  // Simulates a restart of the device: one read fails, then the encoder counts from 0.
  void lose_datum() {
    const std::lock_guard lock(mutex_);
    lost_ = mark_before_.size() + 1;
    gone_once_ = true;
    changed_.notify_all();
  }
  std::string datum_lost() {
    const std::lock_guard lock(mutex_);
    return lost_ > mark_before_.size() ? "it counts from 0 again; drive it over its mark" : "";
  }
  // From go() to come_back(), open() and read() fail.
  void go() { set_gone(true); }
  void come_back() { set_gone(false); }
  void end() {  // the end of a log file
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  // Waits until the station has read and processed all blocks.
  void wait_until_read() {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds(20),
                                  [this] { return blocks_.empty() && !in_hand_; }));
  }

  Status open() {
    const std::lock_guard lock(mutex_);
    return gone_ ? io_error("10.0.0.9: no route to host") : Status();
  }
  Result<drivers::ReadState> read(SampleBlock& block) {
    std::unique_lock lock(mutex_);
    block = SampleBlock();
    if (std::exchange(in_hand_, false)) changed_.notify_all();
    if (std::exchange(gone_once_, false)) return io_error("10.0.0.9: connection lost");
    changed_.wait_for(lock, std::chrono::milliseconds(5),
                      [this] { return gone_ || ended_ || !blocks_.empty(); });
    if (gone_ && blocks_.empty()) return io_error("10.0.0.9: connection lost");
    if (blocks_.empty()) return ended_ ? drivers::ReadState::end : drivers::ReadState::more;
    block = std::move(blocks_.front());
    blocks_.pop_front();
    ++read_;
    in_hand_ = true;
    changed_.notify_all();
    return drivers::ReadState::more;
  }

 private:
  void set_gone(bool gone) {
    const std::lock_guard lock(mutex_);
    gone_ = gone;
    changed_.notify_all();
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<SampleBlock> blocks_;
  bool gone_ = false, ended_ = false, gone_once_ = false;
  bool in_hand_ = false;  // the station has read a block and not processed it yet
  std::size_t lost_ = 0;  // the datum is lost if this is greater than the size of mark_before_
  std::size_t given_ = 0, read_ = 0;  // numbers of blocks
  std::vector<std::size_t> mark_before_;
};

class FedDriver final : public drivers::Driver {
 public:
  FedDriver(std::string name, std::shared_ptr<Feed> feed)
      : name_(std::move(name)), feed_(std::move(feed)) {}
  drivers::DeviceInfo info() const override {
    drivers::DeviceInfo info;
    info.name = name_;
    info.driver = "fed";
    info.rate_hz = 1000;
    info.datum_lost = feed_->datum_lost();
    return info;
  }
  Status open() override { return feed_->open(); }
  int marks_passed() const override { return feed_->marks_passed(); }
  Result<drivers::ReadState> read(SampleBlock& block, std::chrono::milliseconds) override {
    return feed_->read(block);
  }

 private:
  std::string name_;
  std::shared_ptr<Feed> feed_;
};

inline drivers::DriverSpec fed_by(std::shared_ptr<Feed> feed, bool live = true) {
  drivers::DriverSpec spec;
  spec.driver = "fed";
  spec.name = "daq";
  spec.live = spec.recorded = live;
  spec.encoder.counts = live;
  if (!live) spec.source_path = "/logs/of_a_test.csv";
  spec.make = [feed]() -> Result<std::unique_ptr<drivers::Driver>> {
    return std::make_unique<FedDriver>("daq", feed);
  };
  spec.source_info = [](const drivers::Driver&) { return drivers::SourceInfo{}; };
  return spec;
}

// Collects the events of a station in their order. Thread-safe.
class Events {
 public:
  StationEvents sink() {
    StationEvents events;
    events.live = [this](std::string json) { add(live_, std::move(json)); };
    events.run_event = [this](std::string json) { add(run_events_, std::move(json)); };
    events.trouble = [this](Axis, std::int64_t run, const Trouble& trouble) {
      add(troubles_, std::to_string(run) + " " + trouble_line(trouble));
    };
    return events;
  }
  // Waits for the first event of a run that contains all these texts. Returns it, or "" if none
  // arrived.
  std::string wait_for(const std::vector<std::string>& parts) { return wait(run_events_, parts); }
  std::string wait_for_live(const std::vector<std::string>& parts) { return wait(live_, parts); }
  // The first live message until now that contains all these texts, or "".
  std::string find_live(const std::vector<std::string>& parts) {
    return wait(live_, parts, std::chrono::seconds(0));
  }
  std::string wait_for_trouble(const std::vector<std::string>& parts) {
    return wait(troubles_, parts);
  }
  std::size_t count(const std::string& part) {
    const std::lock_guard lock(mutex_);
    return static_cast<std::size_t>(
        std::count_if(run_events_.begin(), run_events_.end(),
                      [&](const auto& json) { return json.find(part) != std::string::npos; }));
  }

 private:
  void add(std::vector<std::string>& to, std::string json) {
    const std::lock_guard lock(mutex_);
    to.push_back(std::move(json));
    changed_.notify_all();
  }
  std::string wait(const std::vector<std::string>& in, const std::vector<std::string>& parts,
                   std::chrono::seconds limit = std::chrono::seconds(20)) {
    std::unique_lock lock(mutex_);
    std::string found;
    changed_.wait_for(lock, limit, [&] {
      for (const auto& json : in) {
        const auto has = [&](const auto& part) { return json.find(part) != std::string::npos; };
        if (!std::all_of(parts.begin(), parts.end(), has)) continue;
        found = json;
        return true;
      }
      return false;
    });
    return found;
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> live_, run_events_, troubles_;
};

class FedStation : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "mdof-station-XXXXXX").string();
    ASSERT_TRUE(::mkdtemp(name.data()));
    folder_ = name;
    open_store();
    make_station();
  }
  void TearDown() override {
    station_.reset();
    keeper_.reset();
    std::filesystem::remove_all(folder_);
  }

  void open_store() {
    Storekeeper::Options options{folder_ / "mdof.db"};
    options.commit_interval = std::chrono::milliseconds(5);
    keeper_ = Storekeeper::start(
                  options, {[](std::int64_t, std::int64_t) {}, [](std::int64_t, const Error&) {}})
                  .value();
  }
  // `index_mm`: machine position of the encoder's reference mark.
  void make_station(bool live = true, std::optional<double> index_mm = std::nullopt) {
    feed_ = std::make_shared<Feed>();
    auto spec = fed_by(feed_, live);
    spec.encoder.index_mm = index_mm;
    station_ = std::make_unique<Station>(AxisConfig{five_probe_rig(), {std::move(spec)}}, options_,
                                         "# mdofd.toml of a test\n", folder_ / "recordings",
                                         *keeper_, events_.sink());
  }
  // Begins the run of the request, or resumes an interrupted run.
  Result<std::int64_t> start(const RunRequest& request = {}) {
    std::promise<Result<std::int64_t>> id;
    station_->start_run(request, [&](const auto& begun) { id.set_value(begun); });
    return id.get_future().get();
  }
  Result<std::int64_t> stop(bool abort = false) {
    std::promise<Result<std::int64_t>> id;
    const HistoryEntry action = action_now(abort ? "run.abort" : "run.stop", this_process());
    station_->stop_run(abort, action, [&](const auto& ended) { id.set_value(ended); });
    return id.get_future().get();
  }
  // Feeds scans begin ... end - 1 in blocks of 100 scans.
  void give(const TestAxis& axis, std::size_t begin = 0, std::size_t end = SIZE_MAX) {
    for (std::size_t i = begin; i < std::min(end, axis.scans()); i += 100)
      feed_->give(axis.block(i, std::min(i + 100, end)));
    feed_->wait_until_read();
  }
  mdof::Run stored(std::int64_t id) {
    auto store = store::Store::open(folder_ / "mdof.db", store::Access::read_only);
    return store.value().run(id).value();
  }
  static std::string notices(const mdof::Run& run) {
    std::string all;
    all += test::shown(run.header.notices);
    return all;
  }

  PipelineOptions options_;
  std::filesystem::path folder_;
  std::unique_ptr<Storekeeper> keeper_;
  Events events_;  // must outlive the station
  std::shared_ptr<Feed> feed_;
  std::unique_ptr<Station> station_;
};

}  // namespace mdof::daemon
