// The methods of mdofd, with stored runs and an axis. A test feeds the samples of the axis'
// device.
#pragma once

#include <simdjson.h>

#include "daemon/rpc/codes.h"
#include "tests/daemon/methods/methods_bench.h"
#include "tests/daemon/station/fed_station.h"

namespace mdof::daemon {

// One reply of a method. Its values are found by JSON pointer, for example "/result/runs/0/note".
class Answer {
 public:
  explicit Answer(std::string text) : text_(std::move(text)) {}
  const std::string& text() const { return text_; }
  // The value as minified JSON; empty if the reply has no such value.
  std::string at(std::string_view pointer) const {
    simdjson::dom::parser parser;
    simdjson::dom::element e;
    if (parser.parse(text_).at_pointer(pointer).get(e)) return {};
    return simdjson::minify(e);
  }
  double number(std::string_view pointer) const {
    const std::string text = at(pointer);
    return text.empty() ? kNaN : std::strtod(text.c_str(), nullptr);
  }
  // Number of elements of the list; 0 if the reply has no such list.
  std::size_t size(std::string_view pointer) const {
    simdjson::dom::parser parser;
    simdjson::dom::array list;
    return parser.parse(text_).at_pointer(pointer).get(list) ? 0 : list.size();
  }
  // The code of the error; 0 if the reply is not an error.
  int code() const {
    const double code = number("/error/code");
    return std::isnan(code) ? 0 : static_cast<int>(code);
  }
  std::string message() const { return at("/error/message"); }

 private:
  std::string text_;
};

// A fixture for tests. Its runs are measured on a simulated axis with known errors.
class MethodsTest : public FedStation {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "mdof-methods-XXXXXX").string();
    ASSERT_TRUE(::mkdtemp(name.data()));
    folder_ = name;
    bench_ = std::make_unique<MethodsBench>(folder_, store::Durability::off);
  }
  void TearDown() override {
    bench_.reset();
    std::filesystem::remove_all(folder_);
  }

  Answer call(const std::string& method, const std::string& params = "{}") {
    return Answer(bench_->call(method, params));
  }
  void add_axis(bool live = true) {
    feed_ = std::make_shared<Feed>();
    bench_->stations.push_back(std::make_unique<Station>(
        AxisConfig{five_probe_rig(), {fed_by(feed_, live)}}, PipelineOptions(), "",
        folder_ / "recordings", *bench_->keeper, events_.sink()));
  }
  // Adds a run that the pipeline measures in both directions. Returns the id of the run.
  std::int64_t add_run(char axis = 'X', const std::string& note = "", bool whole = true) {
    const Rig rig = five_probe_rig(axis);
    Pipeline pipeline = Pipeline::create(rig, {}).value();
    TestAxis moved;
    moved.pass_both_ways({0, 5, 10, 15, 20});
    SampleBlock block = moved.whole();
    for (auto& time_ns : block.time_ns)
      time_ns += runs_ * 1'000'000'000'000;  // each run has its own range of time
    EXPECT_TRUE(pipeline.push(block));
    mdof::Run run = pipeline.finish().value();
    run.header.note = note;
    run.header.started_utc = "2026-11-23T07:00:00.000Z";
    run.header.provenance.recording_kind = "csv";
    if (!recorded_utc_.empty()) {
      run.header.started_utc = recorded_utc_;
      run.header.start_known = true;
      run.header.provenance.recording_kind = "recording";
    }
    run.header.provenance.recording_path = "/logs/" + note + axis + ".csv";
    run.header.provenance.recording_sha256 = std::string(63, '0') + static_cast<char>('a' + runs_);
    run.header.provenance.rig_text = rig.text;
    run.header.provenance.model = "rigid";
    if (!whole) run.header.state = RunState::partial;
    run.header.simulated = simulated_;
    run.header.supersedes = supersedes_;
    std::promise<std::int64_t> id;
    EXPECT_TRUE(bench_->keeper->post(
        [&](store::Store& store) { id.set_value(store.add_run(run).value()); }));
    ++runs_;
    return id.get_future().get();
  }

  std::unique_ptr<MethodsBench> bench_;
  int runs_ = 0;
  bool simulated_ = false;  // applies to runs that are added from now on
  std::optional<std::int64_t> supersedes_;
  // Start of the recording, for runs that are added from now on; empty: the run is from a CSV log.
  std::string recorded_utc_;
};

}  // namespace mdof::daemon
